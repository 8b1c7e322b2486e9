/* render.c - rt_render: checks and completes the options, makes a film, and runs the mode on it. */
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "camera/film_sum.h"
#include "film/bias.h"
#include "film/error_bound.h"
#include "film/cut_off.h"
#include "film/join.h"
#include "mode/modes.h"
#include "mode/photon/layers.h"
#include "photon/fingerprint.h"
#include "photon/map_check.h"
#include "photon/photon_map.h"
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

/* Fails where a part is asked for that there cannot be. */
static rt_status check_part(const rt_render_options *o, rt_error *error)
{
    if (o->parts > 0 && (o->part < 1 || o->part > o->parts))
        return rt_fail_field(error, RT_ERROR_USAGE, "part", "part %u of %u", o->part, o->parts);
    if (o->target_error > 0 && o->parts > 1)
        return rt_fail_field(error, RT_ERROR_USAGE, "target_error",
                             "the error of the picture cannot be tested in a part of it");
    return RT_OK;
}

/* Fails where a render is to leave out samples that there are not. */
static rt_status check_raise(const rt_render_options *o, rt_error *error)
{
    if (o->raised_from > 0 && rt_units_of(o, 0).in_passes)
        return rt_fail_field(error, RT_ERROR_USAGE, "raised_from",
                             "passes need no film that is raised: each is a unit of its own");
    if (o->raised_from > o->spp)
        return rt_fail_field(error, RT_ERROR_USAGE, "raised_from",
                             "raised from %u samples a pixel to %u", o->raised_from, o->spp);
    return RT_OK;
}

/* Fails where a film is to be continued in another mode, whose settings may not go with its own. */
static rt_status check_resume(const rt_render_options *o, rt_error *error)
{
    if (!o->resume || o->resume->options.mode == o->mode)
        return RT_OK;
    return rt_fail_field(error, RT_ERROR_USAGE, "mode",
                         "mode is %s, and %s in the film to be continued", rt_mode_name(o->mode),
                         rt_mode_name(o->resume->options.mode));
}

/* Checks options, and completes them where they are right. */
static rt_status check_and_complete(rt_render_options *o, rt_error *error)
{
    rt_status status = rt_options_check(o, error);
    if (status != RT_OK)
        return status;
    rt_options_complete(o);
    const rt_mode_class *mode = rt_mode_class_of(o->mode);
    status = check_resume(o, error);
    if (status == RT_OK)
        status = check_noise(o, error);
    if (status == RT_OK)
        status = check_part(o, error);
    if (status == RT_OK)
        status = check_raise(o, error);
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
    const int has_layers = job->options->aov || mode->show;
    rt_program_list programs = {0};
    rt_stage_progress progress;
    if (mode->programs)
        mode->programs(&programs, job);
    if (has_layers)
        rt_program_list_add(&programs, RT_PROGRAM_OF(job->renderer, "first_hit"));
    rt_status status = rt_stage_begin(&progress, job->options->hooks, RT_STAGE_COMPILE);
    if (status == RT_OK)
        status = rt_programs_compile(job->renderer->device, &programs, &progress);
    if (status == RT_OK && mode->prepare)
        status = mode->prepare(job, state, &progress, error);
    if (status == RT_OK && has_layers)
        status =
            rt_first_hit_layers_prepare(job->layers, job->renderer, job->film, &progress, error);
    return status == RT_OK ? rt_stage_end(&progress, &job->film->stats.compile_seconds) : status;
}

/* The samples of a pixel whose layers are its picture. */
static void take_counts(rt_film_pixel *pixel, const rt_first_hits *hits)
{
    *pixel = (rt_film_pixel){.weight = hits->weight, .count = hits->count};
    film_reject(pixel, hits->rejected);
}

rt_status rt_film_resolve(rt_film *film, const rt_hooks *hooks, rt_error *error)
{
    if (rt_is_missing(film, "film", error))
        return RT_ERROR_USAGE;
    const rt_mode_class *mode = rt_mode_class_of(film->options.mode);
    const size_t pixels = rt_film_pixels(film);
    rt_status status = RT_OK;
    /* Where a layer is the picture, the film takes its sample counts too. */
    for (size_t i = 0; i < pixels && mode->show && film->first_hits; i++)
        take_counts(film->pixels + i, film->first_hits + i);
    rt_film_make_means(film);
    rt_film_check_cut_off(film, hooks);
    if (film->first_hits)
        status = rt_film_layers_add(&film->layers, RT_LAYERS_FIRST_HIT, pixels, error);
    if (status != RT_OK)
        return status;
    rt_first_hit_layers_resolve(film);
    for (size_t i = 0; i < pixels && mode->show; i++)
        if (film->pixels[i].count > 0)
            mode->show(film->rgb + 3 * i, film->first_hits + i);
    if (film->photon_sums)
        status = rt_photon_layers_resolve(film, error);
    const rt_film_bias found = rt_film_find_bias(film);
    film->stats.relative_bias = found.bias;
    film->stats.relative_bias_bound = found.bound;
    film->stats.relative_noise = found.noise;
    if (status == RT_OK && rt_noise_wanted(&film->options))
        status = rt_noise_resolve(film, error);
    return status == RT_OK && rt_error_bound_wanted(&film->options)
               ? rt_error_bound_resolve(film, error)
               : status;
}

/* The checkpoint of all that was rendered. */
static void save_last(const rt_render_job *job)
{
    rt_profile *const profile = job->renderer->device->profile;
    rt_profile_begin(profile, "checkpoint");
    job->options->checkpoint(job->options->checkpoint_user, job->film);
    rt_profile_end(profile);
    if (job->options->hand_over)
        rt_film_clear(job->film);
}

static void warn_of_darkness(const rt_render_job *job)
{
    if (!job->renderer->has_light)
        rt_warn(job->options->hooks, "the scene has no light: its picture is black");
    else if (job->renderer->is_dark)
        rt_warn(job->options->hooks, "no light of the scene lights anything: its picture is black, "
                                     "or next to it; checking the scene tells why");
}

/* Whether a black picture is for some reason that was told, or asked for. */
static int may_be_black(const rt_render_job *job)
{
    const rt_render_options *o = job->options;
    const rt_film_stats *stats = &job->film->stats;
    return !rt_mode_shows_light(o->mode) || !job->renderer->has_light || job->renderer->is_dark ||
           o->contribution || o->parts > 1 || o->hand_over || stats->rejected > 0 ||
           (o->mode == RT_MODE_PHOTON && stats->photons_stored == 0);
}

/*
 * Of the radiance of the brightest area light: less comes through walls where the ends of a segment
 * are rounded, and is no picture.
 */
static const double leak = 1e-9;

static void warn_of_black(const rt_render_job *job)
{
    const float *rgb = rt_film_rgb(job->film);
    const size_t count = 3 * rt_film_pixels(job->film);
    const double least = leak * job->renderer->brightest;
    if (may_be_black(job))
        return;
    for (size_t i = 0; i < count; i++)
        if (!(rgb[i] <= least && rgb[i] >= -least))
            return;
    rt_warn(job->options->hooks, "the picture is black: no path found light on what the camera "
                                 "sees. Lights may face away or be hidden, shapes be out of sight, "
                                 "or max_depth be too small");
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
    if (rt_mode_shows_light(job->options->mode))
        warn_of_darkness(job);
    rt_profile *const profile = job->renderer->device->profile;
    rt_profile_begin(profile, "compile");
    status = prepare(mode, job, state, error);
    rt_profile_end(profile);
    if (status == RT_OK)
        status = mode->run(job, state, error);
    if ((status == RT_OK || status == RT_CANCELLED) && job->options->checkpoint)
        save_last(job);
    if (status == RT_OK || status == RT_CANCELLED) {
        rt_profile_begin(profile, "resolve");
        rt_status resolved = rt_film_resolve(job->film, job->options->hooks, error);
        rt_profile_end(profile);
        status = resolved == RT_OK ? status : resolved;
    }
    if (status == RT_OK)
        warn_of_black(job);
    if (mode->release)
        mode->release(state);
    rt_first_hit_layers_release(&layers);
    job->layers = NULL;
    free(state);
    return status;
}

/* Whether the film may be put together with others. */
static int has_identity(const rt_render_options *o)
{
    return o->resume || o->checkpoint || o->next_units || o->parts > 0;
}

/* Notes what other films must have in common with this one. */
static rt_status identify(rt_render_job *job, rt_error *error)
{
    const rt_render_options *o = job->options;
    rt_film *film = job->film;
    rt_renderer *renderer = job->renderer;
    int is_own = 1; /* the photons are those that the render itself would emit */
    rt_status status =
        rt_picture_fingerprint(&film->scene, renderer->device, renderer->scene, error);
    if (status == RT_OK && o->photon_map)
        status = rt_photon_map_is_emitted(&is_own, o->photon_map, renderer, o, error);
    for (int kind = 0; kind < RT_PHOTON_KINDS && !is_own; kind++) {
        const rt_path_ranges *ranges = o->photon_map->ranges + kind;
        film->light = rt_fingerprint(film->light, &ranges->count, sizeof ranges->count);
        for (size_t i = 0; i < ranges->count; i++) {
            const rt_path_range *r = ranges->ranges + i;
            const uint64_t words[] = {r->first, r->count, r->photons, r->seed};
            film->light = rt_fingerprint(film->light, words, sizeof words);
        }
    }
    if (o->light_shares)
        film->light = rt_fingerprint(film->light, o->light_shares,
                                     o->light_share_count * sizeof *o->light_shares);
    return status;
}

/* Makes what the render needs besides its mode. */
static rt_status open_job(rt_render_job *job, int is_joined, rt_error *error)
{
    const rt_render_options *o = job->options;
    rt_status status = rt_renderer_aim(job->renderer, o, error);
    if (status == RT_OK)
        status = rt_film_create(&job->film, o, job->renderer->device->memory, error);
    if (status == RT_OK && is_joined) {
        rt_profile_begin(job->renderer->device->profile, "fingerprint");
        status = identify(job, error);
        rt_profile_end(job->renderer->device->profile);
    }
    if (status == RT_OK && o->resume)
        status = rt_film_continue(job->film, o->resume, error);
    if (status == RT_OK)
        job->film->stats.light_power = job->renderer->image.light_power;
    return status;
}

/* Checks a render, completes its options and makes its film. */
static rt_status begin(rt_render_job *job, rt_render_options *o, int is_joined, rt_error *error)
{
    rt_status status = check_and_complete(o, error);
    if (status == RT_OK && !job->renderer->has_camera)
        status = rt_fail(error, RT_ERROR_INPUT,
                         "the scene has no camera, such as camera { eye 0 0 5  look_at 0 0 0 }");
    if (status == RT_OK && job->renderer->has_grids && !rt_mode_class_of(o->mode)->knows_grids)
        status = rt_fail_field(
            error, RT_ERROR_USAGE, "mode",
            "the density or albedo of a medium lies on a grid, which mode %s does not "
            "know; modes path and photon do",
            rt_mode_name(o->mode));
    if (status == RT_OK && job->renderer->has_media && !rt_mode_class_of(o->mode)->knows_media)
        status = rt_fail_field(error, RT_ERROR_USAGE, "mode",
                               "the scene has a `medium` around its solids, media that scatter, "
                               "or interfaces, which mode %s does not know; modes path and photon "
                               "do",
                               rt_mode_name(o->mode));
    return status == RT_OK ? open_job(job, is_joined || has_identity(o), error) : status;
}

rt_status rt_film_begin(rt_film **out, rt_renderer *renderer, const rt_render_options *options,
                        rt_error *error)
{
    if (rt_is_missing(renderer, "renderer", error))
        return RT_ERROR_USAGE;
    rt_render_options o = options ? *options : renderer->options;
    rt_render_job job = {.renderer = renderer, .options = &o};
    rt_status status = begin(&job, &o, 1, error);
    if (status == RT_OK)
        *out = job.film;
    else
        rt_film_destroy(job.film);
    return status;
}

/* Whether a cancelled render is worth something: a picture without holes, or units of a part. */
static int has_samples(const rt_film *film)
{
    return film->stats.spp > 0 || (film->scene && film->done.count > 0);
}

rt_status rt_render(rt_film **out, rt_renderer *renderer, const rt_render_options *options,
                    rt_error *error)
{
    if (rt_is_missing(renderer, "renderer", error))
        return RT_ERROR_USAGE;
    rt_render_options o = options ? *options : renderer->options;
    rt_render_job job = {.renderer = renderer, .options = &o};
    rt_status status = begin(&job, &o, 0, error);
    if (status != RT_OK)
        goto out;
    job.film->stats.build_seconds += renderer->build_seconds;
    status = run(&job, error);
    rt_events_book(renderer->device);
    if (status == RT_CANCELLED) {
        *out = NULL;
        status = rt_fail(error, RT_CANCELLED, "cancelled");
    }
    if (status == RT_OK || (status == RT_CANCELLED && has_samples(job.film))) {
        *out = job.film;
        job.film = NULL;
    }
out:
    rt_film_destroy(job.film);
    return status;
}
