/*
 * test_map_parts.c - maps are the same to the bit, in whichever parts, on whichever device they are
 * made.
 */
#include "support.h"

#include <string.h>

#include "lib/photon/emitted.h"
#include "photon/map_file.h"

static rt_photon_map *merge(rt_photon_map *const *maps, size_t count)
{
    rt_photon_map *map = NULL;
    rt_error error;
    expect_ok(rt_photon_map_merge(&map, (const rt_photon_map *const *)maps, count, &error), &error);
    return map;
}

static void expect_no_merge(rt_photon_map *a, rt_photon_map *b, const char *reason)
{
    const rt_photon_map *both[] = {a, b};
    rt_photon_map *map = NULL;
    rt_error error;
    assert_int_equal(rt_photon_map_merge(&map, both, 2, &error), RT_ERROR_INPUT);
    assert_null(map);
    if (!strstr(error.message, reason))
        fail_msg("'%s' does not say '%s'", error.message, reason);
}

static void parts_join_to_the_map_of_all(void **state)
{
    rt_render_options render = {
        .photons = 10007, .caustic_photons = 5003, .max_depth = 10, .seed = 5};
    rt_emit_options options = {.render = &render};
    rt_photon_map *parts[3];
    (void)state;
    rt_renderer *renderer = test_renderer(ROOM);
    rt_photon_map *whole = emit_map(renderer, &options);
    options.parts = 3;
    for (options.part = 0; options.part < 3; options.part++)
        parts[options.part] = emit_map(renderer, &options);
    static const int orders[][3] = {{0, 1, 2}, {2, 0, 1}, {1, 2, 0}};
    for (int i = 0; i < 3; i++) {
        rt_photon_map *some[] = {parts[orders[i][0]], parts[orders[i][1]], parts[orders[i][2]]};
        rt_photon_map *joined = merge(some, 3);
        expect_same_map(joined, whole);
        rt_photon_map_destroy(joined);
        /* Two at a time comes to the same, with a gap in between or not. */
        rt_photon_map *pair = merge(some, 2);
        rt_photon_map *rest[] = {some[2], pair};
        joined = merge(rest, 2);
        expect_same_map(joined, whole);
        rt_photon_map_destroy(pair);
        rt_photon_map_destroy(joined);
    }
    for (int i = 0; i < 3; i++)
        rt_photon_map_destroy(parts[i]);
    rt_photon_map_destroy(whole);
    rt_renderer_destroy(renderer);
}

static void seeds_join_in_any_order(void **state)
{
    rt_render_options render = {.photons = 3000};
    rt_emit_options options = {.render = &render};
    rt_photon_map *maps[2], *turned[2];
    rt_photon_map_info info;
    size_t range_count = 0;
    (void)state;
    rt_renderer *renderer = test_renderer(ROOM);
    for (int i = 0; i < 2; i++) {
        render.seed = (uint32_t)(9 - i);
        maps[i] = turned[1 - i] = emit_map(renderer, &options);
    }
    rt_photon_map *a = merge(maps, 2), *b = merge(turned, 2);
    expect_same_map(a, b);
    rt_photon_map_get_info(a, &info);
    assert_int_equal(info.paths[RT_PHOTONS_GLOBAL], 6000);
    const rt_path_range *ranges = rt_photon_map_ranges(a, RT_PHOTONS_GLOBAL, &range_count);
    assert_int_equal(range_count, 2);
    for (uint32_t i = 0; i < 2; i++)
        assert_true(ranges[i].seed == 8 + i && ranges[i].first == 0 && ranges[i].count == 3000);
    assert_int_equal(info.photons[RT_PHOTONS_GLOBAL],
                     rt_photon_map_count(maps[0], RT_PHOTONS_GLOBAL) +
                         rt_photon_map_count(maps[1], RT_PHOTONS_GLOBAL));
    for (int i = 0; i < 2; i++)
        rt_photon_map_destroy(maps[i]);
    rt_photon_map_destroy(a);
    rt_photon_map_destroy(b);
    rt_renderer_destroy(renderer);
}

static void maps_that_do_not_fit_are_not_joined(void **state)
{
    static const float shares[] = {1, 1};
    rt_render_options render = {.photons = 100}, other = {.photons = 100, .seed = 1};
    rt_emit_options options = {.render = &render}, others = {.render = &other};
    (void)state;
    rt_renderer *renderer = test_renderer(ROOM);
    rt_renderer *changed = test_renderer(ROOM "light point { position 0 0 0.5  power 1 }\n");
    rt_photon_map *map = emit_map(renderer, &options), *odd[6];
    expect_no_merge(map, map, "the same paths");
    odd[0] = emit_map(changed, &others);
    expect_no_merge(map, odd[0], "different scenes");
    other.max_depth = 5;
    odd[1] = emit_map(renderer, &others);
    expect_no_merge(map, odd[1], "segments");
    other = (rt_render_options){.photons = 100, .seed = 1, .direct = RT_DIRECT_PHOTONS};
    odd[2] = emit_map(renderer, &others);
    expect_no_merge(map, odd[2], "direct light");
    other = (rt_render_options){.photons = 100, .seed = 1, .caustic_photons = 10};
    odd[3] = emit_map(renderer, &others);
    expect_no_merge(map, odd[3], "caustic photons apart");
    other = (rt_render_options){.photons = 100, .seed = 1, .sampler = RT_SAMPLER_INDEPENDENT};
    odd[4] = emit_map(renderer, &others);
    expect_no_merge(map, odd[4], "samplers");
    other = (rt_render_options){.photons = 100, .seed = 1};
    other.light_shares = shares;
    other.light_share_count = 2;
    odd[5] = emit_map(renderer, &others);
    expect_no_merge(map, odd[5], "shares");
    for (int i = 0; i < 6; i++)
        rt_photon_map_destroy(odd[i]);
    rt_photon_map_destroy(map);
    rt_renderer_destroy(changed);
    rt_renderer_destroy(renderer);
}

static void maps_do_not_depend_on_threads_and_work_groups(void **state)
{
    static const uint32_t devices[][2] = {{1, 1}, {2, 16}, {3, 64}}; /* threads, work-group */
    rt_render_options render = {.photons = 20000, .caustic_photons = 5000};
    rt_emit_options options = {.render = &render};
    (void)state;
    rt_renderer *renderer = test_renderer(ROOM);
    rt_photon_map *expected = emit_map(renderer, &options);
    rt_renderer_destroy(renderer);
    for (size_t i = 0; i < sizeof devices / sizeof *devices; i++) {
        rt_device *device = test_device_open(devices[i][0], devices[i][1]);
        renderer = renderer_on(device, ROOM, RT_ACCEL_BVH);
        rt_photon_map *map = emit_map(renderer, &options);
        expect_same_map(map, expected);
        rt_photon_map_destroy(map);
        rt_renderer_destroy(renderer);
        rt_device_close(device);
    }
    rt_photon_map_destroy(expected);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_join_to_the_map_of_all),
        cmocka_unit_test(seeds_join_in_any_order),
        cmocka_unit_test(maps_that_do_not_fit_are_not_joined),
        cmocka_unit_test(maps_do_not_depend_on_threads_and_work_groups),
    };
    return cmocka_run_group_tests_name("lib/photon/map_parts", tests, NULL, NULL);
}
