/*
 * test_noise.c - the error that a render estimates is right: for each pixel, for the whole picture,
 * and with target_error.
 *
 * Over 64 renders the share of pixels whose interval contains the exact value has a standard error
 * below 0.4 %. Of the pictures 95 of 100 or more are within their bound: how many are not has a
 * binomial distribution.
 */
#include "kernels/statistics.h"
#include "support.h"

#include <math.h>
#include <string.h>

enum { side = 16, values = 3 * side * side, renders = 64, samples = 64, reference_samples = 8192 };

/* An open box with a block, under a light out of sight: soft shadows and colour bleeding. */
static const char box[] =
    "camera { eye 0 -0.2 -3.4  look_at 0 -0.35 0  fov 30 }\n"
    "material white { kd 0.73 }\n"
    "material red   { kd 0.65 0.05 0.05 }\n"
    "material green { kd 0.12 0.45 0.15 }\n"
    "material black { kd 0 }\n"
    "quad { corner -1 -1 -1  edge1 0 0 2  edge2 2 0 0  material white }\n"
    "quad { corner -1  1 -1  edge1 2 0 0  edge2 0 0 2  material white }\n"
    "quad { corner -1 -1  1  edge1 0 2 0  edge2 2 0 0  material white }\n"
    "quad { corner  1 -1 -1  edge1 0 0 2  edge2 0 2 0  material red }\n"
    "quad { corner -1 -1 -1  edge1 0 2 0  edge2 0 0 2  material green }\n"
    "quad { corner -0.4 0.99 -0.4  edge1 0.8 0 0  edge2 0 0 0.8  material black  radiance 6 }\n"
    "sphere { centre 0.3 -0.65 0.1  radius 0.35  material white }\n";

enum { filters = RT_FILTER_MITCHELL + 1 };

static rt_renderer *renderer;
static struct {
    rt_film *film;
    uint32_t seed;
} references[filters];
static rt_error error;

static int make_renderer(void **state)
{
    rt_scene *scene = NULL;
    (void)state;
    expect_ok(rt_scene_parse(&scene, box, "box", NULL, &error), &error);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    rt_scene_destroy(scene);
    return 0;
}

static int destroy_renderer(void **state)
{
    (void)state;
    for (int i = 0; i < filters; i++)
        rt_film_destroy(references[i].film);
    rt_renderer_destroy(renderer);
    return 0;
}

static rt_render_options path_options(rt_sampler sampler, rt_filter filter)
{
    rt_render_options options = {.width = side,
                                 .height = side,
                                 .spp = samples,
                                 .max_depth = 4,
                                 .variance = 1,
                                 .sampler = sampler,
                                 .filter = filter};
    return options;
}

static rt_film *render(const rt_render_options *options)
{
    rt_film *film = NULL;
    expect_ok(rt_render(&film, renderer, options, &error), &error);
    return film;
}

static const float *variance_of(const rt_film *film)
{
    uint32_t channels = 0;
    const float *variance = rt_film_layer(film, "variance", &channels);
    assert_non_null(variance);
    assert_int_equal(channels, 3);
    return variance;
}

/* The results of a series of renders with fixed seeds. */
typedef struct tally {
    double inside, pictures;            /* of pixels and pictures */
    double estimated_mse, measured_mse; /* sums */
    double spp;
} tally;

/*
 * Compares a film with the exact picture, known up to exact_variance: `factor` widens the film's
 * own variance. limit is what the picture's relative error should be below.
 */
static void count(tally *t, const rt_film *film, const float *exact, const float *exact_variance,
                  double factor, double limit)
{
    const float *rgb = rt_film_rgb(film), *variance = variance_of(film);
    double mse = 0, mean = 0;
    rt_film_stats stats;
    rt_film_get_stats(film, &stats);
    assert_int_equal(stats.replicates, 8);
    assert_float_equal(stats.interval_factor, 2.3646, 0.002);
    for (int i = 0; i < values; i++) {
        double off = rgb[i] - exact[i], unknown = exact_variance ? exact_variance[i] : 0;
        /* A pixel without noise differs by rounding alone. */
        t->inside += fabs(off) <=
                     stats.interval_factor * sqrt(factor * variance[i] + unknown) + 1e-6 * exact[i];
        mse += off * off / factor - unknown;
        mean += exact[i];
    }
    t->pictures += sqrt(fmax(mse / values, 0)) <= limit * mean / values;
    t->estimated_mse += pow(stats.relative_error * mean / values, 2);
    t->measured_mse += mse / values;
    t->spp += stats.spp;
}

/* Of so many pictures, few enough are beyond their bound. */
static void expect_within_bound(double pictures, int films)
{
    double term = pow(0.95, films), below = 0;
    const int beyond = films - (int)pictures;
    for (int i = 0; i < beyond; i++) {
        below += term;
        term *= (double)(films - i) / (i + 1) * (0.05 / 0.95);
    }
    chance_compare(1 - below, "%d of %d pictures are beyond their bound", beyond, films);
}

static void expect_calibrated(const char *what, const tally *t, int films)
{
    double inside = t->inside / ((double)films * values),
           ratio = sqrt(t->estimated_mse / t->measured_mse);
    print_message("%s: %.2f %% of pixels inside their interval, error %.3f of the true one, %.0f "
                  "of %d pictures below "
                  "their bound, %.0f samples\n",
                  what, 100 * inside, ratio, t->pictures, films, t->spp / films);
    expect_close(inside, 0.95, 0.02, "pixels inside their interval");
    expect_close(ratio, 1, 0.08, "estimated error");
    expect_within_bound(t->pictures, films);
}

/* ---- Path mode ---------------------------------------------------------------- */

/* Of a filter, rendered once for each seed; destroy_renderer frees the last ones. */
static const rt_film *reference(rt_filter filter)
{
    rt_render_options options = path_options(RT_SAMPLER_SOBOL, filter);
    const uint32_t seed = test_seed(1000000);
    if (!references[filter].film || references[filter].seed != seed) {
        rt_film_destroy(references[filter].film);
        options.spp = reference_samples;
        options.seed = references[filter].seed = seed;
        references[filter].film = render(&options);
    }
    return references[filter].film;
}

static void calibrate(const char *what, rt_sampler sampler, rt_filter filter)
{
    rt_render_options options = path_options(sampler, filter);
    const rt_film *exact = reference(filter);
    tally t = {0};
    for (int i = 0; i < renders; i++) {
        rt_film_stats stats;
        options.seed = test_seed((uint32_t)i);
        rt_film *film = render(&options);
        rt_film_get_stats(film, &stats);
        count(&t, film, rt_film_rgb(exact), variance_of(exact), 1, stats.relative_error_bound);
        rt_film_destroy(film);
    }
    expect_calibrated(what, &t, renders);
}

static void intervals_contain_the_exact_value_95_times_of_100(void **state)
{
    (void)state;
    calibrate("Sobol", RT_SAMPLER_SOBOL, RT_FILTER_BOX);
    calibrate("independent", RT_SAMPLER_INDEPENDENT, RT_FILTER_BOX);
}

static void they_do_so_with_other_filters(void **state)
{
    (void)state;
    calibrate("Sobol, Mitchell", RT_SAMPLER_SOBOL, RT_FILTER_MITCHELL);
    calibrate("independent, Gaussian", RT_SAMPLER_INDEPENDENT, RT_FILTER_GAUSSIAN);
}

static void a_target_is_reached_when_it_says_so(void **state)
{
    const double target = 0.039; /* at which some end with 64 samples and some with 96 */
    rt_render_options options = path_options(RT_SAMPLER_SOBOL, RT_FILTER_BOX);
    const rt_film *exact = reference(RT_FILTER_BOX);
    tally t = {0};
    (void)state;
    options.spp = 0;
    options.variance = 0;
    options.target_error = target;
    for (int i = 0; i < renders; i++) {
        rt_film_stats stats;
        options.seed = test_seed((uint32_t)i);
        rt_film *film = render(&options);
        rt_film_get_stats(film, &stats);
        assert_true(stats.relative_error_bound <= target);
        count(&t, film, rt_film_rgb(exact), variance_of(exact), 1, target);
        rt_film_destroy(film);
    }
    print_message("%.0f of %d below the target, %.0f samples\n", t.pictures, renders,
                  t.spp / renders);
    expect_within_bound(t.pictures, renders);
    assert_true(t.spp > 64 * renders && t.spp < 96 * renders);
}

/* ---- Two sequences -------------------------------------------------------------- */

enum { wide = 32, wide_values = 3 * wide * wide };

/* The mean squared difference of two pictures, the second known up to its variance. */
static double squared_error(const rt_film *film, const rt_film *exact, double *mean)
{
    const float *rgb = rt_film_rgb(film), *right = rt_film_rgb(exact),
                *unknown = variance_of(exact);
    double sum = 0;
    *mean = 0;
    for (int i = 0; i < wide_values; i++) {
        sum += pow(rgb[i] - right[i], 2) - unknown[i];
        *mean += right[i] / wide_values;
    }
    return fmax(sum / wide_values, 0);
}

/* A target alone takes two; the spread over the pixels gives the bound. */
static void a_target_of_a_large_picture_is_reached_with_two(void **state)
{
    const double target = 0.03;
    rt_render_options options = path_options(RT_SAMPLER_SOBOL, RT_FILTER_BOX);
    tally t = {0};
    (void)state;
    options.width = options.height = wide;
    options.spp = reference_samples;
    options.seed = test_seed(1000000);
    rt_film *exact = render(&options);
    options.spp = 0;
    options.variance = 0;
    options.target_error = target;
    for (int i = 0; i < renders; i++) {
        rt_film_stats stats;
        double mean;
        options.seed = test_seed((uint32_t)i);
        rt_film *film = render(&options);
        rt_film_get_stats(film, &stats);
        assert_int_equal(stats.replicates, 2);
        assert_true(stats.relative_error < stats.relative_error_bound &&
                    stats.relative_error_bound <= target);
        const double squared = squared_error(film, exact, &mean);
        t.pictures += sqrt(squared) <= target * mean;
        t.measured_mse += squared;
        t.estimated_mse += pow(stats.relative_error * mean, 2);
        t.spp += stats.spp;
        rt_film_destroy(film);
    }
    rt_film_destroy(exact);
    const double ratio = sqrt(t.estimated_mse / t.measured_mse);
    print_message("%.0f of %d below the target, error %.3f of the true one, %.1f samples\n",
                  t.pictures, renders, ratio, t.spp / renders);
    expect_within_bound(t.pictures, renders);
    expect_close(ratio, 1, 0.08, "estimated error");
}

/* Fewer pixels, and the variance of each, take eight. */
static void small_pictures_and_variances_take_eight(void **state)
{
    static const struct {
        uint32_t width, height;
        int variance;
        uint32_t replicates;
    } all[] = {{32, 32, 0, 2}, {33, 31, 0, 8}, {32, 32, 1, 8}};
    (void)state;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        rt_render_options options = path_options(RT_SAMPLER_SOBOL, RT_FILTER_BOX);
        rt_film_stats stats;
        options.width = all[i].width;
        options.height = all[i].height;
        options.variance = all[i].variance;
        options.target_error = 0.5;
        rt_film *film = render(&options);
        rt_film_get_stats(film, &stats);
        assert_int_equal(stats.replicates, all[i].replicates);
        rt_film_destroy(film);
    }
}

/* ---- Ends and limits ---------------------------------------------------------- */

static void samples_and_time_are_limits(void **state)
{
    rt_render_options options = path_options(RT_SAMPLER_SOBOL, RT_FILTER_BOX);
    rt_film_stats stats;
    (void)state;
    options.target_error = 1e-6;
    options.spp = 37;
    rt_film *film = render(&options);
    rt_film_get_stats(film, &stats);
    assert_int_equal(stats.spp, 37);
    assert_true(stats.replicates == 8 && stats.relative_error_bound > options.target_error);
    rt_film_destroy(film);
    options.spp = 0;
    options.time = 0.2;
    film = render(&options);
    rt_film_get_stats(film, &stats);
    assert_true(stats.render_seconds >= 0.2 && stats.render_seconds < 5);
    rt_film_destroy(film);
}

static void without_the_wish_nothing_is_estimated(void **state)
{
    rt_render_options options = path_options(RT_SAMPLER_SOBOL, RT_FILTER_BOX);
    rt_film_stats stats;
    (void)state;
    options.variance = 0;
    options.spp = 8;
    rt_film *film = render(&options);
    rt_film_get_stats(film, &stats);
    assert_int_equal(stats.replicates, 0);
    assert_null(rt_film_layer(film, "variance", NULL));
    rt_film_destroy(film);
}

static void what_cannot_tell_its_error_is_refused(void **state)
{
    static const rt_mode modes[] = {RT_MODE_PHOTON, RT_MODE_NORMALS, RT_MODE_ALBEDO, RT_MODE_DEPTH};
    rt_render_options options = path_options(RT_SAMPLER_SOBOL, RT_FILTER_BOX);
    rt_film *film = NULL;
    (void)state;
    for (int i = 0; i < 4; i++) {
        options.mode = modes[i];
        options.target_error = i % 2 ? 0.1 : 0;
        assert_int_equal(rt_render(&film, renderer, &options, &error), RT_ERROR_USAGE);
        assert_string_equal(error.field, i % 2 ? "target_error" : "variance");
        assert_null(film);
    }
    options.mode = RT_MODE_PATH;
    options.target_error = 0;
    options.spp = 1;
    assert_int_equal(rt_render(&film, renderer, &options, &error), RT_ERROR_USAGE);
    options.target_error = -0.1;
    assert_int_equal(rt_render(&film, renderer, &options, &error), RT_ERROR_USAGE);
    options.target_error = NAN;
    assert_int_equal(rt_render(&film, renderer, &options, &error), RT_ERROR_USAGE);
}

/* ---- Passes ------------------------------------------------------------------- */

enum { passes = 32, maps = 60 };

static rt_render_options pass_options(void)
{
    rt_render_options options = path_options(RT_SAMPLER_SOBOL, RT_FILTER_BOX);
    options.mode = RT_MODE_PHOTON;
    options.spp = 1;
    options.passes = passes;
    options.photons = 1000;
    options.radius = 0.25f;
    return options;
}

/* The noise, not the bias: about the mean of many renders, of which each is a part itself. */
static void intervals_of_passes_hold_the_mean_of_passes(void **state)
{
    const double factor = 1 - 1.0 / maps;
    rt_render_options options = pass_options();
    rt_film *films[maps];
    float mean[values];
    tally t = {0};
    (void)state;
    memset(mean, 0, sizeof mean);
    for (int i = 0; i < maps; i++) {
        options.seed = test_seed((uint32_t)i);
        films[i] = render(&options);
        for (int k = 0; k < values; k++)
            mean[k] += rt_film_rgb(films[i])[k] / maps;
    }
    for (int i = 0; i < maps; i++) {
        rt_film_stats stats;
        rt_film_get_stats(films[i], &stats);
        assert_int_equal(stats.passes, passes);
        count(&t, films[i], mean, NULL, factor, stats.relative_error_bound);
        rt_film_destroy(films[i]);
    }
    expect_calibrated("passes", &t, maps);
}

static void passes_end_at_the_target(void **state)
{
    rt_render_options options = pass_options();
    rt_film_stats stats;
    (void)state;
    options.passes = 4000;
    options.variance = 0;
    options.target_error = 0.2;
    rt_film *film = render(&options);
    rt_film_get_stats(film, &stats);
    print_message("%u passes, error below %.3f\n", (unsigned)stats.passes,
                  stats.relative_error_bound);
    assert_true(stats.passes >= 32 && stats.passes < 1000 && stats.relative_error_bound <= 0.2);
    rt_film_destroy(film);
}

/* ---- Few sequences -------------------------------------------------------------- */

/* Seven samples or passes tell an error, but not how far to trust it; eight tell both. */
static void a_bound_takes_all_sequences(void **state)
{
    (void)state;
    for (int i = 0; i < 4; i++) {
        rt_render_options options =
            i < 2 ? path_options(RT_SAMPLER_SOBOL, RT_FILTER_BOX) : pass_options();
        uint32_t count = i % 2 ? 8 : 7;
        rt_film_stats stats;
        options.spp = i < 2 ? count : 1;
        options.passes = i < 2 ? 0 : count;
        rt_film *film = render(&options);
        rt_film_get_stats(film, &stats);
        assert_int_equal(stats.replicates, count);
        assert_true(stats.relative_error > 0 && isfinite(stats.relative_error));
        assert_int_equal(isfinite(stats.relative_error_bound), count == 8);
        assert_true(stats.relative_error_bound > stats.relative_error);
        rt_film_destroy(film);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(intervals_contain_the_exact_value_95_times_of_100),
        statistical_test(they_do_so_with_other_filters),
        statistical_test(a_target_is_reached_when_it_says_so),
        statistical_test(a_target_of_a_large_picture_is_reached_with_two),
        cmocka_unit_test(small_pictures_and_variances_take_eight),
        cmocka_unit_test(samples_and_time_are_limits),
        cmocka_unit_test(without_the_wish_nothing_is_estimated),
        cmocka_unit_test(what_cannot_tell_its_error_is_refused),
        statistical_test(intervals_of_passes_hold_the_mean_of_passes),
        cmocka_unit_test(passes_end_at_the_target),
        cmocka_unit_test(a_bound_takes_all_sequences),
    };
    return cmocka_run_group_tests(tests, make_renderer, destroy_renderer);
}
