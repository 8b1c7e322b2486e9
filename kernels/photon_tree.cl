/*
 * photon_tree.cl - the tree of photons that are in order: its blocks, and the boxes of its nodes
 * level by level, to the bit those of lib/photon/photon_tree.c.
 */
#include "entry.h"
#include "types.h"

/* Each work-item fills a lane of a block. items: photons in order, as photon_order.cl has them. */
KERNEL fill_blocks(uint count, uint block_count, global const ulong *items,
                   global const rt_photon *photons, global rt_photon_block *blocks)
{
    const uint i = item_number(), lane = i & 7u;
    global rt_photon_block *block = blocks + i / 8u;
    if (i / 8u >= block_count)
        return;
    float3 position = (float3)(INFINITY), normal = (float3)(0.0f), flux = (float3)(0.0f),
           wi = (float3)(0.0f);
    if (i < count) {
        global const rt_photon *photon = photons + (uint)(items[i] & RT_INDEX_MASK);
        position = vload3(0, photon->position);
        normal = vload3(0, photon->normal);
        flux = vload3(0, photon->flux) * photon->shading;
        wi = vload3(0, photon->wi);
    }
    block->position[0][lane] = position.x;
    block->position[1][lane] = position.y;
    block->position[2][lane] = position.z;
    block->normal[0][lane] = normal.x;
    block->normal[1][lane] = normal.y;
    block->normal[2][lane] = normal.z;
    block->flux[0][lane] = flux.x;
    block->flux[1][lane] = flux.y;
    block->flux[2][lane] = flux.z;
    block->wi[0][lane] = wi.x;
    block->wi[1][lane] = wi.y;
    block->wi[2][lane] = wi.z;
}

/* Takes `count` of the rows [3][8] of low and high corners, or of points as both, into a box. */
static inline void write_bounds(global rt_photon_node *node, uint lane,
                                global const float (*low)[8], global const float (*high)[8],
                                uint count)
{
    for (uint axis = 0u; axis < 3u; axis++) {
        float lo = INFINITY, hi = -INFINITY;
        for (uint i = 0u; i < count; i++) {
            lo = low[axis][i] < lo ? low[axis][i] : lo;
            hi = high[axis][i] > hi ? high[axis][i] : hi;
        }
        node->bounds[axis][lane] = lo;
        node->bounds[3u + axis][lane] = hi;
    }
}

/* Each work-item writes the box of a lane of a node of level 0. */
KERNEL bound_blocks(uint count, uint node_count, global const rt_photon_block *blocks,
                    global rt_photon_node *nodes)
{
    const uint child = item_number();
    if (child / 8u >= node_count)
        return;
    const uint before = min(8u * child, count);
    global const rt_photon_block *block = blocks + child;
    write_bounds(nodes + child / 8u, child & 7u, block->position, block->position,
                 min(count - before, 8u));
}

/* The same of a higher level, whose nodes begin at `first`, and those below it at `below`. */
KERNEL bound_nodes(uint below, uint child_count, uint first, uint node_count,
                   global rt_photon_node *nodes)
{
    const uint child = item_number();
    if (child / 8u >= node_count)
        return;
    global const rt_photon_node *from = nodes + below + child;
    write_bounds(nodes + first + child / 8u, child & 7u, from->bounds, from->bounds + 3,
                 child < child_count ? 8u : 0u);
}
