/*
 * test_cut_off.c - the light that max_depth cuts off, between two mirrors that reflect a part r of
 * it: of the throughput of camera paths r^max_depth, of the flux of photon paths r^(max_depth - 1),
 * and the warning where that is much.
 */
#include "support.h"

#include <math.h>
#include <string.h>

enum { side = 16 };

static const double reflectance = 0.9;

/* The camera and a narrow spot look along the axis of the two mirrors. */
static const char mirrors[] =
    "camera { projection orthographic  eye 0 0 0  look_at 0 0 1  width 0.1 }\n"
    "material mirror { ks 0.9 }\n"
    "plane { point 0 0 5  normal 0 0 -1  material mirror }\n"
    "plane { point 0 0 -5  normal 0 0 1  material mirror }\n"
    "light spot { position 0 0 0  target 0 0 1  intensity 1  outer 0.01 }\n";

static void count_warning(void *user, const char *line)
{
    *(int *)user += strstr(line, " cuts off ") != NULL;
}

/* The figures of a render, and how often it warned. */
static rt_film_stats stats_of(const char *text, rt_render_options options, int *warnings)
{
    const rt_hooks hooks = {.user = warnings, .warning = count_warning};
    rt_renderer *renderer = test_renderer(text);
    rt_film *film = NULL;
    rt_film_stats stats;
    rt_error error;
    options.width = options.height = side;
    options.spp = 64;
    options.hooks = &hooks;
    *warnings = 0;
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    rt_film_get_stats(film, &stats);
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
    return stats;
}

/* Without roulette each path loses the same. */
static void camera_paths_lose_what_the_last_surface_would_scatter(void **state)
{
    static const rt_mode modes[] = {RT_MODE_PATH, RT_MODE_DIRECT, RT_MODE_PHOTON};
    (void)state;
    for (int m = 0; m < 3; m++)
        for (uint32_t depth = 1; depth <= 64; depth *= 2) {
            int warnings;
            const rt_render_options options = {.mode = modes[m],
                                               .max_depth = depth,
                                               .roulette_depth = depth,
                                               .photons = 1000,
                                               .k = 2};
            const rt_film_stats stats = stats_of(mirrors, options, &warnings);
            const double lost = pow(reflectance, depth);
            assert_float_equal(stats.cut_off_throughput, lost, 1e-4);
            assert_float_equal(stats.cut_off_in_block, lost, 1e-4);
            assert_int_equal(warnings, depth > 2 && lost > 0.02);
        }
}

/* Fuzz reflects, too; of it and kd the brighter one counts. */
static void cloth_is_cut_off_as_other_surfaces_are(void **state)
{
    static const char felt[] = "camera { projection orthographic  eye 0 0 0  look_at 0 0 1  width "
                               "0.1 }\nmaterial felt { kd 0.3  fuzz 0.8  fuzz_roughness 0.5 }\n"
                               "plane { point 0 0 5  normal 0 0 -1  material felt }\n"
                               "light point { position 0 0 0  intensity 1 }\n";
    int warnings;
    (void)state;
    const rt_render_options options = {.mode = RT_MODE_PATH, .max_depth = 1};
    const rt_film_stats stats = stats_of(felt, options, &warnings);
    assert_float_equal(stats.cut_off_throughput, 0.8, 1e-4);
}

static void roulette_does_not_change_the_mean(void **state)
{
    int warnings;
    (void)state;
    const rt_render_options options = {.mode = RT_MODE_PATH, .max_depth = 24};
    const rt_film_stats stats = stats_of(mirrors, options, &warnings);
    /* 16384 paths, each cut off with at most 1/2. */
    assert_float_equal(stats.cut_off_throughput, pow(reflectance, 24), 0.012);
    assert_int_equal(warnings, 1);
}

static void photon_paths_lose_what_is_left_of_their_flux(void **state)
{
    int warnings;
    (void)state;
    for (uint32_t passes = 1; passes <= 2; passes++) {
        const rt_render_options options = {
            .mode = RT_MODE_PHOTON, .max_depth = 8, .photons = 100000, .passes = passes};
        const rt_film_stats stats = stats_of(mirrors, options, &warnings);
        assert_float_equal(stats.cut_off_flux, pow(reflectance, 7), 0.008);
        assert_int_equal(warnings, 1);
    }
}

/* Light that escapes, and what a black surface takes, is no loss of max_depth. */
static void other_ends_of_paths_do_not_count(void **state)
{
    static const char *const texts[] = {
        "camera { eye 0 0 0  look_at 0 0 1 }\nlight environment { radiance 1 }\n",
        "camera { eye 0 0 0  look_at 0 0 1 }\nmaterial black { kd 0 }\n"
        "plane { point 0 0 5  normal 0 0 -1  material black }\nlight point { intensity 1 "
        "position 0 0 0 }\n"};
    (void)state;
    for (int i = 0; i < 2; i++) {
        int warnings;
        const rt_render_options options = {.mode = RT_MODE_PATH, .max_depth = 1};
        const rt_film_stats stats = stats_of(texts[i], options, &warnings);
        assert_true(stats.cut_off_throughput == 0 && stats.cut_off_flux == 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(camera_paths_lose_what_the_last_surface_would_scatter),
        cmocka_unit_test(cloth_is_cut_off_as_other_surfaces_are),
        cmocka_unit_test(roulette_does_not_change_the_mean),
        cmocka_unit_test(photon_paths_lose_what_is_left_of_their_flux),
        cmocka_unit_test(other_ends_of_paths_do_not_count),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
