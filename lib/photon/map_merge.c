/*
 * map_merge.c - joins photon maps: their ranges of paths in ascending order, and the photons with
 * them.
 */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "photon/photon_map.h"

/* A range of one of the maps, and where its photons lie. */
typedef struct piece {
    const rt_path_range *range;
    const rt_photon *photons;
    const rt_photon_map *map;
} piece;

static int compare_pieces(const void *a, const void *b)
{
    const rt_path_range *x = ((const piece *)a)->range, *y = ((const piece *)b)->range;
    if (x->seed != y->seed)
        return x->seed < y->seed ? -1 : 1;
    return x->first < y->first ? -1 : x->first > y->first;
}

/* Says why two maps cannot be parts of one, and which they are where they come from files. */
static rt_status fail_pair(const rt_photon_map *a, const rt_photon_map *b, rt_error *error,
                           const char *format, ...)
{
    char why[256];
    va_list args;
    va_start(args, format);
    vsnprintf(why, sizeof why, format, args);
    va_end(args);
    if (a->name[0] && b->name[0])
        return rt_fail(error, RT_ERROR_INPUT, "%.120s and %.120s: %s", a->name, b->name, why);
    return rt_fail(error, RT_ERROR_INPUT, "%s", why);
}

/* Whether two maps can be parts of one. */
static rt_status check_pair(const rt_photon_map *a, const rt_photon_map *b, rt_error *error)
{
    const rt_photon_settings *x = &a->settings, *y = &b->settings;
    if (x->scene != y->scene)
        return fail_pair(a, b, error, "the photon maps are of different scenes");
    if (x->direct != y->direct)
        return fail_pair(a, b, error, "one photon map holds direct light, another does not");
    if (x->gather_roughness != y->gather_roughness)
        return fail_pair(a, b, error, "the photon maps have a gather_roughness of %g and of %g",
                         (double)x->gather_roughness, (double)y->gather_roughness);
    if (x->split != y->split)
        return fail_pair(a, b, error,
                         "one photon map keeps caustic photons apart, another does not");
    if (x->media != y->media)
        return fail_pair(a, b, error, "one photon map is of a scene with media, another is not");
    if (x->max_depth != y->max_depth)
        return fail_pair(a, b, error, "the photon maps have paths of %u and of %u segments at most",
                         x->max_depth, y->max_depth);
    if (x->sampler != y->sampler)
        return fail_pair(a, b, error, "the photon maps were made by different samplers");
    if (!rt_ledger_matches(&a->ledger, &b->ledger))
        return fail_pair(a, b, error,
                         "the lights of the photon maps, or their shares, are different");
    return RT_OK;
}

/* The pieces of all maps in ascending order; the caller frees *out. */
static rt_status list_pieces(piece **out, size_t *piece_count, const rt_photon_map *const *maps,
                             size_t count, int kind, rt_error *error)
{
    size_t n = 0;
    for (size_t i = 0; i < count; i++)
        n += maps[i]->ranges[kind].count;
    piece *pieces = malloc((n ? n : 1) * sizeof *pieces);
    if (!pieces)
        return rt_fail(error, RT_ERROR_MEMORY, "no memory for %zu ranges of photon paths", n);
    n = 0;
    for (size_t i = 0; i < count; i++) {
        const rt_photon *photons = maps[i]->lists[kind].photons;
        for (size_t j = 0; j < maps[i]->ranges[kind].count; j++) {
            const rt_path_range *range = maps[i]->ranges[kind].ranges + j;
            pieces[n++] = (piece){range, photons, maps[i]};
            photons = range->photons ? photons + range->photons : photons;
        }
    }
    qsort(pieces, n, sizeof *pieces, compare_pieces);
    *out = pieces;
    *piece_count = n;
    return RT_OK;
}

static rt_status check_overlap(const piece *pieces, size_t count, rt_error *error)
{
    for (size_t i = 1; i < count; i++) {
        const rt_path_range *a = pieces[i - 1].range, *b = pieces[i].range;
        uint64_t end = a->first + a->count, b_end = b->first + b->count;
        if (a->seed == b->seed && b->first < end)
            return fail_pair(pieces[i - 1].map, pieces[i].map, error,
                             "the photon maps hold the same paths, %llu to %llu of seed %u; a "
                             "different seed or part makes others",
                             (unsigned long long)b->first,
                             (unsigned long long)(end < b_end ? end : b_end) - 1, b->seed);
    }
    return RT_OK;
}

/* Makes one list of the same kind of all maps. */
static rt_status merge_lists(rt_photon_map *out, const rt_photon_map *const *maps, size_t count,
                             int kind, rt_error *error)
{
    rt_photon_list *list = out->lists + kind;
    piece *pieces = NULL;
    size_t piece_count = 0, photons = 0;

    rt_status status = list_pieces(&pieces, &piece_count, maps, count, kind, error);
    if (status == RT_OK)
        status = check_overlap(pieces, piece_count, error);
    for (size_t i = 0; i < count && status == RT_OK; i++) {
        list->emitted += maps[i]->lists[kind].emitted;
        list->rejected += maps[i]->lists[kind].rejected;
        photons += maps[i]->lists[kind].count;
    }
    if (status == RT_OK)
        status = rt_photon_list_reserve(list, photons, error);
    for (size_t i = 0; i < piece_count && status == RT_OK; i++) {
        const piece *p = pieces + i;
        if (p->range->photons > 0)
            memcpy(list->photons + list->count, p->photons,
                   (size_t)p->range->photons * sizeof *p->photons);
        list->count += (size_t)p->range->photons;
        status = rt_path_ranges_add(out->ranges + kind, p->range, error);
    }
    free(pieces);
    return status;
}

rt_status rt_photon_map_merge(rt_photon_map **out, const rt_photon_map *const *maps, size_t count,
                              rt_error *error)
{
    rt_status status = RT_OK;
    if (count == 0)
        return rt_fail(error, RT_ERROR_USAGE, "no photon maps to merge");
    for (size_t i = 0; i < count; i++)
        if (rt_is_missing(maps[i], "map", error))
            return RT_ERROR_USAGE;
    rt_photon_map *map = calloc(1, sizeof *map);
    if (!map)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for a photon map");
    map->settings = maps[0]->settings;
    rt_photon_map_set_memory(map, maps[0]->lists[RT_PHOTONS_GLOBAL].memory);
    for (size_t i = 1; i < count && status == RT_OK; i++)
        status = check_pair(maps[0], maps[i], error);
    for (int kind = 0; kind < RT_PHOTON_KINDS && status == RT_OK; kind++)
        status = merge_lists(map, maps, count, kind, error);
    for (size_t i = 0; i < count && status == RT_OK; i++)
        status = rt_ledger_add(&map->ledger, &maps[i]->ledger, error);
    if (status == RT_OK)
        *out = map;
    else
        rt_photon_map_destroy(map);
    return status;
}
