/*
 * canonical.h - points of the shapes that are given in a space of their own, as types.h describes
 * them there: moved onto the surface, with normal, error bound, u and v.
 */
#ifndef RT_KERNELS_SHAPE_CANONICAL_H
#define RT_KERNELS_SHAPE_CANONICAL_H

#include "math/frame.h"
#include "shape/placement.h"
#include "shape/surface.h"
#include "types.h"

/* A surface point in the shape's own space. */
struct canonical {
    float3 position;
    float3 normal; /* unit, outwards */
    float error;   /* how far along the normal a ray must start to be off the surface */
    float u, v;
};

/* Parts of a cylinder or cone. */
#define ROUND_SIDE 0u
#define ROUND_BASE 1u /* the cap at z = 0 */
#define ROUND_TOP 2u  /* the cap at z = 1 */
#define ROUND_PART 3u /* mask */

/* Flag beside the part, of every curved shape: the ray goes out. */
#define PART_LEAVES 4u

/* The radius of a cylinder or cone at z = 1. */
static inline float round_top(global const rt_shape *shape)
{
    return shape->kind == RT_SHAPE_CONE ? shape->p[0] : 1.0f;
}

/*
 * The normal where a ray in this direction goes out or in. Where it grazes, rounding may put the
 * hit on the turned side of a curved surface; the normal is then bent to be just at a right angle
 * to the ray, so that in stays in.
 */
static inline float3 facing_normal(float3 normal, float3 direction, bool leaves)
{
    const float side = leaves ? 1.0f : -1.0f;
    const float3 ahead = unit(direction);
    const float along = dot(normal, ahead);
    return side * along > 0.0f ? normal : unit(normal + (side * 2e-6f - along) * ahead);
}

/* Longitude from +x towards -z and latitude from the south pole of a unit vector, both in [0,1]. */
static inline float2 sphere_parameters(float3 n)
{
    return (float2)(turns(-n.z, n.x), 1.0f - acos(clamp(n.y, -1.0f, 1.0f)) * M_1_PI_F);
}

static inline struct canonical canonical_ellipsoid(float3 p)
{
    struct canonical point;
    const float3 n = unit(p);
    const float2 uv = sphere_parameters(n);
    point.position = n;
    point.normal = n;
    point.error = gamma_bound(8.0f);
    point.u = uv.x;
    point.v = uv.y;
    return point;
}

/*
 * The angle of a point about z, in turns, clockwise seen from the side of the normal (+-z): so no
 * lettering is mirrored.
 */
static inline float turns_on_disc(float3 p, float normal_z)
{
    return turns(normal_z > 0.0f ? -p.y : p.y, p.x);
}

static inline struct canonical canonical_disc(global const rt_shape *shape, float3 p)
{
    struct canonical point;
    const float hole = shape->p[0];
    point.position = (float3)(p.xy, 0.0f);
    point.normal = (float3)(0.0f, 0.0f, 1.0f);
    point.error = gamma_bound(2.0f);
    point.u = turns_on_disc(p, 1.0f);
    point.v = clamp((length(p.xy) - hole) / (1.0f - hole), 0.0f, 1.0f);
    return point;
}

static inline struct canonical canonical_cap(float3 p, float radius, float z, float margin)
{
    struct canonical point;
    const float rim = fmax(radius - margin, 0.0f), from_axis = length(p.xy);
    point.position = (float3)(p.xy * (from_axis > rim ? rim / from_axis : 1.0f), z);
    point.normal = (float3)(0.0f, 0.0f, z > 0.0f ? 1.0f : -1.0f);
    point.error = gamma_bound(2.0f);
    point.u = turns_on_disc(p, point.normal.z);
    point.v = fmin(from_axis / radius, 1.0f);
    return point;
}

/*
 * A point of a cylinder or cone, on the part that was hit. Where parts meet it keeps off the other
 * part by what rounding may do to it: a ray that leaves the one then starts on the inside of the
 * other.
 */
static inline struct canonical canonical_round(global const rt_shape *shape,
                                               global const rt_transform_data *placement, float3 p,
                                               uint part)
{
    const float top = round_top(shape), slope = 1.0f - top;
    const float margin =
        0x1p-20f + 2.0f * length(placement_error(placement, p, point_to_world(placement, p)));
    if (part == ROUND_BASE)
        return canonical_cap(p, 1.0f, 0.0f, margin);
    if (part == ROUND_TOP)
        return canonical_cap(p, top, 1.0f, margin);
    struct canonical point;
    const float from_axis = length(p.xy);
    const float2 outwards = from_axis > 0.0f ? p.xy / from_axis : (float2)(1.0f, 0.0f);
    const float z =
        shape->flags & RT_SHAPE_CAPS ? clamp(p.z, margin, 1.0f - margin) : clamp(p.z, 0.0f, 1.0f);
    point.position = (float3)(outwards * (1.0f - slope * z), z);
    point.normal = unit((float3)(outwards, slope));
    point.error = gamma_bound(16.0f);
    point.u = turns(p.y, p.x);
    point.v = z;
    return point;
}

static inline struct canonical canonical_torus(global const rt_shape *shape, float3 p)
{
    struct canonical point;
    const float minor = shape->p[0];
    const float from_axis = length(p.xy);
    const float2 outwards = from_axis > 0.0f ? p.xy / from_axis : (float2)(1.0f, 0.0f);
    const float2 tube = (float2)(from_axis - 1.0f, p.z); /* from the middle of the tube */
    const float distance = length(tube);
    const float2 n = distance > 0.0f ? tube / distance : (float2)(1.0f, 0.0f);
    point.position = (float3)(outwards * (1.0f + minor * n.x), minor * n.y);
    point.normal = (float3)(outwards * n.x, n.y);
    point.error = gamma_bound(16.0f);
    point.u = turns(p.y, p.x);
    point.v = turns(tube.y, tube.x);
    return point;
}

static inline void place_canonical(struct surface *surface,
                                   global const rt_transform_data *placement,
                                   const struct canonical *point)
{
    place_surface(surface, placement, point->position, point->normal, point->error);
    surface->shading = surface->normal;
    surface->u = point->u;
    surface->v = point->v;
}

#endif
