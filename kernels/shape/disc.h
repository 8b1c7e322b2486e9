/* disc.h - the disc: in object space at z = 0, from the hole's radius p[0] to 1, normal +z. */
#ifndef RT_KERNELS_SHAPE_DISC_H
#define RT_KERNELS_SHAPE_DISC_H

#include "math/frame.h"
#include "math/ray.h"
#include "shape/object_point.h"
#include "types.h"

static inline float disc_intersect(global const rt_shape *shape, const struct ray *ray, uint *part)
{
    (void)part;
    const float hole = shape->p[0];
    const float t = -ray->origin.z / ray->direction.z;
    const float from_axis = length(ray->origin.xy + t * ray->direction.xy);
    return t >= ray->t_min && t <= ray->t_max && from_axis >= hole && from_axis <= 1.0f ? t
                                                                                        : INFINITY;
}

/*
 * The angle of a point about z, in turns, clockwise seen from the side of the normal (+-z): so no
 * lettering is mirrored.
 */
static inline float turns_on_disc(float3 p, float normal_z)
{
    return turns(normal_z > 0.0f ? -p.y : p.y, p.x);
}

static inline struct object_point disc_point(float3 p)
{
    struct object_point point;
    point.position = (float3)(p.xy, 0.0f);
    point.normal = (float3)(0.0f, 0.0f, 1.0f);
    point.error = gamma_bound(2.0f);
    return point;
}

static inline struct object_point disc_hit(global const rt_shape *shape,
                                           global const rt_transform_data *placement,
                                           const struct ray *ray, float3 p, uint part)
{
    (void)shape, (void)placement, (void)ray, (void)part;
    return disc_point(p);
}

static inline struct object_point disc_sample(global const rt_shape *shape,
                                              global const rt_transform_data *placement, float2 u)
{
    (void)placement;
    const float turn = 2.0f * RT_PI * u.y;
    const float radius = sqrt(mix(square(shape->p[0]), 1.0f, u.x));
    return disc_point((float3)(radius * cos(turn), radius * sin(turn), 0.0f));
}

static inline float disc_sample_pdf_a(global const rt_shape *shape,
                                      global const rt_transform_data *placement, float3 n,
                                      float scale)
{
    (void)placement, (void)n;
    return 1.0f / (RT_PI * (1.0f - square(shape->p[0])) * scale);
}

static inline float2 disc_uv(global const rt_shape *shape, float3 p, float3 n)
{
    (void)n;
    const float hole = shape->p[0];
    return (float2)(turns_on_disc(p, 1.0f),
                    clamp((length(p.xy) - hole) / (1.0f - hole), 0.0f, 1.0f));
}

static inline struct tangents disc_tangents(global const rt_shape *shape, float3 p, float3 n)
{
    (void)n;
    const float from_axis = length(p.xy);
    const float2 outwards = from_axis > 0.0f ? p.xy / from_axis : (float2)(1.0f, 0.0f);
    struct tangents along;
    along.u = -2.0f * RT_PI * (float3)(-p.y, p.x, 0.0f);
    along.v = (float3)((1.0f - shape->p[0]) * outwards, 0.0f);
    return along;
}

#endif
