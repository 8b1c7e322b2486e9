/*
 * test_merge_radius.c - with what radii mode vcm merges by default, where light is concentrated in
 * a small part of a large scene, and what it tells of the bias of merging.
 *
 * Bounds are of five standard deviations over 14 seeds, at least, beyond the means of these.
 */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/statistics.h"

/*
 * A spot light of 3 degrees, 2 m above a floor of 40 m, through a pane: a delta light behind smooth
 * glass, which merging and light tracing alone find. Seen from below the pane, `width` wide.
 */
static const char spot[] =
    "camera { projection orthographic  width %s  eye 0 0.2 0  look_at 0 0 0  up 0 0 -1 }\n"
    "material white { kd 0.5 }\nmaterial glass { kt 1  fresnel dielectric  ior 1.5 }\n"
    "quad { corner -20 0 20  edge1 40 0 0  edge2 0 0 -40  material white }\n"
    "box { centre 0 0.5 0  size 4 0.02 4  material glass }\n"
    "light spot { position 0 2 0  target 0 0 0  outer 3  inner 2.9  intensity 10 }\n";

enum { side = 32 };

static rt_film *render(const char *text, rt_render_options options)
{
    rt_renderer *renderer = test_renderer(text);
    rt_film *film = NULL;
    rt_error error;
    options.seed = test_seed(1);
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    rt_renderer_destroy(renderer);
    return film;
}

/* Out of view, of a power of 0.42 W beside 0.086: it has most of the light paths. */
static const char far_light[] =
    "light spot { position -15 3 0  target -15 0 0  outer 30  intensity 0.5 }\n";

static rt_film *render_spot(const char *width, const char *rest)
{
    char text[sizeof spot + sizeof far_light + 16];
    snprintf(text, sizeof text, spot, width);
    strcat(text, rest);
    return render(
        text, (rt_render_options){.mode = RT_MODE_VCM, .width = side, .height = side, .spp = 64});
}

/* The mean of green over the middle x0 <= x, y < x1. */
static double mean_of(const rt_film *film, uint32_t x0, uint32_t x1)
{
    double sum = 0;
    for (uint32_t y = x0; y < x1; y++)
        for (uint32_t x = x0; x < x1; x++)
            sum += (double)rt_film_rgb(film)[3 * (y * side + x) + 1];
    return sum / (x1 - x0) / (x1 - x0);
}

/*
 * Radiance below the spot: kd / pi I T / d^2, with T = (1 - R) / (1 + R) of a pane, R = 0.04, and
 * the distance shorter by what the pane lifts the light, its thickness times 1 - 1/1.5.
 */
static double radiance_of_spot(void)
{
    const double d = 2 - 0.02 / 3;
    return 0.5 / 3.14159265358979 * 10 * (0.96 / 1.04) / (d * d);
}

static void a_small_spot_is_as_bright_as_its_light(void **state)
{
    (void)state;
    rt_film *film = render_spot("0.2", "");
    /* over the seeds 1.003 of it, with a deviation of 0.0032 */
    expect_close(mean_of(film, 12, 20) / radiance_of_spot(), 1, 0.02, "a small spot");
    rt_film_destroy(film);
}

/*
 * Most pixels see none of it, and those beside it do not gather what is lit. The pane sends 1.7 %
 * of the light back to the floor; the rest of what is too much is bias of merging, as radii that
 * differ from pixel to pixel do not keep the power. With 2000 iterations 1.018 of it is left.
 */
static void a_spot_in_a_wide_view_keeps_its_power(void **state)
{
    (void)state;
    rt_film *film = render_spot("1.6", far_light);
    /* Its cosine falls from 1 to 0.9986, its edge from 2.9 to 3 degrees. */
    const double radius =
                     0.5 * (tan(2.9 * 3.14159265358979 / 180) + tan(3 * 3.14159265358979 / 180)),
                 distance = 2 - 0.02 / 3;
    const double area = 3.14159265358979 * pow(radius * distance, 2);
    const double expected = radiance_of_spot() * area / (1.6 * 1.6);
    /* 1.030 of it, with a deviation of 0.0066; the spot 0.996, with 0.014; 0.00015 beside it */
    expect_close(mean_of(film, 0, side) / expected, 1, 0.07, "the power of a spot");
    expect_close(mean_of(film, 15, 17) / radiance_of_spot(), 1, 0.08, "the middle of a spot");
    expect_close(mean_of(film, 0, 8) / radiance_of_spot(), 0, 0.002, "beside a spot");
    rt_film_destroy(film);
}

/*
 * A block in a spot light stands on a wide floor, which it lights: what most pixels see is dark,
 * and discs as large as these would want are larger than the lit top of the block.
 */
static const char block[] =
    "camera { eye 0 4 -7  look_at 0 0.4 0  fov 45 }\nmaterial white { kd 0.7 }\n"
    "quad { corner -300 0 -300  edge1 0 0 600  edge2 600 0 0  material white }\n"
    "box { centre 0 0.4 0  size 1.2 0.8 1.2  material white }\n"
    "light spot { position 1 4 -1  target 0.1 0 0  intensity 50  outer 12 }\n";

static void a_lit_place_beyond_what_pixels_see_keeps_its_light(void **state)
{
    rt_render_options options = {.mode = RT_MODE_VCM, .width = side, .height = side, .spp = 64};
    (void)state;
    rt_film *film = render(block, options);
    options.spp = 256;
    options.techniques = RT_TECHNIQUES_BPT;
    rt_film *reference = render(block, options);
    /* over the seeds 0.997 of it, with a deviation of 0.0010 */
    expect_close(mean_of(film, 0, side) / mean_of(reference, 0, side), 1, 0.012, "all of it");
    rt_film_destroy(film);
    rt_film_destroy(reference);
}

/* ---- Folds ------------------------------------------------------------------------ */

/*
 * A fold of 50 degrees, seen from above its left side, which the light grazes at one degree. Its
 * radiance there is kd / pi E sin(1 degree). Merging within 0.05 m finds light vertices beyond the
 * fold, too, where they are dense.
 */
static const char fold[] =
    "camera { projection orthographic  width 0.08  eye -0.79175 0.61215 0\n"
    "         look_at -0.0257115 -0.0306418 0  up 0 0 1 }\n"
    "material white { kd 0.5 }\n"
    "quad { corner 0 0 0.1  edge1 0.2 0 0  edge2 0 0 -0.2  material white }\n"
    "quad { corner 0 0 -0.1  edge1 -0.0964181 -0.1149067 0  edge2 0 0 0.2  material white }\n"
    "light directional { direction -0.6293204 -0.7771460 0  irradiance 1 }\n";

static void light_beyond_a_fold_is_no_brighter_here(void **state)
{
    (void)state;
    rt_film *film = render(fold, (rt_render_options){.mode = RT_MODE_VCM,
                                                     .width = side,
                                                     .height = side,
                                                     .spp = 64,
                                                     .radius = 0.05f,
                                                     .techniques = RT_TECHNIQUES_MERGING});
    const double pi = 3.14159265358979, expected = 0.5 / pi * sin(pi / 180);
    /* over the seeds 1.00 of it, with a deviation of 0.034 */
    expect_close(mean_of(film, 0, side) / expected, 1, 0.17, "beside a fold");
    rt_film_destroy(film);
}

/* ---- Bias ------------------------------------------------------------------------- */

static const char room[] =
    "camera { eye 0 1.2 -0.95  look_at 0 0.2 0.6  fov 55 }\n"
    "material white { kd 0.7 }\nmaterial emitter { emission 3 }\n"
    "box { centre 0 1 0  size 2 2 2  material white }\n"
    "quad { corner -0.25 1.95 -0.25  edge1 0.5 0 0  edge2 0 0 0.5  material emitter }\n"
    "box { centre -0.3 0.3 0.4  size 0.5 0.6 0.5  material white }\n";

enum { width = 48, height = 36, values = 3 * width * height };

static rt_film *render_room(rt_mode mode, uint32_t spp, float radius)
{
    return render(room, (rt_render_options){.mode = mode,
                                            .width = width,
                                            .height = height,
                                            .spp = spp,
                                            .max_depth = 4,
                                            .radius = radius,
                                            .techniques = RT_TECHNIQUES_VCM,
                                            .alpha = 0.9999f});
}

/* The root mean square difference from the reference, over its mean. */
static double relative_rmse(const rt_film *film, const rt_film *reference)
{
    const float *a = rt_film_rgb(film), *b = rt_film_rgb(reference);
    double squares = 0, sum = 0;
    for (size_t i = 0; i < values; i++) {
        squares += pow((double)a[i] - (double)b[i], 2);
        sum += (double)b[i];
    }
    return sqrt(squares * values) / sum;
}

/* A disc so large that bias is most of what a picture is off. */
static void the_bias_of_merging_is_told(void **state)
{
    rt_film_stats stats;
    (void)state;
    rt_film *reference = render_room(RT_MODE_PATH, 512, 0),
            *film = render_room(RT_MODE_VCM, 64, 0.2f);
    const double off = relative_rmse(film, reference);
    rt_film_get_stats(film, &stats);
    /* off by 0.183, with a deviation of 0.002; of that 1.12 is told, with 0.10 */
    assert_true(off > 0.05);
    expect_close(stats.relative_bias / off, 1.12, 0.52, "the bias");
    /* whose bound is 1.30 of it, with 0.036 */
    expect_close(stats.relative_bias / stats.relative_bias_bound, 0, 1, "the bias in its bound");
    rt_film_destroy(film);
    rt_film_destroy(reference);
}

/* Techniques without merging have none. */
static void without_merging_no_bias_is_told(void **state)
{
    rt_film_stats stats;
    (void)state;
    rt_film *film = render(room, (rt_render_options){.mode = RT_MODE_VCM,
                                                     .width = width,
                                                     .height = height,
                                                     .spp = 8,
                                                     .techniques = RT_TECHNIQUES_BPT});
    rt_film_get_stats(film, &stats);
    assert_true(stats.relative_bias == 0 && stats.relative_bias_bound == 0);
    rt_film_destroy(film);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(a_small_spot_is_as_bright_as_its_light),
        statistical_test(a_spot_in_a_wide_view_keeps_its_power),
        statistical_test(a_lit_place_beyond_what_pixels_see_keeps_its_light),
        statistical_test(light_beyond_a_fold_is_no_brighter_here),
        statistical_test(the_bias_of_merging_is_told),
        cmocka_unit_test(without_merging_no_bias_is_told),
    };
    return cmocka_run_group_tests_name("lib/mode/merge_radius", tests, NULL, NULL);
}
