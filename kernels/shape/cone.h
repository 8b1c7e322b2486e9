/* cone.h - the cone: in object space a frustum of radius 1 at z = 0 and p[0] <= 1 at z = 1. */
#ifndef RT_KERNELS_SHAPE_CONE_H
#define RT_KERNELS_SHAPE_CONE_H

#include "shape/frustum.h"

static inline float cone_intersect(global const rt_shape *shape, const struct ray *ray, uint *part)
{
    return frustum_intersect(shape, shape->p[0], ray, part);
}

static inline struct object_point cone_hit(global const rt_shape *shape,
                                           global const rt_transform_data *placement,
                                           const struct ray *ray, float3 p, uint part)
{
    return frustum_hit(shape, shape->p[0], placement, ray, p, part);
}

static inline struct object_point cone_sample(global const rt_shape *shape,
                                              global const rt_transform_data *placement, float2 u)
{
    return frustum_sample(shape, shape->p[0], placement, u);
}

static inline float cone_sample_pdf_a(global const rt_shape *shape,
                                      global const rt_transform_data *placement, float3 n,
                                      float scale)
{
    return frustum_sample_pdf_a(shape, shape->p[0], placement, n, scale);
}

static inline float2 cone_uv(global const rt_shape *shape, float3 p, float3 n)
{
    return frustum_uv(shape->p[0], p, n);
}

static inline struct tangents cone_tangents(global const rt_shape *shape, float3 p, float3 n)
{
    return frustum_tangents(shape->p[0], p, n);
}

#endif
