/*
 * surface_at.h - from a hit to the surface there.
 */
#ifndef RT_KERNELS_SHAPE_SURFACE_AT_H
#define RT_KERNELS_SHAPE_SURFACE_AT_H

#include "shape/canonical.h"
#include "shape/mesh.h"
#include "shape/placement.h"
#include "math/ray.h"
#include "scene.h"
#include "shape/surface.h"
#include "types.h"

/*
 * The texture coordinates of a point on a sphere; a transform turns the normal to that of u and v.
 */
static inline void locate_on_sphere(struct surface *surface, const struct scene *scene,
                                    global const rt_shape *shape)
{
    const float3 n = unit(surface->position - vload3(0, shape->p));
    const float3 turned = shape->transform == RT_NONE
                              ? n
                              : unit(map_vector(scene->transforms[shape->transform].to_object, n));
    const float2 uv = sphere_parameters(turned);
    surface->u = uv.x;
    surface->v = uv.y;
}

/*
 * Position moved onto the sphere; u and v, which take long, only where a texture or a light may ask
 * for them.
 */
static inline void sphere_surface(struct surface *surface, const struct scene *scene,
                                  global const rt_shape *shape, const struct ray *ray,
                                  const struct hit *hit)
{
    const float3 centre = vload3(0, shape->p);
    const float radius = shape->p[3];
    const float3 n = unit(ray->origin + hit->t * ray->direction - centre);
    surface->normal = facing_normal(n, ray->direction, (uint)hit->u & PART_LEAVES);
    surface->shading = surface->normal;
    surface->position = centre + radius * n;
    surface->error = gamma_bound(6.0f) * radius + gamma_bound(3.0f) * dot(fabs(centre), fabs(n));
    surface->u = surface->v = 0.0f;
    if ((shape->flags & RT_SHAPE_VARIED) || shape->first_light != RT_NONE)
        locate_on_sphere(surface, scene, shape);
}

/*
 * Position moved onto the plane; u, v: metres from its point along plane_axes, or as its transform
 * says. A plane through the origin of an axis is met without any error: a ray that leaves it must
 * still begin beside it.
 */
static inline void plane_surface(struct surface *surface, const struct scene *scene,
                                 global const rt_shape *shape, const struct ray *ray, float t)
{
    const float3 point = vload3(0, shape->p);
    const float3 n = vload3(0, shape->p + 4);
    const float3 p = ray->origin + t * ray->direction;
    surface->normal = n;
    surface->shading = n;
    surface->position = p - dot(p - point, n) * n;
    surface->error = fmax(gamma_bound(8.0f) * dot(fabs(p) + fabs(point), fabs(n)), 0x1p-100f);
    if (shape->transform != RT_NONE) {
        const float3 own = point_to_object(scene->transforms + shape->transform, surface->position);
        surface->u = own.x;
        surface->v = own.y;
        return;
    }
    float3 u, v;
    plane_axes(n, &u, &v);
    surface->u = dot(surface->position - point, u);
    surface->v = dot(surface->position - point, v);
}

/* The shapes with a placement. */
static inline void placed_surface(struct surface *surface, const struct scene *scene,
                                  global const rt_shape *shape, const struct ray *ray,
                                  const struct hit *hit)
{
    global const rt_transform_data *placement = scene->transforms + shape->transform;
    const struct ray own = ray_to_object(placement, ray);
    const float3 p = own.origin + hit->t * own.direction;
    struct canonical point;
    switch (shape->kind) {
    case RT_SHAPE_DISC:
        point = canonical_disc(shape, p);
        break;
    case RT_SHAPE_CYLINDER:
    case RT_SHAPE_CONE:
        point = canonical_round(shape, placement, p, (uint)hit->u & ROUND_PART);
        break;
    case RT_SHAPE_TORUS:
        point = canonical_torus(shape, p);
        break;
    default:
        point = canonical_ellipsoid(p);
    }
    if (shape->kind != RT_SHAPE_DISC)
        point.normal = facing_normal(point.normal, own.direction, (uint)hit->u & PART_LEAVES);
    place_canonical(surface, placement, &point);
}

/*
 * Turns a hit of closest_hit, found with this ray, into a surface; see sphere_surface for u and v.
 */
static inline struct surface surface_at(const struct scene *scene, const struct ray *ray,
                                        const struct hit *hit)
{
    struct surface surface;
    surface.prim = hit->prim;
    surface.shape = scene->prim_shape[hit->prim];
    surface.slot = hit->slot;
    surface.weights = (float2)(0.0f);
    surface.triangle = 0u;
    global const rt_shape *shape = scene->shapes + surface.shape;
    if (!(hit->slot & RT_SLOT_ANALYTIC))
        triangle_surface(&surface, scene, hit);
    else if (shape->kind == RT_SHAPE_PLANE)
        plane_surface(&surface, scene, shape, ray, hit->t);
    else if (shape->kind == RT_SHAPE_SPHERE)
        sphere_surface(&surface, scene, shape, ray, hit);
    else
        placed_surface(&surface, scene, shape, ray, hit);
    return surface;
}

#endif
