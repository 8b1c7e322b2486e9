/*
 * frustum.h - what cylinder and cone share: in object space both are frustums about z, of radius 1
 * at z = 0 and radius `top` at z = 1, open or closed by caps.
 */
#ifndef RT_LIB_SHAPE_FRUSTUM_H
#define RT_LIB_SHAPE_FRUSTUM_H

#include "shape/placed.h"

void rt_frustum_extent(double top, const double row[4], double *lo, double *hi);
double rt_frustum_area(const rt_scene_shape *shape, const rt_affine *to_world, double top);
int rt_frustum_contains(const rt_scene *scene, const rt_scene_shape *shape, double top,
                        const double p[3]);
rt_shape_boundary rt_frustum_boundary(const rt_scene *scene, const rt_scene_shape *shape);

/*
 * Adds a cylinder or cone from a to b, of this radius at a; kind, caps and p are set. Messages call
 * the shape and its ends by `names`.
 */
rt_status rt_frustum_add(rt_scene *scene, uint32_t *out, rt_new_shape *added, const float a[3],
                         const float b[3], float radius, const char *const names[3],
                         rt_error *error);

#endif
