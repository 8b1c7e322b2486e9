/* photon_pass.c - one pass of photon mapping: photons are emitted, and eye paths ask for them. */
#include "render/photon_render.h"
#include "render/replicates.h"

static const rt_photon_list *list_of(const rt_photon_render *r, rt_photon_kind kind)
{
    return r->in_use->lists + kind;
}

uint32_t rt_photon_render_replicates(const rt_photon_render *r)
{
    return r->film->noise ? RT_REPLICATES : 1;
}

/*
 * Fills the map with the photons of a pass: the next paths of the seed, and when its indices are
 * used up, of another. Where the error is to be known, passes take turns at replicates, each with
 * seeds of its own.
 */
static rt_status emit_kind(rt_photon_render *r, rt_photon_kind kind, uint64_t count, uint32_t pass,
                           rt_stage_progress *progress, rt_error *error)
{
    uint64_t passes_a_seed = (UINT64_C(1) << 32) / count;
    uint32_t replicates = rt_photon_render_replicates(r), turn = pass / replicates;
    uint32_t seeds_before = (uint32_t)(turn / passes_a_seed) * replicates + pass % replicates;
    uint32_t seed = r->options->seed + seeds_before * 0x9e3779b9u;
    return rt_emitter_emit(r->emitter, &r->map, kind, seed, turn % passes_a_seed * count, count,
                           progress, error);
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

rt_status rt_photon_render_emit(rt_photon_render *r, uint32_t pass, rt_stage_progress *progress,
                                rt_error *error)
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

const rt_photon_list *rt_photon_render_list(const rt_photon_render *r, rt_photon_way way)
{
    int split = r->in_use->settings.split != 0;
    switch (way) {
    case RT_WAY_GLOBAL:
        return list_of(r, RT_PHOTONS_GLOBAL);
    case RT_WAY_CAUSTIC:
        return split ? list_of(r, RT_PHOTONS_CAUSTIC) : NULL;
    default:
        if (r->options->final_gather == 0)
            return NULL;
        return split ? list_of(r, RT_PHOTONS_CAUSTIC) : &r->caustics;
    }
}

rt_status rt_photon_render_open(rt_photon_render *r, rt_photon_way way,
                                const rt_gather_options *how, rt_error *error)
{
    return rt_gatherer_create(r->gatherers + way, r->renderer->device, r->eye_kernels.gather,
                              rt_photon_render_list(r, way), how, error);
}

rt_status rt_photon_render_open_finer(rt_photon_render *r, rt_photon_way way,
                                      const rt_gather_options *how, rt_error *error)
{
    rt_finer *finer = r->finer + way;
    rt_gather_options narrow;
    if (!r->options->photon_layers || !rt_photon_bias_finer(&narrow, &finer->factor, how))
        return RT_OK;
    return rt_gatherer_create(&finer->gatherer, r->renderer->device, r->eye_kernels.gather,
                              rt_photon_render_list(r, way), &narrow, error);
}

void rt_photon_render_close(rt_photon_render *r)
{
    for (rt_photon_way way = 0; way < RT_PHOTON_WAYS; way++) {
        rt_gatherer_destroy(r->gatherers[way]);
        r->gatherers[way] = NULL;
        rt_gatherer_destroy(r->finer[way].gatherer);
        r->finer[way].gatherer = NULL;
    }
}

double rt_photon_render_elapsed(const rt_photon_render *r)
{
    double time = r->options->time, part = time > 0 ? (rt_clock() - r->began) / time : 0;
    return part < 1 ? part : 1;
}

rt_status rt_photon_render_sample(rt_photon_render *r, uint32_t first, rt_stage_progress *progress,
                                  rt_error *error)
{
    rt_eye_maps maps = {r->gatherers[RT_WAY_GLOBAL], r->gatherers[RT_WAY_CAUSTIC],
                        r->gatherers[RT_WAY_ON_THE_WAY]};
    rt_finer_maps finer = {r->finer[RT_WAY_GLOBAL], r->finer[RT_WAY_CAUSTIC],
                           r->finer[RT_WAY_ON_THE_WAY]};
    double from = progress->from, span = progress->to - progress->from;
    uint32_t spp = r->options->spp;
    rt_status status = RT_OK;

    for (uint32_t i = 0; i < spp && status == RT_OK; i++) {
        double by_samples = from + span * i / spp, by_time = rt_photon_render_elapsed(r);
        if (!r->in_passes && by_time > by_samples)
            rt_stage_part(progress, by_time, by_time);
        else
            rt_stage_part(progress, by_samples, from + span * (i + 1) / spp);
        status = rt_photon_eye_sample(&r->eye, &maps, &finer, first + i, &r->film->stats, progress,
                                      error);
        if (rt_photon_render_elapsed(r) >= 1)
            break;
    }
    return status;
}
