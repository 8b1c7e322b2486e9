/* map_write.c - a photon map to a file; map_file.h describes the bytes. */
#include <stdlib.h>
#include <string.h>

#include "base/checksum.h"
#include "base/error.h"
#include "base/file.h"
#include "photon/ledger_file.h"
#include "photon/map_file.h"

const rt_frame rt_map_frame = {{0x89, 'R', 'T', 'P', '\r', '\n', 0x1a, '\n'},
                               RT_MAP_VERSION,
                               RT_MAP_HEADER,
                               "photon map",
                               "emit it anew"};

static void put_header(rt_writer *w, const rt_photon_map *map, size_t file_size)
{
    rt_frame_put(w, &rt_map_frame, file_size);
    rt_put64(w, map->settings.scene);
    rt_put32(w, map->settings.max_depth);
    rt_put32(w, map->settings.sampler);
    rt_put32(w, map->settings.direct);
    rt_put32(w, map->settings.split);
    rt_put32(w, map->settings.media);
    rt_put_floats(w, &map->settings.gather_roughness, 1);
    rt_put64(w, map->ledger.count);
    rt_put64(w, map->ledger.paths);
    rt_put64(w, map->ledger.rejected);
    for (int kind = 0; kind < RT_PHOTON_KINDS; kind++) {
        rt_put64(w, map->lists[kind].emitted);
        rt_put64(w, map->lists[kind].rejected);
        rt_put64(w, map->lists[kind].count);
        rt_put64(w, map->ranges[kind].count);
        rt_put64(w, 0);
    }
}

static void put_range(rt_writer *w, const rt_path_range *range)
{
    rt_put64(w, range->first);
    rt_put64(w, range->count);
    rt_put64(w, range->photons);
    rt_put32(w, range->seed);
    rt_put32(w, 0);
}

static void put_photon(rt_writer *w, const rt_photon *p)
{
    rt_put_floats(w, p->position, 3);
    rt_put32(w, p->path);
    rt_put_floats(w, p->wi, 3);
    rt_put32(w, p->flags);
    rt_put_floats(w, p->flux, 3);
    rt_put_floats(w, &p->shading, 1);
    rt_put_floats(w, p->normal, 3);
    rt_put32(w, p->shape);
}

static size_t file_size_of(const rt_photon_map *map)
{
    size_t size = RT_MAP_HEADER + RT_MAP_LIGHT * map->ledger.count + RT_FRAME_CHECKSUM;
    for (int kind = 0; kind < RT_PHOTON_KINDS; kind++)
        size += RT_MAP_RANGE * map->ranges[kind].count + RT_MAP_PHOTON * map->lists[kind].count;
    return size;
}

rt_status rt_photon_map_encode_in(rt_bytes *out, const rt_photon_map *map, rt_error *error)
{
    rt_memory *memory = map->lists[RT_PHOTONS_GLOBAL].memory;
    size_t size = file_size_of(map);
    rt_status status = rt_memory_foresee(memory, (double)size, "the file of the photon map", error);
    if (status == RT_OK)
        status = rt_memory_take(memory, size, rt_bytes_owner, error);
    if (status != RT_OK)
        return status;
    uint8_t *data = malloc(size);
    rt_writer w = {data};
    if (!data) {
        rt_memory_give(memory, size, rt_bytes_owner);
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory: %zu bytes for a file", size);
    }
    put_header(&w, map, size);
    for (size_t i = 0; i < map->ledger.count; i++)
        rt_ledger_put(&w, map->ledger.rows + i);
    for (int kind = 0; kind < RT_PHOTON_KINDS; kind++)
        for (size_t i = 0; i < map->ranges[kind].count; i++)
            put_range(&w, map->ranges[kind].ranges + i);
    for (int kind = 0; kind < RT_PHOTON_KINDS; kind++)
        for (size_t i = 0; i < map->lists[kind].count; i++)
            put_photon(&w, map->lists[kind].photons + i);
    rt_put64(&w, rt_checksum_of(data, size - RT_FRAME_CHECKSUM));
    *out = (rt_bytes){data, size, size, memory};
    return RT_OK;
}

rt_status rt_photon_map_encode(const rt_photon_map *map, void *buffer, size_t capacity,
                               size_t *size, rt_error *error)
{
    rt_bytes bytes = {0};
    if (rt_is_missing(map, "map", error))
        return RT_ERROR_USAGE;
    *size = file_size_of(map);
    if (!buffer)
        return RT_OK;
    if (*size > capacity)
        return rt_fail(error, RT_ERROR_USAGE,
                       "the photon map takes %zu bytes, and the buffer has %zu", *size, capacity);
    rt_status status = rt_photon_map_encode_in(&bytes, map, error);
    if (status == RT_OK)
        memcpy(buffer, bytes.data, bytes.size);
    rt_bytes_free(&bytes);
    return status;
}

rt_status rt_photon_map_save(const rt_photon_map *map, const char *path, rt_error *error)
{
    if (rt_is_missing(map, "map", error))
        return RT_ERROR_USAGE;
    rt_bytes bytes = {0};
    rt_status status = rt_photon_map_encode_in(&bytes, map, error);
    if (status == RT_OK)
        status = rt_file_replace(path, &bytes, error);
    rt_bytes_free(&bytes);
    return status;
}
