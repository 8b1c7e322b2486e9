/*
 * surface.h - what a hit looks like as a surface: position, normals, parameters.
 *
 * The position comes from the primitive, not from origin + t direction, and carries a bound on
 * its rounding error, so that rays leave by just as much as is needed, at any scale. Errors are
 * bounded by gamma(n) = n e / (1 - n e), e = 2^-24 (Higham, "Accuracy and Stability of Numerical
 * Algorithms", 2002, section 3.1; for rays, Pharr, Jakob and Humphreys, "Physically Based
 * Rendering", 3rd ed., section 3.9).
 */
#ifndef RT_SURFACE_H
#define RT_SURFACE_H

#include "intersect.h"
#include "scene.h"
#include "types.h"

/* A point on a surface. */
struct surface {
    float3 position; /* metres */
    float error;     /* how far along the normal a ray must start to be off the surface, metres; see leave_surface */
    float3 normal;   /* unit geometric normal, not turned towards the ray */
    float3 shading;  /* unit shading normal, on the side of `normal`; equals it on flat shapes */
    float u, v;      /* surface parameters, as the public header states for each shape */
    uint shape;      /* index in scene->shapes */
    uint prim;       /* primitive of the scene */
};

/*
 * The origin for a ray that leaves the surface in direction w: off the surface by its error
 * bound, on the side of w, so that a ray with t_min = 0 does not meet the same surface again.
 */
static inline float3 leave_surface(const struct surface *surface, float3 w)
{
    const float side = dot(w, surface->normal) < 0.0f ? -1.0f : 1.0f;
    return surface->position + side * surface->error * surface->normal;
}

static inline float gamma_bound(float n)
{
    const float e = 0x1p-24f;
    return n * e / (1.0f - n * e);
}

/* Two orthogonal units that with n make a right-handed frame u, v, n; v points up where n is not vertical. */
static inline void plane_axes(float3 n, float3 *u, float3 *v)
{
    const float3 up = fabs(n.y) > 0.999f ? (float3)(0.0f, 0.0f, -1.0f) : (float3)(0.0f, 1.0f, 0.0f);
    *u = normalize(cross(up, n));
    *v = cross(n, *u);
}

static inline float3 block_vertex(global const float rows[3][RT_BVH_WIDTH], uint lane)
{
    return (float3)(rows[0][lane], rows[1][lane], rows[2][lane]);
}

/* The interpolated normal of triangle `prim`, turned to the side of the geometric normal. */
static inline float3 smooth_normal(const struct scene *scene, global const rt_shape *shape, uint prim, float u, float v,
                                   float3 normal)
{
    global const float4 *corner = scene->normals + shape->first_normal + 3u * (prim - shape->first_prim);
    const float3 mixed = (1.0f - u - v) * corner[0].xyz + u * corner[1].xyz + v * corner[2].xyz;
    const float square = dot(mixed, mixed);
    if (!(square > 1e-12f))
        return normal;
    return mixed * (dot(mixed, normal) < 0.0f ? -rsqrt(square) : rsqrt(square));
}

/* Position from the barycentric mix; the host made what does not depend on where the hit is. */
static inline void triangle_surface(struct surface *surface, const struct scene *scene, const struct hit *hit)
{
    global const rt_tri_block *block = scene->blocks + (hit->slot >> 3);
    const uint lane = hit->slot & 7u;
    const float3 v0 = block_vertex(block->v0, lane);
    const float3 e1 = block_vertex(block->v1, lane) - v0;
    const float3 e2 = block_vertex(block->v2, lane) - v0;
    const float4 face = ((global const float4 *)scene->faces)[hit->slot];
    global const rt_shape *shape = scene->shapes + surface->shape;

    surface->u = hit->u;
    surface->v = hit->v;
    surface->position = v0 + (hit->u * e1 + hit->v * e2);
    surface->normal = face.xyz;
    surface->error = face.w;
    surface->shading = shape->flags & RT_SHAPE_SMOOTH
                           ? smooth_normal(scene, shape, surface->prim, hit->u, hit->v, surface->normal)
                           : surface->normal;
}

/* Position moved onto the sphere; u: longitude from +x towards +z, v: latitude from the south pole. */
static inline void sphere_surface(struct surface *surface, global const rt_shape *shape, const struct ray *ray, float t)
{
    const float3 centre = vload3(0, shape->p);
    const float radius = shape->p[3];
    const float3 n = normalize(ray->origin + t * ray->direction - centre);
    surface->normal = n;
    surface->shading = n;
    surface->position = centre + radius * n;
    surface->error = gamma_bound(6.0f) * radius + gamma_bound(3.0f) * dot(fabs(centre), fabs(n));
    const float turn = atan2(n.z, n.x) * (0.5f * M_1_PI_F);
    surface->u = turn < 0.0f ? turn + 1.0f : turn;
    surface->v = 1.0f - acos(clamp(n.y, -1.0f, 1.0f)) * M_1_PI_F;
}

/* Position moved onto the plane; u, v: metres from its point along plane_axes. */
static inline void plane_surface(struct surface *surface, global const rt_shape *shape, const struct ray *ray, float t)
{
    const float3 point = vload3(0, shape->p);
    const float3 n = vload3(0, shape->p + 4);
    const float3 p = ray->origin + t * ray->direction;
    float3 u, v;
    plane_axes(n, &u, &v);
    surface->normal = n;
    surface->shading = n;
    surface->position = p - dot(p - point, n) * n;
    surface->error = gamma_bound(8.0f) * dot(fabs(p) + fabs(point), fabs(n));
    surface->u = dot(surface->position - point, u);
    surface->v = dot(surface->position - point, v);
}

/* Turns a hit of closest_hit, found with this ray, into a surface. */
static inline struct surface surface_at(const struct scene *scene, const struct ray *ray, const struct hit *hit)
{
    struct surface surface;
    surface.prim = hit->prim;
    surface.shape = scene->prim_shape[hit->prim];
    global const rt_shape *shape = scene->shapes + surface.shape;
    if (!(hit->slot & RT_SLOT_ANALYTIC))
        triangle_surface(&surface, scene, hit);
    else if (shape->kind == RT_SHAPE_PLANE)
        plane_surface(&surface, shape, ray, hit->t);
    else
        sphere_surface(&surface, shape, ray, hit->t);
    return surface;
}

#endif
