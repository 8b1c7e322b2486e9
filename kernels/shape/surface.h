/*
 * surface.h - a point on a surface, and the origins of rays that leave it.
 *
 * The position comes from the primitive, not from origin + t direction, and carries a bound on its
 * rounding error, so that rays start off the surface by just as much as is needed, at any scale.
 * Errors are bounded by gamma(n) = n e / (1 - n e), e = 2^-24 (Higham, "Accuracy and Stability of
 * Numerical Algorithms", 2002, section 3.1; for rays, Pharr, Jakob and Humphreys, "Physically Based
 * Rendering", 3rd ed., section 3.9).
 */
#ifndef RT_KERNELS_SHAPE_SURFACE_H
#define RT_KERNELS_SHAPE_SURFACE_H

#include "math/frame.h"
#include "types.h"

/* A point on a surface. */
struct surface {
    float3 position; /* metres */
    /* how far along the normal a ray must start to be off the surface, metres; see leave_surface */
    float error;
    float3 normal;  /* unit geometric normal, not turned towards the ray */
    float3 shading; /* unit shading normal, on the side of `normal`; equals it on flat shapes */
    float u, v;     /* surface parameters, as the public header states for each shape */
    float2 weights; /* triangles: of v1 and v2, for what is mixed from vertices */
    uint shape;     /* index in scene->shapes */
    uint prim;      /* primitive of the scene */
    uint triangle;  /* triangle of the mesh; 0 for the other shapes */
    uint slot;      /* of the hit, see RT_SLOT_ANALYTIC */
};

/* By member: a copy as a whole, with the gap between members, would keep that in private memory. */
static inline void copy_surface(struct surface *to, const struct surface *from)
{
    to->position = from->position;
    to->error = from->error;
    to->normal = from->normal;
    to->shading = from->shading;
    to->u = from->u;
    to->v = from->v;
    to->weights = from->weights;
    to->shape = from->shape;
    to->prim = from->prim;
    to->triangle = from->triangle;
    to->slot = from->slot;
}

/* Derivatives of the position by u and v, metres. */
struct tangents {
    float3 u, v;
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

/*
 * Whether u and v of a curved shape are made, which take long: where a texture needs them, and
 * everywhere in programs that define RT_LOCATE_ALL. Else they are 0.
 */
static inline bool is_located(global const rt_shape *shape)
{
#ifdef RT_LOCATE_ALL
    return true;
#else
    return shape->flags & RT_SHAPE_LOCATED;
#endif
}

static inline float gamma_bound(float n)
{
    const float e = 0x1p-24f;
    return n * e / (1.0f - n * e);
}

/* An angle, as atan2 gives it, in turns from 0 to 1. */
static inline float turns(float y, float x)
{
    const float turn = atan2(y, x) * (0.5f * M_1_PI_F);
    return turn < 0.0f ? fmin(turn + 1.0f, 1.0f) : turn;
}

/*
 * Two orthogonal units that with n make a right-handed frame u, v, n; v points up where n is not
 * vertical.
 */
static inline void plane_axes(float3 n, float3 *u, float3 *v)
{
    const float3 up = fabs(n.y) > 0.999f ? (float3)(0.0f, 0.0f, -1.0f) : (float3)(0.0f, 1.0f, 0.0f);
    *u = unit(cross(up, n));
    *v = cross(n, *u);
}

#endif
