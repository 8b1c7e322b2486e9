/*
 * sphere.h - the sphere, in world space: p[0..2] centre, p[3] radius. A transform, where it has
 * one, only turns the normal to that of u and v.
 */
#ifndef RT_KERNELS_SHAPE_SPHERE_H
#define RT_KERNELS_SHAPE_SPHERE_H

#include "math/frame.h"
#include "math/ray.h"
#include "scene.h"
#include "shape/object_point.h"
#include "shape/placement.h"
#include "shape/surface.h"
#include "types.h"

/* distance / radius under which an emissive sphere is sampled by area, not by its visible cap */
#define RT_NEAR_SPHERE 1.001f

/* ---- Intersection ----------------------------------------------------------- */

/* sqrt(x y), also where the product, of squares both, is out of a float's range. */
static inline float root_of_product(float x, float y)
{
    const float product = x * y;
    return product >= 1e-30f && product < INFINITY ? sqrt(product) : sqrt(x) * sqrt(y);
}

/*
 * The nearest t in [t_min, t_max] at which the ray meets the sphere about `centre`, or infinity.
 * The discriminant and the smaller root are computed without cancellation: Haines, Gunther and
 * Akenine-Moeller, "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems, 2019,
 * chapter 7.
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
    *part = PART_EXITS;
    return far >= ray->t_min && far <= ray->t_max ? far : INFINITY;
}

static inline float sphere_intersect(global const rt_shape *shape, const struct ray *ray,
                                     uint *part)
{
    return intersect_sphere(vload3(0, shape->p), shape->p[3], ray, part);
}

/* ---- Texture coordinates ---------------------------------------------------- */

/* Longitude from +x towards -z and latitude from the south pole of a unit vector, both in [0,1]. */
static inline float2 sphere_parameters(float3 n)
{
    return (float2)(turns(-n.z, n.x), 1.0f - acos(clamp(n.y, -1.0f, 1.0f)) * M_1_PI_F);
}

/* u and v at the unit normal n. */
static inline float2 sphere_uv(const struct scene *scene, global const rt_shape *shape, float3 n)
{
    const float3 turned = shape->transform == RT_NONE
                              ? n
                              : unit(map_vector(scene->transforms[shape->transform].to_object, n));
    return sphere_parameters(turned);
}

/* Sets u and v of a point on the sphere. */
static inline void locate_on_sphere(struct surface *surface, const struct scene *scene,
                                    global const rt_shape *shape)
{
    const float2 uv = sphere_uv(scene, shape, unit(surface->position - vload3(0, shape->p)));
    surface->u = uv.x;
    surface->v = uv.y;
}

/* The tangents of the unit sphere at p, by the longitude and latitude of sphere_parameters. */
static inline struct tangents unit_sphere_tangents(float3 p)
{
    const float r = length(p.xz);
    const float inverse = r > 0.0f ? 1.0f / r : 0.0f;
    struct tangents along;
    along.u = 2.0f * RT_PI * (float3)(p.z, 0.0f, -p.x);
    along.v = RT_PI * (float3)(-p.y * p.x * inverse, r, -p.y * p.z * inverse);
    return along;
}

static inline struct tangents sphere_tangents(const struct scene *scene,
                                              global const rt_shape *shape,
                                              const struct surface *surface)
{
    const float radius = shape->p[3];
    const float3 n = surface->normal;
    struct tangents along;
    if (shape->transform == RT_NONE) {
        along = unit_sphere_tangents(n);
        along.u *= radius;
        along.v *= radius;
    } else {
        global const rt_transform_data *placement = scene->transforms + shape->transform;
        const float3 p = unit(map_vector(placement->to_object, n));
        const float scale = radius / length(map_vector(placement->to_world, p));
        along = unit_sphere_tangents(p);
        along.u = scale * map_vector(placement->to_world, along.u);
        along.v = scale * map_vector(placement->to_world, along.v);
    }
    return along;
}

/* ---- Surface ---------------------------------------------------------------- */

/* The hit moved onto the sphere. */
static inline void sphere_surface(struct surface *surface, const struct scene *scene,
                                  global const rt_shape *shape, const struct ray *ray,
                                  const struct hit *hit)
{
    const float3 centre = vload3(0, shape->p);
    const float radius = shape->p[3];
    const float3 n = unit(ray->origin + hit->t * ray->direction - centre);
    surface->normal = facing_normal(n, ray->direction, (uint)hit->u & PART_EXITS);
    surface->shading = surface->normal;
    surface->position = centre + radius * n;
    surface->error = gamma_bound(6.0f) * radius + gamma_bound(3.0f) * dot(fabs(centre), fabs(n));
    if (is_located(shape))
        locate_on_sphere(surface, scene, shape);
}

/* ---- Area sampling ---------------------------------------------------------- */

/* The point of an emissive sphere at this unit normal. */
static inline void sphere_point(struct surface *at, global const rt_light_data *light,
                                float3 normal)
{
    const float3 a = row3(light->a);
    at->position = a + light->width * normal;
    at->normal = normal;
    at->error = gamma_bound(8.0f) * (fabs(a.x) + fabs(a.y) + fabs(a.z) + light->width);
}

/*
 * Whether the light is a sphere far enough to be sampled by its visible cap, and its far side is
 * not seen through that; *d2 is its centre's squared distance.
 */
static inline bool see_spherical_light(global const rt_light_data *light, float3 from, float *d2)
{
    if (light->kind != RT_LIGHT_SPHERE || (light->flags & RT_LIGHT_FAR_SIDE))
        return false;
    const float3 towards = row3(light->a) - from;
    *d2 = dot(towards, towards);
    return *d2 > square(RT_NEAR_SPHERE * light->width);
}

#endif
