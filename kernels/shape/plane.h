/*
 * plane.h - the infinite plane, in world space: p[0..2] a point, p[4..6] the unit normal. It is
 * kept beside the tree. A transform, where it has one, maps the point to x = u, y = v.
 */
#ifndef RT_KERNELS_SHAPE_PLANE_H
#define RT_KERNELS_SHAPE_PLANE_H

#include "math/ray.h"
#include "scene.h"
#include "shape/placement.h"
#include "shape/surface.h"
#include "types.h"

/* The t in [t_min, t_max] at which the ray meets the plane, or infinity. It has one part. */
static inline float plane_intersect(global const rt_shape *plane, const struct ray *ray, uint *part)
{
    (void)part;
    const float3 normal = vload3(0, plane->p + 4);
    const float t = dot(normal, vload3(0, plane->p) - ray->origin) / dot(normal, ray->direction);
    return t >= ray->t_min && t <= ray->t_max ? t : INFINITY;
}

/*
 * The hit moved onto the plane; u, v: metres from its point along plane_axes, or as its transform
 * says. A plane through the origin along two axes is met without any error: a ray that leaves it
 * must still begin beside it.
 */
static inline void plane_surface(struct surface *surface, const struct scene *scene,
                                 global const rt_shape *shape, const struct ray *ray,
                                 const struct hit *hit)
{
    const float3 point = vload3(0, shape->p);
    const float3 n = vload3(0, shape->p + 4);
    const float3 p = ray->origin + hit->t * ray->direction;
    surface->normal = n;
    surface->shading = n;
    surface->position = p - dot(p - point, n) * n;
    surface->error = fmax(gamma_bound(8.0f) * dot(fabs(p) + fabs(point), fabs(n)), 0x1p-100f);
    if (shape->transform != RT_NONE) {
        const float3 mapped =
            point_to_object(scene->transforms + shape->transform, surface->position);
        surface->u = mapped.x;
        surface->v = mapped.y;
        return;
    }
    float3 u, v;
    plane_axes(n, &u, &v);
    surface->u = dot(surface->position - point, u);
    surface->v = dot(surface->position - point, v);
}

static inline struct tangents plane_tangents(const struct scene *scene,
                                             global const rt_shape *shape,
                                             const struct surface *surface)
{
    (void)surface;
    struct tangents along;
    if (shape->transform == RT_NONE) {
        plane_axes(vload3(0, shape->p + 4), &along.u, &along.v);
    } else {
        global const rt_transform_data *placement = scene->transforms + shape->transform;
        along.u = map_vector(placement->to_world, (float3)(1.0f, 0.0f, 0.0f));
        along.v = map_vector(placement->to_world, (float3)(0.0f, 1.0f, 0.0f));
    }
    return along;
}

#endif
