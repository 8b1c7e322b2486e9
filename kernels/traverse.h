/*
 * traverse.h - the nearest hit of a ray, and whether anything is hit.
 *
 * The tree is eight wide: a node's children are tested at once against the ray's slabs, the
 * near and far plane of each axis chosen by the sign of the direction. Slabs are widened by
 * the rounding of their distances, so no box that the ray touches is missed (Ize, "Robust BVH
 * Ray Traversal", JCGT 2(2), 2013); a direction component of 0 makes infinite distances, or
 * NaN for an origin in the plane, which lane_min and lane_max then leave out.
 *
 * Ties: of two hits with equal t, the lower primitive wins, whatever order they are met in.
 */
#ifndef RT_TRAVERSE_H
#define RT_TRAVERSE_H

#include "intersect.h"
#include "lanes.h"
#include "scene.h"
#include "surface.h"
#include "types.h"

/* The ray's constants for boxes. */
struct ray_slabs {
    float3 origin;
    float3 near_rate, far_rate;           /* 1 / direction, made smaller and larger by the rounding */
    uint near_x, near_y, near_z;          /* rows of rt_bvh_node.bounds */
    uint far_x, far_y, far_z;
};

static inline struct ray_slabs make_ray_slabs(const struct ray *ray)
{
    const float3 rate = 1.0f / ray->direction;
    const float margin = 0x1p-21f; /* three roundings of each distance, with room */
    struct ray_slabs slabs;
    slabs.origin = ray->origin;
    slabs.near_rate = rate * (1.0f - margin);
    slabs.far_rate = rate * (1.0f + margin);
    slabs.near_x = signbit(rate.x) ? 3u : 0u;
    slabs.near_y = signbit(rate.y) ? 4u : 1u;
    slabs.near_z = signbit(rate.z) ? 5u : 2u;
    slabs.far_x = 3u - slabs.near_x;
    slabs.far_y = 5u - slabs.near_y;
    slabs.far_z = 7u - slabs.near_z;
    return slabs;
}

/* Tests the node's children; returns a bit for each whose box is met in [t_min, t_max], and where. */
static inline uint intersect_boxes(global const rt_bvh_node *node, const struct ray_slabs *slabs, float t_min,
                                   float t_max, float8 *entry)
{
    const float8 near_x = (vload8(0, node->bounds[slabs->near_x]) - slabs->origin.x) * slabs->near_rate.x;
    const float8 near_y = (vload8(0, node->bounds[slabs->near_y]) - slabs->origin.y) * slabs->near_rate.y;
    const float8 near_z = (vload8(0, node->bounds[slabs->near_z]) - slabs->origin.z) * slabs->near_rate.z;
    const float8 far_x = (vload8(0, node->bounds[slabs->far_x]) - slabs->origin.x) * slabs->far_rate.x;
    const float8 far_y = (vload8(0, node->bounds[slabs->far_y]) - slabs->origin.y) * slabs->far_rate.y;
    const float8 far_z = (vload8(0, node->bounds[slabs->far_z]) - slabs->origin.z) * slabs->far_rate.z;
    const float8 near = lane_max(near_z, lane_max(near_y, lane_max(near_x, (float8)(t_min))));
    const float8 far = lane_min(far_z, lane_min(far_y, lane_min(far_x, (float8)(t_max))));
    *entry = near;
    return lane_mask(near <= far);
}

/* Takes the nearest of the block's hits in `mask` into *hit when it is nearer still. */
static inline void take_block_hits(struct hit *hit, const struct block_hits *found, uint mask,
                                   global const rt_tri_block *block, uint index)
{
    float t[8], u[8], v[8];
    vstore8(found->t, 0, t);
    vstore8(found->u, 0, u);
    vstore8(found->v, 0, v);
    for (; mask; mask &= mask - 1u) {
        const uint lane = lane_first(mask);
        const uint prim = block->prim[lane] & RT_BLOCK_PRIM;
        if (t[lane] < hit->t || (t[lane] == hit->t && prim < hit->prim)) {
            hit->t = t[lane];
            hit->u = u[lane];
            hit->v = v[lane];
            hit->prim = prim;
            hit->slot = index * RT_BVH_WIDTH + lane;
        }
    }
}

static inline void test_block(const struct scene *scene, const struct ray *ray, const struct ray_frame *frame,
                              uint index, struct hit *hit)
{
    global const rt_tri_block *block = scene->blocks + index;
    struct block_hits found;
    const uint mask = intersect_block(block, frame, ray->t_min, hit->t, &found);
    if (mask)
        take_block_hits(hit, &found, mask, block, index);
}

static inline void test_shape(const struct scene *scene, const struct ray *ray, uint index, struct hit *hit)
{
    global const rt_shape *shape = scene->shapes + index;
    const float t = intersect_shape(shape, ray);
    const uint prim = shape->first_prim;
    if (t < hit->t || (t == hit->t && t < INFINITY && prim < hit->prim)) {
        hit->t = t;
        hit->u = 0.0f;
        hit->v = 0.0f;
        hit->prim = prim;
        hit->slot = index | RT_SLOT_ANALYTIC;
    }
}

static inline void test_leaf(const struct scene *scene, const struct ray *ray, const struct ray_frame *frame,
                             uint child, struct hit *hit)
{
    const uint index = child & RT_CHILD_INDEX;
    if (child & RT_CHILD_ANALYTIC)
        test_shape(scene, ray, scene->analytic[index], hit);
    else
        test_block(scene, ray, frame, index, hit);
}

/* Children still to visit, and where the ray enters them. */
struct stack {
    uint count;
    uint child[RT_BVH_STACK];
    float entry[RT_BVH_STACK];
};

/* Sorts the children in `mask` by entry onto the stack, the nearest last. */
static inline void push_sorted(struct stack *stack, global const rt_bvh_node *node, uint mask, float8 entry)
{
    float distance[8];
    vstore8(entry, 0, distance);
    const uint first = stack->count;
    for (; mask; mask &= mask - 1u) {
        const uint lane = lane_first(mask);
        uint at = stack->count++;
        for (; at > first && stack->entry[at - 1u] < distance[lane]; at--) {
            stack->entry[at] = stack->entry[at - 1u];
            stack->child[at] = stack->child[at - 1u];
        }
        stack->entry[at] = distance[lane];
        stack->child[at] = node->child[lane];
    }
}

static inline void traverse_closest(const struct scene *scene, const struct ray *ray, struct hit *hit)
{
    const struct ray_slabs slabs = make_ray_slabs(ray);
    const struct ray_frame frame = make_ray_frame(ray);
    struct stack stack;
    stack.count = 1u;
    stack.child[0] = 0u;
    stack.entry[0] = ray->t_min;
    while (stack.count) {
        const uint top = --stack.count;
        const uint child = stack.child[top];
        if (stack.entry[top] > hit->t)
            continue;
        if (child & RT_CHILD_LEAF) {
            test_leaf(scene, ray, &frame, child, hit);
        } else {
            float8 entry;
            global const rt_bvh_node *node = scene->nodes + child;
            const uint mask = intersect_boxes(node, &slabs, ray->t_min, hit->t, &entry);
            push_sorted(&stack, node, mask, entry);
        }
    }
}

/* The nearest hit in [t_min, t_max]; false, and *hit without meaning, when there is none. */
static inline bool closest_hit(const struct scene *scene, const struct ray *ray, struct hit *hit)
{
    hit->t = ray->t_max;
    hit->prim = RT_NONE;
    for (uint i = 0; i < scene->header->plane_count; i++)
        test_shape(scene, ray, scene->planes[i], hit);
    if (scene->header->accel == RT_ACCEL_BVH) {
        traverse_closest(scene, ray, hit);
    } else {
        const struct ray_frame frame = make_ray_frame(ray);
        for (uint i = 0; i < scene->header->block_count; i++)
            test_block(scene, ray, &frame, i, hit);
        for (uint i = 0; i < scene->header->analytic_count; i++)
            test_shape(scene, ray, scene->analytic[i], hit);
    }
    return hit->prim != RT_NONE;
}

static inline bool leaf_occludes(const struct scene *scene, const struct ray *ray, const struct ray_frame *frame,
                                 uint child)
{
    const uint index = child & RT_CHILD_INDEX;
    struct block_hits found;
    if (child & RT_CHILD_ANALYTIC)
        return intersect_shape(scene->shapes + scene->analytic[index], ray) < INFINITY;
    return intersect_block(scene->blocks + index, frame, ray->t_min, ray->t_max, &found) != 0u;
}

static inline bool traverse_any(const struct scene *scene, const struct ray *ray)
{
    const struct ray_slabs slabs = make_ray_slabs(ray);
    const struct ray_frame frame = make_ray_frame(ray);
    uint stack[RT_BVH_STACK];
    uint count = 1u;
    stack[0] = 0u;
    while (count) {
        const uint child = stack[--count];
        if (child & RT_CHILD_LEAF) {
            if (leaf_occludes(scene, ray, &frame, child))
                return true;
        } else {
            float8 entry;
            global const rt_bvh_node *node = scene->nodes + child;
            uint mask = intersect_boxes(node, &slabs, ray->t_min, ray->t_max, &entry);
            for (; mask; mask &= mask - 1u)
                stack[count++] = node->child[lane_first(mask)];
        }
    }
    return false;
}

/* Whether the ray meets anything in [t_min, t_max]; stops at the first. */
static inline bool occluded(const struct scene *scene, const struct ray *ray)
{
    for (uint i = 0; i < scene->header->plane_count; i++)
        if (intersect_shape(scene->shapes + scene->planes[i], ray) < INFINITY)
            return true;
    if (scene->header->accel == RT_ACCEL_BVH)
        return traverse_any(scene, ray);
    const struct ray_frame frame = make_ray_frame(ray);
    for (uint i = 0; i < scene->header->block_count; i++)
        if (leaf_occludes(scene, ray, &frame, i | RT_CHILD_LEAF))
            return true;
    for (uint i = 0; i < scene->header->analytic_count; i++)
        if (leaf_occludes(scene, ray, &frame, i | RT_CHILD_LEAF | RT_CHILD_ANALYTIC))
            return true;
    return false;
}

#endif
