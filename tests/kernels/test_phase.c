/* test_phase.c - the phase function of Henyey and Greenstein: density, samples and moments. */
#include "support.h"

#include <math.h>
#include <stdlib.h>

#include "kernels/statistics.h"

enum { samples = 40000, cells = 24 };

static const double pi = 3.14159265358979323846;
static const float mean_cosines[] = {-0.8f, 0, 1e-3f, 0.6f, 0.95f};

static float (*scatter(float g, uint32_t seed))[4]
{
    float(*out)[4] = malloc(samples * sizeof *out);
    uint32_t count = samples;
    cl_kernel kernel = test_kernel("phase", "scatter");
    cl_mem made = test_buffer(samples * sizeof *out, NULL);
    rt_arg args[] = {RT_ARG(seed), RT_ARG(count), RT_ARG(g), RT_ARG(made)};
    test_run(kernel, args, 4, samples);
    test_read(made, samples * sizeof *out, out);
    rt_buffer_release(test_device(), made);
    rt_kernel_release(kernel);
    return out;
}

/* The part of the light that is scattered by a cosine of at most c. */
static double cumulative(double g, double c)
{
    if (g == 0)
        return (1 + c) / 2;
    return (1 - g * g) / (2 * g) * (1 / sqrt(1 + g * g - 2 * g * c) - 1 / (1 + g));
}

/* The cosine whose cumulative part that is. */
static double quantile(double g, double part)
{
    double lo = -1, hi = 1;
    for (int i = 0; i < 60; i++) {
        const double middle = (lo + hi) / 2;
        if (cumulative(g, middle) < part)
            lo = middle;
        else
            hi = middle;
    }
    return lo;
}

static void densities_are_those_of_the_formula(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof mean_cosines / sizeof *mean_cosines; i++) {
        const double g = mean_cosines[i];
        float(*out)[4] = scatter(mean_cosines[i], 1);
        for (int k = 0; k < 1000; k++) {
            /* Near cos = 1 the digits of float32 bound what is known of the angle. */
            const double d = 1 + g * g - 2 * g * out[k][0];
            const double exact = (1 - g * g) / (4 * pi * pow(d, 1.5));
            assert_float_equal(out[k][2], exact, exact * (1e-5 + 1e-6 / d));
            assert_float_equal(out[k][3], 1, 1e-5);
        }
        free(out);
    }
}

/* 12 equally probable bands of the cosine, each in two halves of the azimuth. */
static void samples_follow_the_density(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof mean_cosines / sizeof *mean_cosines; i++) {
        float(*out)[4] = scatter(mean_cosines[i], test_seed(7));
        uint32_t counts[cells] = {0};
        double expected[cells], edges[cells / 2];
        for (int k = 0; k < cells / 2; k++)
            edges[k] = quantile(mean_cosines[i], 2.0 * k / cells);
        for (int k = 0; k < samples; k++) {
            int band = cells / 2 - 1;
            while (band > 0 && out[k][0] < edges[band])
                band--;
            counts[2 * band + (out[k][1] < 0)]++;
        }
        for (int k = 0; k < cells; k++)
            expected[k] = (double)samples / cells;
        expect_counts(counts, expected, cells, "cosines");
        free(out);
    }
}

static void the_mean_cosine_is_g(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof mean_cosines / sizeof *mean_cosines; i++) {
        float(*out)[4] = scatter(mean_cosines[i], test_seed(8));
        double *cosines = malloc(samples * sizeof *cosines);
        for (int k = 0; k < samples; k++)
            cosines[k] = out[k][0];
        expect_mean(cosines, samples, mean_cosines[i], 1e-6, "mean cosine");
        free(cosines);
        free(out);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(densities_are_those_of_the_formula),
        statistical_test(samples_follow_the_density),
        statistical_test(the_mean_cosine_is_g),
    };
    return cmocka_run_group_tests_name("kernels/phase", tests, NULL, NULL);
}
