/*
 * test_bias.c - bias and noise of photon passes by their moments: of moments that are known, and of
 * pictures whose bias is known.
 */
#include "kernels/rays.h"
#include "kernels/statistics.h"
#include "support.h"

#include <math.h>
#include <string.h>

#include "camera/film_sum.h"
#include "film/bias.h"

enum { side = 64, pixels = side * side, measured = 8, passes = 32, all_passes = 40 };

static void add(rt_film_pixel *pixel, const float value[3])
{
    const film_sums sums = film_sums_of(pixel);
    for (int c = 0; c < 3; c++) {
        rt_u32 bits;
        memcpy(&bits, value + c, sizeof bits);
        film_add_bits(sums, c, bits);
    }
    pixel->count++;
    pixel->weight++;
}

/* A kind of bias: what discs of twice and of four times the area change, over the bias. */
typedef struct kind {
    float twice, four_times;
} kind;

static const kind smooth = {1, 3}, edges = {0.311f, 0.6573f};

/* Passes of radiance 2 with even noise from -n to n, and larger discs with such differences. */
static rt_film_bias of_moments(kind kind, float bias, float n)
{
    const rt_render_options o = {
        .mode = RT_MODE_PHOTON, .width = side, .height = side, .passes = passes, .spp = 1};
    const float expected[2] = {kind.twice * bias, kind.four_times * bias};
    rays_stream random = {test_seed(5)};
    rt_film *film = NULL;
    rt_error error;
    expect_ok(rt_film_create(&film, &o, NULL, &error), &error);
    for (int i = 0; i < pixels; i++)
        for (int p = 0; p < passes; p++) {
            float value[3], difference[2][3], squares[3] = {0, 0, 0};
            for (int c = 0; c < 3; c++) {
                value[c] = 2 + n * (2 * (float)rays_uniform(&random) - 1);
                squares[0] += value[c] * value[c];
                for (int d = 0; d < 2; d++) {
                    difference[d][c] = expected[d] + n * (2 * (float)rays_uniform(&random) - 1);
                    squares[1 + d] += p < measured ? difference[d][c] * difference[d][c] : 0;
                }
            }
            add(film->pixels + i, value);
            for (int d = 0; d < 2 && p < measured; d++)
                add(film->moments + d * pixels + i, difference[d]);
            add(film->moments + 2 * pixels + i, squares);
        }
    const rt_film_bias found = rt_film_find_bias(film);
    rt_film_destroy(film);
    return found;
}

static void moments_tell_bias_without_noise_and_noise(void **state)
{
    (void)state;
    /* The variance of even numbers from -n to n is n^2/3. */
    const rt_film_bias some = of_moments(smooth, 0.2f, 0.25f), none = of_moments(smooth, 0, 1);
    print_message("bias %.4f below %.4f of 0.1; without bias %.4f below %.4f; noise %.4f of %.4f\n",
                  some.bias, some.bound, none.bias, none.bound, some.noise,
                  sqrt(0.0625 / 3 / passes) / 2);
    assert_true(fabs(some.bias - 0.1) < 0.015);
    assert_true(some.bound > some.bias && some.bound < 0.13);
    assert_true(none.bias < 0.07 && none.bound < 0.08 && none.bound > none.bias);
    assert_true(fabs(some.noise - sqrt(0.0625 / 3 / passes) / 2) < 0.0005);
}

/* Half of the squares from each kind: D_4^2 / D_2^2 is not its mean, but B is still the same. */
static void bias_at_edges_and_in_smooth_light_is_told(void **state)
{
    (void)state;
    const kind both = {sqrtf(0.5f * (1 + edges.twice * edges.twice)),
                       sqrtf(0.5f * (9 + edges.four_times * edges.four_times))};
    const double at_edges = of_moments(edges, 0.4f, 0.1f).bias,
                 in_both = of_moments(both, 0.4f, 0.1f).bias;
    print_message("bias at edges %.4f, of both kinds %.4f, of 0.2\n", at_edges, in_both);
    assert_true(fabs(at_edges - 0.2) < 0.004);
    assert_true(fabs(in_both - 0.2) < 0.004);
}

/* ---- Pictures ----------------------------------------------------------------- */

/* A peak of light below a point light, which a disc makes too low by an amount that goes by r^2. */
static const char peak[] =
    "material grey { kd 0.5 }\nquad { corner -2 -2 0  edge1 4 0 0  edge2 0 4 0  material grey }\n"
    "light point { position 0 0 0.25  intensity 1 }\n"
    "camera { projection orthographic  eye 0 0 0.2  look_at 0 0 0  up 0 1 0  width 0.1 }\n";

static rt_film *render(float radius, float target)
{
    const rt_render_options o = {.mode = RT_MODE_PHOTON,
                                 .width = 16,
                                 .height = 16,
                                 .passes = target > 0 ? all_passes : passes,
                                 .photons = 20000,
                                 .radius = radius,
                                 .alpha = 0.999f,
                                 .direct = RT_DIRECT_PHOTONS,
                                 .target_error = target};
    rt_film *film = NULL;
    rt_error error;
    rt_renderer *renderer = test_renderer(peak);
    expect_ok(rt_render(&film, renderer, &o, &error), &error);
    rt_renderer_destroy(renderer);
    return film;
}

static double mean_of(const rt_film *film)
{
    double sum = 0;
    for (int i = 0; i < 3 * 16 * 16; i++)
        sum += rt_film_rgb(film)[i] / (3.0 * 16 * 16);
    return sum;
}

/*
 * In smooth light; the next order of the expansion takes a little of the differences away, most of
 * that by four times the area, so that some of the bias is taken for that of edges.
 */
static void the_bias_of_a_peak_is_told(void **state)
{
    rt_film *film = render(0.05f, 0), *sharp = render(0.02f, 0);
    rt_film_stats stats;
    (void)state;
    const double bias = 25 / 21.0 * (1 - mean_of(film) / mean_of(sharp));
    rt_film_get_stats(film, &stats);
    print_message("bias %.4f, told %.4f below %.4f\n", bias, stats.relative_bias,
                  stats.relative_bias_bound);
    assert_true(stats.relative_bias > 1.4 * bias && stats.relative_bias < 1.9 * bias);
    assert_true(stats.relative_bias_bound > stats.relative_bias);
    assert_true(stats.relative_bias_bound < 1.2 * stats.relative_bias);
    rt_film_destroy(film);
    rt_film_destroy(sharp);
}

/* They spread its light over their area, and change as little as there is left of it. */
static void the_bias_of_discs_larger_than_what_is_lit_is_unknown(void **state)
{
    rt_film *film = render(100, 0.9f);
    rt_film_stats stats;
    (void)state;
    rt_film_get_stats(film, &stats);
    assert_true(isinf(stats.relative_bias) && isinf(stats.relative_bias_bound));
    assert_true(isfinite(stats.relative_noise));
    assert_int_equal(stats.passes, all_passes);
    rt_film_destroy(film);
}

/* The noise is below the target at the first test, after 32 passes; the bias never is. */
static void a_target_counts_the_bias(void **state)
{
    rt_film *film = render(0.1f, 0.06f);
    rt_film_stats stats;
    (void)state;
    rt_film_get_stats(film, &stats);
    print_message("noise below %.4f, bias below %.4f\n", stats.relative_error_bound,
                  stats.relative_bias_bound);
    assert_true(stats.relative_error_bound < 0.06);
    assert_true(stats.relative_bias > 0.06 && isfinite(stats.relative_bias_bound));
    assert_int_equal(stats.passes, all_passes);
    rt_film_destroy(film);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(moments_tell_bias_without_noise_and_noise),
        cmocka_unit_test(bias_at_edges_and_in_smooth_light_is_told),
        cmocka_unit_test(the_bias_of_a_peak_is_told),
        cmocka_unit_test(the_bias_of_discs_larger_than_what_is_lit_is_unknown),
        cmocka_unit_test(a_target_counts_the_bias),
    };
    return cmocka_run_group_tests_name("lib/film/bias", tests, NULL, NULL);
}
