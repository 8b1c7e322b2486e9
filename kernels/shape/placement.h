/*
 * placement.h - the map of a shape between object space and the world.
 *
 * With L the linear part of the map and c the image of the origin, a world point x lies at
 * inverse(L) (x - c): the difference first, which is exact near the shape, so that shapes far from
 * the origin lose nothing but what rounding took from x itself.
 */
#ifndef RT_KERNELS_SHAPE_PLACEMENT_H
#define RT_KERNELS_SHAPE_PLACEMENT_H

#include "math/frame.h"
#include "math/ray.h"
#include "shape/surface.h"
#include "types.h"

static inline float3 linear_row(global const float row[4])
{
    return vload4(0, row).xyz;
}

/* M v, with M the linear part of the rows. */
static inline float3 map_vector(global const float rows[3][4], float3 v)
{
    return (float3)(dot(linear_row(rows[0]), v), dot(linear_row(rows[1]), v),
                    dot(linear_row(rows[2]), v));
}

/* The transpose of M times v. */
static inline float3 map_transposed(global const float rows[3][4], float3 v)
{
    return v.x * linear_row(rows[0]) + v.y * linear_row(rows[1]) + v.z * linear_row(rows[2]);
}

static inline float3 placement_centre(global const rt_transform_data *placement)
{
    return (float3)(placement->to_world[0][3], placement->to_world[1][3],
                    placement->to_world[2][3]);
}

static inline float3 point_to_object(global const rt_transform_data *placement, float3 x)
{
    return map_vector(placement->to_object, x - placement_centre(placement));
}

/*
 * The normal in object space, not of unit length, of a surface with this normal in the world.
 */
static inline float3 normal_to_object(global const rt_transform_data *placement, float3 normal)
{
    return map_transposed(placement->to_world, normal);
}

/*
 * The normal in the world, not of unit length: what is outside stays outside, even where the map
 * mirrors.
 */
static inline float3 normal_to_world(global const rt_transform_data *placement, float3 normal)
{
    return map_transposed(placement->to_object, normal);
}

/* The ray in object space; its t is the world's. */
static inline struct ray ray_to_object(global const rt_transform_data *placement,
                                       const struct ray *ray)
{
    return make_ray(point_to_object(placement, ray->origin),
                    map_vector(placement->to_object, ray->direction), ray->t_min, ray->t_max);
}

/*
 * The factor by which the map scales the area of a surface element of unit normal n: |C n|, with C
 * the cofactors of L.
 */
static inline float area_scale(global const rt_transform_data *placement, float3 n)
{
    const float3 x = linear_row(placement->to_world[0]);
    const float3 y = linear_row(placement->to_world[1]);
    const float3 z = linear_row(placement->to_world[2]);
    return length((float3)(dot(cross(y, z), n), dot(cross(z, x), n), dot(cross(x, y), n)));
}

/*
 * A bound, along each axis of object space, on what rounding does to the point p when it is mapped
 * to the world, where it is x, moved off the surface there, and mapped back.
 */
static inline float3 placement_error(global const rt_transform_data *placement, float3 p, float3 x)
{
    const float3 a = fabs(p);
    const float3 mapped = (float3)(dot(fabs(linear_row(placement->to_world[0])), a),
                                   dot(fabs(linear_row(placement->to_world[1])), a),
                                   dot(fabs(linear_row(placement->to_world[2])), a));
    const float3 there = gamma_bound(9.0f) * mapped + gamma_bound(3.0f) * fabs(x);
    return (float3)(dot(fabs(linear_row(placement->to_object[0])), there),
                    dot(fabs(linear_row(placement->to_object[1])), there),
                    dot(fabs(linear_row(placement->to_object[2])), there));
}

static inline float3 point_to_world(global const rt_transform_data *placement, float3 p)
{
    return map_vector(placement->to_world, p) + placement_centre(placement);
}

/*
 * Sets position, normal and error of a surface point from object space: position p, unit normal n,
 * and how far off along n a ray must start there. Mapping adds its own error along n. A distance
 * along n is one along the world's normal over |inverse transpose of L n|.
 */
static inline void place_surface(struct surface *surface, global const rt_transform_data *placement,
                                 float3 p, float3 n, float error)
{
    const float3 normal = normal_to_world(placement, n);
    const float scale = 1.0f / length(normal);
    surface->position = point_to_world(placement, p);
    surface->normal = normal * scale;
    surface->error =
        (error + dot(fabs(n), placement_error(placement, p, surface->position))) * scale;
}

#endif
