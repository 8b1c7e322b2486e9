/*
 * test_photon_film.c - what a film of photon mode holds: the same bytes however the work is shared
 * out, what was done, layers of what was gathered, and the samples so far when a render is
 * cancelled.
 */
#include "support.h"

#include <string.h>

#include "lib/mode/photon_room.h"

static void films_are_the_same(const rt_render_options *how)
{
    static const uint32_t devices[][2] = {{1, 1}, {2, 16}, {2, 64}}; /* threads, work-group */
    rt_render_options options = *how;
    rt_film *first = NULL;
    for (size_t i = 0; i < sizeof devices / sizeof *devices; i++) {
        rt_device *device = test_device_open(devices[i][0], devices[i][1]);
        rt_renderer *renderer = room_renderer(device);
        rt_film *film = room_render(renderer, &options);
        if (first)
            assert_memory_equal(rt_film_rgb(first), rt_film_rgb(film),
                                side * side * 3 * sizeof(float));
        rt_renderer_destroy(renderer);
        rt_device_close(device);
        if (first)
            rt_film_destroy(film);
        else
            first = film;
    }
    rt_film_destroy(first);
}

static void films_do_not_depend_on_threads_and_work_groups(void **state)
{
    rt_render_options options = room_options();
    (void)state;
    options.spp = 2;
    options.photons = 50000;
    films_are_the_same(&options);
    options.final_gather = 1;
    options.gather = RT_GATHER_DEVICE;
    films_are_the_same(&options);
    options.irradiance_step = 4;
    films_are_the_same(&options);
    options.passes = 3;
    options.final_gather = 0;
    films_are_the_same(&options);
}

static void the_film_tells_what_was_done(void **state)
{
    rt_render_options options = room_options();
    rt_film_stats stats;
    (void)state;
    options.spp = 3;
    rt_renderer *renderer = room_renderer(test_device());
    rt_film *film = room_render(renderer, &options);
    rt_film_get_stats(film, &stats);
    assert_int_equal(stats.photons_emitted, options.photons);
    assert_true(stats.photons_stored > options.photons / 4 &&
                stats.photons_stored < options.photons);
    assert_true(stats.gathers > 0 && stats.gathers <= 3 * side * side);
    assert_int_equal(stats.spp, 3);
    assert_int_equal(stats.rejected, 0);
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
}

static void note_empty(void *user, const char *line)
{
    *(int *)user += strstr(line, "queries of the photon map found no photon") != NULL;
}

/*
 * On the device, in passes and by FLANN; with caustic photons apart, too, whose share of the points
 * is small.
 */
static void gathers_that_find_nothing_are_counted_and_told(void **state)
{
    static const struct {
        rt_gather gather;
        uint32_t k, passes;
        uint64_t caustic_photons;
        float radius;
        int is_empty;
    } cases[] = {
        {RT_GATHER_AUTO, RT_K_ALL, 1, 0, 1e-9f, 1},
        {RT_GATHER_AUTO, 50, 3, 0, 1e-9f, 1},
        {RT_GATHER_FLANN, 50, 1, 0, 1e-9f, 1},
        {RT_GATHER_AUTO, RT_K_ALL, 1, 2000, 1e-9f, 1},
        {RT_GATHER_AUTO, RT_K_ALL, 1, 2000, 0.3f, 0},
        {RT_GATHER_AUTO, 50, 3, 0, 0, 0},
        {RT_GATHER_FLANN, 50, 1, 0, 0, 0},
    };
    (void)state;
    rt_renderer *renderer = room_renderer(test_device());
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        int told = 0;
        rt_hooks hooks = {.user = &told, .warning = note_empty};
        rt_render_options options = room_options();
        rt_film_stats stats;
        options.spp = 1;
        options.photons = 10000;
        options.gather = cases[i].gather;
        options.k = cases[i].k;
        options.passes = cases[i].passes;
        options.caustic_photons = cases[i].caustic_photons;
        options.radius = cases[i].radius;
        options.hooks = &hooks;
        rt_film *film = room_render(renderer, &options);
        rt_film_get_stats(film, &stats);
        assert_int_equal(told, cases[i].is_empty);
        assert_int_equal(stats.gathers_at_ends, stats.gathers);
        assert_true(stats.gathers > side * side / 2);
        assert_true(cases[i].is_empty ? stats.gathers_empty > 0.99 * stats.gathers
                                      : stats.gathers_empty < 0.05 * stats.gathers);
        rt_film_destroy(film);
    }
    rt_renderer_destroy(renderer);
}

/* Caustic photons are asked for on the way, where most points find none, and that is no fault. */
static void points_on_the_way_do_not_count_as_ends(void **state)
{
    rt_render_options options = room_options();
    rt_film_stats stats;
    (void)state;
    options.spp = 1;
    options.final_gather = 1;
    rt_renderer *renderer = room_renderer(test_device());
    rt_film *film = room_render(renderer, &options);
    rt_film_get_stats(film, &stats);
    assert_true(stats.gathers_at_ends > 0 && stats.gathers > 1.5 * stats.gathers_at_ends);
    assert_true(stats.gathers_empty < 0.05 * stats.gathers_at_ends);
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
}

static void layers_tell_what_was_gathered(void **state)
{
    const double pi = 3.14159265358979323846;
    rt_render_options options = room_options();
    uint32_t channels = 0;
    (void)state;
    rt_renderer *renderer = room_renderer(test_device());
    options.photon_layers = 1;
    for (int on_device = 0; on_device < 2; on_device++) {
        options.gather = on_device ? RT_GATHER_DEVICE : RT_GATHER_FLANN;
        rt_film *film = room_render(renderer, &options);
        const float *counts = rt_film_layer(film, "photon.count", &channels);
        const float *radii = rt_film_layer(film, "photon.radius", NULL);
        const float *densities = rt_film_layer(film, "photon.density", NULL);
        const float *variances = rt_film_layer(film, "photon.variance", NULL);
        assert_int_equal(channels, 1);
        assert_null(rt_film_layer(film, "photon.flux", NULL));
        int whole = 0;
        for (int i = 0; i < side * side; i++) {
            assert_true(counts[i] >= 0 && counts[i] <= 49 && radii[i] >= 0 && variances[i] >= 0);
            /* The mean of 49 over the areas is at least that over the mean radius squared. */
            if (counts[i] == 49) {
                assert_true(densities[i] >= 0.999 * 49 / (pi * radii[i] * radii[i]));
                whole++;
            }
        }
        assert_true(whole > side * side / 2);
        rt_film_destroy(film);
    }
    options.photon_layers = 0;
    rt_film *film = room_render(renderer, &options);
    assert_null(rt_film_layer(film, "photon.count", NULL));
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
}

static int cancel_in_stage(void *user, const rt_progress *progress)
{
    return progress->stage == *(const rt_stage *)user && progress->fraction > 0;
}

static void a_cancel_ends_the_render(void **state)
{
    static const rt_stage stages[] = {RT_STAGE_EMIT, RT_STAGE_GATHER};
    (void)state;
    rt_renderer *renderer = room_renderer(test_device());
    for (size_t i = 0; i < sizeof stages / sizeof *stages; i++) {
        rt_stage stage = stages[i];
        rt_hooks hooks = {.progress = cancel_in_stage, .user = &stage};
        rt_render_options options = room_options();
        rt_film *film = NULL;
        rt_error error;
        options.spp = 10000;
        options.hooks = &hooks;
        assert_int_equal(rt_render(&film, renderer, &options, &error), RT_CANCELLED);
        if (stage == RT_STAGE_EMIT)
            assert_null(film);
        if (stage == RT_STAGE_GATHER) {
            assert_non_null(film);
            rt_film_stats stats;
            rt_film_get_stats(film, &stats);
            assert_true(stats.spp >= 1 && stats.spp < 10000);
        }
        rt_film_destroy(film);
    }
    rt_renderer_destroy(renderer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(films_do_not_depend_on_threads_and_work_groups),
        cmocka_unit_test(the_film_tells_what_was_done),
        cmocka_unit_test(gathers_that_find_nothing_are_counted_and_told),
        cmocka_unit_test(points_on_the_way_do_not_count_as_ends),
        cmocka_unit_test(layers_tell_what_was_gathered),
        cmocka_unit_test(a_cancel_ends_the_render),
    };
    return cmocka_run_group_tests_name("lib/mode/photon_film", tests, NULL, NULL);
}
