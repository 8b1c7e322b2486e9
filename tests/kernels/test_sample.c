/*
 * test_sample.c - the sampling routines: ranges and closed forms; tests/statistics/ tests their
 * densities.
 */
#include "support.h"

#include <math.h>

#define PI 3.14159265358979323846

enum { n = 1 << 18 };

static float samples[n][4];

/* Runs a kernel whose first arguments are a seed and a count, and whose last is the output. */
static void draw(const char *name, uint32_t seed, const rt_arg *extra, cl_uint extra_count)
{
    uint32_t count = n;
    cl_kernel kernel = test_kernel("sample", name);
    cl_mem out = test_buffer(sizeof samples, NULL);
    rt_arg args[8] = {RT_ARG(seed), RT_ARG(count)};
    cl_uint used = 2;
    for (cl_uint i = 0; i < extra_count; i++)
        args[used++] = extra[i];
    args[used++] = (rt_arg)RT_ARG(out);
    test_run(kernel, args, used, n);
    test_read(out, sizeof samples, samples);
    rt_buffer_release(test_device(), out);
    rt_kernel_release(kernel);
}

static void directions_are_of_unit_length(void **state)
{
    static const char *const names[] = {"cosine", "sphere"};
    (void)state;
    for (int k = 0; k < 2; k++) {
        draw(names[k], 1, NULL, 0);
        for (int i = 0; i < n; i++) {
            const float *w = samples[i];
            assert_float_equal(w[0] * w[0] + w[1] * w[1] + w[2] * w[2], 1, 1e-6);
            assert_true(k == 1 || w[2] >= 0);
        }
    }
}

static void discs_and_triangles_hold_their_points(void **state)
{
    (void)state;
    draw("disc", 1, NULL, 0);
    for (int i = 0; i < n; i++)
        assert_true((double)samples[i][0] * samples[i][0] + (double)samples[i][1] * samples[i][1] <=
                    1 + 1e-6);
    draw("triangle", 1, NULL, 0);
    for (int i = 0; i < n; i++)
        assert_true(samples[i][0] >= 0 && samples[i][1] >= 0 &&
                    samples[i][0] + samples[i][1] <= 1 + 1e-6);
}

/* Solid angle of the rectangle from (0,0) to (x,y) at distance z, signed by x and y. */
static double corner_angle(double x, double y, double z)
{
    return atan2(x * y, z * sqrt(x * x + y * y + z * z));
}

static double solid_angle(double x0, double y0, double x1, double y1, double z)
{
    return corner_angle(x1, y1, z) - corner_angle(x0, y1, z) - corner_angle(x1, y0, z) +
           corner_angle(x0, y0, z);
}

typedef struct view {
    float shape[4]; /* x0, y0, width, height */
    float z;
} view;

static const view views[] = {
    {{-0.5f, -0.5f, 1, 1}, 1},        {{-0.5f, -0.5f, 1, 1}, 0.01f},
    {{-0.5f, -0.5f, 1, 1}, 8},        {{0.7f, -0.2f, 1, 1}, 0.3f},
    {{0.1f, 0.1f, 1, 1}, 0.02f},      {{-3, 0.2f, 6, 0.1f}, 0.5f},
    {{-1000, -500, 1000, 1000}, 700}, {{1e-3f, 2e-3f, 1e-3f, 1e-3f}, 2e-3f},
    {{0.25f, -4, 0.5f, 8}, 0.05f},    {{2, 2, 1, 1}, 1},
};

static void solid_angle_of_a_rectangle_agrees_with_the_closed_form(void **state)
{
    (void)state;
    for (size_t v = 0; v < sizeof views / sizeof *views; v++) {
        const view *w = views + v;
        const float *s = w->shape;
        rt_arg args[] = {RT_ARG(w->shape), RT_ARG(w->z)};
        draw("rectangle", 0, args, 2);
        double exact = solid_angle(s[0], s[1], (double)s[0] + s[2], (double)s[1] + s[3], w->z);
        assert_float_equal(samples[0][2], exact, 1e-6);
        assert_float_equal(samples[0][3] * samples[0][2], 1, 1e-6);
    }
}

static void points_of_a_cap_lie_on_its_sphere(void **state)
{
    static const float ratios[] = {1.001f, 1.1f, 2, 50, 2000}; /* distance / radius */
    (void)state;
    for (size_t v = 0; v < sizeof ratios / sizeof *ratios; v++) {
        double d = ratios[v], sine2 = 1 / (d * d), height = sine2 / (1 + sqrt(1 - sine2));
        float radius = 1, d2 = ratios[v] * ratios[v];
        rt_arg args[] = {RT_ARG(radius), RT_ARG(d2)};
        draw("cap", (uint32_t)v, args, 2);
        for (int i = 0; i < n; i++) {
            const float *p = samples[i];
            assert_float_equal((double)p[0] * p[0] + (double)p[1] * p[1] + (double)p[2] * p[2], 1,
                               1e-5);
            /*
             * The tangent from the viewer at (0, 0, d) touches at height 1 / d: nothing below is
             * seen.
             */
            assert_true(p[2] * d >= 1 - 2e-3);
            assert_float_equal(p[3] * 2 * PI * height, 1, 5e-4);
        }
    }
}

static void elementary_functions_are_precise(void **state)
{
    static float in[n][2];
    uint32_t count = n;
    (void)state;
    for (int i = 0; i < n; i++) {
        in[i][0] = ldexpf(1 + (float)(i % 64) / 64, i / 64 % 24 - 12);
        in[i][1] = (float)(2 * PI * (2.0 * i / n - 1));
    }
    cl_kernel kernel = test_kernel("sample", "functions");
    cl_mem given = test_buffer(sizeof in, in), out = test_buffer(sizeof samples, NULL);
    rt_arg args[] = {RT_ARG(count), RT_ARG(given), RT_ARG(out)};
    test_run(kernel, args, 3, n);
    test_read(out, sizeof samples, samples);
    for (int i = 0; i < n; i++) {
        assert_float_equal(samples[i][0], sin(in[i][1]), 3e-7);
        assert_float_equal(samples[i][1], cos(in[i][1]), 3e-7);
        assert_float_equal(samples[i][2], atan2(in[i][1], in[i][0]), 2e-7);
    }
    rt_buffer_release(test_device(), given);
    rt_buffer_release(test_device(), out);
    rt_kernel_release(kernel);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(directions_are_of_unit_length),
        cmocka_unit_test(discs_and_triangles_hold_their_points),
        cmocka_unit_test(solid_angle_of_a_rectangle_agrees_with_the_closed_form),
        cmocka_unit_test(points_of_a_cap_lie_on_its_sphere),
        cmocka_unit_test(elementary_functions_are_precise),
    };
    return cmocka_run_group_tests_name("kernels/sample", tests, NULL, NULL);
}
