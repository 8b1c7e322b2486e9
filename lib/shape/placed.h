/*
 * placed.h - what the files of the shapes share: checks of their parameters, placements, bounds,
 * and adding a shape that is kept in object space.
 */
#ifndef RT_LIB_SHAPE_PLACED_H
#define RT_LIB_SHAPE_PLACED_H

#include "base/error.h"
#include "scene/check.h"
#include "scene/scene.h"
#include "shape/classes.h"

/* A length from RT_LENGTH_MIN to RT_COORDINATE_MAX. */
rt_status rt_check_length(float radius, const char *who, const char *field, rt_error *error);

/* Normalises a direction; fails when it has no length. */
rt_status rt_check_direction(double out[3], const float v[3], const char *who, const char *field,
                             rt_error *error);

/*
 * The map to a circle of this radius about unit vector n at `centre`, with `height` along n for 1;
 * and to a box of these half edges about it.
 */
rt_affine rt_placement_about(const float centre[3], const double n[3], double radius,
                             double height);
rt_affine rt_placement_scaled(const float centre[3], double x, double y, double z);

/* Rounds bounds outwards, with room for the roundings of the kernels that intersect the shape. */
void rt_shape_set_bounds(rt_scene_shape *shape, int axis, double lo, double hi);

/*
 * Adds a shape in object space whose kind, p, caps and surface are set: placed by `placement`, and
 * then by the transform of its surface.
 */
rt_status rt_shape_add_placed(rt_scene *scene, uint32_t *out, rt_new_shape *added,
                              const rt_affine *placement, const char *who, rt_error *error);

/* A point of the world in the object space of the shape; 0 when its map cannot be inverted. */
int rt_shape_to_object(double out[3], const rt_scene *scene, const rt_scene_shape *shape,
                       const double p[3]);

#endif
