/*
 * tree.h - traverses the tree of photons: which blocks of eight lie nearer to a point than a
 * radius.
 *
 * Distances are computed without contraction, in one order of operations, the host's: all roundings
 * are monotonic, so the distance to a box is never above that to a photon in it, and no photon is
 * missed.
 */
#ifndef RT_KERNELS_PHOTON_TREE_H
#define RT_KERNELS_PHOTON_TREE_H

#include "math/frame.h"
#include "math/lanes.h"
#include "surface/gather_point.h"
#include "types.h"

/* The tree as kernels hold it. */
struct photon_tree {
    rt_photon_tree shape;
    global const rt_photon_node *nodes;
    global const rt_photon_block *blocks;
};

/* A query point: photons are searched around it. */
struct photon_query {
    float3 position;
    float3 normal;
    /* the bits of a cosine to the normal that count: without the sign, photons of both sides do */
    uint cosine_bits;
    global const rt_gather_point *point;  /* the gather point that scatters them, ... */
    global const rt_scene_header *header; /* ... and its scene */
};

static inline struct photon_query query_of_point(global const rt_gather_point *point,
                                                 global const rt_scene_header *header)
{
    struct photon_query query;
    query.position = row3(point->position);
    query.normal = row3(point->normal);
    query.cosine_bits = point_is_translucent(point) ? 0x7fffffffu : 0xffffffffu;
    query.point = point;
    query.header = header;
    return query;
}

INLINE_ALWAYS float8 squared_length8(float8 x, float8 y, float8 z)
{
#pragma OPENCL FP_CONTRACT OFF
    const float8 xx = x * x, yy = y * y, zz = z * z;
    return xx + yy + zz;
}

/* Squared distances of eight photons. */
INLINE_ALWAYS float8 photon_distances(global const rt_photon_block *block,
                                      const struct photon_query *query)
{
    return squared_length8(query->position.x - vload8(0, block->position[0]),
                           query->position.y - vload8(0, block->position[1]),
                           query->position.z - vload8(0, block->position[2]));
}

/*
 * Which of eight photons have a normal close to the point's, or to its opposite where the surface
 * transmits, and so are accepted.
 */
INLINE_ALWAYS int8 photons_accepted(global const rt_photon_block *block,
                                    const struct photon_query *query)
{
#pragma OPENCL FP_CONTRACT OFF
    const float8 x = vload8(0, block->normal[0]) * query->normal.x;
    const float8 y = vload8(0, block->normal[1]) * query->normal.y;
    const float8 z = vload8(0, block->normal[2]) * query->normal.z;
    return as_float8(as_uint8(x + y + z) & query->cosine_bits) > RT_PHOTON_NORMAL_COSINE;
}

/* How far eight intervals on an axis are from low .. high. */
INLINE_ALWAYS float8 gaps(global const float *from, global const float *to, float low, float high)
{
    return lane_max(lane_max(vload8(0, from) - high, low - vload8(0, to)), (float8)(0.0f));
}

/*
 * Squared distances of the boxes of a node's children from a box: never above those from a point in
 * it.
 */
INLINE_ALWAYS float8 box_gaps(global const rt_photon_node *node, float3 low, float3 high)
{
    return squared_length8(gaps(node->bounds[0], node->bounds[3], low.x, high.x),
                           gaps(node->bounds[1], node->bounds[4], low.y, high.y),
                           gaps(node->bounds[2], node->bounds[5], low.z, high.z));
}

/* Squared distances of the boxes of a node's children. */
INLINE_ALWAYS float8 box_distances(global const rt_photon_node *node,
                                   const struct photon_query *query)
{
    return box_gaps(node, query->position, query->position);
}

/* Squared distances of their farthest corners. */
INLINE_ALWAYS float8 box_reaches(global const rt_photon_node *node,
                                 const struct photon_query *query)
{
    const float8 px = (float8)(query->position.x), py = (float8)(query->position.y),
                 pz = (float8)(query->position.z);
    const float8 x = lane_max(vload8(0, node->bounds[3]) - px, px - vload8(0, node->bounds[0]));
    const float8 y = lane_max(vload8(0, node->bounds[4]) - py, py - vload8(0, node->bounds[1]));
    const float8 z = lane_max(vload8(0, node->bounds[5]) - pz, pz - vload8(0, node->bounds[2]));
    return squared_length8(x, y, z);
}

/* ---- Traversal ---------------------------------------------------------- */

/* An entry of the stack: a node's level in the upper bits, and its index in that level. */
#define ENTRY_LEVEL_SHIFT 28u
#define ENTRY_INDEX 0x0fffffffu

/*
 * Where traversals begin: at the root, or at the few nodes of level 0 that any of a group of points
 * needs, the last first.
 */
#define PHOTON_STARTS 16u
struct photon_start {
    uint entry[PHOTON_STARTS];
    uint count;
};

INLINE_ALWAYS struct photon_start start_at_root(const struct photon_tree *tree)
{
    struct photon_start start;
    start.entry[0] = (tree->shape.levels - 1u) << ENTRY_LEVEL_SHIFT;
    start.count = tree->shape.levels > 0u ? 1u : 0u;
    return start;
}

struct tree_traversal {
    uint stack[RT_PHOTON_STACK];
    uint count;
};

INLINE_ALWAYS void traversal_start(struct tree_traversal *traversal,
                                   const struct photon_start *start)
{
    traversal->count = start->count;
    for (uint i = 0u; i < start->count; i++)
        traversal->stack[i] = start->entry[i];
}

/*
 * Goes on to the next node of level 0; false at the end. `mask` then has a bit for each of its
 * blocks, from *first on, that comes nearer than the squared radius, which may shrink during a
 * traversal.
 */
INLINE_ALWAYS bool traversal_next(struct tree_traversal *traversal, const struct photon_tree *tree,
                                  const struct photon_query *query, float squared_radius,
                                  uint *first, uint *mask)
{
    while (traversal->count > 0u) {
        const uint entry = traversal->stack[--traversal->count];
        const uint level = entry >> ENTRY_LEVEL_SHIFT, index = entry & ENTRY_INDEX;
        global const rt_photon_node *node = tree->nodes + tree->shape.first_node[level] + index;
        uint near = lane_mask(box_distances(node, query) < squared_radius);
        if (level == 0u) {
            *first = 8u * index;
            *mask = near;
            if (near)
                return true;
        } else
            for (; near; near &= near - 1u)
                traversal->stack[traversal->count++] =
                    ((level - 1u) << ENTRY_LEVEL_SHIFT) | (8u * index + lane_first(near));
    }
    return false;
}

/*
 * Where the traversals of all points in a box may begin, for one squared radius: they meet the same
 * blocks in the same order as from the root, which it is when too many nodes come near.
 */
INLINE_NEVER struct photon_start start_near(const struct photon_tree *tree, float3 low, float3 high,
                                            float squared_radius)
{
    uint stack[RT_PHOTON_STACK];
    const struct photon_start root = start_at_root(tree);
    struct photon_start start;
    /* filled from the end, for the last are visited first */
    uint entries = root.count, free = PHOTON_STARTS;
    stack[0] = root.entry[0];
    while (entries > 0u) {
        const uint entry = stack[--entries];
        const uint level = entry >> ENTRY_LEVEL_SHIFT, index = entry & ENTRY_INDEX;
        global const rt_photon_node *node = tree->nodes + tree->shape.first_node[level] + index;
        uint near = lane_mask(box_gaps(node, low, high) < squared_radius);
        if (level == 0u && near) {
            if (free == 0u)
                return root;
            start.entry[--free] = entry;
            continue;
        }
        for (; near; near &= near - 1u)
            stack[entries++] =
                ((level - 1u) << ENTRY_LEVEL_SHIFT) | (8u * index + lane_first(near));
    }
    start.count = PHOTON_STARTS - free;
    for (uint i = 0u; i < start.count; i++)
        start.entry[i] = start.entry[free + i];
    return start;
}

/* Photons under a node, from the packing of the tree. */
INLINE_ALWAYS uint photons_under(const struct photon_tree *tree, uint level, uint index)
{
    const uint each = 3u * (level + 2u); /* as a power of two */
    const ulong begin = (ulong)index << each, end = (ulong)(index + 1u) << each;
    return (uint)(min(end, (ulong)tree->shape.photon_count) - begin);
}

/* Photons of all kinds nearer than a squared radius, or `enough` when there are more. */
INLINE_ALWAYS uint count_photons(const struct photon_tree *tree, const struct photon_query *query,
                                 float squared_radius, uint enough)
{
    uint stack[RT_PHOTON_STACK];
    uint entries = 0u, count = 0u;
    if (tree->shape.levels > 0u)
        stack[entries++] = (tree->shape.levels - 1u) << ENTRY_LEVEL_SHIFT;
    while (entries > 0u && count < enough) {
        const uint entry = stack[--entries];
        const uint level = entry >> ENTRY_LEVEL_SHIFT, index = entry & ENTRY_INDEX;
        global const rt_photon_node *node = tree->nodes + tree->shape.first_node[level] + index;
        uint near = lane_mask(box_distances(node, query) < squared_radius);
        /* A child that is inside by more than rounding counts as a whole. */
        const uint inside =
            near & lane_mask(box_reaches(node, query) < squared_radius * (1.0f - 0x1p-20f));
        for (; near; near &= near - 1u) {
            const uint lane = lane_first(near), child = 8u * index + lane;
            if (level == 0u)
                count += inside >> lane & 1u
                             ? min(8u, tree->shape.photon_count - 8u * child)
                             : popcount(lane_mask(photon_distances(tree->blocks + child, query) <
                                                  squared_radius));
            else if (inside >> lane & 1u)
                count += photons_under(tree, level - 1u, child);
            else
                stack[entries++] = ((level - 1u) << ENTRY_LEVEL_SHIFT) | child;
        }
    }
    return min(count, enough);
}

#endif
