/*
 * enclose.h - the solids that the camera and the lights lie in, so that paths start in the right
 * medium.
 */
#ifndef RT_LIB_RENDER_ENCLOSE_H
#define RT_LIB_RENDER_ENCLOSE_H

#include "base/progress.h"
#include "device/device.h"
#include "rt.h"

/*
 * Finds these solids and notes them in a scene's image on the device; does nothing where no
 * material lets light in. Runs as part of a stage.
 */
rt_status rt_enclose(rt_device *device, cl_mem image, const rt_scene *scene,
                     rt_stage_progress *progress, rt_error *error);

#endif
