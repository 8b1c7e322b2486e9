/* test_density.c - each density kernel against its closed form, and its integral over the disc. */
#include "support.h"

#include <math.h>

#include "types.h"

#define PI 3.14159265358979323846

enum { rings = 4096 };

static const float radii[] = {1e-3f, 1.0f, 250.0f};
static const float cone_constants[] = {1.0f, 1.1f, 3.0f};

/* Values at (i + 1/2) / rings of the disc's area, by the device. */
static void evaluate(uint32_t density, float cone_k, float r2, const float *d2, float *values,
                     uint32_t count)
{
    cl_kernel kernel = test_kernel("density", "evaluate");
    cl_mem in = test_buffer(count * sizeof *d2, d2),
           out = test_buffer(count * sizeof *values, NULL);
    rt_arg args[] = {RT_ARG(count), RT_ARG(density), RT_ARG(cone_k),
                     RT_ARG(r2),    RT_ARG(in),      RT_ARG(out)};
    test_run(kernel, args, 6, count);
    test_read(out, count * sizeof *values, values);
    rt_buffer_release(test_device(), in);
    rt_buffer_release(test_device(), out);
    rt_kernel_release(kernel);
}

/* The integral over the disc of radius r: pi r^2 times the mean over rings of equal area. */
static double integral(uint32_t density, float cone_k, float r)
{
    static float d2[rings], values[rings];
    double sum = 0;
    for (int i = 0; i < rings; i++)
        d2[i] = (float)((i + 0.5) / rings * r * r);
    evaluate(density, cone_k, r * r, d2, values, rings);
    for (int i = 0; i < rings; i++)
        sum += values[i];
    return PI * r * r * sum / rings;
}

/* pi r^2 K, as the formulas of density.h are printed. */
static double closed_form(uint32_t density, double c, double t)
{
    const double b = 1.953, a = 1 / (1 - (1 - 2 / b * (1 - exp(-b / 2))) / (1 - exp(-b)));
    double bell = 1 - (1 - exp(-b * t * t / 2)) / (1 - exp(-b));
    switch (density) {
    case RT_DENSITY_BOX:
        return 1;
    case RT_DENSITY_CONE:
        return (1 - t / c) / (1 - 2 / (3 * c));
    case RT_DENSITY_GAUSSIAN:
        return a * bell;
    case RT_DENSITY_GAUSSIAN_JENSEN:
        return 0.918 * bell;
    case RT_DENSITY_EPANECHNIKOV:
        return 2 * (1 - t * t);
    default:
        return 3 * (1 - t * t) * (1 - t * t);
    }
}

static void kernels_integrate_to_one_over_the_disc(void **state)
{
    static const uint32_t densities[] = {RT_DENSITY_BOX, RT_DENSITY_GAUSSIAN,
                                         RT_DENSITY_EPANECHNIKOV, RT_DENSITY_SILVERMAN};
    (void)state;
    for (size_t r = 0; r < sizeof radii / sizeof *radii; r++) {
        for (size_t i = 0; i < sizeof densities / sizeof *densities; i++)
            assert_float_equal(integral(densities[i], 1.1f, radii[r]), 1, 1e-5);
        for (size_t i = 0; i < sizeof cone_constants / sizeof *cone_constants; i++)
            assert_float_equal(integral(RT_DENSITY_CONE, cone_constants[i], radii[r]), 1, 1e-5);
    }
}

static void the_printed_gaussian_keeps_53_percent(void **state)
{
    (void)state;
    assert_float_equal(integral(RT_DENSITY_GAUSSIAN_JENSEN, 1.1f, 1), 0.531155, 1e-5);
}

static void kernels_equal_their_closed_forms(void **state)
{
    float d2[64], values[64];
    (void)state;
    for (uint32_t density = RT_DENSITY_EPANECHNIKOV; density <= RT_DENSITY_GAUSSIAN_JENSEN;
         density++)
        for (size_t r = 0; r < sizeof radii / sizeof *radii; r++) {
            float r2 = radii[r] * radii[r];
            for (int i = 0; i < 64; i++)
                d2[i] = (float)i / 64 * r2;
            evaluate(density, 1.1f, r2, d2, values, 64);
            for (int i = 0; i < 64; i++)
                assert_float_equal(PI * r2 * values[i], closed_form(density, 1.1f, sqrt(i / 64.0)),
                                   2e-6);
        }
}

static void kernels_are_zero_outside_the_disc_and_on_an_empty_one(void **state)
{
    static const float outside[] = {1.0001f, 2, 1e30f, INFINITY}, inside[] = {0, 1e-30f};
    float values[4];
    (void)state;
    for (uint32_t density = RT_DENSITY_EPANECHNIKOV; density <= RT_DENSITY_GAUSSIAN_JENSEN;
         density++) {
        evaluate(density, 1.1f, 1, outside, values, 4);
        for (int i = 0; i < 4; i++)
            assert_true(values[i] == 0);
        evaluate(density, 1.1f, 0, inside, values, 2);
        for (int i = 0; i < 2; i++)
            assert_true(values[i] == 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kernels_integrate_to_one_over_the_disc),
        cmocka_unit_test(the_printed_gaussian_keeps_53_percent),
        cmocka_unit_test(kernels_equal_their_closed_forms),
        cmocka_unit_test(kernels_are_zero_outside_the_disc_and_on_an_empty_one),
    };
    return cmocka_run_group_tests_name("kernels/density", tests, NULL, NULL);
}
