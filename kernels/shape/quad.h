/*
 * quad.h - the parallelogram, kept in a block as triangles are (triangle.h). An emissive one with
 * right angles is a rectangle, and sampled by the solid angle that it fills.
 *
 * Below RT_SMALL_SOLID_ANGLE, where float32 no longer resolves the difference of angles, a
 * rectangle is sampled by area as well: seen so small, both densities are nearly the same, and each
 * is used with its own pdf, so the mean is seamless.
 */
#ifndef RT_KERNELS_SHAPE_QUAD_H
#define RT_KERNELS_SHAPE_QUAD_H

#include "math/frame.h"
#include "sample/sample.h"
#include "shape/triangle.h"
#include "types.h"

/*
 * How a rectangular light is seen from a point; false when it is none, or is better sampled by
 * area.
 */
static inline bool see_rectangular_light(global const rt_light_data *light, float3 from,
                                         struct seen_rectangle *seen)
{
    if (!(light->flags & RT_LIGHT_RECTANGLE))
        return false;
    const float3 corner = row3(light->a) - from;
    const float x = dot(corner, row3(light->b)), y = dot(corner, row3(light->c)),
                z = dot(corner, row3(light->normal));
    if (!is_near_rectangle(x, y, z, light->width, light->height))
        return false;
    *seen = see_rectangle(x, y, fabs(z), light->width, light->height);
    return seen->solid_angle >= RT_SMALL_SOLID_ANGLE;
}

#endif
