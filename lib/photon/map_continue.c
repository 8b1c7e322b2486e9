/*
 * map_continue.c - takes up a photon map that holds part of the paths of an emission, and tells
 * whether one holds all of another.
 */
#include "photon/map_continue.h"

#include <string.h>

#include "base/error.h"

/* The settings that the photons of a map depend on. */
static rt_render_options options_of(const rt_photon_settings *settings)
{
    return (rt_render_options){.max_depth = settings->max_depth,
                               .sampler = (rt_sampler)settings->sampler,
                               .direct = (rt_direct)settings->direct,
                               .gather_roughness = settings->gather_roughness};
}

static rt_status check_settings(const rt_photon_settings *here, const rt_photon_settings *there,
                                rt_error *error)
{
    static const char *const names[] = {"max_depth", "sampler", "direct", "gather_roughness"};
    const rt_render_options a = options_of(here), b = options_of(there);
    if (here->scene != there->scene)
        return rt_fail(error, RT_ERROR_USAGE,
                       "the photon map is of another scene, or of this one before it was changed");
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const rt_setting *setting = rt_setting_find(names[i]);
        char x[64], y[64];
        rt_setting_get(x, sizeof x, setting, &a);
        rt_setting_get(y, sizeof y, setting, &b);
        if (strcmp(x, y) != 0)
            return rt_fail_field(error, RT_ERROR_USAGE, names[i],
                                 "%s is %s here, and %s in the photon map that is there", names[i],
                                 x, y);
    }
    if (here->split != there->split)
        return rt_fail_field(error, RT_ERROR_USAGE, "caustic_photons",
                             "caustic photons are %skept apart here, and %skept apart in the "
                             "photon map that is there",
                             here->split ? "" : "not ", there->split ? "" : "not ");
    return RT_OK;
}

/* Fails where a map has paths of another seed, or more than `paths`. */
static rt_status check_paths(const rt_path_ranges *ranges, uint32_t seed, uint64_t paths,
                             const char *name, rt_error *error)
{
    for (size_t i = 0; i < ranges->count; i++) {
        const rt_path_range *range = ranges->ranges + i;
        if (range->seed != seed)
            return rt_fail_field(error, RT_ERROR_USAGE, "seed",
                                 "seed is %u here, and %u in the photon map that is there", seed,
                                 range->seed);
        if (range->first + range->count > paths)
            return rt_fail_field(error, RT_ERROR_USAGE, name,
                                 "%s is %llu here, and the photon map that is there has path %llu",
                                 name, (unsigned long long)paths,
                                 (unsigned long long)(range->first + range->count));
    }
    return RT_OK;
}

/* Copies the photons and ranges of a kind. */
static rt_status copy_kind(rt_photon_map *map, const rt_photon_map *from, int kind, rt_error *error)
{
    rt_photon_list *list = map->lists + kind;
    const rt_photon_list *source = from->lists + kind;
    rt_status status = rt_photon_list_reserve(list, source->count, error);
    if (status != RT_OK)
        return status;
    if (source->count > 0)
        memcpy(list->photons, source->photons, source->count * sizeof *list->photons);
    list->count = source->count;
    list->emitted = source->emitted;
    list->rejected = source->rejected;
    for (size_t i = 0; i < from->ranges[kind].count && status == RT_OK; i++)
        status = rt_path_ranges_add(map->ranges + kind, from->ranges[kind].ranges + i, error);
    return status;
}

rt_status rt_photon_map_continue(rt_photon_map *map, const rt_photon_map *from,
                                 const rt_render_options *options, rt_error *error)
{
    rt_status status = check_settings(&map->settings, &from->settings, error);
    if (status == RT_OK)
        status = check_paths(from->ranges + RT_PHOTONS_GLOBAL, options->seed, options->photons,
                             "photons", error);
    if (status == RT_OK)
        status = check_paths(from->ranges + RT_PHOTONS_CAUSTIC, options->seed,
                             options->caustic_photons, "caustic_photons", error);
    if (status == RT_OK && !rt_ledger_matches(&map->ledger, &from->ledger))
        status =
            rt_fail(error, RT_ERROR_USAGE, "the photon map was emitted with other light shares");
    for (int kind = 0; kind < RT_PHOTON_KINDS && status == RT_OK; kind++)
        status = copy_kind(map, from, kind, error);
    return status == RT_OK ? rt_ledger_add(&map->ledger, &from->ledger, error) : status;
}

/* Fails where ranges lack paths of others. Those that touch are one, here as there. */
static rt_status check_ranges(const rt_path_ranges *here, const rt_path_ranges *there,
                              rt_error *error)
{
    for (size_t i = 0; i < there->count; i++) {
        const rt_path_range *r = there->ranges + i;
        size_t j = 0;
        while (j < here->count &&
               !(here->ranges[j].seed == r->seed && here->ranges[j].first <= r->first &&
                 here->ranges[j].first + here->ranges[j].count >= r->first + r->count))
            j++;
        if (j == here->count)
            return rt_fail(error, RT_ERROR_USAGE, "it has paths %llu to %llu of seed %u",
                           (unsigned long long)r->first,
                           (unsigned long long)(r->first + r->count - 1), r->seed);
    }
    return RT_OK;
}

rt_status rt_photon_map_covers(const rt_photon_map *map, const rt_photon_map *other,
                               rt_error *error)
{
    if (rt_is_missing(map, "map", error) || rt_is_missing(other, "other", error))
        return RT_ERROR_USAGE;
    rt_status status = check_settings(&map->settings, &other->settings, error);
    if (status == RT_OK && !rt_ledger_matches(&map->ledger, &other->ledger))
        status =
            rt_fail(error, RT_ERROR_USAGE, "the photon map was emitted with other light shares");
    for (int kind = 0; kind < RT_PHOTON_KINDS && status == RT_OK; kind++)
        status = check_ranges(map->ranges + kind, other->ranges + kind, error);
    return status;
}

rt_path_range rt_path_ranges_gap(const rt_path_ranges *ranges, uint64_t first, uint64_t end)
{
    for (size_t i = 0; i < ranges->count && first < end; i++) {
        const rt_path_range *range = ranges->ranges + i;
        if (range->first > first)
            end = range->first < end ? range->first : end;
        else if (range->first + range->count > first)
            first = range->first + range->count;
    }
    return (rt_path_range){.first = first, .count = first < end ? end - first : 0};
}
