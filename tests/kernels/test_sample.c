/* test_sample.c - every sampling routine against its density, by chi-square, and against closed forms. */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "statistics.h"

#define PI 3.14159265358979323846

enum { n = 1 << 18, side = 16, cells = side * side };

static float samples[n][4];
static uint32_t counts[cells];
static double expected[cells];

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
    rt_buffer_release(out);
    rt_kernel_release(kernel);
    memset(counts, 0, sizeof counts);
}

/* Counts a sample whose two coordinates should be uniform in [0,1]. */
static void count_uniform(double x, double y)
{
    int i = (int)(x * side), j = (int)(y * side);
    assert_true(x >= -1e-6 && x <= 1 + 1e-6 && y >= -1e-6 && y <= 1 + 1e-6);
    i = i < 0 ? 0 : i > side - 1 ? side - 1 : i;
    j = j < 0 ? 0 : j > side - 1 ? side - 1 : j;
    counts[i * side + j]++;
}

static void expect_uniform(const char *what)
{
    for (int i = 0; i < cells; i++)
        expected[i] = (double)n / cells;
    expect_counts(counts, expected, cells, what);
}

static double turn(double x, double y)
{
    double t = atan2(y, x) / (2 * PI);
    return t < 0 ? t + 1 : t;
}

static void disc_is_uniform_in_area(void **state)
{
    (void)state;
    for (uint32_t seed = 0; seed < 3; seed++) {
        draw("disc", seed, NULL, 0);
        for (int i = 0; i < n; i++) {
            double r2 = (double)samples[i][0] * samples[i][0] + (double)samples[i][1] * samples[i][1];
            count_uniform(r2, turn(samples[i][0], samples[i][1]));
            assert_float_equal(samples[i][3], 1 / PI, 1e-7);
        }
        expect_uniform("disc");
    }
}

static void cosine_hemisphere_follows_the_cosine(void **state)
{
    (void)state;
    for (uint32_t seed = 0; seed < 3; seed++) {
        draw("cosine", seed, NULL, 0);
        for (int i = 0; i < n; i++) {
            const float *w = samples[i];
            assert_float_equal(w[0] * w[0] + w[1] * w[1] + w[2] * w[2], 1, 1e-6);
            assert_float_equal(w[3], w[2] / PI, 1e-7);
            count_uniform((double)w[2] * w[2], turn(w[0], w[1]));
        }
        expect_uniform("cosine hemisphere");
    }
}

static void sphere_is_uniform_in_solid_angle(void **state)
{
    (void)state;
    for (uint32_t seed = 0; seed < 3; seed++) {
        draw("sphere", seed, NULL, 0);
        for (int i = 0; i < n; i++) {
            const float *w = samples[i];
            assert_float_equal(w[0] * w[0] + w[1] * w[1] + w[2] * w[2], 1, 1e-6);
            assert_float_equal(w[3], 1 / (4 * PI), 1e-8);
            count_uniform(0.5 + 0.5 * w[2], turn(w[0], w[1]));
        }
        expect_uniform("sphere");
    }
}

static void triangle_is_uniform_in_area(void **state)
{
    (void)state;
    for (uint32_t seed = 0; seed < 3; seed++) {
        draw("triangle", seed, NULL, 0);
        for (int i = 0; i < n; i++) {
            /* Given b1, b2 / (1 - b1) is uniform; and so is 1 - (1 - b1)^2. */
            double b1 = samples[i][0], b2 = samples[i][1], rest = 1 - b1;
            assert_true(b1 >= 0 && b2 >= 0 && b1 + b2 <= 1 + 1e-6);
            count_uniform(1 - rest * rest, rest > 0 ? b2 / rest : 0);
            assert_float_equal(samples[i][3], 1.0 / 3, 1e-6);
        }
        expect_uniform("triangle");
    }
}

/* Solid angle of the rectangle from (0,0) to (x,y) at distance z, signed by x and y. */
static double corner_angle(double x, double y, double z)
{
    return atan2(x * y, z * sqrt(x * x + y * y + z * z));
}

static double solid_angle(double x0, double y0, double x1, double y1, double z)
{
    return corner_angle(x1, y1, z) - corner_angle(x0, y1, z) - corner_angle(x1, y0, z) + corner_angle(x0, y0, z);
}

typedef struct view {
    float shape[4]; /* x0, y0, width, height */
    float z;
} view;

static const view views[] = {
    {{-0.5f, -0.5f, 1, 1}, 1},           {{-0.5f, -0.5f, 1, 1}, 0.01f}, {{-0.5f, -0.5f, 1, 1}, 8},
    {{0.7f, -0.2f, 1, 1}, 0.3f},         {{0.1f, 0.1f, 1, 1}, 0.02f},   {{-3, 0.2f, 6, 0.1f}, 0.5f},
    {{-1000, -500, 1000, 1000}, 700},    {{1e-3f, 2e-3f, 1e-3f, 1e-3f}, 2e-3f},
    {{0.25f, -4, 0.5f, 8}, 0.05f},       {{2, 2, 1, 1}, 1},
};

static void rectangle_is_uniform_in_solid_angle(void **state)
{
    (void)state;
    for (size_t v = 0; v < sizeof views / sizeof *views; v++) {
        const view *w = views + v;
        char what[64];
        rt_arg args[] = {RT_ARG(w->shape), RT_ARG(w->z)};
        draw("rectangle", (uint32_t)v, args, 2);
        double dx = (double)w->shape[2] / side, dy = (double)w->shape[3] / side, sum = 0;
        for (int i = 0; i < cells; i++) {
            double x = w->shape[0] + (i / side) * dx, y = w->shape[1] + (i % side) * dy;
            expected[i] = solid_angle(x, y, x + dx, y + dy, w->z);
            sum += expected[i];
        }
        for (int i = 0; i < cells; i++)
            expected[i] *= n / sum;
        for (int i = 0; i < n; i++)
            count_uniform(samples[i][0] / w->shape[2], samples[i][1] / w->shape[3]);
        snprintf(what, sizeof what, "rectangle, view %zu", v);
        expect_counts(counts, expected, cells, what);
    }
}

static void solid_angle_of_a_rectangle_agrees_with_the_closed_form(void **state)
{
    (void)state;
    for (size_t v = 0; v < sizeof views / sizeof *views; v++) {
        const view *w = views + v;
        const float *s = w->shape;
        rt_arg args[] = {RT_ARG(w->shape), RT_ARG(w->z)};
        draw("rectangle", 0, args, 2);
        double truth = solid_angle(s[0], s[1], (double)s[0] + s[2], (double)s[1] + s[3], w->z);
        assert_float_equal(samples[0][2], truth, 1e-6);
        assert_float_equal(samples[0][3] * samples[0][2], 1, 1e-6);
    }
}

static void cap_is_uniform_in_the_cone_of_directions(void **state)
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
            /* From the viewer at (0, 0, d): sine and cosine of the angle to the axis. */
            double r2 = (double)p[0] * p[0] + (double)p[1] * p[1], z = d - p[2];
            double s2 = r2 / (r2 + z * z), h = s2 / (1 + sqrt(1 - s2));
            assert_float_equal(r2 + (double)p[2] * p[2], 1, 1e-5);
            count_uniform(h / height > 1 && h / height < 1.002 ? 1 : h / height, turn(p[0], p[1]));
            assert_float_equal(p[3] * 2 * PI * height, 1, 5e-4);
        }
        expect_uniform("visible cap");
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
    rt_buffer_release(given);
    rt_buffer_release(out);
    rt_kernel_release(kernel);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(disc_is_uniform_in_area),
        cmocka_unit_test(cosine_hemisphere_follows_the_cosine),
        cmocka_unit_test(sphere_is_uniform_in_solid_angle),
        cmocka_unit_test(triangle_is_uniform_in_area),
        cmocka_unit_test(rectangle_is_uniform_in_solid_angle),
        cmocka_unit_test(solid_angle_of_a_rectangle_agrees_with_the_closed_form),
        cmocka_unit_test(cap_is_uniform_in_the_cone_of_directions),
        cmocka_unit_test(elementary_functions_are_precise),
    };
    return cmocka_run_group_tests_name("kernels/sample", tests, NULL, NULL);
}
