/*
 * photon_maps.c - photon maps by themselves: emitted from a renderer's scene, and checked against
 * one.
 */
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "photon/emit.h"
#include "photon/fingerprint.h"
#include "render/renderer.h"

/* An emission under way. */
typedef struct emission {
    rt_renderer *renderer;
    const rt_emit_options *how;
    rt_render_options options; /* complete */
    cl_kernel kernel;
    rt_emitter *emitter;
    rt_photon_map *map;
} emission;

rt_status rt_emit_kernel_prepare(cl_kernel *out, const rt_renderer *renderer,
                                 rt_stage_progress *progress, rt_error *error)
{
    cl_mem any = renderer->scene;
    rt_params params;
    memset(&params, 0, sizeof params);
    rt_arg args[RT_EMIT_ARGUMENTS] = {RT_ARG(params), RT_ARG(any), RT_ARG(any), RT_ARG(any),
                                      RT_ARG(any)};
    return rt_kernel_prepare(renderer->device, out, "photon_emit", "photon_emit", args,
                             RT_EMIT_ARGUMENTS, progress, error);
}

static rt_status compile(emission *e, rt_error *error)
{
    rt_stage_progress progress;
    rt_status status = rt_stage_begin(&progress, e->options.hooks, RT_STAGE_COMPILE);
    if (status == RT_OK)
        status = rt_emit_kernel_prepare(&e->kernel, e->renderer, &progress, error);
    return status == RT_OK ? rt_stage_end(&progress, NULL) : status;
}

/* Emits this part of `paths` paths into one of the map's lists. */
static rt_status emit_part(emission *e, rt_photon_kind kind, uint64_t paths,
                           rt_stage_progress *progress, rt_error *error)
{
    uint64_t parts = e->how->parts ? e->how->parts : 1, part = e->how->part;
    /* part * paths / parts, without overflow. */
    uint64_t first = paths / parts * part + paths % parts * part / parts;
    uint64_t end = paths / parts * (part + 1) + paths % parts * (part + 1) / parts;
    return rt_emitter_emit(e->emitter, e->map, kind, e->options.seed, first, end - first, progress,
                           error);
}

static rt_status emit(emission *e, rt_error *error)
{
    const rt_render_options *o = &e->options;
    rt_stage_progress progress;

    e->map->settings = rt_photon_settings_of(o);
    rt_status status = rt_scene_fingerprint(&e->map->settings.scene, e->renderer->device,
                                            e->renderer->scene, error);
    if (status == RT_OK)
        status = rt_emitter_create(&e->emitter, e->renderer->device, e->kernel, e->renderer->scene,
                                   o->light_shares, o->light_share_count, error);
    if (status == RT_OK)
        status = rt_stage_begin(&progress, o->hooks, RT_STAGE_EMIT);
    if (status == RT_OK)
        status = emit_part(e, RT_PHOTONS_GLOBAL, o->photons, &progress, error);
    if (status == RT_OK && o->caustic_photons > 0)
        status = emit_part(e, RT_PHOTONS_CAUSTIC, o->caustic_photons, &progress, error);
    if (status != RT_OK)
        return status;
    rt_emitter_warn_reach(e->emitter, o->hooks);
    rt_photon_map_warn_starved(e->map, &e->map->ledger, 0, o->k, o->caustic_k, o->hooks);
    return rt_stage_end(&progress, NULL);
}

static rt_status check_parts(const rt_emit_options *how, rt_error *error)
{
    uint32_t parts = how->parts ? how->parts : 1;
    if (how->part >= parts)
        return rt_fail_field(error, RT_ERROR_USAGE, "part",
                             "part %u of %u, counted from 0, does not exist", how->part, parts);
    return RT_OK;
}

rt_status rt_photon_map_emit(rt_photon_map **out, rt_renderer *renderer,
                             const rt_emit_options *options, rt_error *error)
{
    if (rt_is_missing(renderer, "renderer", error))
        return RT_ERROR_USAGE;
    static const rt_emit_options defaults;
    emission e = {.renderer = renderer, .how = options ? options : &defaults};

    e.options = e.how->render ? *e.how->render : renderer->options;
    rt_status status = rt_options_check(&e.options, error);
    if (status == RT_OK)
        status = check_parts(e.how, error);
    if (status != RT_OK)
        return status;
    e.options.passes = 1;
    rt_options_complete(&e.options);
    e.map = calloc(1, sizeof *e.map);
    if (!e.map)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for a photon map");
    status = compile(&e, error);
    if (status == RT_OK)
        status = emit(&e, error);
    if (status == RT_OK)
        *out = e.map;
    else
        rt_photon_map_destroy(e.map);
    rt_emitter_destroy(e.emitter);
    rt_kernel_release(e.kernel);
    return status == RT_CANCELLED ? rt_fail(error, RT_CANCELLED, "cancelled") : status;
}

/* Only a file that was tampered with can have others: the photons of a scene lie on its shapes. */
static rt_status check_shapes(const rt_photon_map *map, const rt_renderer *renderer,
                              rt_error *error)
{
    rt_u32 count;
    rt_status status =
        rt_buffer_read(renderer->device, renderer->scene, offsetof(rt_scene_header, shape_count),
                       sizeof count, &count, error);
    for (int kind = 0; kind < RT_PHOTON_KINDS && status == RT_OK; kind++)
        for (size_t i = 0; i < map->lists[kind].count; i++)
            if (map->lists[kind].photons[i].shape >= count)
                return rt_fail(error, RT_ERROR_INPUT,
                               "the photon map has a photon on shape %u of a scene of %u shapes",
                               map->lists[kind].photons[i].shape, count);
    return status;
}

rt_status rt_photon_map_check(const rt_photon_map *map, const rt_renderer *renderer,
                              const rt_render_options *options, rt_error *error)
{
    uint64_t scene;
    rt_status status = rt_scene_fingerprint(&scene, renderer->device, renderer->scene, error);
    if (status != RT_OK)
        return status;
    if (map->settings.scene != scene)
        return rt_fail(
            error, RT_ERROR_INPUT,
            "the photon map was emitted in another scene, or in this one before it was changed");
    if (map->settings.direct != options->direct)
        return rt_fail_field(error, RT_ERROR_USAGE, "direct", "the photon map %s direct light",
                             map->settings.direct == RT_DIRECT_PHOTONS ? "already holds"
                                                                       : "does not hold");
    if (map->settings.max_depth != options->max_depth)
        rt_warn(options->hooks,
                "the photon map holds paths of at most %u segments, and max_depth is %u",
                map->settings.max_depth, options->max_depth);
    rt_photon_map_warn_even(map, options->area, options->hooks);
    return check_shapes(map, renderer, error);
}
