/* renderer.c - a scene made ready on a device: hierarchy, tables, upload. */
#include "render/renderer.h"

#include <stdlib.h>

#include "base/error.h"
#include "light/lights.h"
#include "pack/pack.h"

rt_status rt_renderer_create(rt_renderer **out, const rt_scene *scene, rt_device *device,
                             const rt_renderer_options *options, rt_error *error)
{
    if (rt_is_missing(scene, "scene", error) || rt_is_missing(device, "device", error))
        return RT_ERROR_USAGE;
    static const rt_renderer_options defaults;
    rt_stage_progress progress;

    if (!options)
        options = &defaults;
    if ((unsigned)options->accel > RT_ACCEL_NONE)
        return rt_fail_field(error, RT_ERROR_USAGE, "accel",
                             "there is no acceleration structure %d", (int)options->accel);
    rt_renderer *renderer = calloc(1, sizeof *renderer);
    if (!renderer)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for a renderer");
    renderer->device = device;
    renderer->camera = scene->camera;
    renderer->has_camera = scene->has_camera;
    renderer->has_light = rt_scene_has_light(scene);
    renderer->casts_hidden_caustics = rt_scene_casts_hidden_caustics(scene);
    renderer->options = scene->options;

    rt_status status = rt_stage_begin(&progress, options->hooks, RT_STAGE_BUILD);
    if (status == RT_OK)
        status = rt_scene_pack(&renderer->image, scene, options->accel, device->threads, &progress,
                               error);
    if (status == RT_OK) {
        /* A CPU device works on the host's memory; another gets its copy. */
        cl_mem_flags flags = CL_MEM_READ_WRITE | (device->info.is_cpu ? CL_MEM_USE_HOST_PTR : 0);
        status = rt_buffer_create(device, &renderer->scene, flags, renderer->image.bytes,
                                  renderer->image.data, "the scene", error);
    }
    if (status == RT_OK && !device->info.is_cpu)
        rt_scene_image_free(&renderer->image);
    if (status == RT_OK)
        status = rt_renderer_enclose(renderer, scene, rt_lights_count(scene), &progress, error);
    if (status == RT_OK)
        status = rt_stage_end(&progress, &renderer->build_seconds);
    if (status == RT_OK)
        *out = renderer;
    else
        rt_renderer_destroy(renderer);
    return status == RT_CANCELLED ? rt_fail(error, RT_CANCELLED, "cancelled") : status;
}

void rt_renderer_destroy(rt_renderer *renderer)
{
    if (!renderer)
        return;
    rt_buffer_release(renderer->scene);
    rt_scene_image_free(&renderer->image);
    free(renderer);
}
