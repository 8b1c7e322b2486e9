/*
 * wide_tree.h - traverses a tree of eight-wide nodes, with a stack of children: kernels of width 8.
 */
#ifndef RT_KERNELS_ACCEL_WIDE_TREE_H
#define RT_KERNELS_ACCEL_WIDE_TREE_H

#include "accel/boxes.h"
#include "count.h"
#include "math/lanes.h"
#include "math/ray.h"
#include "scene.h"
#include "types.h"

/* A leaf: a child with RT_CHILD_LEAF. */
struct leaf {
    uint child;
};

/* ---- The nearest hit -------------------------------------------------------- */

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
                             float t, struct stack *stack, uint *count, struct leaf *leaf)
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
            leaf->child = child;
            return true;
        }
    }
    return false;
}

/* ---- Any hit ---------------------------------------------------------------- */

struct any_stack {
    uint child[RT_BVH_STACK];
};

/* Fills the stack with a root; returns its count. */
INLINE_ALWAYS uint start_any_at(struct any_stack *stack, uint root)
{
    stack->child[0] = root;
    return 1u;
}

/*
 * Returns the first child hit, and pushes the others in reverse: the builder put the largest first.
 */
INLINE_ALWAYS uint push_later(struct any_stack *stack, uint *count, global const rt_bvh_node *node,
                              uint mask)
{
    const uint first = lane_first(mask);
    for (mask &= mask - 1u; mask;) {
        const uint lane = lane_last(mask);
        stack->child[(*count)++] = node->child[lane];
        mask ^= 1u << lane;
    }
    return node->child[first];
}

/* Goes on to the next leaf hit; false when there is none. The stack begins with the root. */
INLINE_ALWAYS bool next_leaf_any(const struct scene *scene, const struct ray_slabs *slabs,
                                 const struct ray *ray, struct any_stack *stack, uint *count,
                                 struct leaf *leaf)
{
    while (*count) {
        uint child = stack->child[--(*count)];
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
            leaf->child = child;
            return true;
        }
    }
    return false;
}

#endif
