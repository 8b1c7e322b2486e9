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
#include "mode/photon/pilot.h"
#include "mode/photon/radius_test.h"
#include "mode/photon/visibility_pilot.h"

/* Passes in which the first radius of a query is looked for; later ones find their own. */
enum { tries = 16 };

/* By which the pass has shrunk the square of the first radius, after the pilot if there is one. */
static double squared_factor(rt_photon_render *r, uint32_t pass)
{
    const uint32_t pilot = rt_radius_is_tested(r->job->options) ? RT_PILOT_PASSES : 0;
    return rt_shrink_after(&r->shrink, pass, pilot, r->job->options->alpha);
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
    rt_profile_begin(r->work.profile, "structure");
    rt_status status = rt_photon_render_open(r, query, &within, error);
    if (status == RT_OK)
        status = rt_photon_render_open_finer(r, query, &within, error);
    rt_profile_end(r->work.profile);
    if (status == RT_OK && r->first_radii[query])
        limit_pixels(r, query, (float)squared_factor);
    return status;
}

/* ---- First radii ------------------------------------------------------------- */

/* The sequence and number of a pass's first sample. */
static uint32_t aim_at_pass(rt_photon_render *r, uint32_t pass)
{
    r->eye_paths.replicate = pass % rt_photon_render_replicates(r);
    return pass / rt_photon_render_replicates(r) * r->job->options->spp;
}

/* Whether a query has photons, but no radius yet. */
static int lacks_radius(const rt_photon_render *r, rt_query query)
{
    const rt_photon_list *list = rt_photon_render_list(r, query);
    return list && r->first_radius[query] == 0;
}

/* Chooses the radii that are unknown from the photons of this pass, as far as it has any. */
static rt_status choose_radii(rt_photon_render *r, uint32_t pass, rt_stage_progress *progress,
                              rt_error *error)
{
    const uint32_t first = aim_at_pass(r, pass);
    rt_status status = RT_OK;
    for (rt_query query = 0; query < RT_QUERIES && status == RT_OK; query++)
        if (lacks_radius(r, query) && rt_photon_render_list(r, query)->count > 0)
            status = rt_photon_render_choose_radius(r, query, first, progress, error);
    return status;
}

/*
 * First radii are those of the first pass that has photons where it gathers, whichever passes this
 * render takes: the ones before this pass are tried first.
 */
static rt_status choose_earlier_radii(rt_photon_render *r, uint32_t pass,
                                      rt_stage_progress *progress, rt_error *error)
{
    rt_status status = RT_OK;
    for (; r->passes_tried < pass && r->passes_tried < tries && status == RT_OK;
         r->passes_tried++) {
        int unknown = 0;
        for (rt_query query = 0; query < RT_QUERIES; query++)
            unknown |= lacks_radius(r, query);
        if (!unknown)
            continue;
        status = rt_photon_render_emit(r, r->passes_tried, progress, error);
        if (status == RT_OK)
            status = choose_radii(r, r->passes_tried, progress, error);
    }
    return status;
}

/* Forgets radii that were chosen for one pass alone. */
static void forget_radii(rt_photon_render *r, const int *known)
{
    for (rt_query query = 0; query < RT_QUERIES; query++)
        if (!known[query]) {
            r->first_radius[query] = 0;
            rt_buffer_release(r->job->renderer->device, r->first_radii[query]);
            r->first_radii[query] = NULL;
        }
}

/* ---- A pass ------------------------------------------------------------------ */

/*
 * Makes the gatherers of a pass. A query is left out while its radius is unknown, because no point
 * makes it or there are no photons.
 */
static rt_status open_queries(rt_photon_render *r, uint32_t pass, rt_stage_progress *progress,
                              rt_error *error)
{
    const double factor = squared_factor(r, pass);
    rt_status status = choose_radii(r, pass, progress, error);
    if (status == RT_OK)
        status = rt_photon_render_open_volume(r, factor, error);
    for (rt_query query = 0; query < RT_QUERIES && status == RT_OK; query++) {
        const rt_photon_list *list = rt_photon_render_list(r, query);
        if (list && list->count > 0 && r->first_radius[query] > 0)
            status = open_query(r, query, factor, error);
    }
    return status;
}

/* Emits the photons of a pass and gathers them, and adds its film to that of the render. */
static rt_status render_pass(rt_photon_render *r, uint32_t pass, rt_stage_progress *progress,
                             rt_error *error)
{
    rt_film_stats *stats = &r->job->film->stats;
    const rt_film_stats before = *stats;
    double from = progress->from, to = progress->to, t0 = rt_clock();
    int known[RT_QUERIES];

    rt_stage_part(progress, from, from + 0.4 * (to - from));
    rt_status status = choose_earlier_radii(r, pass, progress, error);
    for (rt_query query = 0; query < RT_QUERIES; query++)
        known[query] = r->first_radius[query] > 0 || pass < tries;
    if (status == RT_OK)
        status = rt_photon_render_emit(r, pass, progress, error);
    double t1 = rt_clock();
    rt_stage_part(progress, from + 0.4 * (to - from), to);
    const uint32_t first = aim_at_pass(r, pass);
    rt_eye_paths_begin_pass(&r->eye_paths, pass);
    if (status == RT_OK)
        status = open_queries(r, pass, progress, error);
    if (status == RT_OK)
        status = rt_photon_render_sample(r, first, progress, error);
    rt_photon_render_close(r);
    forget_radii(r, known);
    r->passes_tried = r->passes_tried == pass ? pass + 1 : r->passes_tried;
    if (status == RT_OK)
        status = rt_photon_render_book(r, error);
    if (status == RT_OK)
        status = rt_eye_paths_end_pass(
            &r->eye_paths, r->job->film->units.replicates > 1 ? r->eye_paths.replicate : 0, first,
            error);
    if (status != RT_OK) /* a pass that is not whole is left out */
        *stats = before;
    stats->emit_seconds += t1 - t0;
    stats->gather_seconds += rt_clock() - t1;
    return status;
}

/* Shows a preview and makes a checkpoint where these are due. */
static rt_status look(rt_photon_render *r, rt_error *error)
{
    const int show = rt_work_preview_is_due(&r->work), save = rt_work_save_is_due(&r->work);
    const double began = rt_clock();
    if (!show && !save)
        return RT_OK;
    rt_status status = rt_eye_paths_read(&r->eye_paths, error);
    if (status == RT_OK && show)
        rt_work_preview(&r->work, began);
    if (status == RT_OK && save && rt_work_save(&r->work))
        status = rt_eye_paths_write(&r->eye_paths, error);
    return status;
}

/* Notes that a pass is done, tests the error where that is due, and looks. */
static rt_status end_pass(rt_photon_render *r, uint32_t pass, rt_stage_progress *progress,
                          rt_error *error)
{
    rt_film *film = r->job->film;
    rt_status status = rt_work_done(&r->work, (rt_unit_range){pass, 1}, error);
    film->stats.passes++;
    if (status == RT_OK && rt_work_test_is_due(&r->work)) {
        status = rt_eye_paths_read(&r->eye_paths, error);
        if (status == RT_OK)
            rt_work_test(&r->work);
    }
    if (status == RT_OK)
        status = look(r, error);
    progress->error = rt_noise_last(&r->work.noise);
    return status;
}

/*
 * Looks for first radii, and tests them, before the first pass that this render takes. That counts
 * as gathering.
 */
static rt_status run_pilot(rt_photon_render *r, rt_stage_progress *progress, rt_error *error)
{
    const double from = rt_work_fraction(&r->work), began = rt_clock();
    rt_stage_part(progress, from, from);
    rt_status status = choose_earlier_radii(r, tries, progress, error);
    if (status == RT_OK)
        status = rt_pilot_run(r, progress, error);
    r->job->film->stats.gather_seconds += rt_clock() - began;
    return status;
}

rt_status rt_photon_render_passes(rt_photon_render *r, rt_error *error)
{
    const rt_render_options *o = r->job->options;
    double longest = 0;
    rt_stage_progress progress;
    rt_unit_range run;

    rt_status status = rt_work_begin_stage(&r->work, &progress, RT_STAGE_RENDER);
    if (status == RT_OK)
        status = rt_visibility_pilot_run(r, &progress, error);
    if (status == RT_OK && rt_radius_is_tested(o))
        status = run_pilot(r, &progress, error);
    while (status == RT_OK && rt_work_next(&r->work, &run)) {
        const uint32_t pass = (uint32_t)run.first;
        if (run.count == 0) {
            status = look(r, error);
            continue;
        }
        const double began = rt_clock(), from = rt_work_fraction(&r->work);
        const double to = from + fmax(1 / r->work.all, o->time > 0 ? longest / o->time : 0);
        rt_stage_part(&progress, from, fmin(to, 1));
        status = render_pass(r, pass, &progress, error);
        if (status == RT_OK)
            status = end_pass(r, pass, &progress, error);
        longest = fmax(longest, rt_clock() - began);
    }
    if (status == RT_OK || status == RT_CANCELLED) {
        rt_status end = rt_stage_end(&progress, NULL);
        status = status == RT_OK ? end : status;
    }
    return status;
}
