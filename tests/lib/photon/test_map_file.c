/*
 * test_map_file.c - files of photon maps: they come back to the bit, and what is damaged is refused
 * with its reason.
 */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/crc32.h"
#include "base/file.h"
#include "lib/base/frame_damage.h"
#include "lib/image/scratch.h"
#include "photon/map_file.h"

static const char scene_text[] =
    "material wall { kd 0.5 }\n"
    "material glass { kt 1  ior 1.5  fresnel dielectric }\n"
    "sphere { centre 0 0 0  radius 1  material wall }\n"
    "sphere { centre 0.3 0 0  radius 0.3  material glass }\n"
    "sphere { centre -0.5 0 0  radius 0.1  material wall  radiance 1 2 3 }\n"
    "light point { position 0.3 0 0.1  power 2 3 5 }\n";

/* A small map with caustic photons apart and a gap in its paths: parts 0 and 2 of 3. */
static rt_photon_map *make_map(void)
{
    rt_render_options render = {.photons = 90, .caustic_photons = 60, .max_depth = 8, .seed = 3};
    rt_photon_map *parts[2], *map = NULL;
    rt_renderer *renderer = NULL;
    rt_scene *scene = NULL;
    rt_error error;
    expect_ok(rt_scene_parse(&scene, scene_text, "test", NULL, &error), &error);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    for (uint32_t i = 0; i < 2; i++) {
        rt_emit_options options = {.render = &render, .part = 2 * i, .parts = 3};
        expect_ok(rt_photon_map_emit(parts + i, renderer, &options, &error), &error);
    }
    expect_ok(rt_photon_map_merge(&map, (const rt_photon_map *const *)parts, 2, &error), &error);
    for (int i = 0; i < 2; i++)
        rt_photon_map_destroy(parts[i]);
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
    assert_true(map->lists[RT_PHOTONS_GLOBAL].count > 20 &&
                map->lists[RT_PHOTONS_CAUSTIC].count > 10);
    assert_int_equal(map->ranges[RT_PHOTONS_GLOBAL].count, 2);
    return map;
}

static rt_bytes encode(const rt_photon_map *map)
{
    rt_bytes bytes = {0};
    rt_error error;
    expect_ok(rt_photon_map_encode_in(&bytes, map, &error), &error);
    return bytes;
}

static void checksum_is_that_of_zlib(void **state)
{
    (void)state;
    assert_int_equal(rt_crc32("123456789", 9), 0xcbf43926u);
    assert_int_equal(rt_crc32("", 0), 0);
    assert_int_equal(rt_crc32("abc", 3), 0x352441c2u);
}

static void maps_come_back_to_the_bit(void **state)
{
    rt_photon_map *map = make_map(), *back = NULL;
    rt_error error;
    (void)state;
    expect_ok(rt_photon_map_save(map, "map.rtp", &error), &error);
    expect_ok(rt_photon_map_load(&back, "map.rtp", &error), &error);
    assert_memory_equal(&back->settings, &map->settings, sizeof map->settings);
    for (int kind = 0; kind < RT_PHOTON_KINDS; kind++) {
        const rt_photon_list *a = map->lists + kind, *b = back->lists + kind;
        assert_true(a->count == b->count && a->emitted == b->emitted && a->rejected == b->rejected);
        assert_memory_equal(a->photons, b->photons, a->count * sizeof *a->photons);
        assert_int_equal(map->ranges[kind].count, back->ranges[kind].count);
    }
    assert_true(rt_ledger_matches(&map->ledger, &back->ledger));
    assert_memory_equal(map->ledger.rows, back->ledger.rows,
                        map->ledger.count * sizeof *map->ledger.rows);
    /* And the file of what came back is the same file. */
    rt_bytes first = encode(map), second = encode(back);
    assert_int_equal(first.size, second.size);
    assert_memory_equal(first.data, second.data, first.size);
    rt_bytes_free(&first);
    rt_bytes_free(&second);
    rt_photon_map_destroy(map);
    rt_photon_map_destroy(back);
    assert_int_equal(scratch_count(), 1);
}

/* Of several of the blocks that a file is written by, and in memory, too. */
static void a_file_is_written_as_it_is_encoded(void **state)
{
    rt_render_options render = {.photons = 4000, .max_depth = 8, .seed = 3};
    const rt_emit_options options = {.render = &render};
    rt_renderer *renderer = test_renderer(scene_text);
    rt_photon_map *map = NULL;
    rt_bytes file = {0};
    rt_error error;
    size_t size, again;
    (void)state;
    expect_ok(rt_photon_map_emit(&map, renderer, &options, &error), &error);
    expect_ok(rt_photon_map_save(map, "map.rtp", &error), &error);
    expect_ok(rt_file_read(&file, "map.rtp", SIZE_MAX / 2, &error), &error);
    expect_ok(rt_photon_map_encode(map, NULL, 0, &size, &error), &error);
    assert_true(size > 3 << 16);
    uint8_t *bytes = malloc(size);
    assert_non_null(bytes);
    expect_ok(rt_photon_map_encode(map, bytes, size, &again, &error), &error);
    assert_true(again == size && file.size == size);
    assert_memory_equal(file.data, bytes, size);
    expect_ok(rt_frame_check(&rt_map_frame, bytes, size, "map.rtp", &error), &error);
    free(bytes);
    rt_bytes_free(&file);
    rt_photon_map_destroy(map);
    rt_renderer_destroy(renderer);
}

static void empty_maps_come_back(void **state)
{
    rt_photon_map empty = {.settings = {.max_depth = 1}}, *back = NULL;
    rt_error error;
    (void)state;
    expect_ok(rt_photon_map_save(&empty, "empty.rtp", &error), &error);
    expect_ok(rt_photon_map_load(&back, "empty.rtp", &error), &error);
    assert_int_equal(rt_photon_map_count(back, RT_PHOTONS_GLOBAL), 0);
    rt_photon_map_destroy(back);
}

/* Decoding must fail, say so in the file's name, and leave no map. */
static void expect_refused(const uint8_t *data, size_t size, const char *reason)
{
    rt_photon_map *map = NULL;
    rt_error error = {0};
    /* A copy of the exact size, so that a sanitizer sees what is read beyond it. */
    uint8_t *copy = malloc(size ? size : 1);
    assert_non_null(copy);
    memcpy(copy, data, size);
    rt_status status = rt_photon_map_decode_in(&map, copy, size, "broken.rtp", NULL, &error);
    free(copy);
    assert_int_equal(status, RT_ERROR_INPUT);
    assert_null(map);
    assert_non_null(strstr(error.message, "broken.rtp: "));
    if (!strstr(error.message, reason))
        fail_msg("'%s' does not say '%s'", error.message, reason);
}

static void a_damage_to_any_byte_is_refused(void **state)
{
    rt_photon_map *map = make_map();
    rt_bytes file = encode(map);
    (void)state;
    frame_damage(&file, "photon map", expect_refused);
    /* Two blocks changed places. */
    memmove(file.data + 400, file.data + 464, 64);
    expect_refused(file.data, file.size, "checksum");
    rt_bytes_free(&file);
    rt_photon_map_destroy(map);
}

/* Where the first photon, the first light and the first range of the map of make_map lie. */
enum {
    LIGHTS = 2,
    LIGHT_AT = RT_MAP_HEADER,
    RANGE_AT = LIGHT_AT + LIGHTS * RT_MAP_LIGHT,
    RANGES = 4,
    PHOTON_AT = RANGE_AT + RANGES * RT_MAP_RANGE
};

/* Changes that a checksum made anew would hide. */
static const frame_lie lies[] = {
    {0, 0, 1, "no photon map"},
    {8, 1, 4, "version 1 "},
    {12, 64, 4, "header of 64"},
    {16, 1000, 8, "bytes instead of the 1000"},
    {32, 0, 4, "settings"},
    {36, 2, 4, "settings"},
    {40, 9, 4, "settings"},
    {44, 2, 4, "settings"},
    {44, 0, 4, "keeps none apart"},
    {48, 2, 4, "settings"},
    {48, 1, 4, "not of the paths of the global"},
    {52, 1, 4, "settings"},           /* gather_roughness of 1e-45 */
    {52, 0x3fc00000u, 4, "settings"}, /* 1.5 */
    {52, 0x7fc00000u, 4, "settings"}, /* NaN */
    {56, 3, 8, "counts"},
    {56, UINT64_MAX, 8, "counts"},
    {64, 7, 8, "more paths"},
    {64, 1000, 8, "ledger is not of its paths"},
    {80, 61, 8, "do not add up"},
    {96, 1, 8, "counts"},
    {96, UINT64_MAX / 64, 8, "counts"},
    {104, 3, 8, "counts"},
    {112, 1, 8, "not zero"},
    {LIGHT_AT + 4, 100000, 4, "a light in its ledger"}, /* exponent */
    {LIGHT_AT + 4, (uint32_t)-401, 4, "a light in its ledger"},
    {LIGHT_AT + 16, 0x7ff8000000000000u, 8, "a light in its ledger"}, /* power NaN */
    {LIGHT_AT + 16, 0xbff0000000000000u, 8, "a light in its ledger"}, /* power -1 */
    {LIGHT_AT + 40, 0x4000000000000000u, 8, "a light in its ledger"}, /* share 2 */
    {RANGE_AT, 5, 8, "not of the paths"},
    {RANGE_AT, 70, 8, "not in order"},
    {RANGE_AT, UINT64_MAX, 8, "a range of its paths"},
    {RANGE_AT + 8, 0, 8, "a range of its paths"},
    {RANGE_AT + 8, 31, 8, "do not add up"},
    {RANGE_AT + 16, UINT64_MAX, 8, "a range of its paths"},
    {RANGE_AT + 16, 0, 8, "do not add up"},
    {RANGE_AT + 24, 4, 4, "not in order"},
    {RANGE_AT + 28, 1, 4, "a range of its paths"},
    {PHOTON_AT, 0x7fc00000u, 4, "not finite"},       /* position NaN */
    {PHOTON_AT, 0x7f800000u, 4, "not finite"},       /* infinite */
    {PHOTON_AT, 0x7149f2cau, 4, "farther out"},      /* 1e30 */
    {PHOTON_AT + 8, 0xd8635faau, 4, "farther out"},  /* just beyond -1e15 */
    {PHOTON_AT + 12, 4000, 4, "not of the paths"},   /* path */
    {PHOTON_AT + 16, 0x40000000u, 4, "unit length"}, /* wi.x 2 */
    {PHOTON_AT + 28, 0x80, 4, "flags"},
    {PHOTON_AT + 28, RT_PHOTON_VOLUME, 4, "flags"},
    {160, 1, 8, "volume photons of a scene without"},
    {PHOTON_AT + 32, 0xbf800000u, 4, "negative flux"},
    {PHOTON_AT + 32, 0x7fc00000u, 4, "not finite"}, /* flux NaN */
    {PHOTON_AT + 44, 0x7fc00000u, 4, "not finite"}, /* shading */
    {PHOTON_AT + 48, 0x7fc00000u, 4, "not finite"}, /* normal */
    {PHOTON_AT + 48, 0x40000000u, 4, "unit length"},
};

static void lies_with_a_sound_checksum_are_refused(void **state)
{
    rt_photon_map *map = make_map();
    rt_bytes file = encode(map);
    (void)state;
    frame_tell_lies(&file, lies, sizeof lies / sizeof *lies, expect_refused);
    rt_bytes_free(&file);
    rt_photon_map_destroy(map);
}

/*
 * Any single byte of a file with a sound checksum may lie: the map is refused or sound, never a
 * crash.
 */
static void any_lie_is_refused_or_harmless(void **state)
{
    rt_photon_map *map = make_map();
    rt_bytes file = encode(map);
    (void)state;
    for (size_t at = 8; at < file.size - 8; at += at < PHOTON_AT + 128 ? 1 : 61) {
        uint8_t before = file.data[at];
        rt_photon_map *back = NULL;
        rt_error error;
        file.data[at] ^= 0xff;
        frame_seal(&file);
        rt_status status =
            rt_photon_map_decode_in(&back, file.data, file.size, "lie", NULL, &error);
        assert_true(status == RT_OK || status == RT_ERROR_INPUT);
        assert_int_equal(status == RT_OK, back != NULL);
        rt_photon_map_destroy(back);
        file.data[at] = before;
    }
    rt_bytes_free(&file);
    rt_photon_map_destroy(map);
}

static void what_is_no_map_is_refused_by_its_path(void **state)
{
    static const struct {
        const char *path, *reason;
    } cases[] = {{"missing.rtp", "No such file"},
                 {".", "directory"},
                 {"empty.rtp", "no photon map"},
                 {"text.rtp", "no photon map"},
                 {"/dev/zero", "no photon map"}};
    rt_photon_map *map = NULL;
    rt_error error;
    (void)state;
    scratch_write("empty.rtp", "");
    scratch_write("text.rtp", "light point { position 0 0 0  power 1 }\n");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_int_equal(rt_photon_map_load(&map, cases[i].path, &error), RT_ERROR_INPUT);
        assert_null(map);
        assert_non_null(strstr(error.message, cases[i].path));
        assert_non_null(strstr(error.message, cases[i].reason));
    }
}

static void a_file_that_grew_is_not_read_beyond_its_size(void **state)
{
    rt_photon_map *map = make_map(), *back = NULL;
    rt_bytes file = encode(map);
    rt_error error;
    (void)state;
    size_t size = file.size;
    char says[128];
    snprintf(says, sizeof says, "it has 100001 bytes more than the %zu that its header announces",
             size);
    expect_ok(rt_bytes_put(&file, size + 100000, "x", 1, &error), &error);
    expect_ok(rt_file_replace("long.rtp", &file, &error), &error);
    assert_int_equal(rt_photon_map_load(&back, "long.rtp", &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, says));
    rt_bytes_free(&file);
    rt_photon_map_destroy(map);
}

static void maps_that_cannot_be_written_leave_no_file(void **state)
{
    rt_photon_map *map = make_map();
    rt_error error;
    (void)state;
    assert_int_equal(rt_photon_map_save(map, "nowhere/map.rtp", &error), RT_ERROR_OUTPUT);
    assert_int_equal(rt_photon_map_export(map, "nowhere/map.ply", &error), RT_ERROR_OUTPUT);
    assert_non_null(strstr(error.message, "nowhere/map.ply"));
    assert_int_equal(scratch_count(), 0);
    rt_photon_map_destroy(map);
}

/* Little-endian bytes hold this number. */
static void expect_word(const uint8_t *bytes, uint32_t value)
{
    assert_int_equal(bytes[0] | bytes[1] << 8 | bytes[2] << 16 | (uint32_t)bytes[3] << 24, value);
}

/* The points of an exported map, by the header that says so. */
static void exports_hold_every_photon(void **state)
{
    enum { point_bytes = 67, seed_at = 48, path_at = 52, shape_at = 56, caustic_at = 62 };
    rt_photon_map *map = make_map();
    size_t count = map->lists[0].count + map->lists[1].count;
    const rt_photon *first = map->lists[0].photons,
                    *last = map->lists[1].photons + map->lists[1].count - 1;
    char line[64];
    rt_bytes file = {0};
    rt_error error;
    float flux[3];
    (void)state;
    assert_int_equal(map->ranges[0].ranges[0].seed, 3);
    map->ranges[0].ranges[1].seed = 4;
    expect_ok(rt_photon_map_export(map, "map.ply", &error), &error);
    expect_ok(rt_file_read(&file, "map.ply", 1 << 20, &error), &error);
    assert_memory_equal(file.data, "ply\nformat binary_little_endian 1.0\n", 36);
    expect_ok(rt_bytes_put(&file, file.size, "", 1, &error), &error);
    snprintf(line, sizeof line, "element vertex %zu\n", count);
    assert_non_null(strstr((const char *)file.data, line));
    const char *end = strstr((const char *)file.data, "end_header\n");
    assert_non_null(end);
    const uint8_t *points = (const uint8_t *)end + 11;
    assert_int_equal(file.data + file.size - 1 - points, count * point_bytes);
    assert_memory_equal(points, first->position, 12);
    memcpy(flux, points + 24, sizeof flux);
    for (int c = 0; c < 3; c++)
        assert_float_equal(flux[c] * map->lists[0].emitted, first->flux[c], 1e-5 * first->flux[c]);
    const uint8_t *caustic = points + (count - 1) * point_bytes;
    assert_memory_equal(caustic, last->position, 12);
    assert_true(points[caustic_at] == 0 && caustic[caustic_at] == 1);
    /* After a merge a path is known by its seed as well. */
    expect_word(points + seed_at, map->ranges[0].ranges[0].seed);
    expect_word(points + path_at, first->path);
    expect_word(points + shape_at, first->shape);
    const uint8_t *second = points + map->ranges[0].ranges[0].photons * point_bytes;
    expect_word(second + seed_at, 4);
    rt_bytes_free(&file);
    rt_photon_map_destroy(map);
}

int main(void)
{
#define IN_SCRATCH(test) cmocka_unit_test_setup_teardown(test, scratch_enter, scratch_leave)
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(checksum_is_that_of_zlib),
        IN_SCRATCH(maps_come_back_to_the_bit),
        IN_SCRATCH(a_file_is_written_as_it_is_encoded),
        IN_SCRATCH(empty_maps_come_back),
        cmocka_unit_test(a_damage_to_any_byte_is_refused),
        cmocka_unit_test(lies_with_a_sound_checksum_are_refused),
        cmocka_unit_test(any_lie_is_refused_or_harmless),
        IN_SCRATCH(what_is_no_map_is_refused_by_its_path),
        IN_SCRATCH(a_file_that_grew_is_not_read_beyond_its_size),
        IN_SCRATCH(maps_that_cannot_be_written_leave_no_file),
        IN_SCRATCH(exports_hold_every_photon),
    };
    return cmocka_run_group_tests_name("lib/photon/map_file", tests, NULL, NULL);
}
