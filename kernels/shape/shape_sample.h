/*
 * shape_sample.h - points on the analytic shapes that can emit, and the density of choosing them.
 *
 * A point is chosen evenly over the shape, or over its side and each cap, in the space of its own.
 * The placement, with cofactors C, stretches a surface element of unit normal n by |C n|, so the
 * density over the world's area is the even one over |C n|. Side and caps are chosen by their areas
 * in the world, the side's estimated from its stretch in two directions.
 */
#ifndef RT_KERNELS_SHAPE_SHAPE_SAMPLE_H
#define RT_KERNELS_SHAPE_SHAPE_SAMPLE_H

#include "shape/canonical.h"
#include "shape/placement.h"
#include "sample/sample.h"
#include "scene.h"
#include "shape/surface.h"
#include "types.h"

/*
 * Areas in the world of the side and of the caps at z = 0 and z = 1, the first an estimate, the
 * caps 0 when open.
 */
static inline float3 round_areas(global const rt_shape *shape,
                                 global const rt_transform_data *placement)
{
    const float top = round_top(shape), slope = 1.0f - top;
    const float side = 0.5f * (area_stretch(placement, (float3)(1.0f, 0.0f, slope)) +
                               area_stretch(placement, (float3)(0.0f, 1.0f, slope)));
    const float cap =
        shape->flags & RT_SHAPE_CAPS ? area_stretch(placement, (float3)(0.0f, 0.0f, 1.0f)) : 0.0f;
    return RT_PI * (float3)((1.0f + top) * side, cap, cap * top * top);
}

/*
 * The density over the world's area at a point with this normal in the shape's space, of any
 * length.
 */
static inline float shape_density(const struct scene *scene, global const rt_shape *shape,
                                  float3 normal)
{
    global const rt_transform_data *placement = scene->transforms + shape->transform;
    const float3 n = unit(normal);
    const float stretch = area_stretch(placement, n);
    switch (shape->kind) {
    case RT_SHAPE_DISC:
        return 1.0f / (RT_PI * (1.0f - square(shape->p[0])) * stretch);
    case RT_SHAPE_CYLINDER:
    case RT_SHAPE_CONE: {
        const float3 areas = round_areas(shape, placement);
        const float top = round_top(shape), all = areas.x + areas.y + areas.z;
        if (n.z < -0.9f)
            return areas.y / (all * RT_PI * stretch);
        if (n.z > 0.9f) /* the side's normal rises by 45 degrees at most */
            return areas.z / (all * RT_PI * square(top) * stretch);
        return areas.x / (all * RT_PI * (1.0f + top) * sqrt(1.0f + square(1.0f - top)) * stretch);
    }
    case RT_SHAPE_TORUS:
        return 1.0f / (4.0f * square(RT_PI) * shape->p[0] * stretch);
    default:
        return 1.0f / (4.0f * RT_PI * stretch);
    }
}

/*
 * The angle around the tube at u of the cumulative distribution of 1 + m cos(angle): Kepler's
 * equation angle + m sin(angle) = 2 pi u, by Newton's method kept between bounds.
 */
static inline float tube_angle(float m, float u)
{
    const float mean = 2.0f * RT_PI * u;
    float lo = 0.0f, hi = 2.0f * RT_PI, angle = mean;
    for (int i = 0; i < 24; i++) {
        const float excess = angle + m * sin(angle) - mean;
        if (excess > 0.0f)
            hi = angle;
        else
            lo = angle;
        const float next = angle - excess / (1.0f + m * cos(angle));
        if (fabs(next - angle) < 1e-6f)
            break;
        angle = next > lo && next < hi ? next : 0.5f * (lo + hi);
    }
    return angle;
}

/* A point of the side or a cap of a cylinder or cone; u.x chooses which and is used again. */
static inline struct canonical round_point(global const rt_shape *shape,
                                           global const rt_transform_data *placement, float2 u)
{
    const float3 areas = round_areas(shape, placement);
    const float top = round_top(shape), all = areas.x + areas.y + areas.z;
    const float turn = 2.0f * RT_PI * u.y;
    float x = u.x * all;
    if (x < areas.x || all == areas.x) {
        /* Radii in proportion to themselves, from 1 down to top. */
        const float radius = sqrt(mix(1.0f, square(top), fmin(x / areas.x, 1.0f)));
        const float z = top < 1.0f ? (1.0f - radius) / (1.0f - top) : x / areas.x;
        return canonical_round(shape, placement,
                               (float3)(radius * cos(turn), radius * sin(turn), z), ROUND_SIDE);
    }
    x -= areas.x;
    const bool base = x < areas.y || areas.z == 0.0f;
    x = base ? x / areas.y : (x - areas.y) / areas.z;
    const float radius = sqrt(fmin(x, 1.0f)) * (base ? 1.0f : top);
    return canonical_round(shape, placement,
                           (float3)(radius * cos(turn), radius * sin(turn), base ? 0.0f : 1.0f),
                           base ? ROUND_BASE : ROUND_TOP);
}

/*
 * A point of an ellipsoid, disc, cylinder, cone or torus (shape: its index), for u in [0,1)^2.
 * Fills *at as surface_at does for a hit there, and returns pdf_a, its density over the shape's
 * area in the world, 1/m^2.
 */
static inline float shape_point(const struct scene *scene, uint shape_index, float2 u,
                                struct surface *at)
{
    global const rt_shape *shape = scene->shapes + shape_index;
    global const rt_transform_data *placement = scene->transforms + shape->transform;
    const float turn = 2.0f * RT_PI * u.y;
    struct canonical point;
    switch (shape->kind) {
    case RT_SHAPE_DISC: {
        const float radius = sqrt(mix(square(shape->p[0]), 1.0f, u.x));
        point = canonical_disc(shape, (float3)(radius * cos(turn), radius * sin(turn), 0.0f));
        break;
    }
    case RT_SHAPE_CYLINDER:
    case RT_SHAPE_CONE:
        point = round_point(shape, placement, u);
        break;
    case RT_SHAPE_TORUS: {
        const float angle = tube_angle(shape->p[0], u.x), radius = 1.0f + shape->p[0] * cos(angle);
        point = canonical_torus(
            shape, (float3)(radius * cos(turn), radius * sin(turn), shape->p[0] * sin(angle)));
        break;
    }
    default:
        point = canonical_ellipsoid(sample_sphere(u));
    }
    at->shape = shape_index;
    at->prim = shape->first_prim;
    at->triangle = 0u;
    at->weights = (float2)(0.0f);
    at->slot = shape_index | RT_SLOT_ANALYTIC;
    place_canonical(at, placement, &point);
    return shape_density(scene, shape, point.normal);
}

/* The density, 1/m^2, with which shape_point makes a point that surface_at or shape_point gave. */
static inline float shape_pdf_a(const struct scene *scene, const struct surface *at)
{
    global const rt_shape *shape = scene->shapes + at->shape;
    return shape_density(scene, shape,
                         normal_to_object(scene->transforms + shape->transform, at->normal));
}

#endif
