/*
 * photon_passes.c - progressive photon mapping: emission and gathering again and again with fresh
 * paths, and a radius that shrinks so that the mean of the passes comes to the truth.
 *
 * References:
 *   Knaus, Zwicker: "Progressive Photon Mapping: A Probabilistic Approach", ACM Transactions on
 *     Graphics 30(3), 2011: the radii, equation 15.
 */
#include <math.h>
#include <stdlib.h>

#include "base/error.h"
#include "render/noise.h"
#include "render/photon_render.h"

/* Radii shrink by the product of (i + alpha)/(i + 1) over the passes before, counted from 1. */
static double shrunk(double squared_factor, uint32_t pass, double alpha)
{
    return pass == 0 ? 1 : squared_factor * (pass + alpha) / (pass + 1.0);
}

/*
 * Whether a way's points lie on what the pixel sees, so that one sample tells where the others will
 * be.
 */
static int seen_by_pixels(const rt_photon_render *r, rt_photon_way way)
{
    return way == RT_WAY_ON_THE_WAY || r->options->final_gather == 0;
}

/* The mean distance, from squares; 0 when there are none. */
static double mean_distance(const float *squared, size_t pixels)
{
    double sum = 0;
    size_t found = 0;
    for (size_t i = 0; i < pixels; i++) {
        sum += sqrt(squared[i]);
        found += squared[i] > 0;
    }
    return found ? sum / (double)found : 0;
}

/* The middle one of up to nine, which are sorted by it; of an even number the larger. */
static float median(float *values, int count)
{
    for (int i = 1; i < count; i++)
        for (int j = i; j > 0 && values[j] < values[j - 1]; j--) {
            float smaller = values[j];
            values[j] = values[j - 1];
            values[j - 1] = smaller;
        }
    return values[count / 2];
}

/*
 * Turns the squared distances of the k-th photon, of each pixel, into limits: the median of a pixel
 * and its eight neighbours, for behind glass the samples of a pixel may lie far apart; and none
 * above the mean, which also stands where a distance is missing.
 */
static void limit_radii(float *limits, const float *squared, uint32_t width, uint32_t height,
                        double mean)
{
    const float most = (float)(mean * mean);
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++) {
            float around[9];
            int count = 0;
            for (uint32_t v = y - (y > 0); v <= y + (y + 1 < height); v++)
                for (uint32_t u = x - (x > 0); u <= x + (x + 1 < width); u++) {
                    const float near = squared[(size_t)v * width + u];
                    around[count++] = near > 0 && near < most ? near : most;
                }
            limits[(size_t)y * width + x] = median(around, count);
        }
}

/*
 * Chooses the first radii of a way, from the distances of the k-th photon over one sample of the
 * film.
 */
static rt_status choose_radii(rt_photon_render *r, rt_photon_way way, uint32_t sample,
                              rt_stage_progress *progress, rt_error *error)
{
    rt_gather_options nearest = r->how[way];
    uint32_t width = r->options->width, height = r->options->height;
    size_t pixels = (size_t)width * height;
    float *squared = calloc(2 * pixels, sizeof *squared), *limits = squared + pixels;
    if (!squared)
        return rt_fail(error, RT_ERROR_MEMORY, "no memory for the gather radii of %zu pixels",
                       pixels);

    /* Ask each pixel for its nearest photons. */
    nearest.max_radius = 0;
    nearest.k = way == RT_WAY_GLOBAL ? r->options->k : r->options->caustic_k;
    rt_status status = rt_photon_render_open(r, way, &nearest, error);
    if (status == RT_OK)
        status = rt_photon_eye_radii(&r->eye, r->gatherers[way], way == RT_WAY_ON_THE_WAY, sample,
                                     squared, progress, error);
    rt_gatherer_destroy(r->gatherers[way]);
    r->gatherers[way] = NULL;

    /* Keep the mean, and the radii of the pixels where they mean something. */
    const double mean = mean_distance(squared, pixels);
    if (status == RT_OK && mean > 0 && seen_by_pixels(r, way)) {
        limit_radii(limits, squared, width, height, mean);
        status =
            rt_buffer_create(r->renderer->device, r->first_radii + way, CL_MEM_READ_ONLY,
                             pixels * sizeof *limits, limits, "the gather radii of pixels", error);
    }
    free(squared);
    if (status == RT_OK && mean > 0) {
        r->first_radius[way] = mean;
        rt_log(r->options->hooks, "first radius of the %s photons: %s%g m",
               way == RT_WAY_GLOBAL ? "global" : "caustic",
               r->first_radii[way] ? "each pixel's own, at most " : "", mean);
    }
    return status;
}

/* Gives the gatherers of a way the pixels' own radii; the finer one takes half the area. */
static void limit_pixels(rt_photon_render *r, rt_photon_way way, float squared_factor)
{
    rt_gatherer_limit_pixels(r->gatherers[way], r->first_radii[way], squared_factor);
    if (r->finer[way].gatherer)
        rt_gatherer_limit_pixels(r->finer[way].gatherer, r->first_radii[way],
                                 0.5f * squared_factor);
}

/*
 * Makes the gatherers of a pass, for all photons within its radius; photons are left out while no
 * radius is known for them, because nothing asks for them or there are none.
 */
static rt_status aim_gatherers(rt_photon_render *r, uint32_t sample, double squared_factor,
                               rt_stage_progress *progress, rt_error *error)
{
    rt_status status = RT_OK;
    for (rt_photon_way way = 0; way < RT_PHOTON_WAYS && status == RT_OK; way++) {
        if (!rt_photon_render_list(r, way) || rt_photon_render_list(r, way)->count == 0)
            continue;
        if (r->first_radius[way] == 0)
            status = choose_radii(r, way, sample, progress, error);
        if (status != RT_OK || r->first_radius[way] == 0)
            continue;
        rt_gather_options within = r->how[way];
        within.k = 0;
        within.max_radius = (float)(r->first_radius[way] * sqrt(squared_factor));
        status = rt_photon_render_open(r, way, &within, error);
        if (status == RT_OK)
            status = rt_photon_render_open_finer(r, way, &within, error);
        if (status == RT_OK && r->first_radii[way])
            limit_pixels(r, way, (float)squared_factor);
    }
    return status;
}

static rt_status render_pass(rt_photon_render *r, uint32_t pass, double squared_factor,
                             rt_stage_progress *progress, rt_error *error)
{
    rt_film_stats *stats = &r->film->stats;
    double from = progress->from, to = progress->to, t0 = rt_clock();
    uint32_t first = pass / rt_photon_render_replicates(r) * r->options->spp;

    r->eye.replicate = pass % rt_photon_render_replicates(r);
    rt_stage_part(progress, from, from + 0.4 * (to - from));
    rt_status status = rt_photon_render_emit(r, pass, progress, error);
    double t1 = rt_clock();
    rt_stage_part(progress, from + 0.4 * (to - from), to);
    if (status == RT_OK)
        status = aim_gatherers(r, first, squared_factor, progress, error);
    if (status == RT_OK)
        status = rt_photon_render_sample(r, first, progress, error);
    rt_photon_render_close(r);
    stats->emit_seconds += t1 - t0;
    stats->gather_seconds += rt_clock() - t1;
    return status;
}

/*
 * At the end of a pass: learns what it tells of the error; *enough: the one asked for is reached.
 */
static rt_status end_pass(rt_photon_render *r, uint32_t pass, rt_stage_progress *progress,
                          int *enough, rt_error *error)
{
    rt_stretch samples = {.replicate = r->eye.replicate, .count = r->options->spp};
    rt_noise *noise = r->film->noise;
    if (!noise)
        return RT_OK;
    rt_status status =
        rt_noise_read(noise, &samples, r->renderer->device, r->eye.pixels, r->film, error);
    if (status == RT_OK && samples.replicate == RT_REPLICATES - 1)
        *enough = rt_noise_look(noise, pass / RT_REPLICATES + 1, r->options->target_error);
    progress->error = rt_noise_last(noise);
    return status;
}

/*
 * Where the progress of a pass begins: by passes, by time, or by the error, whichever is furthest.
 */
static double part_done(const rt_photon_render *r, uint32_t passes)
{
    const rt_render_options *o = r->options;
    double length = (double)passes / RT_REPLICATES;
    double by_error =
        r->film->noise ? rt_noise_progress(r->film->noise, length, o->target_error) : 0;
    return fmax((double)passes / o->passes, fmax(rt_photon_render_elapsed(r), by_error));
}

rt_status rt_photon_render_passes(rt_photon_render *r, rt_error *error)
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
