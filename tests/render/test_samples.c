/*
 * No sample of the scenes that ship is infinite or not a number: in path and in photon mode none is
 * rejected, nor any photon, and every pixel is finite.
 *
 * RT_TEST_SAMPLES samples (default 4 x 10^6) are shared by the scenes in path mode, and a tenth as
 * many, which are slower, in photon mode, with as many photon paths. What was drawn is printed as a
 * table.
 */
#include <glob.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support.h"

/* Factor by which pictures are smaller than in the scenes: samples count here, not pixels. */
#define SHRINK 4u

/* So many passes at most share the samples and photons of a scene that asks for passes. */
#define PASSES 4u

static glob_t scenes;
static double samples_wanted = 4e6;

static rt_film *render(const char *path, rt_mode mode, double samples)
{
    rt_scene *scene = NULL;
    rt_renderer *renderer = NULL;
    rt_film *film = NULL;
    rt_error error;
    rt_render_options options;

    expect_ok(rt_scene_load(&scene, path, NULL, &error), &error);
    rt_scene_get_options(scene, &options);
    options.mode = mode;
    options.width = (options.width ? options.width : 512) / SHRINK;
    options.height = (options.height ? options.height : 512) / SHRINK;
    if (options.passes > PASSES)
        options.passes = PASSES;
    const double passes = mode == RT_MODE_PHOTON && options.passes > 1 ? options.passes : 1;
    options.spp = (uint32_t)ceil(samples / ((double)options.width * options.height * passes));
    options.photons = (uint64_t)ceil(samples / passes);
    options.gather = RT_GATHER_DEVICE; /* the faster one */
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
    return film;
}

static uint64_t count_not_finite(const rt_film *film, uint64_t pixels)
{
    const float *rgb = rt_film_rgb(film);
    uint64_t count = 0;
    for (uint64_t i = 0; i < pixels; i++)
        count += !(isfinite(rgb[3 * i]) && isfinite(rgb[3 * i + 1]) && isfinite(rgb[3 * i + 2]));
    return count;
}

static void expect_finite_samples(rt_mode mode, const char *mode_name, double samples)
{
    uint64_t drawn = 0, rejected = 0, photons_rejected = 0, not_finite = 0;
    printf("%-28s %-7s %12s %9s %12s %9s %17s\n", "scene", "mode", "samples", "rejected", "photons",
           "rejected", "pixels not finite");
    for (size_t i = 0; i < scenes.gl_pathc; i++) {
        const char *path = scenes.gl_pathv[i];
        rt_film *film = render(path, mode, samples / (double)scenes.gl_pathc);
        rt_film_stats stats;
        uint32_t width, height;
        rt_film_get_stats(film, &stats);
        rt_film_get_size(film, &width, &height);
        uint64_t pixels = (uint64_t)width * height, wrong = count_not_finite(film, pixels);
        rt_film_destroy(film);
        printf("%-28s %-7s %12llu %9llu %12llu %9llu %17llu\n", path, mode_name,
               (unsigned long long)(pixels * stats.spp), (unsigned long long)stats.rejected,
               (unsigned long long)stats.photons_stored, (unsigned long long)stats.photons_rejected,
               (unsigned long long)wrong);
        fflush(stdout);
        drawn += pixels * stats.spp;
        rejected += stats.rejected;
        photons_rejected += stats.photons_rejected;
        not_finite += wrong;
    }
    printf("%-28s %-7s %12llu %9llu %12s %9llu %17llu\n", "all", mode_name,
           (unsigned long long)drawn, (unsigned long long)rejected, "",
           (unsigned long long)photons_rejected, (unsigned long long)not_finite);
    assert_true((double)drawn >= samples);
    assert_int_equal(rejected, 0);
    assert_int_equal(photons_rejected, 0);
    assert_int_equal(not_finite, 0);
}

static void every_sample_of_path_tracing_is_finite(void **state)
{
    (void)state;
    expect_finite_samples(RT_MODE_PATH, "path", samples_wanted);
}

static void every_sample_of_photon_mapping_is_finite(void **state)
{
    (void)state;
    expect_finite_samples(RT_MODE_PHOTON, "photon", samples_wanted / 10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_sample_of_path_tracing_is_finite),
        cmocka_unit_test(every_sample_of_photon_mapping_is_finite),
    };
    const char *wanted = getenv("RT_TEST_SAMPLES");
    if (wanted)
        samples_wanted = strtod(wanted, NULL);
    if (!(samples_wanted >= 1 && samples_wanted <= 1e12)) {
        fprintf(stderr, "RT_TEST_SAMPLES is a number from 1 to 1e12, not \"%s\"\n", wanted);
        return 1;
    }
    if (glob("scenes/*.rts", 0, NULL, &scenes) != 0) {
        fprintf(stderr, "no scenes/*.rts here: run from the top directory\n");
        return 1;
    }
    int failed = cmocka_run_group_tests_name("render/samples", tests, NULL, NULL);
    globfree(&scenes);
    return failed;
}
