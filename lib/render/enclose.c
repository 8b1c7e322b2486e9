/*
 * enclose.c - finds the solids that the camera and the lights lie in, so that paths start in the
 * right medium.
 */
#include <string.h>

#include "base/error.h"
#include "render/renderer.h"
#include "scene/inside.h"

static int has_solids(const rt_scene *scene)
{
    for (size_t i = 0; i < scene->shape_count; i++)
        if (rt_material_is_transparent(scene->materials + scene->shapes[i].surface.material))
            return 1;
    return 0;
}

rt_status rt_renderer_enclose(rt_renderer *renderer, const rt_scene *scene, size_t light_count,
                              rt_stage_progress *progress, rt_error *error)
{
    float eye[4] = {scene->camera.eye[0], scene->camera.eye[1], scene->camera.eye[2], 0};
    cl_kernel kernel = NULL;
    rt_params params;

    if (!has_solids(scene))
        return RT_OK;
    memset(&params, 0, sizeof params);
    rt_arg args[] = {RT_ARG(params), RT_ARG(renderer->scene), RT_ARG(eye)};
    rt_status status = rt_kernel_prepare(renderer->device, &kernel, "enclose", "enclose", args, 3,
                                         progress, error);
    if (status != RT_OK)
        return status;
    params.item_count = (rt_u32)light_count + 1;
    status = rt_kernel_args(kernel, args, 3, error);
    if (status == RT_OK)
        status = rt_launch(renderer->device, kernel, params.item_count, error);
    if (status == RT_OK)
        status = rt_device_finish(renderer->device, error);
    rt_kernel_release(kernel);
    return status;
}
