/* map_emit.c - rt_photon_map_emit: a photon map by itself, emitted from a renderer's scene. */
#include <math.h>
#include <stdlib.h>

#include "base/error.h"
#include "photon/emit.h"
#include "photon/fingerprint.h"
#include "photon/map_continue.h"
#include "photon/map_warnings.h"
#include "render/renderer.h"
#include "setting/options.h"

/* An emission under way. */
typedef struct emission {
    rt_renderer *renderer;
    const rt_emit_options *how;
    rt_render_options options; /* complete */
    cl_kernel kernel;
    rt_emitter *emitter;
    rt_photon_map *map;
    double saved, saving; /* rt_clock() at the last checkpoint, and the seconds that it took */
    double lacking;       /* paths that the map lacked when it began */
} emission;

static rt_status compile(emission *e, rt_error *error)
{
    rt_stage_progress progress;
    rt_device *device = e->renderer->device;
    rt_status status = rt_stage_begin(&progress, e->options.hooks, RT_STAGE_COMPILE);
    rt_profile_begin(device->profile, "compile");
    if (status == RT_OK)
        status = rt_emit_kernel_prepare(&e->kernel, device, e->renderer->scene,
                                        rt_emit_kernel_name(e->renderer), &progress, error);
    rt_profile_end(device->profile);
    return status == RT_OK ? rt_stage_end(&progress, NULL) : status;
}

/* ---- Checkpoints ------------------------------------------------------------ */

/* Hands out the map so far. */
static void save(emission *e)
{
    for (int kind = 0; kind < RT_PHOTON_KINDS; kind++)
        rt_photon_map_settle(e->map, (rt_photon_kind)kind);
    const double began = rt_clock();
    rt_profile *const profile = e->renderer->device->profile;
    rt_profile_begin(profile, "checkpoint");
    e->how->checkpoint(e->how->checkpoint_user, e->map);
    rt_profile_end(profile);
    e->saved = rt_clock();
    e->saving = e->saved - began;
}

static void save_when_due(void *user)
{
    emission *e = user;
    if (rt_clock() - e->saved >= rt_checkpoint_interval(e->how->checkpoint_seconds, e->saving))
        save(e);
}

/* The paths of a map. */
static double count_paths(const rt_photon_map *map)
{
    return (double)map->lists[RT_PHOTONS_GLOBAL].emitted +
           (double)map->lists[RT_PHOTONS_CAUSTIC].emitted;
}

/* ---- Emission --------------------------------------------------------------- */

/* The paths of this part, of so many. */
static rt_path_range paths_of_part(const emission *e, uint64_t paths)
{
    const uint64_t parts = e->how->parts ? e->how->parts : 1, part = e->how->part;
    /* part * paths / parts, without overflow. */
    const uint64_t first = paths / parts * part + paths % parts * part / parts,
                   end = paths / parts * (part + 1) + paths % parts * (part + 1) / parts;
    return (rt_path_range){.first = first, .count = end - first, .seed = e->options.seed};
}

/* How many of them the map lacks. */
static double count_lacking(const emission *e, rt_photon_kind kind, uint64_t paths)
{
    const rt_path_range all = paths_of_part(e, paths);
    const uint64_t end = all.first + all.count;
    double count = 0;
    for (uint64_t at = all.first; at < end;) {
        const rt_path_range gap = rt_path_ranges_gap(e->map->ranges + kind, at, end);
        if (gap.count == 0)
            break;
        count += (double)gap.count;
        at = gap.first + gap.count;
    }
    return count;
}

/* Emits what this part of `paths` paths lacks into one of the map's lists. */
static rt_status emit_part(emission *e, rt_photon_kind kind, uint64_t paths,
                           rt_stage_progress *progress, rt_error *error)
{
    const rt_path_range all = paths_of_part(e, paths);
    const uint64_t first = all.first, end = all.first + all.count;
    rt_status status = RT_OK;
    for (uint64_t at = first; status == RT_OK;) {
        const rt_path_range gap = rt_path_ranges_gap(e->map->ranges + kind, at, end);
        if (gap.count == 0)
            break;
        at = gap.first + gap.count;
        const double part = (1 - progress->origin) * (double)gap.count / e->lacking;
        rt_stage_part(progress, progress->to, fmin(progress->to + part, 1));
        status = rt_emitter_emit(e->emitter, e->map, kind, e->options.seed, gap.first, gap.count,
                                 progress, error);
        rt_photon_map_settle(e->map, kind);
        if (kind == RT_PHOTONS_GLOBAL)
            rt_photon_map_settle(e->map, RT_PHOTONS_VOLUME);
    }
    return status;
}

/* Emits both kinds. On RT_CANCELLED the map holds the paths so far. */
static rt_status emit_kinds(emission *e, rt_error *error)
{
    const rt_render_options *o = &e->options;
    rt_stage_progress progress;
    rt_status status = rt_stage_begin(&progress, o->hooks, RT_STAGE_EMIT);
    const double all = (double)paths_of_part(e, o->photons).count +
                       (double)paths_of_part(e, o->caustic_photons).count;
    e->lacking = count_lacking(e, RT_PHOTONS_GLOBAL, o->photons) +
                 count_lacking(e, RT_PHOTONS_CAUSTIC, o->caustic_photons);
    progress.origin = all > 0 ? 1 - e->lacking / all : 0;
    rt_stage_part(&progress, progress.origin, progress.origin);
    if (status == RT_OK)
        status = emit_part(e, RT_PHOTONS_GLOBAL, o->photons, &progress, error);
    if (status == RT_OK && o->caustic_photons > 0)
        status = emit_part(e, RT_PHOTONS_CAUSTIC, o->caustic_photons, &progress, error);
    if (status != RT_OK)
        return status;
    if (!e->renderer->has_light)
        rt_warn(o->hooks, "the scene has no light: its photon map is empty");
    rt_emitter_warn_reach(e->emitter, o->hooks);
    rt_photon_map_warn_starved(e->map, &e->map->ledger, 0, o->k, o->caustic_k, o->hooks);
    return rt_stage_end(&progress, NULL);
}

/* Makes an empty map for the scene and the settings, or one with what there is already. */
static rt_status begin(emission *e, rt_error *error)
{
    const rt_render_options *o = &e->options;
    e->map->settings = rt_photon_settings_of(o, e->renderer->has_media);
    rt_device *device = e->renderer->device;
    rt_profile_begin(device->profile, "fingerprint");
    rt_status status =
        rt_scene_fingerprint(&e->map->settings.scene, device, e->renderer->scene, error);
    rt_profile_end(device->profile);
    if (status == RT_OK)
        status = rt_emitter_create(&e->emitter, device, e->kernel, e->renderer->scene,
                                   o->light_shares, o->light_share_count, error);
    if (status == RT_OK)
        status = rt_emitter_make_ledger(e->emitter, &e->map->ledger, error);
    if (status == RT_OK && e->how->resume)
        status = rt_photon_map_continue(e->map, e->how->resume, o, error);
    return status;
}

static rt_status emit(emission *e, rt_error *error)
{
    rt_status status = begin(e, error);
    if (status != RT_OK)
        return status;
    e->saved = rt_clock();
    if (e->how->checkpoint)
        rt_emitter_after_batch(e->emitter, save_when_due, e);
    rt_profile *const profile = e->renderer->device->profile;
    rt_profile_begin(profile, "emit");
    status = emit_kinds(e, error);
    rt_profile_end(profile);
    if (e->how->checkpoint &&
        (status == RT_OK || (status == RT_CANCELLED && count_paths(e->map) > 0)))
        save(e);
    return status;
}

static rt_status check_parts(const rt_emit_options *how, rt_error *error)
{
    uint32_t parts = how->parts ? how->parts : 1;
    if (how->part >= parts)
        return rt_fail_field(error, RT_ERROR_USAGE, "part",
                             "part %u of %u, counted from 0, does not exist", how->part, parts);
    return RT_OK;
}

/* Completes the options, makes an empty map and compiles. */
static rt_status prepare(emission *e, rt_error *error)
{
    e->options = e->how->render ? *e->how->render : e->renderer->options;
    rt_status status = rt_options_check(&e->options, error);
    if (status == RT_OK)
        status = check_parts(e->how, error);
    if (status != RT_OK)
        return status;
    e->options.passes = 1;
    rt_options_complete(&e->options);
    e->map = calloc(1, sizeof *e->map);
    if (!e->map)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for a photon map");
    rt_photon_map_set_memory(e->map, e->renderer->device->memory);
    return compile(e, error);
}

static void release(emission *e)
{
    rt_photon_map_destroy(e->map);
    rt_emitter_destroy(e->emitter);
    rt_kernel_release(e->kernel);
}

static const rt_emit_options defaults;

rt_status rt_photon_map_emit(rt_photon_map **out, rt_renderer *renderer,
                             const rt_emit_options *options, rt_error *error)
{
    if (rt_is_missing(renderer, "renderer", error))
        return RT_ERROR_USAGE;
    emission e = {.renderer = renderer, .how = options ? options : &defaults};
    rt_status status = prepare(&e, error);
    if (status == RT_OK)
        status = emit(&e, error);
    rt_events_book(renderer->device);
    if (status == RT_OK) {
        *out = e.map;
        e.map = NULL;
    }
    release(&e);
    return status == RT_CANCELLED ? rt_fail(error, RT_CANCELLED, "cancelled") : status;
}

rt_status rt_photon_map_emit_covers(rt_renderer *renderer, const rt_emit_options *options,
                                    const rt_photon_map *other, rt_error *error)
{
    if (rt_is_missing(renderer, "renderer", error) || rt_is_missing(other, "other", error))
        return RT_ERROR_USAGE;
    rt_emit_options how = options ? *options : defaults;
    how.resume = NULL;
    emission e = {.renderer = renderer, .how = &how};
    rt_status status = prepare(&e, error);
    if (status == RT_OK)
        status = begin(&e, error);
    /* The paths without their photons. */
    const uint64_t paths[RT_PHOTON_KINDS] = {e.options.photons, e.options.caustic_photons,
                                             renderer->has_media ? e.options.photons : 0};
    for (int kind = 0; kind < RT_PHOTON_KINDS && status == RT_OK; kind++) {
        const rt_path_range range = paths_of_part(&e, paths[kind]);
        status = rt_path_ranges_add(e.map->ranges + kind, &range, error);
    }
    if (status == RT_OK)
        status = rt_photon_map_covers(e.map, other, error);
    release(&e);
    return status == RT_CANCELLED ? rt_fail(error, RT_CANCELLED, "cancelled") : status;
}
