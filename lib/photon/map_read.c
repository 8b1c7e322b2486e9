/*
 * map_read.c - a photon map from a file; map_file.h describes the bytes.
 *
 * Nothing in a file is trusted: sizes are checked against its length before memory is allocated,
 * and what passes the checksum is still checked number by number, because other programs write such
 * files too.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/file.h"
#include "photon/ledger_file.h"
#include "photon/map_file.h"
#include "rt/setting.h"
#include "scene/check.h"

/* A file being read; enough is known to be left for what is read next. */
typedef struct reader {
    rt_reader at;
    const char *name;
    rt_error *error;
} reader;

/* ---- The header ------------------------------------------------------------- */

/* What the header says besides the settings. */
typedef struct counts {
    uint64_t lights, photons[RT_PHOTON_KINDS], ranges[RT_PHOTON_KINDS];
} counts;

static rt_status file_size(uint64_t *out, const uint8_t *start, size_t size, const char *name,
                           rt_error *error)
{
    return rt_frame_size(out, &rt_map_frame, start, size, name, error);
}

static rt_status fail_content(const reader *r, const char *what)
{
    return rt_fail(r->error, RT_ERROR_INPUT, "%.350s: the photon map is damaged: %s", r->name,
                   what);
}

static int is_empty(const rt_photon_map *map, const counts *n, rt_photon_kind kind)
{
    const rt_photon_list *list = map->lists + kind;
    return !n->photons[kind] && !n->ranges[kind] && !list->emitted && !list->rejected;
}

static rt_status read_header(reader *r, rt_photon_map *map, counts *n)
{
    int zero = 1;
    r->at.at += RT_FRAME_START;
    map->settings.scene = rt_get64(&r->at);
    map->settings.max_depth = rt_get32(&r->at);
    map->settings.sampler = rt_get32(&r->at);
    map->settings.direct = rt_get32(&r->at);
    map->settings.split = rt_get32(&r->at);
    map->settings.media = rt_get32(&r->at);
    rt_get_floats(&r->at, &map->settings.gather_roughness, 1);
    n->lights = rt_get64(&r->at);
    map->ledger.paths = rt_get64(&r->at);
    map->ledger.rejected = rt_get64(&r->at);
    for (int kind = 0; kind < RT_PHOTON_KINDS; kind++) {
        map->lists[kind].emitted = rt_get64(&r->at);
        map->lists[kind].rejected = rt_get64(&r->at);
        n->photons[kind] = rt_get64(&r->at);
        n->ranges[kind] = rt_get64(&r->at);
        zero = rt_get64(&r->at) == 0 && zero;
    }
    if (map->settings.max_depth == 0 || map->settings.sampler > RT_SAMPLER_INDEPENDENT ||
        map->settings.direct > RT_DIRECT_PHOTONS || map->settings.split > 1 ||
        map->settings.media > 1 || signbit(map->settings.gather_roughness) ||
        !rt_range_holds(rt_setting_find("gather_roughness")->field.range,
                        (double)map->settings.gather_roughness))
        return fail_content(r, "its settings are out of range");
    if (!zero)
        return fail_content(r, "its header is not zero where it must be");
    if (!map->settings.split && !is_empty(map, n, RT_PHOTONS_CAUSTIC))
        return fail_content(r, "it has caustic photons where it keeps none apart");
    if (!map->settings.media && !is_empty(map, n, RT_PHOTONS_VOLUME))
        return fail_content(r, "it has volume photons of a scene without media");
    if (map->settings.media &&
        map->lists[RT_PHOTONS_VOLUME].emitted != map->lists[RT_PHOTONS_GLOBAL].emitted)
        return fail_content(r, "its volume photons are not of the paths of the global ones");
    return RT_OK;
}

/* Subtracts `count` entries of a size from the bytes left; 0 when there are too few. */
static int take(uint64_t *left, uint64_t count, uint64_t size)
{
    if (count > *left / size)
        return 0;
    *left -= count * size;
    return 1;
}

static rt_status check_counts(const reader *r, const counts *n, size_t file_size)
{
    uint64_t left = file_size - RT_MAP_HEADER - RT_FRAME_CHECKSUM;
    int fits = take(&left, n->lights, RT_MAP_LIGHT);
    for (int kind = 0; kind < RT_PHOTON_KINDS; kind++)
        fits = fits && take(&left, n->ranges[kind], RT_MAP_RANGE) &&
               take(&left, n->photons[kind], RT_MAP_PHOTON);
    return fits && left == 0 ? RT_OK : fail_content(r, "its counts do not fit its size");
}

/* ---- The tables --------------------------------------------------------------- */

static rt_status read_lights(reader *r, rt_ledger *ledger, size_t count, rt_memory *memory)
{
    uint64_t paths = 0;
    ledger->rows =
        rt_memory_zeroed(memory, count, sizeof *ledger->rows, "the energy ledger", r->error);
    if (!ledger->rows)
        return RT_ERROR_MEMORY;
    ledger->count = count;
    for (size_t i = 0; i < count; i++) {
        if (!rt_ledger_get(&r->at, ledger->rows + i))
            return fail_content(r, "a light in its ledger is out of range");
        if (ledger->rows[i].paths > ledger->paths - paths)
            return fail_content(r, "its lights have more paths than it");
        paths += ledger->rows[i].paths;
    }
    return RT_OK;
}

/* Ranges must be in ascending order, apart, and add up to the photons and paths of their list. */
static rt_status read_ranges(reader *r, rt_photon_map *map, int kind, size_t count,
                             uint64_t photon_count)
{
    static const uint64_t indices = (uint64_t)UINT32_MAX + 1;
    rt_path_ranges *ranges = map->ranges + kind;
    uint64_t paths = 0, photons = 0;

    for (size_t i = 0; i < count; i++) {
        rt_path_range range;
        range.first = rt_get64(&r->at);
        range.count = rt_get64(&r->at);
        range.photons = rt_get64(&r->at);
        range.seed = rt_get32(&r->at);
        const rt_path_range *last = ranges->count ? ranges->ranges + ranges->count - 1 : NULL;
        if (rt_get32(&r->at) != 0 || range.count == 0 || range.count > indices ||
            range.first > indices - range.count || range.photons > photon_count - photons)
            return fail_content(r, "a range of its paths is out of range");
        if (last && (range.seed < last->seed ||
                     (range.seed == last->seed && range.first <= last->first + last->count)))
            return fail_content(r, "the ranges of its paths are not in order");
        rt_status status = rt_path_ranges_add(ranges, &range, r->error);
        if (status != RT_OK)
            return status;
        paths += range.count;
        photons += range.photons;
    }
    if (paths != map->lists[kind].emitted || photons != photon_count)
        return fail_content(r, "the ranges of its paths do not add up");
    return RT_OK;
}

static rt_status read_photon(reader *r, rt_photon *p, int kind)
{
    rt_get_floats(&r->at, p->position, 3);
    p->path = rt_get32(&r->at);
    rt_get_floats(&r->at, p->wi, 3);
    p->flags = rt_get32(&r->at);
    rt_get_floats(&r->at, p->flux, 3);
    rt_get_floats(&r->at, &p->shading, 1);
    rt_get_floats(&r->at, p->normal, 3);
    p->shape = rt_get32(&r->at);
    if (!rt_photon_is_finite(p))
        return fail_content(r, "a photon is not finite");
    for (int c = 0; c < 3; c++)
        if (fabsf(p->position[c]) > RT_COORDINATE_MAX)
            return fail_content(r, "a photon lies farther out than coordinates go");
    if (!rt_is_unit(p->wi) || !rt_is_unit(p->normal))
        return fail_content(r, "a direction of a photon is not of unit length");
    if (p->flux[0] < 0 || p->flux[1] < 0 || p->flux[2] < 0 || p->shading < 0)
        return fail_content(r, "a photon has negative flux");
    if ((p->flags & 0xfcu) || !(p->flags & RT_PHOTON_VOLUME) != (kind != RT_PHOTONS_VOLUME))
        return fail_content(r, "a photon has unknown flags");
    return RT_OK;
}

/* Photons must be of the paths of their range, in order. */
static rt_status read_photons(reader *r, rt_photon_map *map, int kind, size_t count)
{
    rt_photon_list *list = map->lists + kind;
    const rt_path_ranges *ranges = map->ranges + kind;
    rt_status status = rt_photon_list_reserve(list, count, r->error);
    for (size_t i = 0; i < ranges->count && status == RT_OK; i++) {
        const rt_path_range *range = ranges->ranges + i;
        uint64_t path = range->first;
        for (uint64_t j = 0; j < range->photons && status == RT_OK; j++) {
            rt_photon *photon = list->photons + list->count++;
            status = read_photon(r, photon, kind);
            if (status == RT_OK &&
                (photon->path < path || photon->path >= range->first + range->count))
                status = fail_content(r, "a photon is not of the paths it lies among");
            path = photon->path;
        }
    }
    return status;
}

rt_status rt_photon_map_decode(rt_photon_map **out, const void *data, size_t size,
                               rt_memory *memory, rt_error *error)
{
    if (rt_is_missing(data, "data", error))
        return RT_ERROR_USAGE;
    return rt_photon_map_decode_in(out, data, size, "the buffer", memory, error);
}

rt_status rt_photon_map_decode_in(rt_photon_map **out, const uint8_t *data, size_t size,
                                  const char *name, rt_memory *memory, rt_error *error)
{
    reader r = {{data}, name, error};
    counts n = {0};
    rt_status status = rt_frame_check(&rt_map_frame, data, size, name, error);
    if (status != RT_OK)
        return status;
    rt_photon_map *map = calloc(1, sizeof *map);
    if (!map)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for a photon map");
    rt_photon_map_set_memory(map, memory);
    status = read_header(&r, map, &n);
    if (status == RT_OK)
        status = check_counts(&r, &n, size);
    if (status == RT_OK)
        status = read_lights(&r, &map->ledger, (size_t)n.lights, memory);
    for (int kind = 0; kind < RT_PHOTON_KINDS && status == RT_OK; kind++)
        status = read_ranges(&r, map, kind, (size_t)n.ranges[kind], n.photons[kind]);
    for (int kind = 0; kind < RT_PHOTON_KINDS && status == RT_OK; kind++)
        status = read_photons(&r, map, kind, (size_t)n.photons[kind]);
    if (status == RT_OK && map->ledger.paths != map->lists[RT_PHOTONS_GLOBAL].emitted)
        status = fail_content(&r, "its ledger is not of its paths");
    if (status == RT_OK) {
        snprintf(map->name, sizeof map->name, "%s", name);
        *out = map;
    } else {
        rt_photon_map_destroy(map);
    }
    return status;
}

rt_status rt_photon_map_load(rt_photon_map **out, const char *path, rt_error *error)
{
    return rt_photon_map_load_in(out, path, NULL, error);
}

rt_status rt_photon_map_load_in(rt_photon_map **out, const char *path, rt_memory *memory,
                                rt_error *error)
{
    rt_bytes bytes = {.memory = memory};
    rt_status status = rt_file_read_sized(&bytes, path, RT_MAP_HEADER, file_size, 0, error);
    if (status == RT_OK)
        status = rt_photon_map_decode_in(out, bytes.data, bytes.size, path, memory, error);
    rt_bytes_free(&bytes);
    return rt_at_file(status, path, error);
}
