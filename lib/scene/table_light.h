/* table_light.h - what lights with an axis share: spots, beams, and those with a table. */
#ifndef RT_LIB_SCENE_TABLE_LIGHT_H
#define RT_LIB_SCENE_TABLE_LIGHT_H

#include "scene/scene.h"

/* Sets position and axis; fails where they have no direction. who: the light in messages. */
rt_status rt_light_aim(rt_scene_light *out, const float position[3], const float target[3],
                       const char *who, rt_error *error);

/*
 * Sets the unit vector across the axis towards `up`, or to the right of it for one who looks along
 * the axis. Left out, up is (0, 1, 0), or (0, 0, -1) where the axis is along y.
 */
rt_status rt_light_set_across(rt_scene_light *out, const float up[3], int is_right, const char *who,
                              rt_error *error);

/* Appends a spot that is complete but for the image in its cone. */
rt_status rt_spot_add_image(rt_scene *scene, rt_scene_light *spot, const rt_spot_light *light,
                            rt_error *error);

#endif
