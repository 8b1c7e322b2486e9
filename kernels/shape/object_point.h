/*
 * object_point.h - points of the shapes that a transform places, in object space, and how they come
 * to the world.
 */
#ifndef RT_KERNELS_SHAPE_OBJECT_POINT_H
#define RT_KERNELS_SHAPE_OBJECT_POINT_H

#include "math/frame.h"
#include "shape/placement.h"
#include "shape/surface.h"

/* A surface point in object space. */
struct object_point {
    float3 position;
    float3 normal; /* unit, outwards */
    float error;   /* how far along the normal a ray must start to be off the surface */
};

/*
 * hit.u holds the part of the shape that was hit: a number defined in the shape's header and, for
 * curved shapes, whether the ray leaves the shape there.
 */
#define PART_MASK 7u
#define PART_EXITS 8u

/*
 * The normal where a ray in this direction goes out or in. Where it grazes, rounding may put the
 * hit on the far side of a curved surface; the normal is then bent to just less than a right angle
 * with the ray, so that going in stays going in.
 */
static inline float3 facing_normal(float3 normal, float3 direction, bool exits)
{
    const float side = exits ? 1.0f : -1.0f;
    const float3 ahead = unit(direction);
    const float along = dot(normal, ahead);
    return side * along > 0.0f ? normal : unit(normal + (side * 2e-6f - along) * ahead);
}

/* Sets the surface, but for its u and v, from its point in object space. */
static inline void place_point(struct surface *surface, global const rt_transform_data *placement,
                               const struct object_point *point)
{
    place_surface(surface, placement, point->position, point->normal, point->error);
    surface->shading = surface->normal;
}

#endif
