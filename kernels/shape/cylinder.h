/* cylinder.h - the cylinder: in object space a frustum of radius 1 at both ends. */
#ifndef RT_KERNELS_SHAPE_CYLINDER_H
#define RT_KERNELS_SHAPE_CYLINDER_H

#include "shape/frustum.h"

static inline float cylinder_intersect(global const rt_shape *shape, const struct ray *ray,
                                       uint *part)
{
    return frustum_intersect(shape, 1.0f, ray, part);
}

static inline struct object_point cylinder_hit(global const rt_shape *shape,
                                               global const rt_transform_data *placement,
                                               const struct ray *ray, float3 p, uint part)
{
    return frustum_hit(shape, 1.0f, placement, ray, p, part);
}

static inline struct object_point
cylinder_sample(global const rt_shape *shape, global const rt_transform_data *placement, float2 u)
{
    return frustum_sample(shape, 1.0f, placement, u);
}

static inline float cylinder_sample_pdf_a(global const rt_shape *shape,
                                          global const rt_transform_data *placement, float3 n,
                                          float scale)
{
    return frustum_sample_pdf_a(shape, 1.0f, placement, n, scale);
}

static inline float2 cylinder_uv(global const rt_shape *shape, float3 p, float3 n)
{
    (void)shape;
    return frustum_uv(1.0f, p, n);
}

static inline struct tangents cylinder_tangents(global const rt_shape *shape, float3 p, float3 n)
{
    (void)shape;
    return frustum_tangents(1.0f, p, n);
}

#endif
