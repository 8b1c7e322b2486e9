/*
 * pair_tree.h - traverses a tree of two-wide nodes: kernels of width 1, where a work-item has one
 * ray.
 *
 * What waits on the stack are sides of nodes whose boxes were hit, without where: the box is tested
 * once more when its turn comes, against the nearest hit by then.
 */
#ifndef RT_KERNELS_ACCEL_PAIR_TREE_H
#define RT_KERNELS_ACCEL_PAIR_TREE_H

#include "accel/boxes.h"
#include "count.h"
#include "math/lanes.h"
#include "math/ray.h"
#include "scene.h"
#include "types.h"

/* A leaf: a child with RT_CHILD_LEAF, and the lanes of its block. */
struct leaf {
    uint child, lanes;
};

/* Sides to visit: the index of the node times 4, and a bit for each of the two. */
struct stack {
    uint sides[RT_PAIR_STACK];
};

#define any_stack stack

/* Fills the stack with a root; returns its count. */
INLINE_ALWAYS uint start_at(struct stack *stack, uint root)
{
    stack->sides[0] = root << 2 | 3u;
    return 1u;
}

INLINE_ALWAYS uint start_any_at(struct stack *stack, uint root)
{
    return start_at(stack, root);
}

/*
 * Goes on to the next leaf whose box the ray enters in [t_min, t_max], nearest side first; false
 * when there is none.
 */
INLINE_ALWAYS bool next_leaf_before(const struct scene *scene, const struct ray_slabs *slabs,
                                    float t_min, float t_max, struct stack *stack, uint *count,
                                    struct leaf *leaf, const uint counted)
{
    while (*count) {
        uint sides = stack->sides[--(*count)];
        for (;;) {
            COUNT(scene, counted, slabs->near_shift.x);
            global const rt_pair_node *node = scene->nodes + (sides >> 2);
            float entry, other;
            const bool left =
                (sides & 1u) && enters_box(node->bounds[0], slabs, t_min, t_max, &entry);
            const bool right =
                (sides & 2u) && enters_box(node->bounds[1], slabs, t_min, t_max, &other);
            if (!left && !right)
                break;
            const uint near = left && right ? other < entry : right;
            if (left && right)
                stack->sides[(*count)++] = (sides & ~3u) | (near ? 1u : 2u);
            const uint child = node->child[near];
            if (child & RT_CHILD_LEAF) {
                COUNT(scene, counted + 1u, slabs->near_shift.x);
                leaf->child = child;
                leaf->lanes = node->lanes[near];
                return true;
            }
            sides = child << 2 | 3u;
        }
    }
    return false;
}

/* The next leaf that begins no farther than t. */
INLINE_ALWAYS bool next_leaf(const struct scene *scene, const struct ray_slabs *slabs, float t_min,
                             float t, struct stack *stack, uint *count, struct leaf *leaf)
{
    return next_leaf_before(scene, slabs, t_min, t, stack, count, leaf, RT_COUNTER_NODES);
}

/* The next leaf of a ray that looks for any hit. */
INLINE_ALWAYS bool next_leaf_any(const struct scene *scene, const struct ray_slabs *slabs,
                                 const struct ray *ray, struct stack *stack, uint *count,
                                 struct leaf *leaf)
{
    return next_leaf_before(scene, slabs, ray->t_min, ray->t_max, stack, count, leaf,
                            RT_COUNTER_SHADOW_NODES);
}

#endif
