/*
 * photon_mode.c - photon mapping: light paths fill a photon map, then eye paths ask it for the light
 * that arrives where they end. In passes, both are done again and again with fresh paths, and a radius that
 * shrinks so that the mean of the passes comes to the truth.
 *
 * References:
 *   Knaus, Zwicker: "Progressive Photon Mapping: A Probabilistic Approach", ACM Transactions on
 *     Graphics 30(3), 2011: the radii, equation 15.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "photon/emit.h"
#include "photon/photon_map.h"
#include "render/aov.h"
#include "render/noise.h"
#include "render/photon_eye.h"
#include "render/renderer.h"

/* The ways in which photons are gathered, each with a radius of its own. */
enum { WAY_GLOBAL, WAY_CAUSTIC, WAY_ON_THE_WAY, WAYS };

/* A render under way. */
typedef struct photon_render {
    rt_renderer *renderer;
    const rt_render_options *options;
    rt_film *film;
    int on_device, in_passes;
    cl_kernel emit;
    rt_eye_kernels eye_kernels;
    rt_emitter *emitter;
    rt_photon_map map;           /* what is emitted */
    const rt_photon_map *in_use; /* that, or the one of the options */
    rt_photon_list caustics;     /* copies out of the global list, for the final gather, unless there is a caustic list */
    rt_aov aov;
    rt_photon_eye eye;
    rt_gather_options how[WAYS]; /* of this pass */
    double first_radius[WAYS];   /* of the passes, 0 while unknown */
    rt_gatherer *gatherers[WAYS];
    double began;                /* of emission, for options->time */
    rt_error error;              /* of the search tree's thread */
} photon_render;

/* ---- Preparation ---------------------------------------------------------- */

rt_status rt_photon_mode_check(const rt_render_options *o, rt_error *error)
{
    int all = o->k == RT_K_ALL || o->caustic_k == RT_K_ALL, in_passes = o->passes > 1;
    if (o->gather == RT_GATHER_FLANN && (all || in_passes))
        return rt_fail_field(error, RT_ERROR_USAGE, "gather",
                             "FLANN finds the k nearest photons only; %s, gather on the device",
                             in_passes ? "in passes" : "for all within a radius");
    if (o->area == RT_AREA_HULL && (all || in_passes || o->gather == RT_GATHER_DEVICE))
        return rt_fail_field(error, RT_ERROR_USAGE, "area",
                             "the hull is for the k nearest photons by FLANN, not for passes or the device");
    if (!in_passes && o->k == RT_K_ALL && o->radius == 0)
        return rt_fail_field(error, RT_ERROR_USAGE, "k", "to gather all photons within a radius, give the radius");
    if (!in_passes && o->caustic_k == RT_K_ALL && o->caustic_radius == 0)
        return rt_fail_field(error, RT_ERROR_USAGE, "caustic_k",
                             "to gather all photons within a radius, give the caustic_radius");
    if ((uint64_t)o->passes * o->spp > UINT32_MAX)
        return rt_fail_field(error, RT_ERROR_USAGE, "passes", "%u passes of %u samples are more than the %lu possible",
                             o->passes, o->spp, (unsigned long)UINT32_MAX);
    if (in_passes && o->photon_map)
        return rt_fail_field(error, RT_ERROR_USAGE, "passes", "a photon map that is there already has one pass");
    return RT_OK;
}

/* Builds the kernels. */
static rt_status compile(photon_render *r, rt_error *error)
{
    rt_device *device = r->renderer->device;
    cl_mem any = r->renderer->scene; /* stands for all buffers that are not touched yet */
    rt_stage_progress progress;
    rt_params params;
    memset(&params, 0, sizeof params);
    rt_arg emit[RT_EMIT_ARGUMENTS] = {RT_ARG(params)};
    for (int i = 1; i < RT_EMIT_ARGUMENTS; i++)
        emit[i] = (rt_arg)RT_ARG(any);

    rt_status status = rt_stage_begin(&progress, r->options->hooks, RT_STAGE_COMPILE);
    if (status == RT_OK && !r->options->photon_map)
        status = rt_kernel_prepare(device, &r->emit, "photon_emit", "photon_emit", emit, RT_EMIT_ARGUMENTS, &progress,
                                   error);
    if (status == RT_OK)
        status = rt_eye_kernels_prepare(&r->eye_kernels, device, any, r->on_device, &progress, error);
    if (status == RT_OK && rt_aov_wanted(r->options))
        status = rt_aov_begin(&r->aov, r->renderer, r->film, &progress, error);
    return status == RT_OK ? rt_stage_end(&progress, &r->film->stats.compile_seconds) : status;
}

static rt_status prepare(photon_render *r, rt_error *error)
{
    const rt_render_options *o = r->options;
    r->map.settings = (rt_photon_settings){0, o->max_depth, o->sampler, o->direct, o->caustic_photons > 0};
    r->how[WAY_GLOBAL] = (rt_gather_options){o->k, o->radius, o->kernel, o->cone_k, o->area, r->on_device};
    r->how[WAY_CAUSTIC] = (rt_gather_options){o->caustic_k,    o->caustic_radius, o->caustic_kernel,
                                            o->cone_k, o->area, r->on_device};
    r->how[WAY_ON_THE_WAY] = r->how[r->in_use->settings.split ? WAY_CAUSTIC : WAY_GLOBAL];
    for (int way = 0; way < WAYS; way++) {
        rt_gather_options *how = r->how + way;
        r->first_radius[way] = how->max_radius;
        if (how->k == RT_K_ALL)
            how->k = 0;
    }
    rt_status status = rt_photon_eye_create(&r->eye, r->renderer, o, &r->eye_kernels, &r->aov, r->film, error);
    if (status == RT_OK && !o->photon_map)
        status = rt_emitter_create(&r->emitter, r->renderer->device, r->emit, r->renderer->scene, NULL, 0, error);
    return status;
}

/* ---- Photons --------------------------------------------------------------- */

static const rt_photon_list *list_of(const photon_render *r, rt_photon_kind kind)
{
    return r->in_use->lists + kind;
}

/* The independent sequences that passes take turns at. */
static uint32_t replicates_of(const photon_render *r)
{
    return r->film->noise ? RT_REPLICATES : 1;
}

/*
 * Fills the map with the photons of a pass: the next paths of the seed, and when its indices are used up, of
 * another. Where the error is to be known, passes take turns at replicates, each with seeds of its own.
 */
static rt_status emit_kind(photon_render *r, rt_photon_kind kind, uint64_t count, uint32_t pass,
                           rt_stage_progress *progress, rt_error *error)
{
    uint64_t passes_a_seed = (UINT64_C(1) << 32) / count;
    uint32_t replicates = replicates_of(r), turn = pass / replicates;
    uint32_t seeds_before = (uint32_t)(turn / passes_a_seed) * replicates + pass % replicates;
    uint32_t seed = r->options->seed + seeds_before * 0x9e3779b9u;
    return rt_emitter_emit(r->emitter, &r->map, kind, seed, turn % passes_a_seed * count, count, progress, error);
}

/* The caustic photons of a list that holds all kinds. */
static rt_status copy_caustics(rt_photon_list *out, const rt_photon_list *list, rt_error *error)
{
    size_t count = 0;
    for (size_t i = 0; i < list->count; i++)
        count += list->photons[i].flags & RT_PHOTON_CAUSTIC;
    rt_photon_list_reset(out);
    rt_status status = rt_photon_list_reserve(out, count, error);
    for (size_t i = 0; i < list->count && status == RT_OK; i++)
        if (list->photons[i].flags & RT_PHOTON_CAUSTIC)
            out->photons[out->count++] = list->photons[i];
    out->emitted = list->emitted;
    return status;
}

static rt_status emit(photon_render *r, uint32_t pass, rt_stage_progress *progress, rt_error *error)
{
    const rt_render_options *o = r->options;
    rt_film_stats *stats = &r->film->stats;
    rt_status status = RT_OK;

    if (r->in_use == &r->map) {
        rt_photon_map_reset(&r->map);
        status = emit_kind(r, RT_PHOTONS_GLOBAL, o->photons, pass, progress, error);
        if (status == RT_OK && r->map.settings.split)
            status = emit_kind(r, RT_PHOTONS_CAUSTIC, o->caustic_photons, pass, progress, error);
    }
    for (int kind = 0; kind < RT_PHOTON_KINDS; kind++) {
        stats->photons_emitted += r->in_use->lists[kind].emitted;
        stats->photons_stored += r->in_use->lists[kind].count;
        stats->photons_rejected += r->in_use->lists[kind].rejected;
    }
    if (status == RT_OK)
        status = rt_ledger_add(&r->film->ledger, &r->in_use->ledger, error);
    if (status == RT_OK && o->final_gather > 0 && !r->in_use->settings.split)
        status = copy_caustics(&r->caustics, list_of(r, RT_PHOTONS_GLOBAL), error);
    return status;
}

/* ---- Gathering ------------------------------------------------------------- */

static const rt_photon_list *list_of_way(const photon_render *r, int way)
{
    int split = r->in_use->settings.split != 0;
    switch (way) {
    case WAY_GLOBAL:
        return list_of(r, RT_PHOTONS_GLOBAL);
    case WAY_CAUSTIC:
        return split ? list_of(r, RT_PHOTONS_CAUSTIC) : NULL;
    default:
        if (r->options->final_gather == 0)
            return NULL;
        return split ? list_of(r, RT_PHOTONS_CAUSTIC) : &r->caustics;
    }
}

static rt_status create_gatherer(photon_render *r, int way)
{
    return rt_gatherer_create(r->gatherers + way, r->renderer->device, r->eye_kernels.gather,
                              list_of_way(r, way), r->how + way, &r->error);
}

static void destroy_gatherers(photon_render *r)
{
    for (int way = 0; way < WAYS; way++) {
        rt_gatherer_destroy(r->gatherers[way]);
        r->gatherers[way] = NULL;
    }
}

/* On a thread of its own, because the building of large trees takes long. */
static rt_status create_gatherers(void *data)
{
    photon_render *r = data;
    rt_status status = RT_OK;
    for (int way = 0; way < WAYS && status == RT_OK; way++)
        if (list_of_way(r, way))
            status = create_gatherer(r, way);
    return status;
}

static double elapsed_part(const photon_render *r)
{
    double time = r->options->time, part = time > 0 ? (rt_clock() - r->began) / time : 0;
    return part < 1 ? part : 1;
}

/* Asks the map for samples from first on of every pixel, until there are enough or time is up. */
static rt_status add_samples(photon_render *r, uint32_t first, rt_stage_progress *progress, rt_error *error)
{
    rt_eye_maps maps = {r->gatherers[WAY_GLOBAL], r->gatherers[WAY_CAUSTIC], r->gatherers[WAY_ON_THE_WAY]};
    double from = progress->from, span = progress->to - progress->from;
    uint32_t spp = r->options->spp;
    rt_status status = RT_OK;

    for (uint32_t i = 0; i < spp && status == RT_OK; i++) {
        double by_samples = from + span * i / spp, by_time = elapsed_part(r);
        if (!r->in_passes && by_time > by_samples)
            rt_stage_part(progress, by_time, by_time);
        else
            rt_stage_part(progress, by_samples, from + span * (i + 1) / spp);
        status = rt_photon_eye_sample(&r->eye, &maps, first + i, &r->film->stats.gathers, progress, error);
        if (elapsed_part(r) >= 1)
            break;
    }
    return status;
}

static rt_status with_own_error(const photon_render *r, rt_status status, rt_error *error)
{
    if (status != RT_OK && status != RT_CANCELLED && error)
        *error = r->error;
    return status;
}

/* ---- One pass ------------------------------------------------------------------ */

/* Emission, then gathering, each a stage. */
static rt_status render_once(photon_render *r, rt_error *error)
{
    const rt_hooks *hooks = r->options->hooks;
    rt_film_stats *stats = &r->film->stats;
    rt_stage_progress progress;

    rt_status status = rt_stage_begin(&progress, hooks, RT_STAGE_EMIT);
    if (status == RT_OK)
        status = emit(r, 0, &progress, error);
    if (status != RT_OK)
        return status;
    rt_log(hooks, "%llu photons stored of %llu paths", (unsigned long long)stats->photons_stored,
           (unsigned long long)stats->photons_emitted);
    status = rt_stage_end(&progress, &stats->emit_seconds);
    if (status == RT_OK)
        status = rt_stage_begin(&progress, hooks, RT_STAGE_GATHER);
    if (status == RT_OK)
        status = with_own_error(r, rt_stage_run(&progress, create_gatherers, r), error);
    if (status != RT_OK)
        return status;
    status = add_samples(r, 0, &progress, error);
    if (status == RT_OK || status == RT_CANCELLED) {
        rt_status end = rt_stage_end(&progress, &stats->gather_seconds);
        status = status == RT_OK ? end : status;
    }
    return status;
}

/* ---- Passes -------------------------------------------------------------------- */

/* Radii shrink by the product of (i + alpha)/(i + 1) over the passes before, counted from 1. */
static double shrunk(double squared_factor, uint32_t pass, double alpha)
{
    return pass == 0 ? 1 : squared_factor * (pass + alpha) / (pass + 1.0);
}

/* Chooses the first radius of a way: the mean distance of the k-th photon, over one sample of the film. */
static rt_status choose_radius(photon_render *r, int way, uint32_t sample, rt_stage_progress *progress,
                               rt_error *error)
{
    rt_gather_options nearest = r->how[way];
    const rt_gather_options within = nearest;
    nearest.max_radius = 0;
    nearest.k = way == WAY_GLOBAL ? r->options->k : r->options->caustic_k;
    if (nearest.k == RT_K_ALL)
        nearest.k = 50;
    r->how[way] = nearest;
    rt_status status = with_own_error(r, create_gatherer(r, way), error);
    r->how[way] = within;
    if (status == RT_OK)
        status = rt_photon_eye_mean_radius(&r->eye, r->gatherers[way], sample, r->first_radius + way, progress, error);
    rt_gatherer_destroy(r->gatherers[way]);
    r->gatherers[way] = NULL;
    if (status == RT_OK && r->first_radius[way] > 0)
        rt_log(r->options->hooks, "first radius of the %s photons: %g m", way == WAY_GLOBAL ? "global" : "caustic",
               r->first_radius[way]);
    return status;
}

/* Makes the gatherers of a pass; photons are left out while no radius is known for them, and there are none. */
static rt_status aim_gatherers(photon_render *r, uint32_t sample, double squared_factor, rt_stage_progress *progress,
                               rt_error *error)
{
    rt_status status = RT_OK;
    for (int way = 0; way < WAYS && status == RT_OK; way++) {
        if (!list_of_way(r, way) || list_of_way(r, way)->count == 0)
            continue;
        if (r->first_radius[way] == 0 && way == WAY_ON_THE_WAY)
            r->first_radius[way] = r->first_radius[r->in_use->settings.split ? WAY_CAUSTIC : WAY_GLOBAL];
        if (r->first_radius[way] == 0)
            status = choose_radius(r, way, sample, progress, error);
        if (status != RT_OK || r->first_radius[way] == 0)
            continue;
        r->how[way].k = 0;
        r->how[way].max_radius = (float)(r->first_radius[way] * sqrt(squared_factor));
        status = with_own_error(r, create_gatherer(r, way), error);
    }
    return status;
}

static rt_status render_pass(photon_render *r, uint32_t pass, double squared_factor, rt_stage_progress *progress,
                             rt_error *error)
{
    rt_film_stats *stats = &r->film->stats;
    double from = progress->from, to = progress->to, t0 = rt_clock();
    uint32_t first = pass / replicates_of(r) * r->options->spp;

    r->eye.replicate = pass % replicates_of(r);
    rt_stage_part(progress, from, from + 0.4 * (to - from));
    rt_status status = emit(r, pass, progress, error);
    double t1 = rt_clock();
    rt_stage_part(progress, from + 0.4 * (to - from), to);
    if (status == RT_OK)
        status = aim_gatherers(r, first, squared_factor, progress, error);
    if (status == RT_OK)
        status = add_samples(r, first, progress, error);
    destroy_gatherers(r);
    stats->emit_seconds += t1 - t0;
    stats->gather_seconds += rt_clock() - t1;
    return status;
}

/* At the end of a pass: learns what it tells of the error; *enough: the one asked for is reached. */
static rt_status end_pass(photon_render *r, uint32_t pass, rt_stage_progress *progress, int *enough, rt_error *error)
{
    rt_stretch samples = {.replicate = r->eye.replicate, .count = r->options->spp};
    rt_noise *noise = r->film->noise;
    if (!noise)
        return RT_OK;
    rt_status status = rt_noise_read(noise, &samples, r->renderer->device, r->eye.pixels, r->film, error);
    if (status == RT_OK && samples.replicate == RT_REPLICATES - 1)
        *enough = rt_noise_look(noise, pass / RT_REPLICATES + 1, r->options->target_error);
    progress->error = rt_noise_last(noise);
    return status;
}

/* Where the progress of a pass begins: by passes, by time, or by the error, whichever is furthest. */
static double part_done(const photon_render *r, uint32_t passes)
{
    const rt_render_options *o = r->options;
    double length = (double)passes / RT_REPLICATES;
    double by_error = r->film->noise ? rt_noise_progress(r->film->noise, length, o->target_error) : 0;
    return fmax((double)passes / o->passes, fmax(elapsed_part(r), by_error));
}

/* Pass after pass, as one stage, until there are enough, time is up or the error is small enough. */
static rt_status render_passes(photon_render *r, rt_error *error)
{
    const rt_render_options *o = r->options;
    double squared_factor = 1, longest = 0;
    int enough = 0;
    rt_stage_progress progress;

    rt_status status = rt_stage_begin(&progress, o->hooks, RT_STAGE_RENDER);
    for (uint32_t pass = 0; pass < o->passes && status == RT_OK && !enough; pass++) {
        double began = rt_clock(), from = part_done(r, pass), to = 1.0 / o->passes;
        if (o->time > 0 && longest / o->time > to)
            to = longest / o->time;
        squared_factor = shrunk(squared_factor, pass, o->alpha);
        rt_stage_part(&progress, from, from + to < 1 ? from + to : 1);
        status = render_pass(r, pass, squared_factor, &progress, error);
        if (status == RT_OK)
            status = end_pass(r, pass, &progress, &enough, error);
        if (status == RT_OK)
            r->film->stats.passes = pass + 1;
        if (elapsed_part(r) >= 1)
            break;
        longest = rt_clock() - began > longest ? rt_clock() - began : longest;
    }
    if (status == RT_OK || status == RT_CANCELLED) {
        rt_status end = rt_stage_end(&progress, NULL);
        status = status == RT_OK ? end : status;
    }
    return status;
}

/* ---- The whole ------------------------------------------------------------------ */

rt_status rt_render_photon(rt_renderer *renderer, const rt_render_options *options, rt_film *film, rt_error *error)
{
    photon_render r;
    rt_status status = RT_OK;
    if (options->photon_map)
        status = rt_photon_map_check(options->photon_map, renderer, options, error);
    if (status != RT_OK)
        return status;

    memset(&r, 0, sizeof r);
    r.renderer = renderer;
    r.options = options;
    r.film = film;
    r.in_passes = options->passes > 1;
    r.on_device = options->gather == RT_GATHER_DEVICE || r.in_passes || options->k == RT_K_ALL ||
                  options->caustic_k == RT_K_ALL;
    r.in_use = options->photon_map ? options->photon_map : &r.map;
    status = compile(&r, error);
    if (status == RT_OK)
        status = prepare(&r, error);
    if (status == RT_OK) {
        r.began = rt_clock();
        status = r.in_passes ? render_passes(&r, error) : render_once(&r, error);
    }
    if (status == RT_OK && r.emitter)
        rt_emitter_warn_reach(r.emitter, options->hooks);
    if (status == RT_OK)
        rt_photon_map_warn_starved(r.in_use, &film->ledger, options->k, options->caustic_k, options->hooks);
    if (status == RT_OK || (status == RT_CANCELLED && r.eye.pixels)) {
        rt_status read = rt_photon_eye_read(&r.eye, film, error);
        if (read == RT_OK)
            read = rt_aov_read(&r.aov, renderer, film, error);
        status = read == RT_OK ? status : read;
    }
    destroy_gatherers(&r);
    rt_photon_eye_release(&r.eye);
    rt_emitter_destroy(r.emitter);
    rt_photon_list_clear(&r.caustics);
    rt_photon_map_free(&r.map);
    rt_eye_kernels_release(&r.eye_kernels);
    rt_aov_free(&r.aov);
    rt_kernel_release(r.emit);
    return status;
}
