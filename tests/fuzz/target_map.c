/* target_map.c - photon maps. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fuzz/targets.h"
#include "mesh/load.h"
#include "photon/map_file.h"

enum { PAIR_SEED = 3 }; /* a map of other paths, of the same scene and lights */

static void seed(fuzz_inputs *seeds);

static rt_photon_map *decode(const uint8_t *data, size_t size)
{
    rt_photon_map *map = fuzz_untouched;
    rt_error error;
    rt_status status = rt_photon_map_decode_in(&map, data, size, "fuzz", NULL, &error);
    return fuzz_expect_answer(status, &error, map) ? map : NULL;
}

static void check_values(const rt_photon_map *map)
{
    for (int kind = 0; kind < RT_PHOTON_KINDS; kind++)
        for (size_t i = 0; i < rt_photon_map_count(map, (rt_photon_kind)kind); i++) {
            const rt_photon *p = rt_photon_map_photons(map, (rt_photon_kind)kind) + i;
            fuzz_expect_finite(p->position, 3);
            fuzz_expect_finite(p->wi, 3);
            fuzz_expect_finite(p->flux, 3);
            fuzz_expect_finite(p->normal, 3);
            fuzz_expect_finite(&p->shading, 1);
        }
    rt_light_ledger row;
    if (rt_photon_map_ledger(map, &row, 1))
        for (int c = 0; c < 3; c++)
            FUZZ_EXPECT(isfinite(row.power[c]) && isfinite(row.emitted[c]) &&
                        isfinite(row.roulette[c]));
}

/* Encoded again, and merged with nothing, a map is the same to the bit. */
static void check_bytes(const rt_photon_map *map, const uint8_t *data, size_t size)
{
    rt_bytes bytes = {0};
    rt_error error;
    FUZZ_EXPECT(rt_photon_map_encode_in(&bytes, map, &error) == RT_OK);
    FUZZ_EXPECT(bytes.size == size && memcmp(bytes.data, data, size) == 0);
    rt_bytes_free(&bytes);
}

static void check_merge(const rt_photon_map *map, const uint8_t *data, size_t size)
{
    const rt_photon_map *const twice[2] = {map, map};
    rt_photon_map *merged = fuzz_untouched;
    rt_photon_map_info info;
    rt_error error;
    FUZZ_EXPECT(rt_photon_map_merge(&merged, twice, 1, &error) == RT_OK);
    check_bytes(merged, data, size);
    rt_photon_map_destroy(merged);
    rt_photon_map_get_info(map, &info);
    merged = fuzz_untouched;
    rt_status status = rt_photon_map_merge(&merged, twice, 2, &error);
    FUZZ_EXPECT(status != RT_OK || info.paths[0] + info.paths[1] == 0);
    if (status == RT_OK)
        rt_photon_map_destroy(merged);
    else
        FUZZ_EXPECT(merged == fuzz_untouched);
}

/* With another map it fits or not, in either order. */
static void check_pair(const rt_photon_map *map)
{
    fuzz_inputs seeds = {0};
    rt_photon_map *merged[2] = {NULL, NULL};
    rt_bytes bytes[2] = {{0}, {0}};
    rt_status status[2];
    rt_error error;
    seed(&seeds);
    rt_photon_map *other = decode(seeds.items[PAIR_SEED].data, seeds.items[PAIR_SEED].size);
    FUZZ_EXPECT(other != NULL);
    for (int i = 0; i < 2; i++) {
        const rt_photon_map *const pair[2] = {i ? other : map, i ? map : other};
        status[i] = rt_photon_map_merge(&merged[i], pair, 2, &error);
        if (status[i] == RT_OK)
            FUZZ_EXPECT(rt_photon_map_encode_in(&bytes[i], merged[i], &error) == RT_OK);
        else
            fuzz_expect_line(error.message);
    }
    FUZZ_EXPECT(status[0] == status[1] && bytes[0].size == bytes[1].size);
    FUZZ_EXPECT(!bytes[0].size || memcmp(bytes[0].data, bytes[1].data, bytes[0].size) == 0);
    for (int i = 0; i < 2; i++) {
        rt_bytes_free(&bytes[i]);
        rt_photon_map_destroy(merged[i]);
    }
    rt_photon_map_destroy(other);
    fuzz_inputs_free(&seeds);
}

/* Saved and loaded it is the same to the bit. */
static void check_file(const rt_photon_map *map, const uint8_t *data, size_t size)
{
    rt_photon_map *again = NULL;
    rt_error error;
    FUZZ_EXPECT(rt_photon_map_save(map, "map.rtp", &error) == RT_OK);
    FUZZ_EXPECT(rt_photon_map_load(&again, "map.rtp", &error) == RT_OK);
    check_bytes(again, data, size);
    rt_photon_map_destroy(again);
}

/* The points that it is exported as are a PLY file, with as many vertices as photons. */
static void check_export(const rt_photon_map *map)
{
    rt_photon_map_info info;
    rt_mesh *points = NULL;
    rt_error error;
    rt_photon_map_get_info(map, &info);
    FUZZ_EXPECT(rt_photon_map_export(map, "map.ply", &error) == RT_OK);
    FUZZ_EXPECT(rt_mesh_load(&points, "map.ply", NULL, &error) == RT_OK);
    FUZZ_EXPECT(points->vertex_count == info.photons[0] + info.photons[1] + info.photons[2]);
    rt_mesh_destroy(points);
}

static int run(const uint8_t *data, size_t size)
{
    rt_photon_map *map = decode(data, size);
    if (!map)
        return 0;
    check_values(map);
    check_bytes(map, data, size);
    check_merge(map, data, size);
    check_pair(map);
    check_file(map, data, size);
    check_export(map);
    rt_photon_map_destroy(map);
    return 1;
}

/* ---- The file ------------------------------------------------------------------------------- */

/* Places of numbers of 8 bytes in the header, and of a kind of photons after its start. */
enum {
    at_lights = 56,
    at_paths = 64,
    at_kinds = 80,
    of_kind = 40,
    kind_paths = 0,
    kind_photons = 16,
    kind_ranges = 24,
    table_count = 7
};

/* ---- Seeds --------------------------------------------------------------------------------- */

enum { photons_a_range = 3, paths_a_range = 10 };

static void put_counts(rt_bytes *out, int is_there, unsigned ranges)
{
    fuzz_put_number(out, is_there ? paths_a_range * ranges : 0, 8, 0);
    fuzz_put_number(out, is_there ? 4 : 0, 8, 0);
    fuzz_put_number(out, is_there ? photons_a_range * ranges : 0, 8, 0);
    fuzz_put_number(out, is_there ? ranges : 0, 8, 0);
    fuzz_put_number(out, 0, 8, 0);
}

static void put_light(rt_bytes *out, uint32_t shape)
{
    fuzz_put_number(out, shape, 4, 0);
    fuzz_put_number(out, (uint32_t)-20, 4, 0);
    fuzz_put_number(out, 4, 8, 0);
    for (int i = 0; i < 4; i++)
        fuzz_put_number(out, UINT64_C(0x3fe0000000000000), 8, 0); /* power and share: 0.5 */
    for (unsigned i = 0; i < 15; i++)
        fuzz_put_number(out, 9 * i, 8, 0);
}

static void put_range(rt_bytes *out, unsigned i, uint32_t path_seed)
{
    fuzz_put_number(out, 20 * i, 8, 0);
    fuzz_put_number(out, paths_a_range, 8, 0);
    fuzz_put_number(out, photons_a_range, 8, 0);
    fuzz_put_number(out, path_seed + i / 2, 4, 0);
    fuzz_put_number(out, 0, 4, 0);
}

static void put_photon(rt_bytes *out, unsigned path, int kind)
{
    static const uint32_t flags[RT_PHOTON_KINDS] = {0x200, 0x301, 0x202};
    static const float position[3] = {1, 2, 3}, wi[3] = {0, 1, 0}, flux[3] = {1, 0.5f, 0};
    static const float normal[3] = {0, 0, -1};
    for (int c = 0; c < 3; c++)
        fuzz_put_float(out, position[c], 0);
    fuzz_put_number(out, path, 4, 0);
    for (int c = 0; c < 3; c++)
        fuzz_put_float(out, wi[c], 0);
    fuzz_put_number(out, flags[kind], 4, 0);
    for (int c = 0; c < 3; c++)
        fuzz_put_float(out, flux[c], 0);
    fuzz_put_float(out, 1, 0);
    for (int c = 0; c < 3; c++)
        fuzz_put_float(out, normal[c], 0);
    fuzz_put_number(out, 1, 4, 0);
}

/* A map of so many lights and, of each kind, ranges; those of caustics and of media may lack. */
static void add(fuzz_inputs *seeds, unsigned lights, int is_split, int has_media, unsigned ranges,
                uint32_t path_seed)
{
    static const uint32_t settings[3] = {5, 1, 1}; /* greatest depth, sampler, direct light */
    const int is_there[RT_PHOTON_KINDS] = {1, is_split, has_media};
    rt_bytes file = {0};
    fuzz_put(&file, rt_map_frame.magic, sizeof rt_map_frame.magic);
    fuzz_put_number(&file, 0, 8, 0); /* fuzz_seal fills in these and the next, the size */
    fuzz_put_number(&file, 0, 8, 0);
    fuzz_put_number(&file, 7, 8, 0);
    for (int i = 0; i < 3; i++)
        fuzz_put_number(&file, settings[i], 4, 0);
    fuzz_put_number(&file, (uint32_t)is_split, 4, 0);
    fuzz_put_number(&file, (uint32_t)has_media, 8, 0);
    fuzz_put_number(&file, lights, 8, 0);
    fuzz_put_number(&file, paths_a_range * ranges, 8, 0);
    fuzz_put_number(&file, 1, 8, 0);
    for (int kind = 0; kind < RT_PHOTON_KINDS; kind++)
        put_counts(&file, is_there[kind], ranges);
    for (unsigned i = 0; i < lights; i++)
        put_light(&file, i ? RT_NONE : 2);
    for (int kind = 0; kind < RT_PHOTON_KINDS; kind++)
        for (unsigned i = 0; is_there[kind] && i < ranges; i++)
            put_range(&file, i, path_seed);
    for (int kind = 0; kind < RT_PHOTON_KINDS; kind++)
        for (unsigned i = 0; is_there[kind] && i < photons_a_range * ranges; i++)
            put_photon(&file, 20 * (i / photons_a_range) + i % photons_a_range, kind);
    fuzz_put_number(&file, 0, RT_FRAME_CHECKSUM, 0);
    fuzz_seal(file.data, file.size, &rt_map_frame);
    fuzz_add(seeds, file.data, file.size);
    rt_bytes_free(&file);
}

static void seed(fuzz_inputs *seeds)
{
    add(seeds, 0, 0, 0, 0, 1);
    add(seeds, 1, 0, 0, 1, 1);
    add(seeds, 2, 1, 0, 3, 1);
    add(seeds, 2, 1, 0, 2, 2);
    add(seeds, 1, 1, 1, 2, 1);
}

/* ---- Mutation ------------------------------------------------------------------------------ */

/* The tables: lights, three of ranges, three of photons. */
static const size_t row_sizes[table_count] = {RT_MAP_LIGHT, RT_MAP_RANGE,  RT_MAP_RANGE,
                                              RT_MAP_RANGE, RT_MAP_PHOTON, RT_MAP_PHOTON,
                                              RT_MAP_PHOTON};
static const size_t count_places[table_count] = {at_lights,
                                                 at_kinds + kind_ranges,
                                                 at_kinds + of_kind + kind_ranges,
                                                 at_kinds + 2 * of_kind + kind_ranges,
                                                 at_kinds + kind_photons,
                                                 at_kinds + of_kind + kind_photons,
                                                 at_kinds + 2 * of_kind + kind_photons};

/* Where each table starts; 0 when the counts do not fit the size. */
static int find_tables(const uint8_t *data, size_t size, size_t starts[table_count + 1])
{
    size_t at = RT_MAP_HEADER;
    if (size < RT_MAP_HEADER + RT_FRAME_CHECKSUM)
        return 0;
    for (int i = 0; i < table_count; i++) {
        uint64_t count = fuzz_get(data + count_places[i], 8);
        starts[i] = at;
        if (count > (size - RT_FRAME_CHECKSUM - at) / row_sizes[i])
            return 0;
        at += (size_t)count * row_sizes[i];
    }
    starts[table_count] = at;
    return at == size - RT_FRAME_CHECKSUM;
}

/* Adds a copy of a row, or takes one away. */
static size_t change_rows(uint8_t *data, size_t size, size_t room, fuzz_random *random)
{
    size_t starts[table_count + 1];
    uint8_t row[RT_MAP_HEADER]; /* no row is longer */
    if (!find_tables(data, size, starts))
        return size;
    uint32_t i = fuzz_random_below(random, table_count);
    uint64_t count = fuzz_get(data + count_places[i], 8);
    int adds = count == 0 || fuzz_random_below(random, 2);
    size_t at = starts[i];
    if (count)
        at += row_sizes[i] * fuzz_random_below(random, (uint32_t)count);
    memset(row, 0, sizeof row);
    if (count)
        memcpy(row, data + at, row_sizes[i]);
    size_t changed =
        fuzz_splice(data, size, room, at, adds ? 0 : row_sizes[i], row, adds ? row_sizes[i] : 0);
    if (changed != size)
        fuzz_set(data + count_places[i], adds ? count + 1 : count - 1, 8);
    return changed;
}

/* Makes ranges, photons and paths of each kind add up. */
static void add_up(uint8_t *data, size_t size)
{
    size_t starts[table_count + 1];
    if (!find_tables(data, size, starts))
        return;
    for (int kind = 0; kind < RT_PHOTON_KINDS; kind++) {
        uint8_t *counts = data + at_kinds + of_kind * kind;
        uint64_t ranges = fuzz_get(counts + kind_ranges, 8), paths = 0;
        uint64_t photons = fuzz_get(counts + kind_photons, 8);
        for (uint64_t i = 0; i < ranges; i++) {
            uint8_t *range = data + starts[1 + kind] + RT_MAP_RANGE * i;
            uint64_t here = fuzz_get(range + 16, 8);
            paths += fuzz_get(range + 8, 8);
            if (here > photons || i + 1 == ranges)
                fuzz_set(range + 16, here = photons, 8);
            photons -= here;
        }
        fuzz_set(counts + kind_paths, paths, 8);
    }
    memcpy(data + at_paths, data + at_kinds + kind_paths, 8);
}

/* Changes bytes of one row, or of the header, in place. */
static void change_bytes(uint8_t *data, size_t size, fuzz_random *random)
{
    size_t starts[table_count + 1], at = 24, length = RT_MAP_HEADER - 24;
    uint8_t row[RT_MAP_HEADER]; /* no row is longer */
    uint32_t i = fuzz_random_below(random, table_count + 1);
    if (!find_tables(data, size, starts))
        return;
    if (i < table_count && starts[i + 1] > starts[i]) {
        uint32_t rows = (uint32_t)((starts[i + 1] - starts[i]) / row_sizes[i]);
        length = row_sizes[i];
        at = starts[i] + length * fuzz_random_below(random, rows);
    }
    memcpy(row, data + at, length);
    size_t changed = fuzz_mutate_bytes(row, length, length);
    memcpy(data + at, row, changed);
}

static size_t mutate(uint8_t *data, size_t size, size_t room, uint32_t seed)
{
    fuzz_random random = fuzz_random_begin(seed);
    switch (fuzz_random_below(&random, 8)) {
    case 0:
        size = fuzz_mutate_bytes(data, size, room);
        break;
    case 1:
    case 2:
        size = change_rows(data, size, room, &random);
        break;
    case 3:
        size = change_rows(data, size, room, &random);
        change_bytes(data, size, &random);
        break;
    default:
        change_bytes(data, size, &random);
        break;
    }
    if (fuzz_random_below(&random, 4))
        add_up(data, size);
    if (fuzz_random_below(&random, 16))
        fuzz_seal(data, size, &rt_map_frame);
    return size;
}

const fuzz_target fuzz_target_map = {
    .name = "map",
    .sources = "lib/photon/map_read* lib/photon/map_write* lib/photon/map_merge* "
               "lib/photon/map_ply* lib/photon/photon_map.c",
    .run = run,
    .seed = seed,
    .mutate = mutate,
    .size_max = 4096,
    .tries = 20000,
};
