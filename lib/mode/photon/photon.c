/*
 * photon.c - the mode photon: light paths fill a photon map, then eye paths gather from it the
 * light that arrives where they end; once, or in passes.
 */
#include "base/error.h"
#include "mode/modes.h"
#include "mode/photon/emission.h"
#include "mode/photon/passes.h"
#include "mode/photon/radius_test.h"
#include "mode/photon/visibility_pilot.h"
#include "photon/map_check.h"
#include "photon/map_warnings.h"
#include "scene/scene.h"

/* ---- Options ---------------------------------------------------------------- */

/* Refuses what neighbour lists, or the tree, cannot do. */
static rt_status check_gather(const rt_render_options *o, rt_error *error)
{
    int all = o->k == RT_K_ALL || o->caustic_k == RT_K_ALL, in_passes = o->passes > 1;
    if (o->gather == RT_GATHER_FLANN && (all || in_passes))
        return rt_fail_field(error, RT_ERROR_USAGE, "gather",
                             "FLANN finds the k nearest photons only; %s, gather on the device",
                             in_passes ? "in passes" : "for all within a radius");
    if (o->area == RT_AREA_HULL && (all || in_passes || o->gather == RT_GATHER_DEVICE))
        return rt_fail_field(
            error, RT_ERROR_USAGE, "area",
            "the hull is for the k nearest photons by FLANN, not for passes or the device");
    if (o->k == RT_K_ALL && o->radius == 0)
        return rt_fail_field(error, RT_ERROR_USAGE, "k",
                             "to gather all photons within a radius, give the radius");
    if (o->caustic_k == RT_K_ALL && o->caustic_radius == 0)
        return rt_fail_field(error, RT_ERROR_USAGE, "caustic_k",
                             "to gather all photons within a radius, give the caustic_radius");
    if (o->volume_k == RT_K_ALL && o->volume_radius == 0)
        return rt_fail_field(error, RT_ERROR_USAGE, "volume_k",
                             "for volume photons of one radius, give the volume_radius");
    return RT_OK;
}

static rt_status check(const rt_render_options *o, rt_error *error)
{
    if (rt_noise_wanted(o) && o->passes < 2)
        return rt_fail_field(
            error, RT_ERROR_USAGE, o->target_error > 0 ? "target_error" : "variance",
            "the samples of one photon map share its photons, so that they cannot tell its error; "
            "give passes");
    rt_status status = check_gather(o, error);
    if (status != RT_OK)
        return status;
    if (o->irradiance_step > 0 && o->final_gather > 0 && (o->passes > 1 || o->photon_layers))
        return rt_fail_field(error, RT_ERROR_USAGE, "irradiance_step",
                             "the irradiance at photons is for one photon map without %s",
                             o->passes > 1 ? "passes" : "photon_layers, which tell of gathering");
    if ((uint64_t)o->passes * o->spp > INT32_MAX)
        return rt_fail_field(error, RT_ERROR_USAGE, "passes",
                             "%u passes of %u samples are more than the %lu possible", o->passes,
                             o->spp, (unsigned long)INT32_MAX);
    if (o->photon_importance && o->photon_map)
        return rt_fail_field(error, RT_ERROR_USAGE, "photon_importance",
                             "the photons of a map that is there already have started");
    if (o->passes > 1 && o->photon_map)
        return rt_fail_field(error, RT_ERROR_USAGE, "passes",
                             "a photon map that is there already has one pass");
    return RT_OK;
}

/* ---- Preparation ------------------------------------------------------------ */

static rt_photon_search search_of(const rt_render_job *job)
{
    return job->options->passes > 1 ? RT_SEARCH_TREE : rt_photon_search_of(job->options);
}

static void programs(rt_program_list *list, const rt_render_job *job)
{
    static const char *const keeping[] = {"photon_pack", "prefix_sum", "path_sums", "photon_order",
                                          "photon_tree"};
    const rt_renderer *renderer = job->renderer;
    const size_t keep = rt_photon_render_keeps(job, search_of(job)) ? 5 : 0;
    if (!job->options->photon_map)
        rt_program_list_add(list, rt_emit_kernel_name(renderer));
    if (rt_visibility_pilot_is_run(job))
        rt_program_list_add(list, "photon_starts");
    for (size_t i = 0; i < keep; i++)
        rt_program_list_add(list, keeping[i]);
    rt_program_list_add(list, rt_camera_kernel_name(renderer));
    rt_program_list_add(list, rt_gather_kernel_name(search_of(job), renderer->is_plain));
    rt_program_list_add(list, "photon_film");
    if (rt_radius_is_tested(job->options))
        rt_program_list_add(list, "photon_radius");
    if (rt_eye_paths_take_irradiance(job->options))
        rt_program_list_add(list, rt_gather_kernel_name(RT_SEARCH_IRRADIANCE, 0));
}

/* Irradiance does not tell where the light comes from, which a rough lobe must know. */
static rt_status check_lobes(const rt_renderer *renderer, const rt_render_options *o,
                             rt_error *error)
{
    if (o->gather_roughness > 0)
        return rt_fail_field(error, RT_ERROR_USAGE, "irradiance_step",
                             "the irradiance at photons is for diffuse materials alone, without "
                             "`gather_roughness`");
    return renderer->has_rough_diffuse
               ? rt_fail_field(error, RT_ERROR_USAGE, "irradiance_step",
                               "the irradiance at photons is for diffuse materials by Lambert's "
                               "law, and the scene has one with roughness, fuzz, a coat "
                               "or diffuse_transmission")
               : RT_OK;
}

static rt_status prepare(const rt_render_job *job, void *state, rt_stage_progress *progress,
                         rt_error *error)
{
    rt_photon_render *r = state;
    const rt_render_options *o = job->options;
    rt_status status = RT_OK;

    r->job = job;
    r->in_passes = o->passes > 1;
    r->search = search_of(job);
    r->keeps = rt_photon_render_keeps(job, r->search);
    r->in_use = o->photon_map ? o->photon_map : &r->map;
    if (rt_eye_paths_take_irradiance(o))
        status = check_lobes(job->renderer, o, error);
    if (status != RT_OK)
        return status;
    if (o->photon_map)
        status = rt_photon_map_check(o->photon_map, job->renderer, o, error);
    else
        status = rt_emit_kernel_prepare(&r->emit, job->renderer->device, job->renderer->scene,
                                        rt_emit_kernel_name(job->renderer), progress, error);
    if (status == RT_OK && rt_visibility_pilot_is_run(job))
        status = rt_device_kernel(job->renderer->device, &r->starts, "photon_starts",
                                  "photon_starts", NULL, error);
    return status == RT_OK
               ? rt_eye_kernels_prepare(&r->eye_kernels, job, r->search, progress, error)
               : status;
}

/* ---- A render without passes ------------------------------------------------ */

/* Runs on a thread of its own, because the building of large trees takes long. */
static rt_status open_queries(void *data)
{
    rt_photon_render *r = data;
    rt_status status = rt_photon_render_open_volume(r, 1, &r->error);
    for (rt_query query = 0; query < RT_QUERIES && status == RT_OK; query++)
        if (rt_photon_render_list(r, query)) {
            status = rt_photon_render_open(r, query, r->options + query, &r->error);
            if (status == RT_OK)
                status = rt_photon_render_open_finer(r, query, r->options + query, &r->error);
        }
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

/* Samples the film, a batch of eye paths at a time. */
static rt_status sample(rt_photon_render *r, rt_stage_progress *progress, rt_error *error)
{
    const rt_units *units = &r->job->film->units;
    rt_status status = RT_OK;
    rt_unit_range run;
    while (status == RT_OK && rt_work_next(&r->work, &run)) {
        const rt_sample_block block = rt_units_block(units, run.first);
        const size_t batch = rt_eye_paths_batch(&r->eye_paths, &r->queries);
        if (run.count > batch) {
            run.count = batch;
            r->work.at = run.first + run.count;
        }
        const rt_unit_range items = {run.first % units->items, run.count};
        const double from = rt_work_fraction(&r->work);
        rt_stage_part(progress, from, from);
        if (block.count > 0 && run.count > 0)
            status = rt_eye_paths_sample(&r->eye_paths, &r->queries, items, block.first, progress,
                                         error);
        /* A cancel comes after the batch is in the film. */
        if (status == RT_OK || status == RT_CANCELLED) {
            rt_status noted = rt_work_done(&r->work, run, error);
            status = noted == RT_OK ? status : noted;
        }
        if (status == RT_OK)
            status = look(r, error);
    }
    return status;
}

/* Builds the search trees, then samples the film, as one stage. */
static rt_status gather(rt_photon_render *r, rt_error *error)
{
    rt_stage_progress progress;
    rt_status status = rt_work_begin_stage(&r->work, &progress, RT_STAGE_GATHER);
    rt_work_time(&r->work, &r->job->film->stats.gather_seconds);
    rt_profile *const profile = r->job->renderer->device->profile;
    rt_profile_begin(profile, "structure");
    if (status == RT_OK)
        status = rt_stage_run(&progress, open_queries, r);
    rt_profile_end(profile);
    if (status != RT_OK) {
        if (status != RT_CANCELLED && error)
            *error = r->error;
        return status;
    }
    status = sample(r, &progress, error);
    if (status == RT_OK || status == RT_CANCELLED) {
        rt_status end = rt_stage_end(&progress, NULL);
        rt_work_end_time(&r->work);
        status = status == RT_OK ? end : status;
    }
    return status;
}

/* Emission, then gathering, each a stage. */
static rt_status render_once(rt_photon_render *r, rt_error *error)
{
    const rt_hooks *hooks = r->job->options->hooks;
    rt_film_stats *stats = &r->job->film->stats;
    rt_stage_progress progress;

    rt_status status = rt_stage_begin(&progress, hooks, RT_STAGE_EMIT);
    if (status == RT_OK)
        status = rt_visibility_pilot_run(r, &progress, error);
    if (status == RT_OK)
        status = rt_photon_render_emit(r, 0, &progress, error);
    /* A film that is continued has the photons of the same map. */
    rt_ledger_free(&r->job->film->ledger);
    stats->photons_emitted = stats->photons_stored = stats->photons_rejected = 0;
    if (status == RT_OK)
        status = rt_photon_render_book(r, error);
    if (status != RT_OK)
        return status;
    rt_log(hooks, "%llu photons stored of %llu paths", (unsigned long long)stats->photons_stored,
           (unsigned long long)stats->photons_emitted);
    double seconds;
    status = rt_stage_end(&progress, &seconds);
    stats->emit_seconds += seconds;
    return status == RT_OK ? gather(r, error) : status;
}

/* ---- The whole -------------------------------------------------------------- */

static const char *leaves_out(const rt_renderer *renderer, const rt_render_options *o)
{
    return rt_mode_has_caustics(renderer, o, RT_CAUSTICS_ROUGH) && o->gather_roughness == 0
               ? RT_DELTA_CAUSTICS " where they fall on rough surfaces"
               : NULL;
}

/* Of the radius of the scene: what is told as too wide. */
static const double wide_of_scene = 0.2;

/* Warns of a radius within which all photons of a large part of the scene are one estimate. */
static void warn_of_radius(const rt_photon_render *r)
{
    const rt_render_options *o = r->job->options;
    rt_scene_header header;
    rt_error unused;
    if (o->k == RT_K_ALL &&
        rt_buffer_read(r->job->renderer->device, r->job->renderer->scene, 0, sizeof header, &header,
                       &unused) == RT_OK &&
        o->radius > wide_of_scene * header.radius)
        rt_warn(o->hooks,
                "all photons within a radius of %.3g m, %.3g of that of the scene, are one "
                "estimate, which spreads light over as wide a disc: use a smaller radius",
                (double)o->radius, (double)o->radius / header.radius);
}

/* Warns of light that is missing, or all noise. */
static void warn(const rt_photon_render *r)
{
    const rt_render_options *o = r->job->options;
    const rt_film *film = r->job->film;
    const rt_film_stats *stats = &film->stats;
    const char *const missing = leaves_out(r->job->renderer, o);
    if (missing)
        rt_warn(o->hooks,
                "mode photon leaves out %s; %s`gather_roughness` finds those on opaque ones",
                missing, r->job->renderer->has_media ? "" : "mode vcm shows them, and ");
    warn_of_radius(r);
    if (r->emitter)
        rt_emitter_warn_reach(r->emitter, o->hooks);
    rt_photon_map_warn_starved(r->in_use, &film->ledger, stats->passes, o->k, o->caustic_k,
                               o->hooks);
    /* Where radii were chosen by what passes together leave, single ones may find nothing. */
    if (!r->in_passes || rt_radius_rule_of(o) != RT_RADIUS_MSE)
        rt_photon_map_warn_gathers(stats, o->hooks);
}

static rt_status run(const rt_render_job *job, void *state, rt_error *error)
{
    rt_photon_render *r = state;
    (void)job;
    rt_status status = rt_photon_render_begin(r, error);
    if (status != RT_OK)
        return status;
    status = r->in_passes ? rt_photon_render_passes(r, error) : render_once(r, error);
    if (status == RT_OK)
        warn(r);
    if (status == RT_OK || status == RT_CANCELLED) {
        rt_profile_begin(r->work.profile, "read film");
        rt_status read = rt_eye_paths_read(&r->eye_paths, error);
        rt_profile_end(r->work.profile);
        status = read == RT_OK ? status : read;
    }
    return status;
}

static void release(void *state)
{
    rt_photon_render_free(state);
}

const rt_mode_class rt_mode_photon = {
    .has_noise = 1,
    .knows_media = 1,
    .knows_grids = 1,
    .leaves_out = leaves_out,
    .state_size = sizeof(rt_photon_render),
    .check = check,
    .programs = programs,
    .prepare = prepare,
    .run = run,
    .release = release,
};
