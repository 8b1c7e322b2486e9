/*
 * traverse.h - the nearest hit of a ray, and whether anything is hit.
 *
 * The tree is eight wide: a node's children are tested at once against the ray's slabs, the near and far plane
 * of each axis chosen by the sign of the direction. The distance to a plane is one multiply-add,
 * plane * rate + shift; the bounds on its rounding are in rate and shift, so that no box that the ray touches is
 * missed (after Ize, "Robust BVH Ray Traversal", JCGT 2(2), 2013, which has them in the far distance).
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

/*
 * Whether the ray can be followed: its numbers are finite and small enough for what make_ray_slabs does with
 * them. A comparison with NaN fails, so without this the boxes of unused lanes would be met. closest_hit and
 * occluded ask for such rays; it is asked where a path begins, for a bounce's direction is a unit vector.
 */
INLINE_ALWAYS bool can_follow(const struct ray *ray)
{
    const float3 size = fabs(ray->origin) + fabs(ray->direction);
    return size.x + size.y + size.z <= 0x1p53f;
}

/* The ray's constants for boxes: the distance to a plane is plane * rate + shift. */
struct ray_slabs {
    float3 near_rate, near_shift; /* never above the true distance */
    float3 far_rate, far_shift;   /* never below it */
    uint near_x, near_y, near_z;  /* rows of rt_bvh_node.bounds */
    uint far_x, far_y, far_z;
};

/*
 * With e = 2^-24, the distance (plane - origin) rate is off by at most 4 e of itself and 4 e |origin rate|; both
 * are allowed for twice. Making rates smaller and larger widens what lies ahead of the origin; what lies behind,
 * where t_min allows it, is widened by as much through the slack. A direction component near 0 is taken as
 * 2^-74: then, for rays that can be followed, rates and shifts are finite, and distances far beyond any other
 * wherever the plane is not within rounding of the origin.
 */
INLINE_ALWAYS struct ray_slabs make_ray_slabs(const struct ray *ray)
{
    const float least = 0x1p-74f, relative = 0x1p-21f, absolute = 0x1p-60f;
    const float3 direction = copysign(fmax(fabs(ray->direction), (float3)(least)), ray->direction);
    const float3 rate = 1.0f / direction;
    const float behind = fmax(-ray->t_min, 0.0f) * (2.0f * relative);
    const float3 slack = fabs(rate) * (fabs(ray->origin) * relative + absolute) + behind;
    struct ray_slabs slabs;
    slabs.near_rate = rate * (1.0f - relative);
    slabs.far_rate = rate * (1.0f + relative);
    slabs.near_shift = -(ray->origin * slabs.near_rate) - slack;
    slabs.far_shift = -(ray->origin * slabs.far_rate) + slack;
    slabs.near_x = rate.x < 0.0f ? 3u : 0u;
    slabs.near_y = rate.y < 0.0f ? 4u : 1u;
    slabs.near_z = rate.z < 0.0f ? 5u : 2u;
    slabs.far_x = 3u - slabs.near_x;
    slabs.far_y = 5u - slabs.near_y;
    slabs.far_z = 7u - slabs.near_z;
    return slabs;
}

INLINE_ALWAYS float8 plane_distance(global const rt_bvh_node *node, uint row, float rate, float shift)
{
    return lane_mad(vload8(0, node->bounds[row]), (float8)(rate), (float8)(shift));
}

/* Tests the node's children; returns a bit for each whose box is met in [t_min, t_max], and where. */
INLINE_ALWAYS uint intersect_boxes(global const rt_bvh_node *node, const struct ray_slabs *slabs, float t_min,
                                   float t_max, float8 *entry)
{
    const float8 near_x = plane_distance(node, slabs->near_x, slabs->near_rate.x, slabs->near_shift.x);
    const float8 near_y = plane_distance(node, slabs->near_y, slabs->near_rate.y, slabs->near_shift.y);
    const float8 near_z = plane_distance(node, slabs->near_z, slabs->near_rate.z, slabs->near_shift.z);
    const float8 far_x = plane_distance(node, slabs->far_x, slabs->far_rate.x, slabs->far_shift.x);
    const float8 far_y = plane_distance(node, slabs->far_y, slabs->far_rate.y, slabs->far_shift.y);
    const float8 far_z = plane_distance(node, slabs->far_z, slabs->far_rate.z, slabs->far_shift.z);
    const float8 near = lane_max(lane_max(near_x, near_y), lane_max(near_z, (float8)(t_min)));
    const float8 far = lane_min(lane_min(far_x, far_y), lane_min(far_z, (float8)(t_max)));
    *entry = near;
    return lane_mask(near <= far);
}

/* Takes the nearest of the block's hits in `mask` into *hit when it is nearer still and not before t_min. */
INLINE_ALWAYS void take_block_hits(struct hit *hit, const struct block_hits *found, uint mask, float t_min,
                                   global const rt_tri_block *block, uint index)
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

/* Lets hits as far as the nearest through, ties included, and a rounding beyond: take_block_hits compares exactly. */
INLINE_ALWAYS void test_block(const struct scene *scene, const struct ray *ray, const struct ray_frame *frame,
                              uint index, struct hit *hit)
{
    global const rt_tri_block *block = scene->blocks + index;
    const float reach = hit->t + fabs(hit->t) * 0x1p-22f;
    struct block_hits found;
    const uint mask = intersect_block(block, frame, ray->t_min, reach, &found);
    if (mask)
        take_block_hits(hit, &found, mask, ray->t_min, block, index);
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

INLINE_ALWAYS void test_leaf(const struct scene *scene, const struct ray *ray, const struct ray_frame *frame,
                             uint child, struct hit *hit)
{
    const uint index = child & RT_CHILD_INDEX;
    if (child & RT_CHILD_ANALYTIC)
        test_shape(scene, ray, scene->analytic[index], hit);
    else
        test_block(scene, ray, frame, index, hit);
}

/* Children still to visit, and where the ray enters them, the nearest of each node last. */
struct stack {
    uint child[RT_BVH_STACK];
    float entry[RT_BVH_STACK];
};

/* Returns the nearest of the node's children in `mask`, which is not 0, and pushes the others. */
INLINE_ALWAYS uint push_farther(struct stack *stack, uint *count, global const rt_bvh_node *node, uint mask,
                                float8 entry)
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

INLINE_ALWAYS void traverse_closest(const struct scene *scene, const struct ray *ray, struct hit *hit)
{
    const struct ray_slabs slabs = make_ray_slabs(ray);
    const struct ray_frame frame = make_ray_frame(ray);
    struct hit nearest = *hit;
    struct stack stack;
    uint count = 0u;
    uint child = 0u;
    do {
        /* Go down to a leaf, always to the nearest child, or until no box is met. */
        uint mask = 1u;
        while (!(child & RT_CHILD_LEAF)) {
            global const rt_bvh_node *node = scene->nodes + child;
            float8 entry;
            mask = intersect_boxes(node, &slabs, ray->t_min, nearest.t, &entry);
            if (!mask)
                break;
            child = push_farther(&stack, &count, node, mask, entry);
        }
        if (mask)
            test_leaf(scene, ray, &frame, child, &nearest);
    } while (pop_nearer(&stack, &count, nearest.t, &child));
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

/* The nearest hit in [t_min, t_max] of a ray that can be followed; false, and *hit without meaning, when there is none. */
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

INLINE_ALWAYS bool leaf_occludes(const struct scene *scene, const struct ray *ray, const struct ray_frame *frame,
                                 uint child)
{
    const uint index = child & RT_CHILD_INDEX;
    struct block_hits found;
    if (child & RT_CHILD_ANALYTIC)
        return intersect_shape(scene->shapes + scene->analytic[index], ray) < INFINITY;
    return intersect_block(scene->blocks + index, frame, ray->t_min, ray->t_max, &found) != 0u;
}

/* Goes to the first child met, and pushes the others in reverse: the builder put the largest first. */
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

INLINE_ALWAYS bool traverse_any(const struct scene *scene, const struct ray *ray)
{
    const struct ray_slabs slabs = make_ray_slabs(ray);
    const struct ray_frame frame = make_ray_frame(ray);
    uint stack[RT_BVH_STACK];
    uint count = 0u;
    uint child = 0u;
    for (;;) {
        uint mask = 1u;
        while (!(child & RT_CHILD_LEAF)) {
            global const rt_bvh_node *node = scene->nodes + child;
            float8 entry;
            mask = intersect_boxes(node, &slabs, ray->t_min, ray->t_max, &entry);
            if (!mask)
                break;
            child = push_later(stack, &count, node, mask);
        }
        if (mask && leaf_occludes(scene, ray, &frame, child))
            return true;
        if (count == 0u)
            return false;
        child = stack[--count];
    }
}

static inline bool all_occlude(const struct scene *scene, const struct ray *ray)
{
    const struct ray_frame frame = make_ray_frame(ray);
    for (uint i = 0; i < scene->header->block_count; i++)
        if (leaf_occludes(scene, ray, &frame, i | RT_CHILD_LEAF))
            return true;
    for (uint i = 0; i < scene->header->analytic_count; i++)
        if (leaf_occludes(scene, ray, &frame, i | RT_CHILD_LEAF | RT_CHILD_ANALYTIC))
            return true;
    return false;
}

/* Whether a ray that can be followed meets anything in [t_min, t_max]; stops at the first. */
INLINE_NEVER bool occluded(const struct scene *scene, const struct ray *ray)
{
    for (uint i = 0; i < scene->header->plane_count; i++)
        if (intersect_shape(scene->shapes + scene->planes[i], ray) < INFINITY)
            return true;
    return scene->header->accel == RT_ACCEL_BVH ? traverse_any(scene, ray) : all_occlude(scene, ray);
}

#endif
