/*
 * test_pilot.c - the pilot of progressive passes: its tests reject even light as often as stated,
 * and uneven light; the radii of a picture shrink where light is uneven and nowhere else.
 */
#include "kernels/rays.h"
#include "kernels/statistics.h"
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "mode/photon/pilot.h"
#include "mode/photon/radius_choice.h"
#include "mode/photon/radius_test.h"
#include "setting/options.h"

/* ---- The statistics ------------------------------------------------------------------- */

enum { pixels = 5000, sectors = RT_RADIUS_SECTORS, fewest = 24 };

static rt_radius_test discs[pixels];
static float limits[pixels];

/* A standard normal deviate (Box and Muller 1958). */
static double normal(rays_stream *random)
{
    const double u = 1 - rays_uniform(random), v = rays_uniform(random);
    return sqrt(-2 * log(u)) * cos(2 * 3.14159265358979 * v);
}

/* Photons whose density rises from sector to sector by this part of the mean in all. */
static void fill(uint32_t seed, uint32_t photons, uint32_t passes, double slope)
{
    rays_stream random = {test_seed(seed)};
    memset(discs, 0, sizeof discs);
    for (int i = 0; i < pixels; i++) {
        rt_radius_test *t = discs + i;
        t->passes = passes;
        limits[i] = 1;
        for (uint32_t n = 0; n < photons;) {
            const uint32_t s = (uint32_t)(sectors * rays_uniform(&random));
            const double density = 1 + slope * ((s + 0.5) / sectors - 0.5);
            if (rays_uniform(&random) * (1 + slope / 2) > density)
                continue;
            t->count[s]++;
            n++;
        }
        for (int s = 0; s < sectors; s++)
            for (uint32_t pass = 0; pass < passes; pass++) {
                const double density = 1 + slope * ((s + 0.5) / sectors - 0.5);
                const double light = 7 * density + 0.5 * normal(&random);
                t->light[s] += (float)light;
                t->square[s] += (float)(light * light);
            }
    }
}

/* The share of pixels whose squared radius a test makes smaller. */
static double shrunk(rt_radius_rule rule)
{
    cl_kernel kernel = NULL;
    rt_error error;
    rt_u32 count = pixels, which = rule, least = fewest;
    expect_ok(
        rt_device_kernel(test_device(), &kernel, "photon_radius", "test_sectors", NULL, &error),
        &error);
    float radii[pixels];
    memcpy(radii, limits, sizeof radii);
    cl_mem critical = test_buffer(RT_RADIUS_LENGTHS * sizeof(float), rt_radius_test_critical(rule)),
           squared = test_buffer(sizeof radii, radii), tests = test_buffer(sizeof discs, discs);
    rt_arg args[] = {RT_ARG(count),    RT_ARG(which),   RT_ARG(least),
                     RT_ARG(critical), RT_ARG(squared), RT_ARG(tests)};
    test_run(kernel, args, 6, pixels);
    test_read(squared, sizeof radii, radii);
    rt_buffer_release(test_device(), critical);
    rt_buffer_release(test_device(), squared);
    rt_buffer_release(test_device(), tests);
    rt_kernel_release(kernel);
    double share = 0;
    for (int i = 0; i < pixels; i++)
        share += radii[i] < 1 ? 1.0 / pixels : 0;
    return share;
}

/*
 * 1 % of the discs with even light, after 1, 2, 4, 8 and 16 passes; the counts are whole numbers,
 * which moves that a little.
 */
static void even_light_is_rejected_as_often_as_stated(void **state)
{
    const double deviation = sqrt(0.01 * 0.99 / pixels);
    (void)state;
    fill(1, 400, 1, 0);
    const double many = shrunk(RT_RADIUS_CPPM);
    assert_true(shrunk(RT_RADIUS_FTEST) == 0);
    fill(2, fewest, 1, 0);
    const double few = shrunk(RT_RADIUS_CPPM);
    print_message("cppm rejects %.4f, of few photons %.4f\n", many, few);
    expect_close(many, 0.01, 5 * deviation + 0.0003, "cppm");
    expect_close(few, 0.01, 5 * deviation + 0.002, "cppm, few photons");
    for (uint32_t passes = 2; passes <= 16; passes *= 2) {
        fill(2 + passes, fewest, passes, 0);
        const double share = shrunk(RT_RADIUS_FTEST);
        print_message("ftest rejects %.4f after %u passes\n", share, passes);
        expect_deviate((share - 0.01) / deviation, "ftest");
    }
}

/*
 * The density of 400 photons rises by its mean: X^2 is non-central chi-square with lambda 33, and
 * F's light rises by 14 of its deviations.
 */
static void uneven_light_is_rejected(void **state)
{
    (void)state;
    fill(3, 400, 4, 1);
    const double cppm = shrunk(RT_RADIUS_CPPM), ftest = shrunk(RT_RADIUS_FTEST);
    print_message("cppm rejects %.4f, ftest %.4f\n", cppm, ftest);
    assert_true(cppm > 0.9);
    assert_true(ftest > 0.999);
    /* Too few photons, or no power of 2 passes: no test. */
    fill(4, fewest - 1, 4, 1);
    assert_true(shrunk(RT_RADIUS_CPPM) == 0);
    fill(5, 400, 3, 1);
    assert_true(shrunk(RT_RADIUS_CPPM) == 0);
}

/* ---- The least mean squared error ------------------------------------------------------ */

enum { image_side = 80, half = 8 };

static rt_radius_trial trials[2][image_side * image_side];

/*
 * Trials of an estimate whose variance is 1/t a pass, as of the box kernel: a change from half the
 * disc has that of the whole disc. On the right half of the image its bias is b t^order.
 */
static void fill_trials(uint32_t seed, double bias, double order)
{
    rays_stream random = {test_seed(seed)};
    memset(trials, 0, sizeof trials);
    for (int i = 0; i < 2 * image_side * image_side; i++) {
        rt_radius_trial *t = &trials[0][0] + i;
        const double b = i % image_side < image_side / 2 ? 0 : bias;
        t->passes = half;
        t->variance[0] = half / 4.0f;
        t->variance[1] = half;
        for (int pass = 0; pass < half; pass++)
            for (int l = -2; l < 3; l++) {
                const double change = b * (pow(2, -l * order) - pow(2, -(l + 1) * order)) +
                                      pow(2, 0.5 * l) * normal(&random);
                t->change[2 + l] += (float)change;
                t->square[2 + l] += (float)(change * change);
            }
    }
}

/* The mean of t over the columns from .. to - 1. */
static double chosen(int from, int to, const rt_radius_passes *passes)
{
    static float squared[image_side * image_side];
    const rt_radius_trial *const halves[2] = {trials[0], trials[1]};
    rt_error error;
    double sum = 0;
    for (int i = 0; i < image_side * image_side; i++)
        squared[i] = 3;
    expect_ok(rt_radius_choose(squared, halves, image_side, image_side, passes, NULL, &error),
              &error);
    for (int i = 0; i < image_side * image_side; i++)
        if (i % image_side >= from && i % image_side < to)
            sum += squared[i] / 3 / (image_side * (to - from));
    return sum;
}

/*
 * t^(2 g + 1) = V mean(1/s) / (2 g P b^2 mean(s^g)^2), from the sums over passes here. Columns at
 * the border of the halves are left out, where neighbourhoods are mixed. Without bias, t would be 1
 * but for the noise of what is taken for it; if that were not taken off, t would be 0.12.
 */
static void the_area_has_the_least_mean_squared_error(void **state)
{
    const rt_radius_passes passes = {100, 16, 2 / 3.0, RT_RADIUS_LARGER},
                           limited = {100, 16, 2 / 3.0, 0};
    const double orders[] = {1, 0.5}, within[] = {1.15, 1.4}; /* small classes tell g less well */
    (void)state;
    for (int i = 0; i < 2; i++) {
        const double bias = 2, g = orders[i];
        double s = 1, powers = 0, inverse = 0;
        for (int pass = 0; pass < 100; pass++) {
            powers += pow(s, g) / 100;
            inverse += 1 / s / 100;
            s *= (pass + 17 + 2 / 3.0) / (pass + 18);
        }
        const double exact =
            pow(inverse / (2 * g * 100 * bias * bias * powers * powers), 1 / (2 * g + 1));
        fill_trials(20 + i, bias, g);
        const double even = chosen(0, image_side / 2 - 4, &passes),
                     uneven = chosen(image_side / 2 + 4, image_side, &passes);
        const double even_limited = chosen(0, image_side / 2 - 4, &limited);
        print_message("t %.4f where light is uneven, exactly %.4f; %.3f where it is even, %.3f at "
                      "most 1\n",
                      uneven, exact, even, even_limited);
        assert_true(uneven > exact / within[i] && uneven < exact * within[i]);
        assert_true(even > 1);
        assert_true(even_limited > 0.35 && even_limited <= 1);
    }
}

/* Passes of which nothing else is said: the default rule, and four photons for each pixel. */
static void passes_have_defaults_that_balance_bias_and_noise(void **state)
{
    rt_render_options o = {.mode = RT_MODE_PHOTON, .width = 30, .height = 20, .passes = 128};
    (void)state;
    rt_options_complete(&o);
    assert_int_equal(o.photons, 4 * 30 * 20);
    assert_int_equal(rt_radius_rule_of(&o), RT_RADIUS_MSE);
    o.passes = 127;
    assert_int_equal(rt_radius_rule_of(&o), RT_RADIUS_KNAUS);
    o.passes = 128;
    o.radius = 0.1f;
    assert_int_equal(rt_radius_rule_of(&o), RT_RADIUS_KNAUS);
    o.radius_rule = RT_RADIUS_CPPM;
    assert_int_equal(rt_radius_rule_of(&o), RT_RADIUS_CPPM);
}

/* ---- Radii of pictures ---------------------------------------------------------------- */

enum { side = 24 };

static const char floor_text[] =
    "camera { projection orthographic  eye 0 5 0  look_at 0 0 0  up 0 0 1  width 2 }\n"
    "material floor { kd 0.5 }\n"
    "quad { corner -4 0 -4  edge1 0 0 8  edge2 8 0 0  material floor }\n"
    "light spot { position 0 40 0  target 0 0 0  outer 8  inner 7  intensity 1600 }\n";

/* Hides the light from the half with x below 0. */
static const char shade_text[] =
    "material black { kd 0 }\n"
    "quad { corner -8 6 -8  edge1 0 0 16  edge2 8 0 0  material black }\n";

/* The mean radius that each pixel gathered from, over all passes. */
static rt_film *render_passes(int has_shade, float radius, rt_radius_rule rule, uint32_t passes,
                              uint32_t photons)
{
    char text[1024];
    rt_film *film = NULL;
    rt_error error;
    rt_render_options o = {.mode = RT_MODE_PHOTON,
                           .width = side,
                           .height = side,
                           .passes = passes,
                           .photons = photons,
                           .k = 40,
                           .radius = radius,
                           .direct = RT_DIRECT_PHOTONS,
                           .sampler = RT_SAMPLER_INDEPENDENT,
                           .photon_layers = 1,
                           .radius_rule = rule};
    snprintf(text, sizeof text, "%s%s", floor_text, has_shade ? shade_text : "");
    rt_renderer *renderer = test_renderer(text);
    expect_ok(rt_render(&film, renderer, &o, &error), &error);
    rt_renderer_destroy(renderer);
    return film;
}

static rt_film *render(int has_shade, float radius, rt_radius_rule rule)
{
    return render_passes(has_shade, radius, rule, 2, 30000);
}

/* The share of pixels, of columns from .. to - 1, whose radius is less than half the other's. */
static double share_below(const rt_film *film, const rt_film *other, int from, int to, double part)
{
    const float *a = rt_film_layer(film, "photon.radius", NULL),
                *b = rt_film_layer(other, "photon.radius", NULL);
    double share = 0;
    for (int y = 0; y < side; y++)
        for (int x = from; x < to; x++)
            share += a[y * side + x] < part * b[y * side + x] ? 1.0 / (side * (to - from)) : 0;
    return share;
}

/* The RMSE beside the edge, where the floor is either lit as in the outer columns or black. */
static double error_of_step(const rt_film *film)
{
    const float *rgb = rt_film_rgb(film);
    double light = 0, squares = 0;
    for (int y = 0; y < side; y++)
        for (int x = 0; x < 4; x++)
            light += rgb[3 * (y * side + x)] / (4.0 * side);
    for (int y = 0; y < side; y++)
        for (int x = side / 4; x < 3 * side / 4; x++)
            squares += pow(rgb[3 * (y * side + x)] - (x < side / 2 ? light : 0), 2);
    return sqrt(squares / (side * side / 2)) / light;
}

static void radii_shrink_where_light_is_uneven(void **state)
{
    const rt_radius_rule rules[] = {RT_RADIUS_CPPM, RT_RADIUS_FTEST};
    (void)state;
    rt_film *even = render(0, 0, RT_RADIUS_KNAUS), *step = render(1, 0, RT_RADIUS_KNAUS);
    for (int i = 0; i < 2; i++) {
        rt_film *film = render(0, 0, rules[i]);
        const double by_chance = share_below(film, even, 0, side, 0.9);
        rt_film_destroy(film);
        film = render(1, 0, rules[i]);
        /* The orthographic camera shows x from the right to the left. */
        const double edge = share_below(film, step, side / 2 - 1, side / 2 + 1, 0.6);
        print_message("shrunk: %.3f of even light, %.3f at the edge\n", by_chance, edge);
        /* Five tests of 1 % each at most. */
        assert_true(by_chance < 0.05 + 5 * sqrt(0.05 * 0.95 / (side * side)));
        assert_true(edge > 0.9);
        rt_film_destroy(film);
    }
    rt_film_destroy(even);
    rt_film_destroy(step);
}

/*
 * By the least mean squared error the discs of an even floor keep most of their area, and those at
 * the edge of a shadow lose most, which brings the picture closer to the step.
 */
static void radii_of_least_error_keep_even_light_and_sharpen_edges(void **state)
{
    (void)state;
    rt_film *knaus = render_passes(1, 0, RT_RADIUS_KNAUS, 64, 3000),
            *film = render_passes(1, 0, RT_RADIUS_MSE, 64, 3000);
    const double edge = share_below(film, knaus, side / 2 - 1, side / 2 + 1, 0.6),
                 lit = share_below(film, knaus, 0, side / 4, 0.3),
                 rmse = error_of_step(film) / error_of_step(knaus);
    print_message("shrunk: %.3f at the edge, %.3f in the light; RMSE %.3f of knaus\n", edge, lit,
                  rmse);
    assert_true(edge > 0.9);
    assert_true(lit < 0.2);
    assert_true(rmse < 0.8);
    rt_film_destroy(film);
    rt_film_destroy(knaus);
}

/* Far from edges discs grow to almost twice their radius; one that is given is the largest. */
static void discs_grow_in_even_light(void **state)
{
    rt_film *knaus = render(0, 0, RT_RADIUS_KNAUS), *film = render(0, 0, RT_RADIUS_MSE);
    const double as_small = share_below(film, knaus, 0, side, 1.4),
                 twice = share_below(film, knaus, 0, side, 2.1);
    (void)state;
    print_message("%.3f have less than 1.4 of the radius, %.3f less than 2.1\n", as_small, twice);
    assert_true(as_small < 0.3);
    assert_true(twice > 0.99);
    rt_film_destroy(knaus);
    rt_film_destroy(film);
    film = render(0, 0.2f, RT_RADIUS_MSE);
    const float *radius = rt_film_layer(film, "photon.radius", NULL);
    double mean = 0;
    for (int i = 0; i < side * side; i++) {
        assert_true(radius[i] < 0.2f);
        mean += radius[i] / (side * side);
    }
    print_message("mean radius %.4f\n", mean);
    assert_true(mean > 0.1);
    rt_film_destroy(film);
}

/*
 * The radius of the other passes falls as if the pilot had been the first of them; a radius that
 * was given is tested as well.
 */
static void passes_go_on_from_the_radii_of_the_pilot(void **state)
{
    const double alpha = 2 / 3.0, by_knaus = (1 + sqrt((1 + alpha) / 2)) / 2,
                 after = (1 + sqrt((RT_PILOT_PASSES + 1 + alpha) / (RT_PILOT_PASSES + 2))) / 2;
    (void)state;
    rt_film *knaus = render(0, 0, RT_RADIUS_KNAUS), *film = render(0, 0, RT_RADIUS_CPPM);
    assert_true(share_below(film, knaus, 0, side, after / by_knaus - 1e-4) < 0.1);
    assert_true(share_below(film, knaus, 0, side, after / by_knaus + 1e-4) > 0.99);
    rt_film_destroy(knaus);
    rt_film_destroy(film);
    film = render(1, 0.2f, RT_RADIUS_CPPM);
    const float *radius = rt_film_layer(film, "photon.radius", NULL);
    double whole = 0;
    for (int i = 0; i < side * side; i++)
        whole += fabs(radius[i] - 0.2 * after) < 1e-4 ? 1.0 / (side * side) : 0;
    print_message("%.3f have the whole radius\n", whole);
    assert_true(whole > 0.3 && whole < 0.95);
    rt_film_destroy(film);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(even_light_is_rejected_as_often_as_stated),
        cmocka_unit_test(uneven_light_is_rejected),
        cmocka_unit_test(the_area_has_the_least_mean_squared_error),
        cmocka_unit_test(passes_have_defaults_that_balance_bias_and_noise),
        cmocka_unit_test(radii_shrink_where_light_is_uneven),
        cmocka_unit_test(radii_of_least_error_keep_even_light_and_sharpen_edges),
        cmocka_unit_test(discs_grow_in_even_light),
        cmocka_unit_test(passes_go_on_from_the_radii_of_the_pilot),
    };
    return cmocka_run_group_tests_name("lib/mode/pilot", tests, NULL, NULL);
}
