/* lights.h - the table of lights: delta lights, the environment, and every emissive primitive. */
#ifndef RT_LIB_LIGHT_LIGHTS_H
#define RT_LIB_LIGHT_LIGHTS_H

#include "scene/scene.h"

/*
 * The number of lights of the scene: delta lights, the environment, and the primitives of emissive
 * shapes.
 */
size_t rt_lights_count(const rt_scene *scene);

/*
 * Fills lights[rt_lights_count(scene)], delta lights and the environment first, then shape by
 * shape, and first_light[shape_count] with the light of each shape's first primitive, or RT_NONE.
 * first_prim[shape_count] says where each shape's primitives begin; radius is that of a sphere
 * around all finite shapes, metres, or 0 when there are none. pmf and cdf are set in proportion to
 * power, the mean of the three channels. Returns the power of all lights, W.
 */
double rt_lights_fill(const rt_scene *scene, const rt_u32 *first_prim, double radius,
                      rt_light_data *lights, rt_u32 *first_light);

#endif
