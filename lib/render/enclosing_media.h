/*
 * enclosing_media.h - the media around the camera and the lights, so that paths start in the right
 * one.
 */
#ifndef RT_LIB_RENDER_ENCLOSING_MEDIA_H
#define RT_LIB_RENDER_ENCLOSING_MEDIA_H

#include "base/progress.h"
#include "device/device.h"
#include "rt.h"

/*
 * Whether the kernel may find a solid around the camera or a light; where it cannot, as bounds
 * tell, the image of the scene is right without it.
 */
int rt_enclosing_media_are_possible(const rt_scene *scene);

/* Finds these solids and notes them in a scene's image on the device. Runs as part of a stage. */
rt_status rt_enclosing_media_find(rt_device *device, cl_mem image, const rt_scene *scene,
                                  rt_stage_progress *progress, rt_error *error);

#endif
