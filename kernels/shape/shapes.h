/*
 * shapes.h - rays against the shapes that are not kept in blocks, but instances.
 */
#ifndef RT_KERNELS_SHAPE_SHAPES_H
#define RT_KERNELS_SHAPE_SHAPES_H

#include "math/lanes.h"
#include "shape/line.h"
#include "shape/placement.h"
#include "math/ray.h"
#include "shape/round.h"
#include "scene.h"
#include "shape/torus.h"
#include "types.h"

/* sqrt(x y), also where the product, of squares both, is out of a float's range. */
static inline float root_of_product(float x, float y)
{
    const float product = x * y;
    return product >= 1e-30f && product < INFINITY ? sqrt(product) : sqrt(x) * sqrt(y);
}

/*
 * The nearest t in [t_min, t_max] at which the ray meets the sphere about `centre`, or infinity;
 * *part tells in from out. The discriminant and the smaller root are computed without cancellation:
 * Haines, Gunther and Akenine-Moeller, "Precision Improvements for Ray/Sphere Intersection", Ray
 * Tracing Gems, 2019, chapter 7.
 */
static inline float intersect_sphere(float3 centre, float radius, const struct ray *ray, uint *part)
{
    const float3 f = ray->origin - centre;
    const float3 d = ray->direction;
    const float a = dot(d, d);
    const float b = -dot(f, d);
    const float3 nearest = f + (b / a) * d; /* from the centre to the line's nearest point */
    const float h = (radius - length(nearest)) * (radius + length(nearest));
    if (!(h >= 0.0f))
        return INFINITY;
    const float q = b + copysign(root_of_product(a, h), b);
    const float distance = length(f);
    const float c = (distance - radius) * (distance + radius);
    const float t0 = c / q, t1 = q / a;
    const float near = t0 < t1 ? t0 : t1, far = t0 < t1 ? t1 : t0;
    if (near >= ray->t_min && near <= ray->t_max)
        return near;
    *part = PART_LEAVES;
    return far >= ray->t_min && far <= ray->t_max ? far : INFINITY;
}

/* The t in [t_min, t_max] at which the ray meets the plane, or infinity. */
static inline float intersect_plane(global const rt_shape *plane, const struct ray *ray)
{
    const float3 normal = vload3(0, plane->p + 4);
    const float t = dot(normal, vload3(0, plane->p) - ray->origin) / dot(normal, ray->direction);
    return t >= ray->t_min && t <= ray->t_max ? t : INFINITY;
}

/* The same for the disc in its own space. */
static inline float intersect_disc(float hole, const struct ray *ray)
{
    const float t = -ray->origin.z / ray->direction.z;
    const float from_axis = length(ray->origin.xy + t * ray->direction.xy);
    return t >= ray->t_min && t <= ray->t_max && from_axis >= hole && from_axis <= 1.0f ? t
                                                                                        : INFINITY;
}

/* The same for the shapes that a transform places; *part as intersect_shape has it. */
INLINE_NEVER float intersect_placed(const struct scene *scene, global const rt_shape *shape,
                                    const struct ray *ray, uint *part)
{
    const struct ray own = ray_to_object(scene->transforms + shape->transform, ray);
    if (shape->kind == RT_SHAPE_ELLIPSOID)
        return intersect_sphere((float3)(0.0f), 1.0f, &own, part);
    if (shape->kind == RT_SHAPE_DISC)
        return intersect_disc(shape->p[0], &own);
    const struct line line = make_line(&own);
    const float s = shape->kind == RT_SHAPE_TORUS ? intersect_torus(shape->p[0], &line, part)
                                                  : intersect_round(shape, &line, part);
    return s < INFINITY ? line_t(&line, ray, s) : INFINITY;
}

/*
 * The nearest t in [t_min, t_max] at which the ray meets a shape that is not kept in blocks, or
 * infinity; *part is the part of a cylinder or cone that it meets, with PART_LEAVES where it goes
 * out of a curved shape.
 */
INLINE_NEVER float intersect_shape(const struct scene *scene, global const rt_shape *shape,
                                   const struct ray *ray, uint *part)
{
    *part = 0u;
    if (shape->kind == RT_SHAPE_SPHERE)
        return intersect_sphere(vload3(0, shape->p), shape->p[3], ray, part);
    if (shape->kind == RT_SHAPE_PLANE)
        return intersect_plane(shape, ray);
    return intersect_placed(scene, shape, ray, part);
}

#endif
