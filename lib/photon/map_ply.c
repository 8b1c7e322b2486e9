/* map_ply.c - exports a photon map as a point cloud for MeshLab or Blender. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "base/file.h"
#include "image/srgb.h"
#include "photon/photon_map.h"

static const char header[] =
    "ply\n"
    "format binary_little_endian 1.0\n"
    "comment photons; flux in W, in media W m; travel is the direction in which light came\n"
    "comment a path is known by seed and path; shapes are counted from 0\n"
    "element vertex %llu\n"
    "property float x\n"
    "property float y\n"
    "property float z\n"
    "property float nx\n"
    "property float ny\n"
    "property float nz\n"
    "property float flux_red\n"
    "property float flux_green\n"
    "property float flux_blue\n"
    "property float travel_x\n"
    "property float travel_y\n"
    "property float travel_z\n"
    "property uint seed\n"
    "property uint path\n"
    "property uint shape\n"
    "property ushort segments\n"
    "property uchar caustic\n"
    "property uchar volume\n"
    "property uchar red\n"
    "property uchar green\n"
    "property uchar blue\n"
    "end_header\n";

enum { POINT_BYTES = 12 * 4 + 3 * 4 + 2 + 2 + 3 };

static void put_bytes(uint8_t **at, uint32_t value, int count)
{
    for (int i = 0; i < count; i++)
        *(*at)++ = (uint8_t)(value >> (8 * i));
}

static void put_float(uint8_t **at, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    put_bytes(at, bits, 4);
}

/* per_path: 1 / emitted paths; brightest: flux that is shown as white. */
static void put_point(uint8_t **at, const rt_photon *p, uint32_t seed, double per_path,
                      double brightest)
{
    uint32_t segments = p->flags >> 8;
    for (int c = 0; c < 3; c++)
        put_float(at, p->position[c]);
    for (int c = 0; c < 3; c++)
        put_float(at, p->normal[c]);
    for (int c = 0; c < 3; c++)
        put_float(at, (float)(p->flux[c] * per_path));
    for (int c = 0; c < 3; c++)
        put_float(at, -p->wi[c]);
    put_bytes(at, seed, 4);
    put_bytes(at, p->path, 4);
    put_bytes(at, p->shape, 4);
    put_bytes(at, segments < UINT16_MAX ? segments : UINT16_MAX, 2);
    put_bytes(at, (p->flags & RT_PHOTON_CAUSTIC) != 0, 1);
    put_bytes(at, (p->flags & RT_PHOTON_VOLUME) != 0, 1);
    for (int c = 0; c < 3; c++)
        put_bytes(at, rt_srgb_quantise(brightest > 0 ? p->flux[c] * per_path / brightest : 0), 1);
}

static double scale_of(const rt_photon_list *list)
{
    return list->emitted ? 1.0 / (double)list->emitted : 0;
}

/* The largest flux in any channel of the photons in media, or of all others. */
static double find_brightest(const rt_photon_map *map, int in_media)
{
    double brightest = 0;
    for (int kind = in_media ? RT_PHOTONS_VOLUME : 0;
         kind < (in_media ? RT_PHOTON_KINDS : RT_PHOTONS_VOLUME); kind++)
        for (size_t i = 0; i < map->lists[kind].count; i++)
            for (int c = 0; c < 3; c++) {
                double flux = map->lists[kind].photons[i].flux[c] * scale_of(map->lists + kind);
                brightest = flux > brightest ? flux : brightest;
            }
    return brightest;
}

/* Writes a list; its photons lie range by range, each of a seed. */
static void put_list(uint8_t **at, const rt_photon_map *map, int kind, double brightest)
{
    const rt_path_ranges *ranges = map->ranges + kind;
    const rt_photon *p = map->lists[kind].photons;
    for (size_t i = 0; i < ranges->count; i++)
        for (uint64_t j = 0; j < ranges->ranges[i].photons; j++)
            put_point(at, p++, ranges->ranges[i].seed, scale_of(map->lists + kind), brightest);
}

rt_status rt_photon_map_export(const rt_photon_map *map, const char *path, rt_error *error)
{
    if (rt_is_missing(map, "map", error))
        return RT_ERROR_USAGE;
    char text[sizeof header + 32];
    size_t count = 0;
    for (int kind = 0; kind < RT_PHOTON_KINDS; kind++)
        count += map->lists[kind].count;
    size_t start = (size_t)snprintf(text, sizeof text, header, (unsigned long long)count);
    size_t size = start + count * POINT_BYTES;
    uint8_t *data = rt_memory_alloc(map->lists[RT_PHOTONS_GLOBAL].memory, size, 1,
                                    "the file of the photons", error);

    if (!data)
        return RT_ERROR_MEMORY;
    memcpy(data, text, start);
    uint8_t *at = data + start;
    for (int kind = 0; kind < RT_PHOTON_KINDS; kind++)
        put_list(&at, map, kind, find_brightest(map, kind == RT_PHOTONS_VOLUME));
    rt_bytes bytes = {data, size, size, NULL};
    rt_status status = rt_file_replace(path, &bytes, error);
    rt_memory_free(data);
    return status;
}
