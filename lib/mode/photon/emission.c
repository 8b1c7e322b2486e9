/* emission.c - emits the photons of one pass: the next paths of the seed. */
#include "mode/photon/emission.h"

/*
 * Fills a list of the map with the photons of a pass: the next paths of the seed, and when its
 * indices are used up, of another. Where the error is estimated, passes take turns at replicates,
 * each with seeds of its own.
 */
static rt_status emit_kind(rt_photon_render *r, rt_photon_kind kind, uint64_t count, uint32_t pass,
                           rt_stage_progress *progress, rt_error *error)
{
    uint64_t passes_a_seed = (UINT64_C(1) << 32) / count;
    uint32_t replicates = rt_photon_render_replicates(r), turn = pass / replicates;
    uint32_t seeds_before = (uint32_t)(turn / passes_a_seed) * replicates + pass % replicates;
    uint32_t seed = r->job->options->seed + seeds_before * 0x9e3779b9u;
    return rt_emitter_emit(r->emitter, &r->map, kind, seed, turn % passes_a_seed * count, count,
                           progress, error);
}

/* Copies the caustic photons of a list that holds all kinds. */
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

rt_status rt_photon_render_emit(rt_photon_render *r, uint32_t pass, rt_stage_progress *progress,
                                rt_error *error)
{
    const rt_render_options *o = r->job->options;
    rt_profile *const profile = r->job->renderer->device->profile;
    rt_status status = RT_OK;

    rt_profile_begin(profile, "emit");
    if (r->in_use == &r->map) {
        rt_photon_map_reset(&r->map);
        status = emit_kind(r, RT_PHOTONS_GLOBAL, o->photons, pass, progress, error);
        if (status == RT_OK && r->map.settings.split)
            status = emit_kind(r, RT_PHOTONS_CAUSTIC, o->caustic_photons, pass, progress, error);
    }
    if (status == RT_OK && o->final_gather > 0 && !r->in_use->settings.split)
        status = copy_caustics(&r->caustics, r->in_use->lists + RT_PHOTONS_GLOBAL, error);
    rt_profile_end(profile);
    return status;
}

rt_status rt_photon_render_book(const rt_photon_render *r, rt_error *error)
{
    const rt_photon_list *lists = r->in_use->lists;
    rt_film *film = r->job->film;
    for (int kind = 0; kind < RT_PHOTON_KINDS; kind++) {
        /* The paths of volume photons are those of the global ones. */
        film->stats.photons_emitted += kind == RT_PHOTONS_VOLUME ? 0 : lists[kind].emitted;
        film->stats.photons_stored += lists[kind].count;
        film->stats.photons_rejected += lists[kind].rejected;
    }
    return rt_ledger_add(&film->ledger, &r->in_use->ledger, error);
}
