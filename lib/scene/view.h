/* view.h - the rays of a camera, and which shapes are in its view. */
#ifndef RT_LIB_SCENE_VIEW_H
#define RT_LIB_SCENE_VIEW_H

#include "scene/scene.h"

/* The rays of a camera for a film of these proportions, none of which is 0; pixels are square. */
void rt_view_aim(rt_camera_data *out, const rt_camera *camera, uint32_t width, uint32_t height);

/*
 * Whether the camera may see a shape. 0 is certain: all of the shape's bounds lie behind the eye or
 * beside the picture.
 */
int rt_view_may_see(const rt_camera_data *camera, const rt_scene *scene,
                    const rt_scene_shape *shape);

#endif
