/*
 * tree.h - traverses a BVH of eight-wide nodes: closest hit in front-to-back order, or any hit in
 * any order. A leaf is a block of triangles, an analytic shape or an instance.
 */
#ifndef RT_KERNELS_ACCEL_TREE_H
#define RT_KERNELS_ACCEL_TREE_H

#include "accel/boxes.h"
#include "accel/cutout.h"
#include "accel/intersect.h"
#include "count.h"
#include "math/lanes.h"
#include "math/ray.h"
#include "scene.h"
#include "types.h"

/* ---- The nearest hit -------------------------------------------------------- */

/*
 * Takes the nearest of the block's hits in `mask` into *hit when it is nearer still and not before
 * t_min; placed: as passes_lane says. `cuts`, a constant at each call: whether there may be
 * cutouts; the code for them, though not run, takes 3 % of the time of path tracing.
 */
INLINE_ALWAYS void take_block_hits(struct hit *hit, const struct scene *scene,
                                   const struct ray *ray, const struct block_hits *found, uint mask,
                                   uint index, uint placed, const bool cuts)
{
    global const rt_tri_block *block = scene->blocks + index;
    const struct lane_hits hits = lane_hits(found);
    for (; mask; mask &= mask - 1u) {
        const uint lane = lane_first(mask);
        const uint prim = block->prim[lane] & RT_BLOCK_PRIM;
        const uint slot = index * RT_BVH_WIDTH + lane;
        const float t = lane_hit(&hits, &hits.t, lane);
        if (t >= ray->t_min && (t < hit->t || (t == hit->t && prim < hit->prim))) {
            const float u = lane_hit(&hits, &hits.u, lane), v = lane_hit(&hits, &hits.v, lane);
            if (cuts && (block->prim[lane] & RT_BLOCK_CUTOUT) &&
                passes_lane(scene->header, ray, slot, placed, u, v))
                continue;
            hit->t = t;
            hit->u = u;
            hit->v = v;
            hit->prim = prim;
            hit->slot = slot;
        }
    }
}

/*
 * How far blocks are tested when the nearest hit so far is at t: ties included, and a rounding
 * error beyond. take_block_hits compares exactly.
 */
INLINE_ALWAYS float block_reach(float t)
{
    return t + fabs(t) * 0x1p-22f;
}

INLINE_ALWAYS void test_block(const struct scene *scene, const struct ray *ray,
                              const struct ray_frame *frame, uint index, uint placed,
                              struct hit *hit, const bool cuts)
{
    struct block_hits found;
    const uint mask =
        intersect_block(scene->blocks + index, frame, ray->t_min, block_reach(hit->t), &found);
    if (mask)
        take_block_hits(hit, scene, ray, &found, mask, index, placed, cuts);
}

/* Children still to visit, and where the ray enters them, the nearest of each node last. */
struct stack {
    uint child[RT_BVH_STACK];
    float entry[RT_BVH_STACK];
};

/* Fills the stack with a root; returns its count. */
INLINE_ALWAYS uint start_at(struct stack *stack, uint root)
{
    stack->child[0] = root;
    stack->entry[0] = -INFINITY;
    return 1u;
}

/* Returns the nearest of the node's children in `mask`, which is not 0, and pushes the others. */
INLINE_ALWAYS uint push_farther(struct stack *stack, uint *count, global const rt_bvh_node *node,
                                uint mask, const struct lane_array *distances)
{
    const uint first = lane_first(mask);
    mask &= mask - 1u;
    if (!mask)
        return node->child[first];

    const uint second = lane_first(mask);
    const float distance = lane_read(distances, first);
    if (!(mask & (mask - 1u))) {
        const uint a = node->child[first], b = node->child[second];
        const float other = lane_read(distances, second);
        const bool in_order = distance <= other;
        stack->child[*count] = in_order ? b : a;
        stack->entry[*count] = in_order ? other : distance;
        (*count)++;
        return in_order ? a : b;
    }

    /* Three or more are rare: insert them in order. */
    const uint base = *count;
    stack->child[base] = node->child[first];
    stack->entry[base] = distance;
    uint top = base + 1u;
    for (; mask; mask &= mask - 1u) {
        const uint lane = lane_first(mask);
        const float entered = lane_read(distances, lane);
        uint at = top++;
        for (; at > base && stack->entry[at - 1u] < entered; at--) {
            stack->entry[at] = stack->entry[at - 1u];
            stack->child[at] = stack->child[at - 1u];
        }
        stack->entry[at] = entered;
        stack->child[at] = node->child[lane];
    }
    *count = top - 1u;
    return stack->child[*count];
}

/* Takes the last child pushed that begins no farther than t; false when there is none. */
INLINE_ALWAYS bool pop_nearer(const struct stack *stack, uint *count, float t, uint *child)
{
    do {
        if (*count == 0u)
            return false;
        (*count)--;
    } while (stack->entry[*count] > t);
    *child = stack->child[*count];
    return true;
}

/*
 * Goes on to the next leaf that begins no farther than t, always to the nearest child of a node
 * first; false when there is none. The stack begins with the root.
 */
INLINE_ALWAYS bool next_leaf(const struct scene *scene, const struct ray_slabs *slabs, float t_min,
                             float t, struct stack *stack, uint *count, uint *leaf)
{
    uint child;
    while (pop_nearer(stack, count, t, &child)) {
        uint mask = 1u;
        while (!(child & RT_CHILD_LEAF)) {
            COUNT(scene, RT_COUNTER_NODES, slabs->near_shift.x);
            global const rt_bvh_node *node = scene->nodes + child;
            float8 entry;
            mask = intersect_boxes(node, slabs, t_min, t, &entry);
            if (!mask)
                break;
            const struct lane_array distances = lane_array(entry);
            child = push_farther(stack, count, node, mask, &distances);
        }
        if (mask) {
            COUNT(scene, RT_COUNTER_LEAVES, slabs->near_shift.x);
            *leaf = child;
            return true;
        }
    }
    return false;
}

/* ---- Any hit ---------------------------------------------------------------- */

/*
 * Returns the first child hit, and pushes the others in reverse: the builder put the largest first.
 */
INLINE_ALWAYS uint push_later(uint *stack, uint *count, global const rt_bvh_node *node, uint mask)
{
    const uint first = lane_first(mask);
    for (mask &= mask - 1u; mask;) {
        const uint lane = lane_last(mask);
        stack[(*count)++] = node->child[lane];
        mask ^= 1u << lane;
    }
    return node->child[first];
}

/* Goes on to the next leaf hit; false when there is none. The stack begins with the root. */
INLINE_ALWAYS bool next_leaf_any(const struct scene *scene, const struct ray_slabs *slabs,
                                 const struct ray *ray, uint *stack, uint *count, uint *leaf)
{
    while (*count) {
        uint child = stack[--(*count)];
        uint mask = 1u;
        while (!(child & RT_CHILD_LEAF)) {
            COUNT(scene, RT_COUNTER_SHADOW_NODES, slabs->near_shift.x);
            global const rt_bvh_node *node = scene->nodes + child;
            float8 entry;
            mask = intersect_boxes(node, slabs, ray->t_min, ray->t_max, &entry);
            if (!mask)
                break;
            child = push_later(stack, count, node, mask);
        }
        if (mask) {
            COUNT(scene, RT_COUNTER_SHADOW_LEAVES, slabs->near_shift.x);
            *leaf = child;
            return true;
        }
    }
    return false;
}

/* Whether one of the lanes in `mask`, some of which may be cutouts, does not let the ray pass. */
RARELY_CALLED bool cutouts_occlude(global const rt_scene_header *header, const struct ray *ray,
                                   const struct block_hits *found, uint mask, uint index,
                                   uint placed)
{
    global const rt_tri_block *block = scene_open(header).blocks + index;
    const struct lane_hits hits = lane_hits(found);
    for (; mask; mask &= mask - 1u) {
        const uint lane = lane_first(mask);
        if (!(block->prim[lane] & RT_BLOCK_CUTOUT) ||
            !passes_lane(header, ray, index * RT_BVH_WIDTH + lane, placed,
                         lane_hit(&hits, &hits.u, lane), lane_hit(&hits, &hits.v, lane)))
            return true;
    }
    return false;
}

INLINE_ALWAYS bool block_occludes(const struct scene *scene, const struct ray *ray,
                                  const struct ray_frame *frame, uint index, uint placed,
                                  const bool cuts)
{
    struct block_hits found;
    const uint mask = intersect_block(scene->blocks + index, frame, ray->t_min, ray->t_max, &found);
    if (!mask || !cuts)
        return mask != 0u;
    return cutouts_occlude(scene->header, ray, &found, mask, index, placed);
}

#endif
