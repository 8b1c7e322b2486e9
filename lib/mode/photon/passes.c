/*
 * passes.c - progressive passes: their radii, gatherers and progress.
 *
 * References:
 *   Knaus, Zwicker: "Progressive Photon Mapping: A Probabilistic Approach", ACM Transactions on
 *     Graphics 30(3), 2011: the radii, equation 15.
 */
#include "mode/photon/passes.h"

#include <math.h>

#include "mode/photon/emission.h"
#include "mode/photon/first_radius.h"

/* Radii shrink by the product of (i + alpha)/(i + 1) over the passes before, counted from 1. */
static double shrunk(double squared_factor, uint32_t pass, double alpha)
{
    return pass == 0 ? 1 : squared_factor * (pass + alpha) / (pass + 1.0);
}

/* Gives the gatherers of a query the pixels' own radii; the finer one takes half the area. */
static void limit_pixels(rt_photon_render *r, rt_query query, float squared_factor)
{
    rt_gatherer *finer = r->queries.finer[query].gatherer;
    rt_gatherer_limit_pixels(r->queries.gatherers[query], r->first_radii[query], squared_factor);
    if (finer)
        rt_gatherer_limit_pixels(finer, r->first_radii[query], 0.5f * squared_factor);
}

/* Makes the gatherers of a query, for all photons within the radius of the pass. */
static rt_status open_query(rt_photon_render *r, rt_query query, double squared_factor,
                            rt_error *error)
{
    rt_gather_options within = r->options[query];
    within.k = 0;
    within.max_radius = (float)(r->first_radius[query] * sqrt(squared_factor));
    rt_status status = rt_photon_render_open(r, query, &within, error);
    if (status == RT_OK)
        status = rt_photon_render_open_finer(r, query, &within, error);
    if (status == RT_OK && r->first_radii[query])
        limit_pixels(r, query, (float)squared_factor);
    return status;
}

/*
 * Makes the gatherers of a pass. A query is left out while its radius is unknown, because no point
 * makes it or there are no photons.
 */
static rt_status open_queries(rt_photon_render *r, uint32_t sample, double squared_factor,
                              rt_stage_progress *progress, rt_error *error)
{
    rt_status status = RT_OK;
    for (rt_query query = 0; query < RT_QUERIES && status == RT_OK; query++) {
        const rt_photon_list *list = rt_photon_render_list(r, query);
        if (!list || list->count == 0)
            continue;
        if (r->first_radius[query] == 0)
            status = rt_photon_render_choose_radius(r, query, sample, progress, error);
        if (status == RT_OK && r->first_radius[query] > 0)
            status = open_query(r, query, squared_factor, error);
    }
    return status;
}

static rt_status render_pass(rt_photon_render *r, uint32_t pass, rt_stage_progress *progress,
                             rt_error *error)
{
    rt_film_stats *stats = &r->job->film->stats;
    double from = progress->from, to = progress->to, t0 = rt_clock();
    uint32_t first = pass / rt_photon_render_replicates(r) * r->job->options->spp;

    r->eye_paths.replicate = pass % rt_photon_render_replicates(r);
    rt_stage_part(progress, from, from + 0.4 * (to - from));
    rt_status status = rt_photon_render_emit(r, pass, progress, error);
    double t1 = rt_clock();
    rt_stage_part(progress, from + 0.4 * (to - from), to);
    if (status == RT_OK)
        status = open_queries(r, first, r->squared_factor, progress, error);
    if (status == RT_OK)
        status = rt_photon_render_sample(r, first, progress, error);
    rt_queries_close(&r->queries);
    stats->emit_seconds += t1 - t0;
    stats->gather_seconds += rt_clock() - t1;
    return status;
}

/* At the end of a pass: estimates the error; *enough: the one asked for is reached. */
static rt_status end_pass(rt_photon_render *r, uint32_t pass, rt_stage_progress *progress,
                          int *enough, rt_error *error)
{
    const rt_render_job *job = r->job;
    rt_sample_range samples = {.replicate = r->eye_paths.replicate, .count = job->options->spp};
    if (!job->noise)
        return RT_OK;
    rt_status status = rt_noise_read(job->noise, &samples, job->renderer->device,
                                     r->eye_paths.pixels, job->film, error);
    if (status == RT_OK && samples.replicate == RT_REPLICATES - 1)
        *enough = rt_noise_test(job->noise, pass / RT_REPLICATES + 1, job->options->target_error);
    progress->error = rt_noise_last(job->noise);
    return status;
}

/*
 * Where the progress of a pass begins: by passes, by time, or by the error, whichever is furthest.
 */
static double part_done(const rt_photon_render *r, uint32_t passes)
{
    const rt_render_options *o = r->job->options;
    double length = (double)passes / RT_REPLICATES;
    double by_error = r->job->noise ? rt_noise_progress(r->job->noise, length, o->target_error) : 0;
    return fmax((double)passes / o->passes, fmax(rt_photon_render_elapsed(r), by_error));
}

rt_status rt_photon_render_passes(rt_photon_render *r, rt_error *error)
{
    const rt_render_options *o = r->job->options;
    rt_film_stats *stats = &r->job->film->stats;
    double longest = 0;
    int enough = 0;
    rt_stage_progress progress;

    rt_status status = rt_stage_begin(&progress, o->hooks, RT_STAGE_RENDER);
    for (uint32_t pass = stats->passes; pass < o->passes && status == RT_OK && !enough; pass++) {
        double began = rt_clock(), from = part_done(r, pass), to = 1.0 / o->passes;
        if (o->time > 0 && longest / o->time > to)
            to = longest / o->time;
        r->squared_factor = shrunk(r->squared_factor, pass, o->alpha);
        rt_stage_part(&progress, from, from + to < 1 ? from + to : 1);
        status = render_pass(r, pass, &progress, error);
        if (status == RT_OK)
            status = end_pass(r, pass, &progress, &enough, error);
        if (status == RT_OK)
            stats->passes = pass + 1;
        if (rt_photon_render_elapsed(r) >= 1)
            break;
        longest = rt_clock() - began > longest ? rt_clock() - began : longest;
    }
    if (status == RT_OK || status == RT_CANCELLED) {
        rt_status end = rt_stage_end(&progress, NULL);
        status = status == RT_OK ? end : status;
    }
    return status;
}
