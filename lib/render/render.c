/* render.c - rt_render: completes the options, aims the camera, runs the mode. */
#include <stddef.h>
#include <string.h>

#include "base/bytes.h"
#include "base/error.h"
#include "render/noise.h"
#include "render/renderer.h"
#include "scene/view.h"

rt_params rt_params_make(const rt_render_options *options)
{
    rt_params p;
    memset(&p, 0, sizeof p);
    p.width = options->width;
    p.height = options->height;
    p.seed = options->seed;
    p.sampler = options->sampler;
    p.max_depth = options->max_depth;
    p.final_gather = options->final_gather;
    p.direct = options->direct;
    p.estimator = options->estimator;
    p.roulette_depth = options->roulette_depth;
    p.roulette_threshold = options->roulette_threshold;
    return p;
}

/*
 * A kernel being prepared on a thread of its own. What it logs is kept, for hooks are called by the
 * caller's thread.
 */
typedef struct preparation {
    rt_device *device;
    const char *program, *kernel;
    const rt_arg *args;
    cl_uint count;
    cl_kernel made;
    rt_bytes log; /* lines, each with its closing zero */
    rt_error *error;
} preparation;

static void keep_line(void *user, const char *line)
{
    preparation *p = user;
    /* Without memory a line of the log is lost, nothing else. */
    rt_bytes_put(&p->log, p->log.size, line, strlen(line) + 1, NULL);
}

static rt_status prepare(void *data)
{
    preparation *p = data;
    rt_params none;
    rt_arg first = {sizeof none, &none};
    rt_hooks hooks = {.log = keep_line, .user = p};

    memset(&none, 0, sizeof none);
    rt_status status =
        rt_device_kernel(p->device, &p->made, p->program, p->kernel, &hooks, p->error);
    if (status == RT_OK)
        status = rt_kernel_args(p->made, p->args, p->count, p->error);
    if (status == RT_OK)
        status = rt_kernel_args(p->made, &first, 1, p->error);
    if (status == RT_OK)
        status = rt_launch(p->device, p->made, 1, p->error);
    return status == RT_OK ? rt_device_finish(p->device, p->error) : status;
}

rt_status rt_kernel_prepare(rt_device *device, cl_kernel *out, const char *program,
                            const char *kernel, const rt_arg *args, cl_uint count,
                            rt_stage_progress *progress, rt_error *error)
{
    preparation p = {device, program, kernel, args, count, NULL, {0}, error};
    rt_status status = rt_stage_run(progress, prepare, &p);
    for (size_t at = 0; at < p.log.size; at += strlen((const char *)p.log.data + at) + 1)
        rt_log(progress->hooks, "%s", (const char *)p.log.data + at);
    rt_bytes_free(&p.log);
    if (status == RT_OK)
        *out = p.made;
    else
        rt_kernel_release(p.made);
    return status;
}

/*
 * Three segments, from the eye to what is lit, to the mirror and to the lamp, are the shortest path
 * of a caustic.
 */
enum { caustic_depth = 3 };

/* Says what light the picture will lack. */
static void warn_of_missing_light(const rt_renderer *renderer, const rt_render_options *o)
{
    if (!renderer->has_light && rt_mode_shows_light(o->mode))
        rt_warn(o->hooks, "the scene has no light: its picture is black");
    if (renderer->casts_hidden_caustics && o->mode == RT_MODE_PATH && o->max_depth >= caustic_depth)
        rt_warn(o->hooks, "mode path leaves out the light that point, spot and directional lights "
                          "cast by way of smooth "
                          "mirrors or glass; mode photon shows it");
}

rt_status rt_render_options_check(const rt_render_options *options, rt_error *error)
{
    if (rt_is_missing(options, "options", error))
        return RT_ERROR_USAGE;
    rt_render_options complete = *options;
    rt_status status = rt_options_check(options, error);
    rt_options_complete(&complete);
    if (status == RT_OK)
        status = rt_noise_check(&complete, error);
    if (status == RT_OK && complete.mode == RT_MODE_PHOTON)
        status = rt_photon_mode_check(&complete, error);
    return status;
}

rt_status rt_render(rt_film **out, rt_renderer *renderer, const rt_render_options *options,
                    rt_error *error)
{
    if (rt_is_missing(renderer, "renderer", error))
        return RT_ERROR_USAGE;
    rt_render_options complete = options ? *options : renderer->options;
    rt_camera_data camera;
    rt_film *film = NULL;
    rt_status status = rt_render_options_check(&complete, error);

    if (status != RT_OK)
        return status;
    if (!renderer->has_camera)
        return rt_fail(error, RT_ERROR_INPUT, "the scene has no camera");
    rt_options_complete(&complete);
    rt_view_aim(&camera, &renderer->camera, complete.width, complete.height);
    camera.filter = complete.filter;
    status = rt_buffer_write(renderer->device, renderer->scene, offsetof(rt_scene_header, camera),
                             sizeof camera, &camera, error);
    if (status == RT_OK)
        status = rt_film_create(&film, &complete, error);
    if (status == RT_OK && rt_noise_wanted(&complete))
        status = rt_noise_create(&film->noise, (size_t)complete.width * complete.height, error);
    if (status != RT_OK) {
        rt_film_destroy(film);
        return status;
    }

    warn_of_missing_light(renderer, &complete);
    film->stats.build_seconds = renderer->build_seconds;
    film->stats.light_power = renderer->image.light_power;
    status = complete.mode == RT_MODE_PHOTON ? rt_render_photon(renderer, &complete, film, error)
                                             : rt_render_samples(renderer, &complete, film, error);
    if (status == RT_OK || status == RT_CANCELLED) {
        rt_status resolved = rt_film_resolve(film, error);
        status = resolved == RT_OK ? status : resolved;
    }
    int keep = status == RT_OK || (status == RT_CANCELLED && film->stats.spp > 0);
    if (keep || status == RT_CANCELLED)
        *out = keep ? film : NULL;
    if (!keep)
        rt_film_destroy(film);
    return status == RT_CANCELLED ? rt_fail(error, RT_CANCELLED, "cancelled") : status;
}
