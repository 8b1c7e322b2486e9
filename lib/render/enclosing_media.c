/* enclosing_media.c - runs the kernel enclosing_media for the camera and each light. */
#include "render/enclosing_media.h"

#include <string.h>

#include "base/error.h"
#include "light/lights.h"
#include "render/prepare.h"
#include "types.h"

rt_status rt_enclosing_media_find(rt_device *device, cl_mem image, const rt_scene *scene,
                                  rt_stage_progress *progress, rt_error *error)
{
    float eye[4] = {scene->camera.eye[0], scene->camera.eye[1], scene->camera.eye[2], 0};
    cl_kernel kernel = NULL;
    rt_params params;

    memset(&params, 0, sizeof params);
    rt_arg args[] = {RT_ARG(params), RT_ARG(image), RT_ARG(eye)};
    rt_status status = rt_kernel_prepare(device, &kernel, "enclosing_media", "enclosing_media",
                                         args, 3, progress, error);
    if (status != RT_OK)
        return status;
    params.item_count = (rt_u32)rt_lights_count(scene) + 1;
    status = rt_kernel_args(kernel, args, 3, error);
    if (status == RT_OK)
        status = rt_launch(device, kernel, params.item_count, error);
    if (status == RT_OK)
        status = rt_device_finish(device, error);
    rt_kernel_release(kernel);
    return status;
}
