/* map_check.c - checks a loaded map against the scene and the options of a render. */
#include "photon/map_check.h"

#include <stddef.h>

#include "base/error.h"
#include "photon/fingerprint.h"
#include "photon/map_warnings.h"

/* Whether a photon lies on a shape, or in a medium, of so many shapes or materials. */
static int lies_in_scene(const rt_photon *photon, int kind, rt_u32 shapes, rt_u32 materials)
{
    return kind == RT_PHOTONS_VOLUME ? photon->shape == RT_NONE || photon->shape < materials
                                     : photon->shape < shapes;
}

/*
 * Only a file that was tampered with can have others: the photons of a scene lie on its shapes, and
 * in the media of its materials.
 */
static rt_status check_shapes(const rt_photon_map *map, const rt_renderer *renderer,
                              rt_error *error)
{
    rt_u32 shapes, materials;
    rt_status status =
        rt_buffer_read(renderer->device, renderer->scene, offsetof(rt_scene_header, shape_count),
                       sizeof shapes, &shapes, error);
    if (status == RT_OK)
        status = rt_buffer_read(renderer->device, renderer->scene,
                                offsetof(rt_scene_header, material_count), sizeof materials,
                                &materials, error);
    for (int kind = 0; kind < RT_PHOTON_KINDS && status == RT_OK; kind++)
        for (size_t i = 0; i < map->lists[kind].count; i++)
            if (!lies_in_scene(map->lists[kind].photons + i, kind, shapes, materials))
                return rt_fail(error, RT_ERROR_INPUT,
                               "the photon map has a photon %s %u of a scene of %u %s",
                               kind == RT_PHOTONS_VOLUME ? "in material" : "on shape",
                               map->lists[kind].photons[i].shape,
                               kind == RT_PHOTONS_VOLUME ? materials : shapes,
                               kind == RT_PHOTONS_VOLUME ? "materials" : "shapes");
    return status;
}

/* Whether a list has the paths that a render emits for it, and no others. */
static int has_paths(const rt_path_ranges *ranges, uint64_t paths, uint32_t seed)
{
    const rt_path_range *r = ranges->ranges;
    return paths == 0 ? ranges->count == 0
                      : ranges->count == 1 && r->first == 0 && r->count == paths && r->seed == seed;
}

rt_status rt_photon_map_is_emitted(int *out, const rt_photon_map *map, const rt_renderer *renderer,
                                   const rt_render_options *o, rt_error *error)
{
    const rt_photon_settings mine = rt_photon_settings_of(o, renderer->has_media),
                             *its = &map->settings;
    rt_light_sources lights = {0};
    rt_ledger ledger = {0};

    *out = 0;
    if (its->max_depth != mine.max_depth || its->sampler != mine.sampler ||
        its->direct != mine.direct || its->gather_roughness != mine.gather_roughness ||
        its->split != mine.split || its->media != mine.media ||
        !has_paths(map->ranges + RT_PHOTONS_GLOBAL, o->photons, o->seed) ||
        !has_paths(map->ranges + RT_PHOTONS_CAUSTIC, o->caustic_photons, o->seed) ||
        !has_paths(map->ranges + RT_PHOTONS_VOLUME, mine.media ? o->photons : 0, o->seed))
        return RT_OK;
    rt_status status = rt_light_sources_read(&lights, renderer->device, renderer->scene,
                                             o->light_shares, o->light_share_count, error);
    if (status == RT_OK)
        status = rt_ledger_create(&ledger, &lights, error);
    if (status == RT_OK)
        *out = rt_ledger_matches(&ledger, &map->ledger);
    rt_ledger_free(&ledger);
    rt_light_sources_free(&lights);
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
    if (map->settings.gather_roughness != options->gather_roughness)
        return rt_fail_field(error, RT_ERROR_USAGE, "gather_roughness",
                             "the photon map was emitted with gather_roughness %g, and here it is "
                             "%g",
                             (double)map->settings.gather_roughness,
                             (double)options->gather_roughness);
    if (map->settings.max_depth != options->max_depth)
        rt_warn(options->hooks,
                "the photon map holds paths of at most %u segments, and max_depth is %u",
                map->settings.max_depth, options->max_depth);
    rt_photon_map_warn_even(map, options->area, options->hooks);
    return check_shapes(map, renderer, error);
}
