/* shape_check.h - placed shapes on the device against shape_reference. */
#ifndef RT_TESTS_KERNELS_SHAPE_CHECK_H
#define RT_TESTS_KERNELS_SHAPE_CHECK_H

#include <stddef.h>
#include <stdint.h>

#include "kernels/rays.h"
#include "kernels/shape_reference.h"

/* The shapes that the tests go through; fails when a kind of the list is not among them. */
extern const reference_shape shape_kinds[];
extern const size_t shape_kind_count;
void shape_expect_all_kinds(void);

/*
 * A placement: the size, the distance of the middle from the origin in sizes, and whether it is
 * skewed.
 */
typedef struct shape_place {
    float size, offset;
    int is_skewed;
} shape_place;
extern const shape_place shape_places[];
extern const size_t shape_place_count;

/*
 * The shape at a place; skewed by a rotation, a stretch of 1 to 4 and another rotation, mirrored at
 * times.
 */
reference_shape shape_placed(rays_stream *stream, size_t kind, size_t place);

/* A scene that holds nothing else. */
rt_scene *shape_scene(const reference_shape *shape);

/* Rays from all around, from inside, and along the surface within a few bands of grazing it. */
rt_ray shape_ray(rays_stream *stream, const reference_shape *shape);

/*
 * Traces so many rays through the device and expects the hits of shape_reference: hit or miss and,
 * with t and normal, which hit, unless the answer depends on 1e-4 of the size.
 */
void shape_expect_reference(const reference_shape *shape, size_t rays, uint64_t seed);

#endif
