/* area.h - areas of curved shapes under affine maps. */
#ifndef RT_LIB_SCENE_AREA_H
#define RT_LIB_SCENE_AREA_H

#include "scene/transform.h"

/*
 * Areas in world space, m^2, of the shapes that kernels/types.h describes, each placed by a map; to
 * 1e-6 of the area.
 */
double rt_area_ellipsoid(const rt_affine *to_world);
double rt_area_disc(const rt_affine *to_world, double inner_radius);
/* a cylinder with apex_radius 1 */
double rt_area_cone(const rt_affine *to_world, double apex_radius, int caps);
double rt_area_torus(const rt_affine *to_world, double minor_radius);

#endif
