/*
 * traverse.h - the nearest hit of a ray, and whether anything is hit.
 *
 * A leaf of the tree is a block of triangles, some of a block, an analytic shape, or an instance,
 * which has a tree of its own. Ties: of two hits with equal t, the lower primitive wins, whatever
 * order they are found in.
 */
#ifndef RT_KERNELS_ACCEL_TRAVERSE_H
#define RT_KERNELS_ACCEL_TRAVERSE_H

#include "accel/instance.h"
#include "accel/tree.h"
#include "scene.h"
#include "shape/shapes.h"
#include "types.h"

/* The hit at t on a part of a shape that is not kept in blocks. */
static inline struct hit shape_hit(global const rt_shape *shape, uint index, float t, uint part)
{
    struct hit hit;
    hit.t = t;
    hit.u = (float)part;
    hit.v = 0.0f;
    hit.prim = shape->first_prim;
    hit.slot = index | RT_SLOT_ANALYTIC;
    return hit;
}

/* Whether a ray passes a cutout that is no block where it meets it at t. */
RARELY_CALLED bool passes_shape(global const rt_scene_header *header, uint index,
                                const struct ray *ray, float t, uint part)
{
    const struct scene scene = scene_open(header);
    global const rt_shape *shape = scene.shapes + index;
    const struct hit hit = shape_hit(shape, index, t, part);
    struct surface at;
    surface_at(&at, &scene, ray, &hit);
    const struct texture_place place = texture_place_at(shape, &at);
    return passes_at(&scene, &place, ray, hit.slot ^ as_uint(t));
}

#define CUTOUT_LAYERS 8u /* of one shape that a ray passes: no shape has more */

/* As intersect_shape, past the points at which a cutout lets the ray through. */
static inline float intersect_opaque(const struct scene *scene, uint index, const struct ray *ray,
                                     uint *part, const bool cuts)
{
    global const rt_shape *shape = scene->shapes + index;
    float t = intersect_shape(scene, shape, ray, part);
    if (!cuts || !(shape->flags & RT_SHAPE_CUTOUT))
        return t;
    struct ray rest = *ray;
    for (uint i = 0u; t < INFINITY && passes_shape(scene->header, index, ray, t, *part); i++) {
        if (i == CUTOUT_LAYERS)
            return INFINITY;
        rest.t_min = nextafter(t, INFINITY);
        t = intersect_shape(scene, shape, &rest, part);
    }
    return t;
}

static inline void test_shape(const struct scene *scene, const struct ray *ray, uint index,
                              struct hit *hit, const bool cuts)
{
    global const rt_shape *shape = scene->shapes + index;
    if (shape->kind == RT_SHAPE_INSTANCE) {
        struct hit nearest = *hit; /* a copy, so that *hit can live in registers */
        if (cuts)
            test_instance_with_cutouts(scene, ray, shape, &nearest);
        else
            test_instance(scene, ray, shape, &nearest);
        *hit = nearest;
        return;
    }
    uint part;
    const float t = intersect_opaque(scene, index, ray, &part, cuts);
    const uint prim = shape->first_prim;
    if (t < hit->t || (t == hit->t && t < INFINITY && prim < hit->prim))
        *hit = shape_hit(shape, index, t, part);
}

INLINE_ALWAYS void test_leaf(const struct scene *scene, const struct ray *ray,
                             const struct ray_frame *frame, struct leaf leaf, struct hit *hit,
                             const bool cuts)
{
    if (UNLIKELY(leaf.child & RT_CHILD_ANALYTIC))
        test_shape(scene, ray, scene->analytic[leaf.child & RT_CHILD_INDEX], hit, cuts);
    else
        test_block(scene, ray, frame, leaf, RT_NONE, hit, cuts);
}

INLINE_ALWAYS void traverse_closest(const struct scene *scene, const struct ray *ray,
                                    struct hit *hit, const bool cuts)
{
    const struct ray_slabs slabs = make_ray_slabs(ray);
    const struct ray_frame frame = make_ray_frame(ray);
    struct hit nearest = *hit;
    struct stack stack;
    uint count = start_at(&stack, 0u);
    struct leaf leaf;
    while (next_leaf(scene, &slabs, ray->t_min, nearest.t, &stack, &count, &leaf))
        test_leaf(scene, ray, &frame, leaf, &nearest, cuts);
    *hit = nearest;
}

/* Tests every primitive but the planes. */
static inline void test_all(const struct scene *scene, const struct ray *ray, struct hit *hit,
                            const bool cuts)
{
    const struct ray_frame frame = make_ray_frame(ray);
    for (uint i = 0; i < scene->header->block_count; i++)
        test_block(scene, ray, &frame, whole_block(i), RT_NONE, hit, cuts);
    for (uint i = 0; i < scene->header->analytic_count; i++)
        test_shape(scene, ray, scene->analytic[i], hit, cuts);
}

/* Begins a search with the planes, which are beside the tree; prim is RT_NONE without a hit. */
INLINE_ALWAYS void begin_at_planes(const struct scene *scene, const struct ray *ray,
                                   struct hit *hit, const bool cuts)
{
    hit->t = ray->t_max;
    hit->prim = RT_NONE;
    for (uint i = 0; i < scene->header->plane_count; i++)
        test_shape(scene, ray, scene->planes[i], hit, cuts);
}

INLINE_ALWAYS bool find_closest(const struct scene *scene, const struct ray *ray, struct hit *hit,
                                const bool cuts)
{
    begin_at_planes(scene, ray, hit, cuts);
    if (scene->header->accel == RT_ACCEL_BVH)
        traverse_closest(scene, ray, hit, cuts);
    else
        test_all(scene, ray, hit, cuts);
    return hit->prim != RT_NONE;
}

/* Two functions side by side: on a GPU what one calls adds up, memory and all. */

RARELY_CALLED bool closest_hit_with_cutouts(const struct scene *scene, const struct ray *ray,
                                            struct hit *hit)
{
    return find_closest(scene, ray, hit, true);
}

INLINE_NEVER bool closest_hit_of_opaque(const struct scene *scene, const struct ray *ray,
                                        struct hit *hit)
{
    return find_closest(scene, ray, hit, false);
}

/*
 * The nearest hit in [t_min, t_max] of a ray that can be followed; when there is none, returns
 * false and *hit is undefined.
 */
static inline bool closest_hit(const struct scene *scene, const struct ray *ray, struct hit *hit)
{
    return UNLIKELY(has_cutouts(scene)) ? closest_hit_with_cutouts(scene, ray, hit)
                                        : closest_hit_of_opaque(scene, ray, hit);
}

static inline bool shape_occludes(const struct scene *scene, const struct ray *ray, uint index,
                                  const bool cuts)
{
    global const rt_shape *shape = scene->shapes + index;
    uint part;
    if (shape->kind == RT_SHAPE_INSTANCE)
        return cuts ? instance_occludes_with_cutouts(scene, ray, shape)
                    : instance_occludes(scene, ray, shape);
    return intersect_opaque(scene, index, ray, &part, cuts) < INFINITY;
}

INLINE_ALWAYS bool leaf_occludes(const struct scene *scene, const struct ray *ray,
                                 const struct ray_frame *frame, struct leaf leaf, const bool cuts)
{
    if (UNLIKELY(leaf.child & RT_CHILD_ANALYTIC))
        return shape_occludes(scene, ray, scene->analytic[leaf.child & RT_CHILD_INDEX], cuts);
    return block_occludes(scene, ray, frame, leaf, RT_NONE, cuts);
}

INLINE_ALWAYS bool traverse_any(const struct scene *scene, const struct ray *ray, const bool cuts)
{
    const struct ray_slabs slabs = make_ray_slabs(ray);
    const struct ray_frame frame = make_ray_frame(ray);
    struct any_stack stack;
    uint count = start_any_at(&stack, 0u);
    struct leaf leaf;
    while (next_leaf_any(scene, &slabs, ray, &stack, &count, &leaf))
        if (leaf_occludes(scene, ray, &frame, leaf, cuts))
            return true;
    return false;
}

static inline bool all_occlude(const struct scene *scene, const struct ray *ray, const bool cuts)
{
    const struct ray_frame frame = make_ray_frame(ray);
    for (uint i = 0; i < scene->header->block_count; i++)
        if (block_occludes(scene, ray, &frame, whole_block(i), RT_NONE, cuts))
            return true;
    for (uint i = 0; i < scene->header->analytic_count; i++)
        if (shape_occludes(scene, ray, scene->analytic[i], cuts))
            return true;
    return false;
}

INLINE_ALWAYS bool find_any(const struct scene *scene, const struct ray *ray, const bool cuts)
{
    for (uint i = 0; i < scene->header->plane_count; i++)
        if (shape_occludes(scene, ray, scene->planes[i], cuts))
            return true;
    return scene->header->accel == RT_ACCEL_BVH ? traverse_any(scene, ray, cuts)
                                                : all_occlude(scene, ray, cuts);
}

RARELY_CALLED bool occluded_with_cutouts(const struct scene *scene, const struct ray *ray)
{
    return find_any(scene, ray, true);
}

INLINE_NEVER bool occluded_by_opaque(const struct scene *scene, const struct ray *ray)
{
    return find_any(scene, ray, false);
}

/* Whether a ray that can be followed hits anything in [t_min, t_max]; stops at the first. */
static inline bool occluded(const struct scene *scene, const struct ray *ray)
{
    return UNLIKELY(has_cutouts(scene)) ? occluded_with_cutouts(scene, ray)
                                        : occluded_by_opaque(scene, ray);
}

#endif
