/*
 * test_convergence.c - how fast the noise falls as samples grow, for both samplers: the slope of
 * log RMSE against log samples, -1/2 for independent samples and steeper for Sobol points.
 *
 * The mean square of a pixel's noise is its variance over the renders, so that no reference is
 * needed; that the means are right is for the other tests. The slope's standard error is that of
 * the jackknife (Efron and Stein 1981).
 */
#include <math.h>

#include "chance.h"
#include "proof/page.h"
#include "proof/proof.h"
#include "proof/room.h"

enum { octaves = 9, side = 12 }; /* 1 to 256 samples */

/*
 * Root of the mean variance of the green pixels over the renders but `without`, over their mean;
 * -1: over all.
 */
static double noise(const proof_films *films, int without)
{
    const int n = proof_renders - (without >= 0);
    const size_t pixels = (size_t)films->width * films->height;
    double squares = 0, total = 0;
    for (size_t i = 0; i < pixels; i++) {
        double mean = 0, sum = 0;
        for (int k = 0; k < proof_renders; k++)
            mean += k == without ? 0 : films->rgb[k][3 * i + 1] / n;
        for (int k = 0; k < proof_renders; k++)
            sum += k == without
                       ? 0
                       : (films->rgb[k][3 * i + 1] - mean) * (films->rgb[k][3 * i + 1] - mean);
        squares += sum / (n - 1);
        total += mean;
    }
    return sqrt(squares * (double)pixels) / total;
}

/* Of the straight line that fits best. */
static double slope_of(const double log_noise[octaves])
{
    double mean = (octaves - 1) / 2.0, above = 0, below = 0;
    for (int i = 0; i < octaves; i++) {
        above += (i - mean) * log_noise[i];
        below += (i - mean) * (i - mean);
    }
    return above / (below * log(2));
}

/*
 * Renders with 1, 2, 4, ... samples. Writes the noise at each and the slope's jackknife values,
 * whose mean it is.
 */
static void measure(const char *text, rt_sampler sampler, double rmse[octaves],
                    proof_values *slopes)
{
    double logs[proof_renders + 1][octaves];
    for (int i = 0; i < octaves; i++) {
        rt_render_options options = {.width = side,
                                     .height = side,
                                     .spp = 1u << i,
                                     .sampler = sampler,
                                     .seed = 100u * (uint32_t)i};
        proof_films films;
        proof_render(&films, text, &options);
        for (int without = -1; without < proof_renders; without++)
            logs[without + 1][i] = log(noise(&films, without));
        rmse[i] = exp(logs[0][i]);
        proof_free(&films);
    }
    for (int k = 0; k < proof_renders; k++)
        slopes->of[k] =
            proof_renders * slope_of(logs[0]) - (proof_renders - 1) * slope_of(logs[k + 1]);
}

static void mean_and_error(const proof_values *values, double *mean, double *error)
{
    double squares = 0;
    *mean = 0;
    for (int i = 0; i < proof_renders; i++)
        *mean += values->of[i] / proof_renders;
    for (int i = 0; i < proof_renders; i++)
        squares += (values->of[i] - *mean) * (values->of[i] - *mean);
    *error = sqrt(squares / (proof_renders * (proof_renders - 1.0)));
}

/*
 * The slope is -1/2 for independent samples, and at most `bound` for Sobol points, by 7 standard
 * errors.
 */
static void expect_slope(const char *scene, const char *text, rt_sampler sampler, double bound)
{
    double rmse[octaves], slope, error;
    proof_values slopes;
    measure(text, sampler, rmse, &slopes);
    mean_and_error(&slopes, &slope, &error);
    chance_spend(PROOF_FALSE_ALARM);
    const int is_sobol = sampler == RT_SAMPLER_SOBOL;
    page_row(
        proof_text("%s, %s: slope %s%g\n ", scene, is_sobol ? "Sobol" : "independent",
                   is_sobol ? "below " : "", bound),
        proof_text("measured %.3f, standard error %.3f; relative RMSE %.4f, %.4f, %.4f, %.4f, %.4f",
                   slope, error, rmse[0], rmse[2], rmse[4], rmse[6], rmse[8]));
    if (!(slope < bound + 7 * error && (is_sobol || slope > bound - 7 * error)))
        fail_msg("%s, sampler %d: slope %.4f with a standard error of %.4f", scene, sampler, slope,
                 error);
}

#define LIGHT_OVER_FLOOR                                                                           \
    "camera { eye 0 2 2  look_at 0 0 0  fov 40 }\nmaterial white { kd 0.8 }\nmaterial emitter { "  \
    "emission 4 }\n"                                                                               \
    "plane { point 0 0 0  normal 0 1 0  material white }\n"                                        \
    "quad { corner -0.5 1 -1.5  edge1 1 0 0  edge2 0 0.3 1  material emitter }\n"

static void independent_samples_by_the_root(void **state)
{
    (void)state;
    expect_slope("area light over a floor", LIGHT_OVER_FLOOR, RT_SAMPLER_INDEPENDENT, -0.5);
    expect_slope("room", ROOM, RT_SAMPLER_INDEPENDENT, -0.5);
}

static void sobol_points_faster(void **state)
{
    (void)state;
    expect_slope("area light over a floor", LIGHT_OVER_FLOOR, RT_SAMPLER_SOBOL, -0.7);
    expect_slope("room", ROOM, RT_SAMPLER_SOBOL, -0.52);
}

static void the_page_has_the_rows(void **state)
{
    (void)state;
    page_section("Convergence");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(independent_samples_by_the_root),
        cmocka_unit_test(sobol_points_faster),
        cmocka_unit_test(the_page_has_the_rows),
    };
    return cmocka_run_group_tests_name("proof/convergence", tests, NULL, NULL);
}
