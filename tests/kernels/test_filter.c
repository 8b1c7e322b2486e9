/* test_filter.c - samples of reconstruction filters have their signs and moments. */
#include "support.h"

#include <math.h>
#include <string.h>

#include "statistics.h"

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

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(weights_have_the_sign_of_the_filter),
        cmocka_unit_test(a_radius_stretches_the_filter),
    };
    return cmocka_run_group_tests_name("kernels/filter", tests, NULL, NULL);
}
