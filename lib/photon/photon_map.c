/* photon_map.c - photon maps: settings, ranges of paths, and access to photons. */
#include "photon/photon_map.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"

rt_photon_settings rt_photon_settings_of(const rt_render_options *o)
{
    rt_sampler sampler = o->area == RT_AREA_HULL ? RT_SAMPLER_INDEPENDENT : o->sampler;
    return (rt_photon_settings){0, o->max_depth, sampler, o->direct, o->caustic_photons > 0};
}

rt_status rt_path_ranges_add(rt_path_ranges *r, const rt_path_range *range, rt_error *error)
{
    rt_path_range *last = r->count ? r->ranges + r->count - 1 : NULL;
    if (range->count == 0)
        return RT_OK;
    if (last && last->seed == range->seed && last->first + last->count == range->first) {
        last->count += range->count;
        last->photons += range->photons;
        return RT_OK;
    }
    if (r->count == r->capacity) {
        size_t capacity = r->capacity ? 2 * r->capacity : 4;
        rt_path_range *grown = realloc(r->ranges, capacity * sizeof *grown);
        if (!grown)
            return rt_fail(error, RT_ERROR_MEMORY, "no memory for %zu ranges of photon paths",
                           capacity);
        r->ranges = grown;
        r->capacity = capacity;
    }
    r->ranges[r->count++] = *range;
    return RT_OK;
}

void rt_photon_map_reset(rt_photon_map *map)
{
    for (int kind = 0; kind < RT_PHOTON_KINDS; kind++) {
        rt_photon_list_reset(map->lists + kind);
        map->ranges[kind].count = 0;
    }
    rt_ledger_reset(&map->ledger);
}

void rt_photon_map_set_memory(rt_photon_map *map, rt_memory *memory)
{
    for (int kind = 0; kind < RT_PHOTON_KINDS; kind++)
        map->lists[kind].memory = memory;
}

void rt_photon_map_free(rt_photon_map *map)
{
    for (int kind = 0; kind < RT_PHOTON_KINDS; kind++) {
        rt_photon_list_clear(map->lists + kind);
        free(map->ranges[kind].ranges);
    }
    rt_ledger_free(&map->ledger);
    memset(map, 0, sizeof *map);
}

void rt_photon_map_destroy(rt_photon_map *map)
{
    if (!map)
        return;
    rt_photon_map_free(map);
    free(map);
}

size_t rt_photon_map_count(const rt_photon_map *map, rt_photon_kind kind)
{
    return (unsigned)kind < RT_PHOTON_KINDS ? map->lists[kind].count : 0;
}

const rt_photon *rt_photon_map_photons(const rt_photon_map *map, rt_photon_kind kind)
{
    return (unsigned)kind < RT_PHOTON_KINDS ? map->lists[kind].photons : NULL;
}

const rt_path_range *rt_photon_map_ranges(const rt_photon_map *map, rt_photon_kind kind,
                                          size_t *count)
{
    *count = (unsigned)kind < RT_PHOTON_KINDS ? map->ranges[kind].count : 0;
    return *count ? map->ranges[kind].ranges : NULL;
}

void rt_photon_map_get_info(const rt_photon_map *map, rt_photon_map_info *out)
{
    memset(out, 0, sizeof *out);
    for (int kind = 0; kind < RT_PHOTON_KINDS; kind++) {
        out->paths[kind] = map->lists[kind].emitted;
        out->photons[kind] = map->lists[kind].count;
        out->rejected += map->lists[kind].rejected;
    }
    out->split = (int)map->settings.split;
    out->direct = (rt_direct)map->settings.direct;
    out->sampler = (rt_sampler)map->settings.sampler;
    out->max_depth = map->settings.max_depth;
    out->scene = map->settings.scene;
    out->lights = map->ledger.count;
}

size_t rt_photon_map_ledger(const rt_photon_map *map, rt_light_ledger *out, size_t capacity)
{
    for (size_t i = 0; i < map->ledger.count && i < capacity; i++)
        rt_ledger_read(&map->ledger, i, out + i);
    return map->ledger.count;
}
