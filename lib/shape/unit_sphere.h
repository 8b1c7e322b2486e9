/* unit_sphere.h - adds a placed unit sphere to the scene, which is a sphere or an ellipsoid. */
#ifndef RT_LIB_SHAPE_UNIT_SPHERE_H
#define RT_LIB_SHAPE_UNIT_SPHERE_H

#include "shape/placed.h"

/* Adds a sphere where placement and transform together are a similarity, else an ellipsoid. */
rt_status rt_shape_add_unit_sphere(rt_scene *scene, uint32_t *out, const rt_affine *placement,
                                   const rt_surface *surface, const char *who, rt_error *error);

/* Its extent, as rt_shape_class has it. */
void rt_unit_sphere_extent(const rt_scene_shape *shape, const double row[4], double *lo,
                           double *hi);

#endif
