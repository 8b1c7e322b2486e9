/* ball.h - what sphere and ellipsoid share: a map of the unit sphere may give either. */
#ifndef RT_LIB_SHAPE_BALL_H
#define RT_LIB_SHAPE_BALL_H

#include "shape/placed.h"

/* Adds a sphere where the placement keeps the unit sphere one, else an ellipsoid. */
rt_status rt_shape_add_ball(rt_scene *scene, uint32_t *out, const rt_affine *placement,
                            const rt_surface *surface, const char *who, rt_error *error);

#endif
