/* eye_kernels.c - builds the kernels of the camera's half of photon mapping. */
#include "mode/photon/eye_kernels.h"

#include <string.h>

#include "mode/photon/radius_test.h"
#include "render/prepare.h"

int rt_eye_paths_take_irradiance(const rt_render_options *options)
{
    return options->final_gather > 0 && options->irradiance_step > 0;
}

const char *rt_camera_kernel_name(const rt_renderer *renderer)
{
    static const char *const programs[] = RT_PROGRAMS("photon_camera");
    return rt_renderer_program(renderer, programs);
}

rt_status rt_eye_kernels_prepare(rt_eye_kernels *out, const rt_render_job *job,
                                 rt_photon_search search, rt_stage_progress *progress,
                                 rt_error *error)
{
    const rt_renderer *renderer = job->renderer;
    rt_device *device = renderer->device;
    cl_mem any = renderer->scene; /* stands for all buffers that are not touched yet */
    rt_params params;
    rt_u32 stride = 0;
    memset(&params, 0, sizeof params);
    rt_volume_params volume = {0};
    rt_photon_tree tree = {0};
    rt_arg camera[] = {RT_ARG(params), RT_ARG(any),  RT_ARG(any), RT_ARG(any), RT_ARG(stride),
                       RT_ARG(volume), RT_ARG(tree), RT_ARG(any), RT_ARG(any)};
    const char *name = rt_camera_kernel_name(renderer);
    rt_arg film[] = {RT_ARG(params), RT_ARG(any), RT_ARG(any), RT_ARG(stride), RT_ARG(any)};

    memset(out, 0, sizeof *out);
    rt_status status = rt_kernel_prepare(device, &out->camera, name, name, camera,
                                         renderer->has_media ? 9 : 5, progress, error);
    if (status == RT_OK)
        status = rt_gather_kernel_prepare(&out->gather, device, search, renderer->is_plain, any,
                                          progress, error);
    if (status == RT_OK && rt_eye_paths_take_irradiance(job->options))
        status = rt_gather_kernel_prepare(&out->irradiance, device, RT_SEARCH_IRRADIANCE, 0, any,
                                          progress, error);
    if (status == RT_OK)
        status = rt_kernel_prepare(device, &out->film, "photon_film", "photon_film", film, 5,
                                   progress, error);
    if (status == RT_OK)
        status = rt_device_kernel(device, &out->join, "photon_film", "photon_join", NULL, error);
    if (status == RT_OK)
        status = rt_device_kernel(device, &out->count, "photon_film", "count_queries", NULL, error);
    if (status == RT_OK)
        status = rt_device_kernel(device, &out->moments, "photon_film", "add_moments", NULL, error);
    if (status == RT_OK && rt_radius_is_tested(job->options))
        status = rt_radius_test_prepare(&out->sectors, &out->test, rt_radius_rule_of(job->options),
                                        device, any, progress, error);
    return status;
}

void rt_eye_kernels_release(rt_eye_kernels *kernels)
{
    rt_kernel_release(kernels->camera);
    rt_kernel_release(kernels->gather);
    rt_kernel_release(kernels->irradiance);
    rt_kernel_release(kernels->film);
    rt_kernel_release(kernels->join);
    rt_kernel_release(kernels->count);
    rt_kernel_release(kernels->moments);
    rt_kernel_release(kernels->sectors);
    rt_kernel_release(kernels->test);
    memset(kernels, 0, sizeof *kernels);
}
