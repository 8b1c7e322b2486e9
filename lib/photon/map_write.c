/* map_write.c - a photon map to a file; map_file.h describes the bytes. */
#include <stdlib.h>

#include "base/error.h"
#include "base/file.h"
#include "base/sink.h"
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

/* ---- The file ----------------------------------------------------------------- */

enum { BLOCK = 1 << 16 };

/* What is written goes by blocks: a map may take most of the memory, and its file as much. */
typedef struct output {
    rt_sink sink;
    int code;      /* the errno of what failed, or 0 */
    rt_writer row; /* where the next one goes, into the block */
    uint8_t block[BLOCK];
} output;

static void put_block(output *out)
{
    if (!out->code)
        out->code = rt_sink_put(&out->sink, out->block, (size_t)(out->row.at - out->block));
    out->row.at = out->block;
}

/* Room for the header or any row. */
static rt_writer *row_of(output *out)
{
    if (out->row.at > out->block + BLOCK - RT_MAP_HEADER)
        put_block(out);
    return &out->row;
}

/* Writes all to memory or, without, to a file; returns the errno of what failed, or 0. */
static int put_map(const rt_photon_map *map, uint8_t *to, int fd)
{
    output out;
    out.sink = rt_sink_begin(to, fd);
    out.code = 0;
    out.row.at = out.block;
    put_header(row_of(&out), map, file_size_of(map));
    for (size_t i = 0; i < map->ledger.count; i++)
        rt_ledger_put(row_of(&out), map->ledger.rows + i);
    for (int kind = 0; kind < RT_PHOTON_KINDS; kind++)
        for (size_t i = 0; i < map->ranges[kind].count; i++)
            put_range(row_of(&out), map->ranges[kind].ranges + i);
    for (int kind = 0; kind < RT_PHOTON_KINDS; kind++)
        for (size_t i = 0; i < map->lists[kind].count && !out.code; i++)
            put_photon(row_of(&out), map->lists[kind].photons + i);
    put_block(&out);
    return out.code ? out.code : rt_sink_end(&out.sink);
}

rt_status rt_photon_map_encode_in(rt_bytes *out, const rt_photon_map *map, rt_error *error)
{
    rt_memory *memory = map->lists[RT_PHOTONS_GLOBAL].memory;
    const size_t size = file_size_of(map);
    rt_status status = rt_memory_take(memory, size, rt_bytes_owner, error);
    if (status != RT_OK)
        return status;
    uint8_t *data = malloc(size);
    if (!data) {
        rt_memory_give(memory, size, rt_bytes_owner);
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory: %zu bytes for a file", size);
    }
    put_map(map, data, -1);
    *out = (rt_bytes){data, size, size, memory};
    return RT_OK;
}

rt_status rt_photon_map_encode(const rt_photon_map *map, void *buffer, size_t capacity,
                               size_t *size, rt_error *error)
{
    if (rt_is_missing(map, "map", error))
        return RT_ERROR_USAGE;
    *size = file_size_of(map);
    if (buffer && *size > capacity)
        return rt_fail(error, RT_ERROR_USAGE,
                       "the photon map takes %zu bytes, and the buffer has %zu", *size, capacity);
    if (buffer)
        put_map(map, buffer, -1);
    return RT_OK;
}

static int file_content(const void *map, int fd)
{
    return put_map(map, NULL, fd);
}

rt_status rt_photon_map_save(const rt_photon_map *map, const char *path, rt_error *error)
{
    if (rt_is_missing(map, "map", error))
        return RT_ERROR_USAGE;
    return rt_file_replace_by(path, file_content, map, error);
}
