/* pixel_samples.c - launches over the film, sized for frequent progress and a prompt cancel. */
#include "mode/pixel_samples.h"

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "render/prepare.h"

/* Target duration of a launch: short enough for frequent progress and a prompt cancel. */
static const double launch_seconds = 0.2;

enum { samples_per_launch_max = 64 };

/* The state of a render: every pixel gets its samples of a round before any gets more. */
typedef struct schedule {
    uint32_t pixels, spp;
    uint32_t done;            /* samples of each pixel */
    rt_sample_range range;    /* those that come next */
    uint32_t pixel, sample;   /* the next launch begins here */
    uint32_t pixels_a_launch; /* the next launch's share of the film */
    uint32_t samples_a_launch;
} schedule;

/* Adapts the size of launches to the time the last one took. */
static void adapt(schedule *s, double seconds)
{
    if (seconds < 0.5 * launch_seconds) {
        if (s->pixels_a_launch < s->pixels)
            s->pixels_a_launch =
                s->pixels_a_launch > s->pixels / 2 ? s->pixels : 2 * s->pixels_a_launch;
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
static rt_status launch_part(const rt_render_job *job, const rt_pixel_samples *state,
                             rt_params *params, schedule *s, uint32_t samples, rt_error *error)
{
    rt_device *device = job->renderer->device;
    uint32_t left = s->pixels - s->pixel;
    rt_status status = RT_OK;
    params->first_item = s->pixel;
    params->item_count = left < s->pixels_a_launch ? left : s->pixels_a_launch;
    params->replicate = s->range.replicate;
    params->first_sample = s->sample;
    params->sample_count = samples;
    params->pixels_an_item = state->kernel ? state->pixels_an_item : 1;

    if (state->kernel) {
        uint32_t each = state->pixels_an_item;
        rt_arg first = {sizeof *params, params};
        status = rt_kernel_args(state->kernel, &first, 1, error);
        if (status == RT_OK)
            status =
                rt_launch(device, state->kernel, (params->item_count + each - 1) / each, error);
    }
    if (status == RT_OK)
        status = rt_first_hit_layers_add(job->layers, params, error);
    if (status == RT_OK)
        status = rt_device_finish(device, error);
    s->pixel += params->item_count;
    return status;
}

/*
 * At the end of a range: estimates the error where it is due; *enough: the one asked for is
 * reached.
 */
static rt_status end_range(const rt_render_job *job, const rt_pixel_samples *state, schedule *s,
                           rt_stage_progress *progress, int *enough, rt_error *error)
{
    rt_noise *noise = job->noise;
    rt_status status = RT_OK;
    if (noise) {
        status =
            rt_noise_read(noise, &s->range, job->renderer->device, state->pixels, job->film, error);
        if (status == RT_OK && s->range.replicate == RT_REPLICATES - 1)
            *enough = rt_noise_test(noise, s->range.to, job->options->target_error);
        progress->error = rt_noise_last(noise);
    }
    s->range = rt_sample_range_next(s->range);
    s->sample = s->range.first;
    return status;
}

/* How much of the render is done: by samples, by time, or by the error, whichever is furthest. */
static double part_done(const rt_render_job *job, const schedule *s, double samples, double seconds)
{
    const rt_render_options *o = job->options;
    double by_samples = samples / s->spp, by_time = o->time > 0 ? fmin(seconds / o->time, 1) : 0;
    if (o->target_error == 0)
        return fmax(by_samples, by_time);
    /* Until the error is first tested nothing is known: samples may be without limit. */
    double by_error = rt_noise_progress(job->noise, samples / RT_REPLICATES, o->target_error);
    return fmax(by_time, by_error > 0 ? fmax(by_samples, by_error) : 0);
}

/* The whole film, round by round; a round gives every pixel the same number of samples. */
static rt_status sample_film(const rt_render_job *job, const rt_pixel_samples *state,
                             rt_stage_progress *progress, rt_error *error)
{
    const rt_render_options *options = job->options;
    rt_params params = rt_params_make(options);
    schedule s = {
        .pixels = options->width * options->height, .spp = options->spp, .samples_a_launch = 1};
    rt_status status = RT_OK;
    double began = rt_clock();
    int enough = 0;

    s.pixels_a_launch = s.pixels < 16384 ? s.pixels : 16384;
    s.range = rt_sample_range_first(s.spp, job->noise != NULL);
    while (status == RT_OK && s.done < s.spp && !enough) {
        uint32_t left = s.range.first + s.range.count - s.sample;
        uint32_t samples = s.samples_a_launch < left ? s.samples_a_launch : left;
        for (s.pixel = 0; s.pixel < s.pixels && status == RT_OK;) {
            double launched = rt_clock();
            status = launch_part(job, state, &params, &s, samples, error);
            double now = rt_clock(), done = s.done + (double)samples * s.pixel / s.pixels;
            adapt(&s, now - launched);
            if (status == RT_OK)
                status = rt_stage_update(progress, part_done(job, &s, done, now - began));
        }
        s.sample += samples;
        s.done += samples;
        if (status == RT_OK && samples == left)
            status = end_range(job, state, &s, progress, &enough, error);
        if (options->time > 0 && rt_clock() - began >= options->time)
            break;
    }
    return status;
}

rt_status rt_pixel_samples_check(const rt_render_options *options, rt_error *error)
{
    if (rt_noise_wanted(options) && options->spp < 2)
        return rt_fail_field(error, RT_ERROR_USAGE,
                             options->target_error > 0 ? "target_error" : "variance",
                             "one sample a pixel cannot tell its error");
    return RT_OK;
}

rt_status rt_pixel_samples_prepare(rt_pixel_samples *out, const rt_render_job *job,
                                   const char *kernel, uint32_t pixels_an_item,
                                   rt_stage_progress *progress, rt_error *error)
{
    rt_device *device = job->renderer->device;
    size_t bytes = rt_film_pixels(job->film) * sizeof *job->film->pixels;
    rt_params none;

    memset(&none, 0, sizeof none);
    out->device = device;
    out->pixels_an_item = pixels_an_item;
    rt_status status = rt_buffer_create(device, &out->pixels, CL_MEM_READ_WRITE, bytes,
                                        job->film->pixels, "the film", error);
    rt_arg args[] = {RT_ARG(none), RT_ARG(job->renderer->scene), RT_ARG(out->pixels)};
    if (status == RT_OK)
        status = rt_kernel_prepare(device, &out->kernel, kernel, kernel, args, 3, progress, error);
    return status;
}

rt_status rt_pixel_samples_run(const rt_render_job *job, void *state, rt_error *error)
{
    const rt_pixel_samples *samples = state;
    rt_film *film = job->film;
    rt_stage_progress progress;

    rt_status status = rt_stage_begin(&progress, job->options->hooks, RT_STAGE_RENDER);
    if (status != RT_OK)
        return status;
    status = sample_film(job, samples, &progress, error);
    if (status == RT_OK || status == RT_CANCELLED) {
        rt_status read = RT_OK;
        if (samples->kernel)
            read = rt_buffer_read(job->renderer->device, samples->pixels, 0,
                                  rt_film_pixels(film) * sizeof *film->pixels, film->pixels, error);
        rt_status end = rt_stage_end(&progress, &film->stats.render_seconds);
        status = read != RT_OK ? read : status != RT_OK ? status : end;
    }
    return status;
}

void rt_pixel_samples_release(void *state)
{
    rt_pixel_samples *samples = state;
    rt_kernel_release(samples->kernel);
    rt_buffer_release(samples->device, samples->pixels);
}
