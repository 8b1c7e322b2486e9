/* map_write.c - a photon map to a file; map_file.h describes the bytes. */
#include <stdlib.h>
#include <string.h>

#include "base/crc32.h"
#include "base/error.h"
#include "base/file.h"
#include "photon/map_file.h"

const uint8_t rt_map_magic[8] = {0x89, 'R', 'T', 'P', '\r', '\n', 0x1a, '\n'};

/* Where the next number goes; the memory is known to suffice. */
typedef struct writer {
    uint8_t *at;
} writer;

static void put32(writer *w, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        *w->at++ = (uint8_t)(value >> (8 * i));
}

static void put64(writer *w, uint64_t value)
{
    put32(w, (uint32_t)value);
    put32(w, (uint32_t)(value >> 32));
}

static void put_double(writer *w, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    put64(w, bits);
}

static void put_floats(writer *w, const float *values, int count)
{
    for (int i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, values + i, sizeof bits);
        put32(w, bits);
    }
}

static void put_header(writer *w, const rt_photon_map *map, size_t file_size)
{
    memcpy(w->at, rt_map_magic, sizeof rt_map_magic);
    w->at += sizeof rt_map_magic;
    put32(w, RT_MAP_VERSION);
    put32(w, RT_MAP_HEADER);
    put64(w, file_size);
    put64(w, map->settings.scene);
    put32(w, map->settings.max_depth);
    put32(w, map->settings.sampler);
    put32(w, map->settings.direct);
    put32(w, map->settings.split);
    put64(w, 0);
    put64(w, map->ledger.count);
    put64(w, map->ledger.paths);
    put64(w, map->ledger.rejected);
    for (int kind = 0; kind < RT_PHOTON_KINDS; kind++) {
        put64(w, map->lists[kind].emitted);
        put64(w, map->lists[kind].rejected);
        put64(w, map->lists[kind].count);
        put64(w, map->ranges[kind].count);
        put64(w, 0);
    }
}

static void put_light(writer *w, const rt_ledger_row *row)
{
    put32(w, row->shape);
    put32(w, (uint32_t)row->exponent);
    put64(w, row->paths);
    for (int c = 0; c < 3; c++)
        put_double(w, row->power[c]);
    put_double(w, row->share);
    for (int column = 0; column < RT_LEDGER_COLUMNS; column++)
        for (int c = 0; c < 3; c++)
            put64(w, (uint64_t)row->sums[column][c]);
}

static void put_range(writer *w, const rt_path_range *range)
{
    put64(w, range->first);
    put64(w, range->count);
    put64(w, range->photons);
    put32(w, range->seed);
    put32(w, 0);
}

static void put_photon(writer *w, const rt_photon *p)
{
    put_floats(w, p->position, 3);
    put32(w, p->path);
    put_floats(w, p->wi, 3);
    put32(w, p->flags);
    put_floats(w, p->flux, 3);
    put_floats(w, &p->shading, 1);
    put_floats(w, p->normal, 3);
    put32(w, p->shape);
}

static size_t file_size_of(const rt_photon_map *map)
{
    size_t size = RT_MAP_HEADER + RT_MAP_LIGHT * map->ledger.count + RT_MAP_CHECKSUM;
    for (int kind = 0; kind < RT_PHOTON_KINDS; kind++)
        size += RT_MAP_RANGE * map->ranges[kind].count + RT_MAP_PHOTON * map->lists[kind].count;
    return size;
}

rt_status rt_photon_map_encode(rt_bytes *out, const rt_photon_map *map, rt_error *error)
{
    rt_memory *memory = map->lists[RT_PHOTONS_GLOBAL].memory;
    size_t size = file_size_of(map);
    rt_status status = rt_memory_take(memory, size, "the file of the photon map", error);
    if (status != RT_OK)
        return status;
    uint8_t *data = malloc(size);
    writer w = {data};
    if (!data) {
        rt_memory_give(memory, size);
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory: %zu bytes for a file", size);
    }
    put_header(&w, map, size);
    for (size_t i = 0; i < map->ledger.count; i++)
        put_light(&w, map->ledger.rows + i);
    for (int kind = 0; kind < RT_PHOTON_KINDS; kind++)
        for (size_t i = 0; i < map->ranges[kind].count; i++)
            put_range(&w, map->ranges[kind].ranges + i);
    for (int kind = 0; kind < RT_PHOTON_KINDS; kind++)
        for (size_t i = 0; i < map->lists[kind].count; i++)
            put_photon(&w, map->lists[kind].photons + i);
    put32(&w, rt_crc32(data, size - RT_MAP_CHECKSUM));
    *out = (rt_bytes){data, size, size, memory};
    return RT_OK;
}

rt_status rt_photon_map_save(const rt_photon_map *map, const char *path, rt_error *error)
{
    if (rt_is_missing(map, "map", error))
        return RT_ERROR_USAGE;
    rt_bytes bytes = {0};
    rt_status status = rt_photon_map_encode(&bytes, map, error);
    if (status == RT_OK)
        status = rt_file_replace(path, &bytes, error);
    rt_bytes_free(&bytes);
    return status;
}
