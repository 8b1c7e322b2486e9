/* table_light.h - what lights with a table of their intensity share with other lights. */
#ifndef RT_LIB_SCENE_TABLE_LIGHT_H
#define RT_LIB_SCENE_TABLE_LIGHT_H

#include "scene/scene.h"

/* Sets position and axis; fails where they have no direction. who: the light in messages. */
rt_status rt_light_aim(rt_scene_light *out, const float position[3], const float target[3],
                       const char *who, rt_error *error);

/* Appends a spot that is complete but for the image in its cone. */
rt_status rt_spot_add_image(rt_scene *scene, rt_scene_light *spot, const rt_spot_light *light,
                            rt_error *error);

#endif
