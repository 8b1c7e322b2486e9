/* pairs.c - splits the children of wide nodes and the lanes of blocks, from the root down. */
#include "accel/pairs.h"

#include <assert.h>
#include <math.h>
#include <string.h>

enum { LEAF_LANES = 2 };

/* A box, and what is in it. */
typedef struct item {
    float bounds[6]; /* lo x, lo y, lo z, hi x, hi y, hi z */
    uint32_t child, lanes;
} item;

typedef struct writer {
    rt_pair_node *out;
    uint32_t at;      /* the next node */
    uint32_t deepest; /* levels so far */
    int is_even;      /* sides have as many items, whatever their areas */
    const rt_bvh_node *nodes;
    const rt_tri_block *blocks;
} writer;

uint64_t rt_pairs_most(const rt_bvh_counts *counts)
{
    const uint64_t leaves = (uint64_t)counts->blocks + counts->analytic;
    return leaves + (uint64_t)counts->blocks * (RT_BVH_WIDTH / LEAF_LANES - 1) + 1;
}

/* ---- Splits -------------------------------------------------------------------------------- */

static void widen(float bounds[6], const float by[6])
{
    for (int a = 0; a < 3; a++) {
        bounds[a] = fminf(bounds[a], by[a]);
        bounds[3 + a] = fmaxf(bounds[3 + a], by[3 + a]);
    }
}

static void bound(float bounds[6], const item *items, int count)
{
    for (int a = 0; a < 3; a++) {
        bounds[a] = INFINITY;
        bounds[3 + a] = -INFINITY;
    }
    for (int i = 0; i < count; i++)
        widen(bounds, items[i].bounds);
}

static float area(const item *items, int count)
{
    float b[6];
    bound(b, items, count);
    const float x = b[3] - b[0], y = b[4] - b[1], z = b[5] - b[2];
    return x * (y + z) + y * z;
}

/* By the centres along an axis; stable, so that the order depends on nothing else. */
static void sort(item *items, int count, int axis)
{
    for (int i = 1; i < count; i++) {
        const item moved = items[i];
        const float centre = moved.bounds[axis] + moved.bounds[3 + axis];
        int at = i;
        for (; at > 0 && items[at - 1].bounds[axis] + items[at - 1].bounds[3 + axis] > centre; at--)
            items[at] = items[at - 1];
        items[at] = moved;
    }
}

/*
 * Sorts at least two items so that the first of them, whose number is returned, are one side. Lanes
 * fill leaves but for the last.
 */
static int split(item *items, int count, int is_even)
{
    const int step = items->lanes ? LEAF_LANES : 1;
    const int half = (count + 2 * step - 1) / (2 * step) * step;
    const int first = is_even ? half : step, last = is_even ? half : count - 1;
    float least = INFINITY;
    int best_axis = 0, best = first;
    for (int axis = 0; axis < 3; axis++) {
        sort(items, count, axis);
        for (int left = first; left <= last; left += step) {
            const float cost = area(items, left) * (float)left +
                               area(items + left, count - left) * (float)(count - left);
            if (cost < least) {
                least = cost;
                best = left;
                best_axis = axis;
            }
        }
    }
    sort(items, count, best_axis);
    return best;
}

/* ---- What is split --------------------------------------------------------------------------- */

/* The children of a wide node; returns their number. */
static int children_of(item items[RT_BVH_WIDTH], const rt_bvh_node *node)
{
    int count = 0;
    for (int lane = 0; lane < RT_BVH_WIDTH; lane++) {
        if (node->child[lane] == RT_NONE)
            continue;
        for (int row = 0; row < 6; row++)
            items[count].bounds[row] = node->bounds[row][lane];
        items[count].lanes = 0;
        items[count++].child = node->child[lane];
    }
    return count;
}

/*
 * The box of a lane; where that is a parallelogram with room for the 1e-6 by which the intersection
 * moves its far edges, and for rounding.
 */
static void bound_lane(float bounds[6], const rt_tri_block *block, int lane)
{
    const int is_quad = (block->prim[lane] & RT_BLOCK_QUAD) != 0;
    for (int a = 0; a < 3; a++) {
        const float p = block->v0[a][lane], q = block->v1[a][lane], r = block->v2[a][lane];
        const float far = is_quad ? q + (r - p) : p;
        float lo = fminf(fminf(p, q), fminf(r, far)), hi = fmaxf(fmaxf(p, q), fmaxf(r, far));
        const float reach = fmaxf(-lo, hi),
                    room = 4e-6f * (fabsf(q - p) + fabsf(r - p)) + 0x1p-21f * reach;
        bounds[a] = is_quad ? lo - room : lo;
        bounds[3 + a] = is_quad ? hi + room : hi;
    }
}

/* The lanes of a block, within its box; returns their number. */
static int lanes_of(item items[RT_BVH_WIDTH], const rt_tri_block *blocks, const item *whole)
{
    const rt_tri_block *block = blocks + (whole->child & RT_CHILD_INDEX);
    int count = 0;
    for (int lane = 0; lane < RT_BVH_WIDTH; lane++) {
        if (block->prim[lane] == RT_NONE)
            continue;
        bound_lane(items[count].bounds, block, lane);
        for (int a = 0; a < 3; a++) {
            items[count].bounds[a] = fmaxf(items[count].bounds[a], whole->bounds[a]);
            items[count].bounds[3 + a] = fminf(items[count].bounds[3 + a], whole->bounds[3 + a]);
        }
        items[count].child = whole->child;
        items[count++].lanes = 1u << lane;
    }
    return count;
}

/* ---- Nodes ----------------------------------------------------------------------------------- */

static uint32_t write_node(writer *w, item *items, int count, uint32_t level);

/* Makes a leaf of an analytic shape, or of lanes of a block; returns whether it holds the items. */
static int join(item *out, const item *items, int count)
{
    *out = *items;
    for (int i = 1; i < count; i++)
        out->lanes |= items[i].lanes;
    return out->lanes ? count <= LEAF_LANES : count == 1 && (out->child & RT_CHILD_ANALYTIC) != 0;
}

/* Writes what is below one side of a node, and refers to it there. */
static void write_side(writer *w, uint32_t node, int side, item *items, int count, uint32_t level)
{
    item below[RT_BVH_WIDTH], leaf;
    float bounds[6];
    bound(bounds, items, count);
    memcpy(w->out[node].bounds[side], bounds, sizeof bounds);
    if (count == 1 && items->lanes == 0 && !(items->child & RT_CHILD_LEAF)) {
        count = children_of(below, w->nodes + items->child);
        items = below;
    } else if (count == 1 && items->lanes == 0 && !(items->child & RT_CHILD_ANALYTIC)) {
        count = lanes_of(below, w->blocks, items);
        items = below;
    }
    const int is_leaf = join(&leaf, items, count);
    const uint32_t child = is_leaf ? leaf.child : write_node(w, items, count, level + 1);
    w->out[node].child[side] = child;
    w->out[node].lanes[side] = is_leaf ? leaf.lanes : 0;
}

/* A node of these items; one side is empty where there is one item alone. */
static uint32_t write_node(writer *w, item *items, int count, uint32_t level)
{
    const uint32_t node = w->at++;
    const int left = count > 1 ? split(items, count, w->is_even) : count;
    w->deepest = level > w->deepest ? level : w->deepest;
    for (int side = 0; side < 2; side++) {
        const int first = side ? left : 0, held = side ? count - left : left;
        bound(w->out[node].bounds[side], NULL, 0);
        w->out[node].child[side] = RT_NONE;
        w->out[node].lanes[side] = 0;
        if (held > 0)
            write_side(w, node, side, items + first, held, level);
    }
    return node;
}

uint32_t rt_pairs_write(rt_pair_node *out, uint32_t first, const rt_bvh_node *nodes, uint32_t root,
                        const rt_tri_block *blocks)
{
    writer w = {out, first, 0, 0, nodes, blocks};
    for (; w.is_even < 2; w.is_even++) {
        item items[RT_BVH_WIDTH];
        const int count = children_of(items, nodes + root);
        w.at = first;
        w.deepest = 0;
        write_node(&w, items, count, 1);
        if (w.deepest <= RT_PAIR_STACK)
            break;
    }
    assert(w.deepest <= RT_PAIR_STACK);
    return w.at - first;
}
