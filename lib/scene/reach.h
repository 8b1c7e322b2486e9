/* reach.h - how far shapes reach along a direction, and which of them a line meets first. */
#ifndef RT_LIB_SCENE_REACH_H
#define RT_LIB_SCENE_REACH_H

#include "scene/scene.h"

/*
 * The largest n . x over the points x of a shape, or some value above `enough` where it reaches
 * that far; infinite for a plane that n is not normal to. Counts what it looks at in *work.
 */
double rt_shape_reach(const rt_scene *scene, const rt_scene_shape *shape, const double n[3],
                      double enough, size_t *work);

/*
 * The shape that the line from p along unit vector d meets first, but for `from`, nearer than
 * *distance, which then is where; RT_NONE where it meets none. Of curved shapes, discs and boxes it
 * meets the bounds; for `walls` only opaque ones count of which it meets the surface itself. Counts
 * as above.
 */
uint32_t rt_scene_first_along(const rt_scene *scene, const rt_scene_shape *from, const double p[3],
                              const double d[3], int walls, double *distance, size_t *work);

#endif
