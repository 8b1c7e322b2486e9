/*
 * test_adaptive.c - adaptive sampling: pixels get samples by the noise around them, their means
 * have no bias, and the error that is told holds.
 */
#include "film/noise.h"
#include "film/rates.h"
#include "support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { side = 24, pixels = side * side, values = 3 * pixels, renders = 48, samples = 160 };

/* Most is a wall that glows evenly; a block on a floor has the soft shadow of a lamp. */
static const char room[] =
    "camera { eye 0 1 4  look_at 0 1 0  fov 50 }\n"
    "material white { kd 0.7 }\n"
    "material black { }\n"
    "quad { corner -9 -9 -3  edge1 18 0 0  edge2 0 18 0  material black  radiance 0.5 }\n"
    "quad { corner -0.7 0 -0.7  edge1 0 0 1.4  edge2 1.4 0 0  material white }\n"
    "box { centre 0 0.35 0  size 0.3 0.7 0.3  material white }\n"
    "quad { corner -2.5 3 -1  edge1 2 0 0  edge2 0 0 2  material black  radiance 4 }\n";

static rt_renderer *renderer;
static rt_error error;

static int make_renderer(void **state)
{
    (void)state;
    renderer = test_renderer(room);
    return 0;
}

static int destroy_renderer(void **state)
{
    (void)state;
    rt_renderer_destroy(renderer);
    return 0;
}

static rt_render_options options_of(rt_sampling sampling, uint32_t spp, uint32_t seed)
{
    return (rt_render_options){.width = side,
                               .height = side,
                               .spp = spp,
                               .seed = seed,
                               .max_depth = 4,
                               .sampling = sampling,
                               .variance = sampling == RT_SAMPLING_UNIFORM};
}

static rt_film *render(rt_sampling sampling, uint32_t spp, uint32_t seed)
{
    const rt_render_options options = options_of(sampling, spp, seed);
    rt_film *film = NULL;
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    return film;
}

/* ---- Rates ----------------------------------------------------------------------------------- */

/* The same rates by the formula of rates.h, through sums over rectangles. */
static void find_rates(double *out, const double *variances)
{
    static double sums[side + 1][side + 1];
    double mean = 0, all = 0;
    for (int y = 0; y < side; y++)
        for (int x = 0; x < side; x++)
            sums[y + 1][x + 1] =
                variances[y * side + x] + sums[y][x + 1] + sums[y + 1][x] - sums[y][x];
    for (int y = 0; y < side; y++)
        for (int x = 0; x < side; x++) {
            const int l = x < 4 ? 0 : x - 4, t = y < 4 ? 0 : y - 4;
            const int r = x + 5 > side ? side : x + 5, b = y + 5 > side ? side : y + 5;
            const double sum = sums[b][r] - sums[t][r] - sums[b][l] + sums[t][l];
            const double others = sum - variances[y * side + x];
            out[y * side + x] = sqrt(fmax(others, 0) / ((r - l) * (b - t) - 1));
            mean += out[y * side + x] / pixels;
        }
    for (int i = 0; i < pixels; i++) {
        out[i] = fmin(0.5 + 0.5 * out[i] / mean, 8);
        all += out[i] / pixels;
    }
    for (int i = 0; i < pixels; i++)
        out[i] /= all;
}

static void rates_follow_the_noise_around(void **state)
{
    static double variances[pixels], rates[pixels];
    rt_film *film = render(RT_SAMPLING_ADAPTIVE, RT_PILOT_SAMPLES, 1);
    double mean = 0, least = 1e9, most = 0;
    (void)state;
    assert_true(rt_rates_can_be_found(film));
    assert_false(rt_rates_are_known(film));
    for (size_t i = 0; i < pixels; i++) {
        float rgb[3];
        rt_noise_variance(rgb, film, i);
        variances[i] = (double)rgb[0] + rgb[1] + rgb[2];
    }
    find_rates(rates, variances);
    expect_ok(rt_rates_find(film, film, &error), &error);
    assert_true(rt_rates_are_known(film));
    for (size_t i = 0; i < pixels; i++) {
        assert_true(fabs(film->rates[i] - RT_RATE_UNIT * rates[i]) < 0.51);
        mean += film->rates[i] / (double)(RT_RATE_UNIT * pixels);
        least = fmin(least, film->rates[i]);
        most = fmax(most, film->rates[i]);
    }
    assert_true(fabs(mean - 1) < 0.002);
    assert_true(least > 0.4 * RT_RATE_UNIT && least < 0.8 * RT_RATE_UNIT);
    assert_true(most > 1.5 * RT_RATE_UNIT && most <= RT_RATE_MOST);
    rt_film_destroy(film);
}

/* But for the mean of all, which one pixel hardly changes. */
static void the_samples_of_a_pixel_do_not_set_its_rate(void **state)
{
    enum { one = 14 * side + 12 }; /* in the shadow */
    rt_film *film = render(RT_SAMPLING_ADAPTIVE, RT_PILOT_SAMPLES, 1);
    (void)state;
    expect_ok(rt_rates_find(film, film, &error), &error);
    const double before = film->rates[one], beside = film->rates[one + 1];
    for (size_t r = 1; r < film->units.replicates; r++) /* its sequences agree */
        film->pixels[r * pixels + one] = film->pixels[one];
    expect_ok(rt_rates_find(film, film, &error), &error);
    assert_true(fabs(film->rates[one] - before) < 0.02 * before);
    assert_true(film->rates[one + 1] != beside);
    rt_film_destroy(film);
}

static void a_black_picture_has_even_rates(void **state)
{
    const rt_render_options options = options_of(RT_SAMPLING_ADAPTIVE, 64, 1);
    rt_film *film = NULL;
    (void)state;
    expect_ok(rt_film_begin(&film, renderer, &options, &error), &error);
    expect_ok(rt_rates_find(film, film, &error), &error);
    for (size_t i = 0; i < pixels; i++)
        assert_int_equal(film->rates[i], RT_RATE_UNIT);
    rt_film_destroy(film);
}

/* ---- Pictures -------------------------------------------------------------------------------- */

/* The samples of the whole film are as many as were asked for, to the rounding of rates. */
static void the_samples_are_as_many_as_asked_for(void **state)
{
    rt_film *film = render(RT_SAMPLING_ADAPTIVE, samples, 5);
    double count = 0, differ = 0;
    (void)state;
    for (size_t i = 0; i < (size_t)film->units.replicates * pixels; i++)
        count += film->pixels[i].count / (double)pixels;
    for (size_t i = 0; i < pixels; i++)
        differ += film->pixels[i].count != film->pixels[0].count;
    assert_true(fabs(count - samples) < 0.02 * samples);
    assert_true(differ > pixels / 2);
    rt_film_destroy(film);
}

/* Errors over many seeds beside a reference of many samples. */
typedef struct tally {
    double sum[values], squares[values]; /* of differences */
    double mean, mean_squares;           /* of the mean of the picture's */
    double error;                        /* mean squared, over all seeds */
    int within;                          /* renders whose bound holds */
} tally;

static void add_render(tally *t, const rt_film *film, const float *reference, double level)
{
    const float *rgb = rt_film_rgb(film);
    double mean = 0, squares = 0;
    for (int i = 0; i < values; i++) {
        const double d = (double)rgb[i] - reference[i];
        t->sum[i] += d;
        t->squares[i] += d * d;
        mean += d / values;
        squares += d * d / values;
    }
    t->mean += mean / renders;
    t->mean_squares += mean * mean / renders;
    t->error += squares / renders;
    t->within += sqrt(squares) / level <= film->stats.relative_error_bound;
}

static void means_have_no_bias_and_less_noise(void **state)
{
    static tally adaptive, uniform;
    rt_film *const exact = render(RT_SAMPLING_UNIFORM, 16384, 999);
    const float *const reference = rt_film_rgb(exact);
    double level = 0, chi = 0, noisy = 0;
    (void)state;
    for (int i = 0; i < values; i++)
        level += reference[i] / values;
    for (uint32_t seed = 0; seed < renders; seed++) {
        rt_film *a = render(RT_SAMPLING_ADAPTIVE, samples, seed),
                *b = render(RT_SAMPLING_UNIFORM, samples, seed);
        add_render(&adaptive, a, reference, level);
        add_render(&uniform, b, reference, level);
        rt_film_destroy(a);
        rt_film_destroy(b);
    }
    /* The mean of the picture, and those of all pixels: z^2 has a mean near 1. */
    const double spread = sqrt((adaptive.mean_squares - adaptive.mean * adaptive.mean) / renders);
    assert_true(fabs(adaptive.mean) < 4 * spread);
    for (int i = 0; i < values; i++) {
        const double mean = adaptive.sum[i] / renders;
        const double variance = adaptive.squares[i] / renders - mean * mean;
        if (variance > 0) {
            chi += mean * mean * (renders - 1) / variance;
            noisy++;
        }
    }
    assert_true(noisy > 150 && chi > 0.7 * noisy && chi < 1.3 * noisy);
    assert_true(adaptive.error < 0.7 * uniform.error);
    assert_true(adaptive.within >= 42); /* 95 % of 48 are 45.6; fewer than 42 have 1.4 % */
    rt_film_destroy(exact);
}

static void other_modes_refuse_or_ignore_it(void **state)
{
    rt_film *film = NULL;
    (void)state;
    rt_render_options options = options_of(RT_SAMPLING_ADAPTIVE, 1, 1);
    assert_int_equal(rt_render(&film, renderer, &options, &error), RT_ERROR_USAGE);
    assert_string_equal(error.field, "sampling");
    options = options_of(RT_SAMPLING_ADAPTIVE, 4, 1);
    options.mode = RT_MODE_VCM;
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    assert_null(film->rates);
    rt_film_destroy(film);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rates_follow_the_noise_around),
        cmocka_unit_test(the_samples_of_a_pixel_do_not_set_its_rate),
        cmocka_unit_test(a_black_picture_has_even_rates),
        cmocka_unit_test(the_samples_are_as_many_as_asked_for),
        cmocka_unit_test(means_have_no_bias_and_less_noise),
        cmocka_unit_test(other_modes_refuse_or_ignore_it),
    };
    return cmocka_run_group_tests_name("lib/mode/adaptive", tests, make_renderer, destroy_renderer);
}
