/*
 * test_filter.c - samples of reconstruction filters have their signs and moments, and splats give
 * each pixel what its samples would find.
 */
#include "support.h"

#include <math.h>
#include <string.h>

#include "statistics.h"
#include "types.h"

enum { n = 1 << 18 };

static float samples[n][4];
static double values[n];

static void draw(uint32_t filter, float radius, uint32_t seed)
{
    uint32_t count = n;
    seed = test_seed(seed);
    cl_kernel kernel = test_kernel("filter", "sample");
    cl_mem out = test_buffer(sizeof samples, NULL);
    rt_arg args[] = {RT_ARG(filter), RT_ARG(radius), RT_ARG(seed), RT_ARG(count), RT_ARG(out)};
    test_run(kernel, args, 5, n);
    test_read(out, sizeof samples, samples);
    rt_buffer_release(test_device(), out);
    rt_kernel_release(kernel);
}

/* Mitchell and Netravali 1988, equation 8, B = C = 1/3. */
static double mitchell(double x)
{
    x = fabs(x);
    if (x < 1)
        return (7 * x * x * x - 12 * x * x + 16.0 / 3) / 6;
    return x < 2 ? (-7.0 / 3 * x * x * x + 12 * x * x - 20 * x + 32.0 / 3) / 6 : 0;
}

static double value(rt_filter filter, double x, double y)
{
    switch (filter) {
    case RT_FILTER_BOX:
        return fabs(x) < 0.5 && fabs(y) < 0.5;
    case RT_FILTER_TENT:
        return fmax(0, 1 - fabs(x)) * fmax(0, 1 - fabs(y));
    case RT_FILTER_GAUSSIAN:
        return x * x + y * y < 2.25 ? exp(-(x * x + y * y) / 0.5) : 0;
    default:
        return mitchell(x) * mitchell(y);
    }
}

/* The integral of the magnitude. */
static double magnitude_of(rt_filter filter)
{
    enum { steps = 1152 };
    double sum = 0, h = 4.0 / steps;
    for (int i = 0; i < steps; i++)
        for (int j = 0; j < steps; j++)
            sum += fabs(value(filter, (i + 0.5) * h - 2, (j + 0.5) * h - 2)) * h * h;
    return sum;
}

/* With the signs, samples have the moments of the filter itself. */
static void weights_have_the_sign_of_the_filter(void **state)
{
    (void)state;
    for (int filter = RT_FILTER_BOX; filter <= RT_FILTER_MITCHELL; filter++) {
        double magnitude = filter == RT_FILTER_MITCHELL ? magnitude_of((rt_filter)filter) : 1;
        draw((uint32_t)filter, 0, 9);
        for (int i = 0; i < n; i++) {
            double f = value((rt_filter)filter, samples[i][0] - 0.5, samples[i][1] - 0.5),
                   w = samples[i][2];
            assert_true(filter == RT_FILTER_MITCHELL
                            ? fabs(w) == 1 && (fabs(f) < 1e-4 || (f > 0) == (w > 0))
                            : w == 1);
            values[i] = magnitude * w;
        }
        expect_mean(values, n, 1, 1e-5, "integral");
        for (int i = 0; i < n; i++)
            values[i] = magnitude * samples[i][2] * (samples[i][0] - 0.5) * (samples[i][0] - 0.5);
        /*
         * Second moments of each coordinate; of a Gaussian cut at three deviations r^2/2 is the
         * mean.
         */
        static const double moments[] = {1.0 / 12, 1.0 / 6, 0, 1.0 / 9};
        double cut = exp(-4.5), gaussian = 0.25 * (1 - 4.5 * cut / (1 - cut));
        expect_mean(values, n, filter == RT_FILTER_GAUSSIAN ? gaussian : moments[filter], 1e-5,
                    "second moment");
    }
}

/*
 * A radius stretches the filter about the centre of the pixel, and 0 stands for the filter's own.
 */
static void a_radius_stretches_the_filter(void **state)
{
    static const float own[] = {0, 1, 1.5f, 2};
    static float plain[n][4];
    (void)state;
    for (int filter = RT_FILTER_BOX; filter <= RT_FILTER_MITCHELL; filter++) {
        float reach = 0;
        draw((uint32_t)filter, 0, 10);
        memcpy(plain, samples, sizeof plain);
        draw((uint32_t)filter, own[filter], 10);
        assert_memory_equal(samples, plain, sizeof plain);
        draw((uint32_t)filter, 3, 10);
        double stretch = filter == RT_FILTER_BOX ? 1 : 3 / own[filter];
        for (int i = 0; i < n; i++) {
            for (int c = 0; c < 2; c++) {
                double expected = 0.5 + stretch * (plain[i][c] - 0.5);
                assert_true(fabs(samples[i][c] - expected) < 1e-5);
                reach = fmaxf(reach, fabsf(samples[i][c] - 0.5f));
            }
            assert_true(samples[i][2] == plain[i][2]);
        }
        assert_true(filter == RT_FILTER_BOX ? reach <= 0.5f : reach > 2.5f && reach <= 3.0001f);
    }
}

/* ---- Splats ------------------------------------------------------------------------ */

enum { columns = 7, rows = 5, side = 512, images = 2 };

static double magnitudes[RT_FILTER_MITCHELL + 1];

/* The density of a pixel's samples, with the sign, at an offset from its centre. */
static double density(rt_filter filter, double stretch, double x, double y)
{
    return value(filter, x / stretch, y / stretch) / (magnitudes[filter] * stretch * stretch);
}

/* The same over all images of the point that a film of all directions has. */
static double density_around(rt_filter filter, double stretch, const float *at, int column, int row)
{
    double sum = 0;
    for (int k = -images; k <= images; k++)
        for (int m = -images; m <= images; m++) {
            const double x = at[0] - column - 0.5 + m * columns, y = 2 * k * rows - row - 0.5;
            sum += density(filter, stretch, x, y + at[1]) +
                   density(filter, stretch, x + 0.5 * columns, y - at[1]);
        }
    return sum;
}

/* Adds up what each pixel gets of light at a point, over even numbers. */
static void splat(double *out, const rt_camera_data *camera, const float *at)
{
    static float found[side * side][2];
    uint32_t width = columns, height = rows, n_side = side;
    cl_kernel kernel = test_kernel("filter", "splat");
    cl_mem in = test_buffer(sizeof *camera, camera), results = test_buffer(sizeof found, NULL);
    rt_arg args[] = {RT_ARG(in),    RT_ARG(width),  RT_ARG(height), RT_ARG(at[0]),
                     RT_ARG(at[1]), RT_ARG(n_side), RT_ARG(results)};
    test_run(kernel, args, 7, side * side);
    test_read(results, sizeof found, found);
    memset(out, 0, columns * rows * sizeof *out);
    for (int i = 0; i < side * side; i++) {
        assert_true(found[i][0] < columns * rows);
        out[(int)found[i][0]] += found[i][1] / (side * side);
    }
    rt_buffer_release(test_device(), in);
    rt_buffer_release(test_device(), results);
    rt_kernel_release(kernel);
}

/* What each pixel gets of light at a point; numbers are spread to 1 / side, which is the bound. */
static void expect_splat(const rt_camera_data *camera, double stretch, const float *at)
{
    const rt_filter filter = (rt_filter)camera->filter;
    double got[columns * rows];
    splat(got, camera, at);
    for (int p = 0; p < columns * rows; p++) {
        const int column = p % columns, row = p / columns;
        const double expected =
            camera->kind == RT_CAMERA_KIND_ENVIRONMENT
                ? density_around(filter, stretch, at, column, row)
                : density(filter, stretch, at[0] - column - 0.5, at[1] - row - 0.5);
        if (fabs(got[p] - expected) > 2.0 / side)
            fail_msg("filter %d, radius %g, camera %u, point %g %g, pixel %d %d: %g, expected %g",
                     (int)filter, (double)camera->filter_radius, camera->kind, (double)at[0],
                     (double)at[1], column, row, got[p], expected);
    }
}

/* Inside, at an edge, beyond it, and at a corner. */
static void a_splat_gives_pixels_what_their_samples_find(void **state)
{
    static const float places[][2] = {{3.2f, 2.7f}, {0.1f, 2.5f}, {6.9f, 4.8f},  {3.5f, 0.2f},
                                      {3.5f, 2.5f}, {7.6f, 1.9f}, {-0.9f, -0.4f}};
    static const float own[] = {0, 1, 1.5f, 2};
    (void)state;
    for (uint32_t filter = RT_FILTER_BOX; filter <= RT_FILTER_MITCHELL; filter++)
        for (int i = 0; i < 7; i++) {
            rt_camera_data camera = {.kind = RT_CAMERA_KIND_PERSPECTIVE, .filter = filter};
            magnitudes[filter] = magnitude_of((rt_filter)filter);
            expect_splat(&camera, 1, places[i]);
            camera.filter_radius = 3;
            expect_splat(&camera, filter == RT_FILTER_BOX ? 1 : 3 / (double)own[filter], places[i]);
            if (i >= 5) /* where no direction lies */
                continue;
            camera.kind = RT_CAMERA_KIND_ENVIRONMENT;
            expect_splat(&camera, filter == RT_FILTER_BOX ? 1 : 3 / (double)own[filter], places[i]);
            camera.filter_radius = 0;
            expect_splat(&camera, 1, places[i]);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(weights_have_the_sign_of_the_filter),
        cmocka_unit_test(a_radius_stretches_the_filter),
        cmocka_unit_test(a_splat_gives_pixels_what_their_samples_find),
    };
    return cmocka_run_group_tests_name("kernels/filter", tests, NULL, NULL);
}
