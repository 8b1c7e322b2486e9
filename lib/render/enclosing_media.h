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
 * Finds these solids and notes them in a scene's image on the device. Runs as part of a stage.
 * Without it the image is right where rt_scene_image.may_start_in_solids is 0.
 */
rt_status rt_enclosing_media_find(rt_device *device, cl_mem image, const rt_scene *scene,
                                  rt_stage_progress *progress, rt_error *error);

#endif
