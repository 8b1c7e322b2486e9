/* render.c - rt_render: checks and completes the options, makes a film, and runs the mode on it. */
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "film/cut_off.h"
#include "mode/modes.h"
#include "setting/options.h"

/* ---- Options ---------------------------------------------------------------- */

/* Fails where an estimate of the error is asked for and the mode has none. */
static rt_status check_noise(const rt_render_options *o, rt_error *error)
{
    const rt_mode_class *mode = rt_mode_class_of(o->mode);
    if (!rt_noise_wanted(o) || mode->has_noise)
        return RT_OK;
    return rt_fail_field(error, RT_ERROR_USAGE, o->target_error > 0 ? "target_error" : "variance",
                         "the error is that of light, and mode %s shows none",
                         rt_mode_name(o->mode));
}

/* Checks options, and completes them where they are right. */
static rt_status check_and_complete(rt_render_options *o, rt_error *error)
{
    rt_status status = rt_options_check(o, error);
    if (status != RT_OK)
        return status;
    rt_options_complete(o);
    const rt_mode_class *mode = rt_mode_class_of(o->mode);
    status = check_noise(o, error);
    return status == RT_OK && mode->check ? mode->check(o, error) : status;
}

rt_status rt_render_options_check(const rt_render_options *options, rt_error *error)
{
    if (rt_is_missing(options, "options", error))
        return RT_ERROR_USAGE;
    rt_render_options copy = *options;
    return check_and_complete(&copy, error);
}

/* ---- A render --------------------------------------------------------------- */

/* Compiles the kernels of the mode and of the layers beside it, as one stage. */
static rt_status prepare(const rt_mode_class *mode, const rt_render_job *job, void *state,
                         rt_error *error)
{
    rt_stage_progress progress;
    rt_status status = rt_stage_begin(&progress, job->options->hooks, RT_STAGE_COMPILE);
    if (status == RT_OK && mode->prepare)
        status = mode->prepare(job, state, &progress, error);
    if (status == RT_OK && (job->options->aov || mode->show))
        status =
            rt_first_hit_layers_prepare(job->layers, job->renderer, job->film, &progress, error);
    return status == RT_OK ? rt_stage_end(&progress, &job->film->stats.compile_seconds) : status;
}

/* Makes the means, the layers and the estimate of the error from the sums. */
static rt_status resolve(const rt_mode_class *mode, const rt_render_job *job, rt_error *error)
{
    rt_film *film = job->film;
    size_t pixels = rt_film_pixels(film);
    rt_status status = rt_first_hit_layers_read(job->layers, film, error);
    if (status != RT_OK)
        return status;
    /* Where a layer is the picture, the film takes its sample counts too. */
    if (mode->show && film->layer_sums)
        memcpy(film->pixels, film->layer_sums, pixels * sizeof *film->pixels);
    rt_film_resolve(film);
    rt_film_check_cut_off(film, job->options->hooks);
    rt_first_hit_layers_resolve(film);
    for (size_t i = 0; i < pixels && mode->show; i++)
        if (film->pixels[i].count > 0)
            mode->show(film->rgb + 3 * i, film, i);
    return job->noise ? rt_noise_resolve(job->noise, film, error) : RT_OK;
}

/* Runs the mode. On RT_CANCELLED the film holds the samples so far. */
static rt_status run(rt_render_job *job, rt_error *error)
{
    const rt_mode_class *mode = rt_mode_class_of(job->options->mode);
    rt_first_hit_layers layers = {0};
    rt_status status = RT_OK;
    void *state = calloc(1, mode->state_size);

    if (!state)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for a render");
    job->layers = &layers;
    if (rt_mode_shows_light(job->options->mode) && !job->renderer->has_light)
        rt_warn(job->options->hooks, "the scene has no light: its picture is black");
    status = prepare(mode, job, state, error);
    if (status == RT_OK)
        status = mode->run(job, state, error);
    if (status == RT_OK || status == RT_CANCELLED) {
        rt_status resolved = resolve(mode, job, error);
        status = resolved == RT_OK ? status : resolved;
    }
    if (mode->release)
        mode->release(state);
    rt_first_hit_layers_release(&layers);
    job->layers = NULL;
    free(state);
    return status;
}

/* Makes what the render needs besides its mode. */
static rt_status open(rt_render_job *job, rt_error *error)
{
    const rt_render_options *o = job->options;
    rt_status status = rt_renderer_aim(job->renderer, o, error);
    if (status == RT_OK)
        status = rt_film_create(&job->film, o, job->renderer->device->memory, error);
    if (status == RT_OK && rt_noise_wanted(o))
        status = rt_noise_create(&job->noise, rt_film_pixels(job->film),
                                 job->renderer->device->memory, error);
    return status;
}

rt_status rt_render(rt_film **out, rt_renderer *renderer, const rt_render_options *options,
                    rt_error *error)
{
    if (rt_is_missing(renderer, "renderer", error))
        return RT_ERROR_USAGE;
    rt_render_options o = options ? *options : renderer->options;
    rt_render_job job = {.renderer = renderer, .options = &o};
    rt_status status = check_and_complete(&o, error);

    if (status == RT_OK && !renderer->has_camera)
        status = rt_fail(error, RT_ERROR_INPUT, "the scene has no camera");
    if (status == RT_OK)
        status = open(&job, error);
    if (status != RT_OK)
        goto out;
    job.film->stats.build_seconds = renderer->build_seconds;
    job.film->stats.light_power = renderer->image.light_power;
    status = run(&job, error);
    if (status == RT_CANCELLED) {
        *out = NULL;
        status = rt_fail(error, RT_CANCELLED, "cancelled");
    }
    if (status == RT_OK || (status == RT_CANCELLED && job.film->stats.spp > 0)) {
        *out = job.film;
        job.film = NULL;
    }
out:
    rt_noise_destroy(job.noise);
    rt_film_destroy(job.film);
    return status;
}
