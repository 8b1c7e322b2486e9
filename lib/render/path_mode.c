/* path_mode.c - drives the path tracing kernel over the film. */
#include <string.h>

#include "error.h"
#include "render/renderer.h"

/* A launch aims at this long: short enough for lively progress and a prompt cancel. */
static const double launch_seconds = 0.2;

enum { samples_per_launch_max = 64 };

/* Where a render stands: samples are given to all pixels before any pixel gets more. */
typedef struct schedule {
    uint32_t pixels, spp;
    uint32_t pixel, sample;  /* next launch begins here */
    uint32_t pixels_a_launch; /* the next launch's share of the film */
    uint32_t samples_a_launch;
} schedule;

/* Adapts the size of launches to the time the last one took. */
static void adapt(schedule *s, double seconds)
{
    if (seconds < 0.5 * launch_seconds) {
        if (s->pixels_a_launch < s->pixels)
            s->pixels_a_launch = s->pixels_a_launch > s->pixels / 2 ? s->pixels : 2 * s->pixels_a_launch;
        else if (s->samples_a_launch < samples_per_launch_max)
            s->samples_a_launch *= 2;
    } else if (seconds > 2 * launch_seconds) {
        if (s->samples_a_launch > 1)
            s->samples_a_launch /= 2;
        else if (s->pixels_a_launch > 1024)
            s->pixels_a_launch /= 2;
    }
}

/* Launches one part of the film and waits for it. */
static rt_status launch_part(rt_renderer *renderer, cl_kernel kernel, rt_params *params, schedule *s,
                             uint32_t samples, rt_error *error)
{
    uint32_t left = s->pixels - s->pixel;
    params->first_item = s->pixel;
    params->item_count = left < s->pixels_a_launch ? left : s->pixels_a_launch;
    params->first_sample = s->sample;
    params->sample_count = samples;

    rt_arg first = {sizeof *params, params};
    rt_status status = rt_kernel_args(kernel, &first, 1, error);
    if (status == RT_OK)
        status = rt_launch(renderer->device, kernel, (params->item_count + RT_PATH_BATCH - 1) / RT_PATH_BATCH, error);
    if (status == RT_OK)
        status = rt_device_finish(renderer->device, error);
    s->pixel += params->item_count;
    return status;
}

/* The whole film, pass by pass; a pass gives every pixel the same number of samples. */
static rt_status render_passes(rt_renderer *renderer, cl_kernel kernel, const rt_render_options *options,
                               rt_stage_progress *progress, rt_error *error)
{
    rt_params params = rt_params_make(options);
    schedule s = {options->width * options->height, options->spp, 0, 0, 0, 1};
    rt_status status = RT_OK;
    double began = rt_clock();

    s.pixels_a_launch = s.pixels < 16384 ? s.pixels : 16384;
    while (status == RT_OK && s.sample < s.spp) {
        uint32_t samples = s.samples_a_launch < s.spp - s.sample ? s.samples_a_launch : s.spp - s.sample;
        for (s.pixel = 0; s.pixel < s.pixels && status == RT_OK;) {
            double launched = rt_clock();
            status = launch_part(renderer, kernel, &params, &s, samples, error);
            double now = rt_clock(), by_samples = (s.sample + (double)samples * s.pixel / s.pixels) / s.spp;
            double by_time = options->time > 0 ? (now - began) / options->time : 0;
            adapt(&s, now - launched);
            if (status == RT_OK)
                status = rt_stage_update(progress, by_samples > by_time ? by_samples : by_time);
        }
        s.sample += samples;
        if (options->time > 0 && rt_clock() - began >= options->time)
            break;
    }
    return status;
}

rt_status rt_render_path(rt_renderer *renderer, const rt_render_options *options, rt_film *film, rt_error *error)
{
    rt_device *device = renderer->device;
    size_t bytes = (size_t)options->width * options->height * sizeof *film->pixels;
    rt_params none;
    rt_stage_progress progress;
    cl_mem pixels = NULL;
    cl_kernel kernel = NULL;

    memset(&none, 0, sizeof none);
    rt_status status = rt_buffer_create(device, &pixels, CL_MEM_READ_WRITE, bytes, film->pixels, "the film", error);
    if (status != RT_OK)
        goto out;

    if ((status = rt_stage_begin(&progress, options->hooks, RT_STAGE_COMPILE)) != RT_OK)
        goto out;
    rt_arg args[] = {RT_ARG(none), RT_ARG(renderer->scene), RT_ARG(pixels)};
    status = rt_kernel_prepare(device, &kernel, "path", "path", args, 3, &progress, error);
    if (status != RT_OK || (status = rt_stage_end(&progress, &film->stats.compile_seconds)) != RT_OK)
        goto out;

    if ((status = rt_stage_begin(&progress, options->hooks, RT_STAGE_RENDER)) != RT_OK)
        goto out;
    status = render_passes(renderer, kernel, options, &progress, error);
    if (status == RT_OK || status == RT_CANCELLED) {
        rt_status read = rt_buffer_read(device, pixels, 0, bytes, film->pixels, error);
        rt_status end = rt_stage_end(&progress, &film->stats.render_seconds);
        status = read != RT_OK ? read : status != RT_OK ? status : end;
    }
out:
    rt_kernel_release(kernel);
    rt_buffer_release(pixels);
    return status;
}
