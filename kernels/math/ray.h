/*
 * ray.h - rays on the device, and what is kept of a hit.
 */
#ifndef RT_KERNELS_MATH_RAY_H
#define RT_KERNELS_MATH_RAY_H

#include "types.h"

/*
 * origin + t direction, t_min <= t <= t_max, t_max may be infinite; direction of any length but
 * zero.
 */
struct ray {
    float3 origin;
    float3 direction;
    float t_min;
    float t_max;
};

/* What a traversal keeps of the nearest hit; surface_at makes a surface of it. */
struct hit {
    float t;
    /* triangle: weights of v1 and v2; parallelogram: along the edges; shapes: u is the part */
    float u, v;
    uint prim; /* primitive of the scene: of an instance, the instance */
    uint slot; /* see RT_SLOT_ANALYTIC */
};

static inline struct ray make_ray(float3 origin, float3 direction, float t_min, float t_max)
{
    struct ray ray;
    ray.origin = origin;
    ray.direction = direction;
    ray.t_min = t_min;
    ray.t_max = t_max;
    return ray;
}

#endif
