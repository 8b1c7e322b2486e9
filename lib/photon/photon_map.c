/* photon_map.c - photon maps: settings, ranges of paths, and access to photons. */
#include "photon/photon_map.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"

rt_photon_settings rt_photon_settings_of(const rt_render_options *o, int has_media)
{
    rt_sampler sampler = o->area == RT_AREA_HULL ? RT_SAMPLER_INDEPENDENT : o->sampler;
    return (rt_photon_settings){.max_depth = o->max_depth,
                                .sampler = sampler,
                                .direct = o->direct,
                                .split = o->caustic_photons > 0,
                                /* 0 as one number, without a sign */
                                .gather_roughness =
                                    o->gather_roughness > 0 ? o->gather_roughness : 0,
                                .media = has_media != 0};
}

/* Whether the second range begins where the first ends. */
static int touches(const rt_path_range *a, const rt_path_range *b)
{
    return a->seed == b->seed && a->first + a->count == b->first;
}

rt_status rt_path_ranges_add(rt_path_ranges *r, const rt_path_range *range, rt_error *error)
{
    rt_path_range *last = r->count ? r->ranges + r->count - 1 : NULL;
    if (range->count == 0)
        return RT_OK;
    if (last && touches(last, range)) {
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

static void reverse(rt_photon *photons, size_t count)
{
    for (size_t i = 0; i < count / 2; i++) {
        const rt_photon photon = photons[i];
        photons[i] = photons[count - 1 - i];
        photons[count - 1 - i] = photon;
    }
}

/* Lets the last `last` of so many photons change places with those before, in place. */
static void rotate(rt_photon *photons, size_t count, size_t last)
{
    reverse(photons, count - last);
    reverse(photons + (count - last), last);
    reverse(photons, count);
}

/* Joins each range with those that it touches. */
static void join(rt_path_ranges *r)
{
    size_t kept = 0;
    for (size_t i = 1; i < r->count; i++)
        if (touches(r->ranges + kept, r->ranges + i)) {
            r->ranges[kept].count += r->ranges[i].count;
            r->ranges[kept].photons += r->ranges[i].photons;
        } else {
            r->ranges[++kept] = r->ranges[i];
        }
    r->count = kept + 1;
}

void rt_photon_map_settle(rt_photon_map *map, rt_photon_kind kind)
{
    rt_path_ranges *r = map->ranges + kind;
    const rt_photon_list *list = map->lists + kind;
    if (r->count < 2)
        return;
    const rt_path_range last = r->ranges[r->count - 1];
    size_t place = r->count - 1, photons = (size_t)last.photons;
    while (place > 0 &&
           (last.seed < r->ranges[place - 1].seed ||
            (last.seed == r->ranges[place - 1].seed && last.first < r->ranges[place - 1].first)))
        photons += (size_t)r->ranges[--place].photons;
    if (place == r->count - 1)
        return;
    if (photons > 0)
        rotate(list->photons + (list->count - photons), photons, (size_t)last.photons);
    memmove(r->ranges + place + 1, r->ranges + place, (r->count - 1 - place) * sizeof last);
    r->ranges[place] = last;
    join(r);
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
        map->lists[kind].memory = rt_memory_hold(memory);
}

void rt_photon_map_free(rt_photon_map *map)
{
    for (int kind = 0; kind < RT_PHOTON_KINDS; kind++) {
        rt_photon_list_clear(map->lists + kind);
        rt_memory_drop(map->lists[kind].memory);
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
    out->media = (int)map->settings.media;
    out->direct = (rt_direct)map->settings.direct;
    out->gather_roughness = map->settings.gather_roughness;
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
