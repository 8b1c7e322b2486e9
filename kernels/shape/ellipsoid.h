/* ellipsoid.h - the ellipsoid: the unit sphere in object space. */
#ifndef RT_KERNELS_SHAPE_ELLIPSOID_H
#define RT_KERNELS_SHAPE_ELLIPSOID_H

#include "sample/sample.h"
#include "shape/object_point.h"
#include "shape/sphere.h"

static inline float ellipsoid_intersect(global const rt_shape *shape, const struct ray *ray,
                                        uint *part)
{
    (void)shape;
    return intersect_sphere((float3)(0.0f), 1.0f, ray, part);
}

static inline struct object_point ellipsoid_point(float3 p)
{
    struct object_point point;
    const float3 n = unit(p);
    point.position = n;
    point.normal = n;
    point.error = gamma_bound(8.0f);
    return point;
}

static inline struct object_point ellipsoid_hit(global const rt_shape *shape,
                                                global const rt_transform_data *placement,
                                                const struct ray *ray, float3 p, uint part)
{
    (void)shape, (void)placement;
    struct object_point point = ellipsoid_point(p);
    point.normal = facing_normal(point.normal, ray->direction, part & PART_EXITS);
    return point;
}

static inline struct object_point
ellipsoid_sample(global const rt_shape *shape, global const rt_transform_data *placement, float2 u)
{
    (void)shape, (void)placement;
    return ellipsoid_point(sample_sphere(u));
}

static inline float ellipsoid_sample_pdf_a(global const rt_shape *shape,
                                           global const rt_transform_data *placement, float3 n,
                                           float scale)
{
    (void)shape, (void)placement, (void)n;
    return 1.0f / (4.0f * RT_PI * scale);
}

static inline float2 ellipsoid_uv(global const rt_shape *shape, float3 p, float3 n)
{
    (void)shape, (void)n;
    return sphere_parameters(unit(p));
}

static inline struct tangents ellipsoid_tangents(global const rt_shape *shape, float3 p, float3 n)
{
    (void)shape, (void)n;
    return unit_sphere_tangents(unit(p));
}

#endif
