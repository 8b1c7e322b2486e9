/*
 * photon_mode.c - photon mapping: light paths fill a photon map, then eye paths ask it for the
 * light that arrives where they end; once, or in passes.
 */
#include <string.h>

#include "base/error.h"
#include "render/photon_render.h"

/* ---- Preparation ---------------------------------------------------------- */

rt_status rt_photon_mode_check(const rt_render_options *o, rt_error *error)
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
    if ((uint64_t)o->passes * o->spp > UINT32_MAX)
        return rt_fail_field(error, RT_ERROR_USAGE, "passes",
                             "%u passes of %u samples are more than the %lu possible", o->passes,
                             o->spp, (unsigned long)UINT32_MAX);
    if (in_passes && o->photon_map)
        return rt_fail_field(error, RT_ERROR_USAGE, "passes",
                             "a photon map that is there already has one pass");
    return RT_OK;
}

/* Builds the kernels. */
static rt_status compile(rt_photon_render *r, rt_error *error)
{
    const rt_renderer *renderer = r->renderer;
    rt_stage_progress progress;
    rt_status status = rt_stage_begin(&progress, r->options->hooks, RT_STAGE_COMPILE);
    if (status == RT_OK && !r->options->photon_map)
        status = rt_emit_kernel_prepare(&r->emit, renderer, &progress, error);
    if (status == RT_OK)
        status = rt_eye_kernels_prepare(&r->eye_kernels, renderer, r->on_device, &progress, error);
    if (status == RT_OK && rt_aov_wanted(r->options))
        status = rt_aov_begin(&r->aov, r->renderer, r->film, &progress, error);
    return status == RT_OK ? rt_stage_end(&progress, &r->film->stats.compile_seconds) : status;
}

static rt_status prepare(rt_photon_render *r, rt_error *error)
{
    const rt_render_options *o = r->options;
    r->map.settings = rt_photon_settings_of(o);
    r->how[RT_WAY_GLOBAL] =
        (rt_gather_options){o->k, o->radius, o->kernel, o->cone_k, o->area, r->on_device};
    r->how[RT_WAY_CAUSTIC] = (rt_gather_options){o->caustic_k, o->caustic_radius, o->caustic_kernel,
                                                 o->cone_k,    o->area,           r->on_device};
    r->how[RT_WAY_ON_THE_WAY] = r->how[r->in_use->settings.split ? RT_WAY_CAUSTIC : RT_WAY_GLOBAL];
    for (rt_photon_way way = 0; way < RT_PHOTON_WAYS; way++) {
        rt_gather_options *how = r->how + way;
        r->first_radius[way] = how->max_radius;
        if (how->k == RT_K_ALL)
            how->k = 0;
    }
    rt_status status =
        rt_photon_eye_create(&r->eye, r->renderer, o, &r->eye_kernels, &r->aov, r->film, error);
    if (status == RT_OK && !o->photon_map)
        status = rt_emitter_create(&r->emitter, r->renderer->device, r->emit, r->renderer->scene,
                                   o->light_shares, o->light_share_count, error);
    return status;
}

/* ---- The whole ------------------------------------------------------------------ */

/* On a thread of its own, because the building of large trees takes long. */
static rt_status create_gatherers(void *data)
{
    rt_photon_render *r = data;
    rt_status status = RT_OK;
    for (rt_photon_way way = 0; way < RT_PHOTON_WAYS && status == RT_OK; way++)
        if (rt_photon_render_list(r, way)) {
            status = rt_photon_render_open(r, way, r->how + way, &r->error);
            if (status == RT_OK)
                status = rt_photon_render_open_finer(r, way, r->how + way, &r->error);
        }
    return status;
}

/* Warns when most of the points that asked for all photons found none. */
static void warn_empty(const rt_film_stats *stats, const rt_hooks *hooks)
{
    if (stats->gathers_empty > stats->gathers_at_ends / 2)
        rt_warn(hooks,
                "%llu of the %llu points that asked for photons found none: the light that photons "
                "bring is missing "
                "there, or all noise; a larger radius or more photons help",
                (unsigned long long)stats->gathers_empty,
                (unsigned long long)stats->gathers_at_ends);
}

/* Emission, then gathering, each a stage. */
static rt_status render_once(rt_photon_render *r, rt_error *error)
{
    const rt_hooks *hooks = r->options->hooks;
    rt_film_stats *stats = &r->film->stats;
    rt_stage_progress progress;

    rt_status status = rt_stage_begin(&progress, hooks, RT_STAGE_EMIT);
    if (status == RT_OK)
        status = rt_photon_render_emit(r, 0, &progress, error);
    if (status != RT_OK)
        return status;
    rt_log(hooks, "%llu photons stored of %llu paths", (unsigned long long)stats->photons_stored,
           (unsigned long long)stats->photons_emitted);
    status = rt_stage_end(&progress, &stats->emit_seconds);
    if (status == RT_OK)
        status = rt_stage_begin(&progress, hooks, RT_STAGE_GATHER);
    if (status == RT_OK)
        status = rt_stage_run(&progress, create_gatherers, r);
    if (status != RT_OK) {
        if (status != RT_CANCELLED && error)
            *error = r->error;
        return status;
    }
    status = rt_photon_render_sample(r, 0, &progress, error);
    if (status == RT_OK || status == RT_CANCELLED) {
        rt_status end = rt_stage_end(&progress, &stats->gather_seconds);
        status = status == RT_OK ? end : status;
    }
    return status;
}

rt_status rt_render_photon(rt_renderer *renderer, const rt_render_options *options, rt_film *film,
                           rt_error *error)
{
    rt_photon_render r;
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
        status = r.in_passes ? rt_photon_render_passes(&r, error) : render_once(&r, error);
    }
    if (status == RT_OK && r.emitter)
        rt_emitter_warn_reach(r.emitter, options->hooks);
    if (status == RT_OK)
        rt_photon_map_warn_starved(r.in_use, &film->ledger, film->stats.passes, options->k,
                                   options->caustic_k, options->hooks);
    if (status == RT_OK)
        warn_empty(&film->stats, options->hooks);
    if (status == RT_OK || (status == RT_CANCELLED && r.eye.pixels)) {
        rt_status read = rt_photon_eye_read(&r.eye, film, error);
        if (read == RT_OK)
            read = rt_aov_read(&r.aov, renderer, film, error);
        status = read == RT_OK ? status : read;
    }
    rt_photon_render_close(&r);
    for (rt_photon_way way = 0; way < RT_PHOTON_WAYS; way++)
        rt_buffer_release(r.first_radii[way]);
    rt_photon_eye_release(&r.eye);
    rt_emitter_destroy(r.emitter);
    rt_photon_list_clear(&r.caustics);
    rt_photon_map_free(&r.map);
    rt_eye_kernels_release(&r.eye_kernels);
    rt_aov_free(&r.aov);
    rt_kernel_release(r.emit);
    return status;
}
