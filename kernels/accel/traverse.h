/*
 * traverse.h - the nearest hit of a ray, and whether anything is hit.
 *
 * The tree is eight wide. A leaf is a block of triangles, an analytic shape, or an instance, which
 * has a tree of its own. Ties: of two hits with equal t, the lower primitive wins, whatever order
 * they are met in.
 */
#ifndef RT_KERNELS_ACCEL_TRAVERSE_H
#define RT_KERNELS_ACCEL_TRAVERSE_H

#include "accel/boxes.h"
#include "accel/intersect.h"
#include "math/lanes.h"
#include "scene.h"
#include "shape/shapes.h"
#include "shape/surface_at.h"
#include "types.h"

/*
 * Takes the nearest of the block's hits in `mask` into *hit when it is nearer still and not before
 * t_min.
 */
INLINE_ALWAYS void take_block_hits(struct hit *hit, const struct block_hits *found, uint mask,
                                   float t_min, global const rt_tri_block *block, uint index)
{
    const float8 scale = 1.0f / found->det;
    float t[8], u[8], v[8];
    vstore8(found->t * scale, 0, t);
    vstore8(found->u * scale, 0, u);
    vstore8(found->v * scale, 0, v);
    for (; mask; mask &= mask - 1u) {
        const uint lane = lane_first(mask);
        const uint prim = block->prim[lane] & RT_BLOCK_PRIM;
        if (t[lane] >= t_min && (t[lane] < hit->t || (t[lane] == hit->t && prim < hit->prim))) {
            hit->t = t[lane];
            hit->u = u[lane];
            hit->v = v[lane];
            hit->prim = prim;
            hit->slot = index * RT_BVH_WIDTH + lane;
        }
    }
}

/*
 * Lets hits as far as the nearest through, ties included, and a rounding beyond: take_block_hits
 * compares exactly.
 */
INLINE_ALWAYS void test_block(const struct scene *scene, const struct ray *ray,
                              const struct ray_frame *frame, uint index, struct hit *hit)
{
    global const rt_tri_block *block = scene->blocks + index;
    const float reach = hit->t + fabs(hit->t) * 0x1p-22f;
    struct block_hits found;
    const uint mask = intersect_block(block, frame, ray->t_min, reach, &found);
    if (mask)
        take_block_hits(hit, &found, mask, ray->t_min, block, index);
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
                                uint mask, float8 entry)
{
    const uint first = lane_first(mask);
    mask &= mask - 1u;
    if (!mask)
        return node->child[first];

    float distance[8];
    vstore8(entry, 0, distance);
    const uint second = lane_first(mask);
    if (!(mask & (mask - 1u))) {
        const uint a = node->child[first], b = node->child[second];
        const bool in_order = distance[first] <= distance[second];
        stack->child[*count] = in_order ? b : a;
        stack->entry[*count] = in_order ? distance[second] : distance[first];
        (*count)++;
        return in_order ? a : b;
    }

    /* Three and more are rare: sort them in. */
    const uint base = *count;
    stack->child[base] = node->child[first];
    stack->entry[base] = distance[first];
    uint top = base + 1u;
    for (; mask; mask &= mask - 1u) {
        const uint lane = lane_first(mask);
        uint at = top++;
        for (; at > base && stack->entry[at - 1u] < distance[lane]; at--) {
            stack->entry[at] = stack->entry[at - 1u];
            stack->child[at] = stack->child[at - 1u];
        }
        stack->entry[at] = distance[lane];
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
            global const rt_bvh_node *node = scene->nodes + child;
            float8 entry;
            mask = intersect_boxes(node, slabs, t_min, t, &entry);
            if (!mask)
                break;
            child = push_farther(stack, count, node, mask, entry);
        }
        if (mask) {
            *leaf = child;
            return true;
        }
    }
    return false;
}

/*
 * Tests the triangles of an instance, through the tree of its mesh, with the ray in the mesh's
 * space. That tree has a stack of its own, so each of the two levels may be as deep as the builder
 * allows.
 */
INLINE_NEVER void test_instance(const struct scene *scene, const struct ray *ray,
                                global const rt_shape *shape, struct hit *hit)
{
    const struct ray own = ray_to_object(scene->transforms + shape->transform, ray);
    if (!can_follow(&own))
        return;
    const struct ray_frame frame = make_ray_frame(&own);
    /*
     * Within the mesh prim is the triangle; a triangle as near as the hit so far wins if the
     * instance comes first.
     */
    struct hit nearest = *hit;
    nearest.prim = shape->first_prim < hit->prim ? RT_NONE : 0u;
    nearest.slot = RT_NONE;
    if (scene->header->accel == RT_ACCEL_BVH) {
        const struct ray_slabs slabs = make_ray_slabs(&own);
        struct stack stack;
        uint count = start_at(&stack, shape->root), leaf;
        while (next_leaf(scene, &slabs, own.t_min, nearest.t, &stack, &count, &leaf))
            test_block(scene, &own, &frame, leaf & RT_CHILD_INDEX, &nearest);
    } else {
        for (uint i = 0; i < shape->block_count; i++)
            test_block(scene, &own, &frame, shape->first_block + i, &nearest);
    }
    if (nearest.slot == RT_NONE)
        return;
    *hit = nearest;
    hit->prim = shape->first_prim;
}

static inline void test_shape(const struct scene *scene, const struct ray *ray, uint index,
                              struct hit *hit)
{
    global const rt_shape *shape = scene->shapes + index;
    if (shape->kind == RT_SHAPE_INSTANCE) {
        struct hit nearest = *hit; /* by way of a copy, so that *hit can live in registers */
        test_instance(scene, ray, shape, &nearest);
        *hit = nearest;
        return;
    }
    uint part;
    const float t = intersect_shape(scene, shape, ray, &part);
    const uint prim = shape->first_prim;
    if (t < hit->t || (t == hit->t && t < INFINITY && prim < hit->prim)) {
        hit->t = t;
        hit->u = (float)part;
        hit->v = 0.0f;
        hit->prim = prim;
        hit->slot = index | RT_SLOT_ANALYTIC;
    }
}

INLINE_ALWAYS void test_leaf(const struct scene *scene, const struct ray *ray,
                             const struct ray_frame *frame, uint child, struct hit *hit)
{
    const uint index = child & RT_CHILD_INDEX;
    if (SELDOM(child & RT_CHILD_ANALYTIC))
        test_shape(scene, ray, scene->analytic[index], hit);
    else
        test_block(scene, ray, frame, index, hit);
}

INLINE_ALWAYS void traverse_closest(const struct scene *scene, const struct ray *ray,
                                    struct hit *hit)
{
    const struct ray_slabs slabs = make_ray_slabs(ray);
    const struct ray_frame frame = make_ray_frame(ray);
    struct hit nearest = *hit;
    struct stack stack;
    uint count = start_at(&stack, 0u), leaf;
    while (next_leaf(scene, &slabs, ray->t_min, nearest.t, &stack, &count, &leaf))
        test_leaf(scene, ray, &frame, leaf, &nearest);
    *hit = nearest;
}

/* Tests every primitive but the planes. */
static inline void test_all(const struct scene *scene, const struct ray *ray, struct hit *hit)
{
    const struct ray_frame frame = make_ray_frame(ray);
    for (uint i = 0; i < scene->header->block_count; i++)
        test_block(scene, ray, &frame, i, hit);
    for (uint i = 0; i < scene->header->analytic_count; i++)
        test_shape(scene, ray, scene->analytic[i], hit);
}

/*
 * The nearest hit in [t_min, t_max] of a ray that can be followed; false, and *hit without meaning,
 * when there is none.
 */
INLINE_NEVER bool closest_hit(const struct scene *scene, const struct ray *ray, struct hit *hit)
{
    hit->t = ray->t_max;
    hit->prim = RT_NONE;
    for (uint i = 0; i < scene->header->plane_count; i++)
        test_shape(scene, ray, scene->planes[i], hit);
    if (scene->header->accel == RT_ACCEL_BVH)
        traverse_closest(scene, ray, hit);
    else
        test_all(scene, ray, hit);
    return hit->prim != RT_NONE;
}

/*
 * Goes to the first child met, and pushes the others in reverse: the builder put the largest first.
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

/* Goes on to the next leaf met; false when there is none. The stack begins with the root. */
INLINE_ALWAYS bool next_leaf_any(const struct scene *scene, const struct ray_slabs *slabs,
                                 const struct ray *ray, uint *stack, uint *count, uint *leaf)
{
    while (*count) {
        uint child = stack[--(*count)];
        uint mask = 1u;
        while (!(child & RT_CHILD_LEAF)) {
            global const rt_bvh_node *node = scene->nodes + child;
            float8 entry;
            mask = intersect_boxes(node, slabs, ray->t_min, ray->t_max, &entry);
            if (!mask)
                break;
            child = push_later(stack, count, node, mask);
        }
        if (mask) {
            *leaf = child;
            return true;
        }
    }
    return false;
}

INLINE_ALWAYS bool block_occludes(const struct scene *scene, const struct ray *ray,
                                  const struct ray_frame *frame, uint index)
{
    struct block_hits found;
    return intersect_block(scene->blocks + index, frame, ray->t_min, ray->t_max, &found) != 0u;
}

/* Whether the ray meets the instance; as test_instance. */
INLINE_NEVER bool instance_occludes(const struct scene *scene, const struct ray *ray,
                                    global const rt_shape *shape)
{
    const struct ray own = ray_to_object(scene->transforms + shape->transform, ray);
    if (!can_follow(&own))
        return false;
    const struct ray_frame frame = make_ray_frame(&own);
    if (scene->header->accel == RT_ACCEL_BVH) {
        const struct ray_slabs slabs = make_ray_slabs(&own);
        uint stack[RT_BVH_STACK];
        uint count = 1u, leaf;
        stack[0] = shape->root;
        while (next_leaf_any(scene, &slabs, &own, stack, &count, &leaf))
            if (block_occludes(scene, &own, &frame, leaf & RT_CHILD_INDEX))
                return true;
        return false;
    }
    for (uint i = 0; i < shape->block_count; i++)
        if (block_occludes(scene, &own, &frame, shape->first_block + i))
            return true;
    return false;
}

static inline bool shape_occludes(const struct scene *scene, const struct ray *ray, uint index)
{
    global const rt_shape *shape = scene->shapes + index;
    uint part;
    return shape->kind == RT_SHAPE_INSTANCE ? instance_occludes(scene, ray, shape)
                                            : intersect_shape(scene, shape, ray, &part) < INFINITY;
}

INLINE_ALWAYS bool leaf_occludes(const struct scene *scene, const struct ray *ray,
                                 const struct ray_frame *frame, uint leaf)
{
    const uint index = leaf & RT_CHILD_INDEX;
    if (SELDOM(leaf & RT_CHILD_ANALYTIC))
        return shape_occludes(scene, ray, scene->analytic[index]);
    return block_occludes(scene, ray, frame, index);
}

INLINE_ALWAYS bool traverse_any(const struct scene *scene, const struct ray *ray)
{
    const struct ray_slabs slabs = make_ray_slabs(ray);
    const struct ray_frame frame = make_ray_frame(ray);
    uint stack[RT_BVH_STACK];
    uint count = 1u, leaf;
    stack[0] = 0u;
    while (next_leaf_any(scene, &slabs, ray, stack, &count, &leaf))
        if (leaf_occludes(scene, ray, &frame, leaf))
            return true;
    return false;
}

static inline bool all_occlude(const struct scene *scene, const struct ray *ray)
{
    const struct ray_frame frame = make_ray_frame(ray);
    for (uint i = 0; i < scene->header->block_count; i++)
        if (block_occludes(scene, ray, &frame, i))
            return true;
    for (uint i = 0; i < scene->header->analytic_count; i++)
        if (shape_occludes(scene, ray, scene->analytic[i]))
            return true;
    return false;
}

/* Whether a ray that can be followed meets anything in [t_min, t_max]; stops at the first. */
INLINE_NEVER bool occluded(const struct scene *scene, const struct ray *ray)
{
    for (uint i = 0; i < scene->header->plane_count; i++)
        if (shape_occludes(scene, ray, scene->planes[i]))
            return true;
    return scene->header->accel == RT_ACCEL_BVH ? traverse_any(scene, ray)
                                                : all_occlude(scene, ray);
}

#endif
