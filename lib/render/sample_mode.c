/*
 * sample_mode.c - drives the kernels that take samples of pixels over the film: paths, direct
 * light, layers.
 */
#include <math.h>
#include <string.h>

#include "base/error.h"
#include "render/aov.h"
#include "render/noise.h"
#include "render/renderer.h"

/* A launch aims at this long: short enough for lively progress and a prompt cancel. */
static const double launch_seconds = 0.2;

enum { samples_per_launch_max = 64 };

/* Where a render stands: samples are given to all pixels before any pixel gets more. */
typedef struct schedule {
    uint32_t pixels, spp;
    uint32_t done;            /* samples of each pixel */
    rt_stretch stretch;       /* those that come next, */
    uint32_t pixel, sample;   /* next launch begins here */
    uint32_t pixels_a_launch; /* the next launch's share of the film */
    uint32_t samples_a_launch;
} schedule;

/* A render under way. */
typedef struct sample_render {
    rt_renderer *renderer;
    const rt_render_options *options;
    rt_film *film;
    cl_kernel kernel; /* NULL in the modes that show a layer */
    uint32_t batch;   /* pixels that a work-item of it takes */
    cl_mem pixels;    /* rt_film_pixel, the film on the device */
    rt_aov aov;
} sample_render;

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
static rt_status launch_part(sample_render *r, rt_params *params, schedule *s, uint32_t samples,
                             rt_error *error)
{
    uint32_t left = s->pixels - s->pixel;
    rt_status status = RT_OK;
    params->first_item = s->pixel;
    params->item_count = left < s->pixels_a_launch ? left : s->pixels_a_launch;
    params->replicate = s->stretch.replicate;
    params->first_sample = s->sample;
    params->sample_count = samples;
    params->pixels_an_item = r->batch;

    if (r->kernel) {
        rt_arg first = {sizeof *params, params};
        status = rt_kernel_args(r->kernel, &first, 1, error);
        if (status == RT_OK)
            status = rt_launch(r->renderer->device, r->kernel,
                               (params->item_count + r->batch - 1) / r->batch, error);
    }
    if (status == RT_OK)
        status = rt_aov_add(&r->aov, r->renderer, params, error);
    if (status == RT_OK)
        status = rt_device_finish(r->renderer->device, error);
    s->pixel += params->item_count;
    return status;
}

/*
 * At the end of a stretch: learns what it tells of the error; *enough: the one asked for is
 * reached.
 */
static rt_status end_stretch(const sample_render *r, schedule *s, rt_stage_progress *progress,
                             int *enough, rt_error *error)
{
    rt_noise *noise = r->film->noise;
    rt_status status = RT_OK;
    if (noise) {
        status = rt_noise_read(noise, &s->stretch, r->renderer->device, r->pixels, r->film, error);
        if (status == RT_OK && s->stretch.replicate == RT_REPLICATES - 1)
            *enough = rt_noise_look(noise, s->stretch.to, r->options->target_error);
        progress->error = rt_noise_last(noise);
    }
    s->stretch = rt_stretch_next(s->stretch);
    s->sample = s->stretch.first;
    return status;
}

/* How much of the render is done: by samples, by time, or by the error, whichever is furthest. */
static double part_done(const sample_render *r, const schedule *s, double samples, double seconds)
{
    const rt_render_options *o = r->options;
    const rt_noise *noise = r->film->noise;
    double by_samples = samples / s->spp, by_time = o->time > 0 ? fmin(seconds / o->time, 1) : 0;
    if (o->target_error == 0)
        return fmax(by_samples, by_time);
    /* Until the error is first looked at, there is no telling: samples may be without limit. */
    double by_error = rt_noise_progress(noise, samples / RT_REPLICATES, o->target_error);
    return fmax(by_time, by_error > 0 ? fmax(by_samples, by_error) : 0);
}

/* The whole film, pass by pass; a pass gives every pixel the same number of samples. */
static rt_status render_passes(sample_render *r, rt_stage_progress *progress, rt_error *error)
{
    const rt_render_options *options = r->options;
    rt_params params = rt_params_make(options);
    schedule s = {
        .pixels = options->width * options->height, .spp = options->spp, .samples_a_launch = 1};
    rt_status status = RT_OK;
    double began = rt_clock();
    int enough = 0;

    s.pixels_a_launch = s.pixels < 16384 ? s.pixels : 16384;
    s.stretch = rt_stretch_first(s.spp, r->film->noise != NULL);
    while (status == RT_OK && s.done < s.spp && !enough) {
        uint32_t left = s.stretch.first + s.stretch.count - s.sample;
        uint32_t samples = s.samples_a_launch < left ? s.samples_a_launch : left;
        for (s.pixel = 0; s.pixel < s.pixels && status == RT_OK;) {
            double launched = rt_clock();
            status = launch_part(r, &params, &s, samples, error);
            double now = rt_clock(), done = s.done + (double)samples * s.pixel / s.pixels;
            adapt(&s, now - launched);
            if (status == RT_OK)
                status = rt_stage_update(progress, part_done(r, &s, done, now - began));
        }
        s.sample += samples;
        s.done += samples;
        if (status == RT_OK && samples == left)
            status = end_stretch(r, &s, progress, &enough, error);
        if (options->time > 0 && rt_clock() - began >= options->time)
            break;
    }
    return status;
}

/* The program and kernel that makes the picture of a mode, or NULL where a layer is the picture. */
static const char *kernel_of(rt_mode mode)
{
    return mode == RT_MODE_PATH ? "path" : mode == RT_MODE_DIRECT ? "direct" : NULL;
}

static rt_status compile(sample_render *r, rt_error *error)
{
    const char *name = kernel_of(r->options->mode);
    rt_stage_progress progress;
    rt_params none;
    memset(&none, 0, sizeof none);
    rt_arg args[] = {RT_ARG(none), RT_ARG(r->renderer->scene), RT_ARG(r->pixels)};

    rt_status status = rt_stage_begin(&progress, r->options->hooks, RT_STAGE_COMPILE);
    if (status == RT_OK && name)
        status = rt_kernel_prepare(r->renderer->device, &r->kernel, name, name, args, 3, &progress,
                                   error);
    if (status == RT_OK && rt_aov_wanted(r->options))
        status = rt_aov_begin(&r->aov, r->renderer, r->film, &progress, error);
    return status == RT_OK ? rt_stage_end(&progress, &r->film->stats.compile_seconds) : status;
}

/*
 * Copies what there is from the device; a layer that is the picture has the counts of its samples
 * too.
 */
static rt_status read_film(sample_render *r, rt_error *error)
{
    rt_film *film = r->film;
    size_t count = (size_t)r->options->width * r->options->height,
           bytes = count * sizeof *film->pixels;
    rt_status status = rt_aov_read(&r->aov, r->renderer, film, error);
    if (status == RT_OK && r->kernel)
        status = rt_buffer_read(r->renderer->device, r->pixels, 0, bytes, film->pixels, error);
    else if (status == RT_OK)
        memcpy(film->pixels, film->layer_sums + RT_LAYER_ALBEDO * count, bytes);
    return status;
}

rt_status rt_render_samples(rt_renderer *renderer, const rt_render_options *options, rt_film *film,
                            rt_error *error)
{
    size_t bytes = (size_t)options->width * options->height * sizeof *film->pixels;
    sample_render r;
    rt_stage_progress progress;

    memset(&r, 0, sizeof r);
    r.renderer = renderer;
    r.options = options;
    r.film = film;
    r.batch = options->mode == RT_MODE_PATH ? renderer->device->path_pixels : 1;
    rt_status status = rt_buffer_create(renderer->device, &r.pixels, CL_MEM_READ_WRITE, bytes,
                                        film->pixels, "the film", error);
    if (status == RT_OK)
        status = compile(&r, error);
    if (status == RT_OK)
        status = rt_stage_begin(&progress, options->hooks, RT_STAGE_RENDER);
    if (status == RT_OK) {
        status = render_passes(&r, &progress, error);
        if (status == RT_OK || status == RT_CANCELLED) {
            rt_status read = read_film(&r, error);
            rt_status end = rt_stage_end(&progress, &film->stats.render_seconds);
            status = read != RT_OK ? read : status != RT_OK ? status : end;
        }
    }
    rt_aov_free(&r.aov);
    rt_kernel_release(r.kernel);
    rt_buffer_release(r.pixels);
    return status;
}
