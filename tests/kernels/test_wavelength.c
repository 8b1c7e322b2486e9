/*
 * test_wavelength.c - wavelengths of paths: white stays white whatever the throughput of a path is,
 * weights are bounded, and indices are those of Cauchy's and Sellmeier's equations.
 */
#include "support.h"

#include <math.h>
#include <string.h>

#include "sample/responses.h"
#include "types.h"

enum { count = 1 << 18 };
static float drawn[count][4];

/* ---- Drawing ---------------------------------------------------------------------- */

static void draw(float r, float g, float b)
{
    const cl_float4 beta = {{r, g, b, 0}};
    const cl_uint many = count;
    cl_kernel kernel = test_kernel("wavelength", "draw_wavelengths");
    cl_mem out = test_buffer(sizeof drawn, NULL);
    rt_arg args[] = {RT_ARG(many), RT_ARG(beta), RT_ARG(out)};
    test_run(kernel, args, 3, count);
    test_read(out, sizeof drawn, drawn);
    rt_buffer_release(test_device(), out);
    rt_kernel_release(kernel);
}

/* Of an even grid of numbers, the mean is the integral but for the kinks at knots. */
static void white_stays_white(void **state)
{
    static const float betas[][3] = {{1, 1, 1},          {0.2f, 0.9f, 0.5f}, {3, 0.01f, 0.002f},
                                     {1e-6f, 1e-3f, 10}, {0.5f, 0, 0.25f},   {0, 0, 2}};
    (void)state;
    for (size_t k = 0; k < sizeof betas / sizeof *betas; k++) {
        const double sum = (double)betas[k][0] + betas[k][1] + betas[k][2];
        double mean[3] = {0};
        draw(betas[k][0], betas[k][1], betas[k][2]);
        for (int i = 0; i < count; i++)
            for (int c = 0; c < 3; c++) {
                const double weighed = (double)betas[k][c] * drawn[i][c];
                assert_true(weighed >= 0 && weighed <= sum * (1 + 1e-5));
                mean[c] += weighed / count;
            }
        for (int c = 0; c < 3; c++)
            assert_float_equal(mean[c], betas[k][c], 2e-4 * sum);
    }
}

/* The part of the integral of a channel's response up to a wavelength, by the trapezoids. */
static double response_up_to(int channel, double length)
{
#define CHANNELS(red, green, blue) {red, green, blue},
    static const double rows[RT_KNOTS][3] = {RT_RESPONSES(CHANNELS)};
    double sum = 0;
    for (int i = 0; i < 330000; i++) {
        const double place = (i + 0.5) * 1e-4;
        const int knot = (int)place;
        if (0.38 + place * 0.01 < length)
            sum += 1e-8 * (rows[knot][channel] * (knot + 1 - place) +
                           rows[knot + 1][channel] * (place - knot));
    }
    return sum;
}

/* What is drawn up to a wavelength has the weight of the responses up to there. */
static void weights_follow_the_responses(void **state)
{
    static const double lengths[] = {0.4861, 0.543, 0.5876, 0.6563, 0.72};
    (void)state;
    draw(0.7f, 0.4f, 0.9f);
    for (size_t k = 0; k < sizeof lengths / sizeof *lengths; k++)
        for (int c = 0; c < 3; c++) {
            double sum = 0;
            for (int i = 0; i < count; i++)
                sum += drawn[i][3] < lengths[k] ? drawn[i][c] : 0;
            assert_float_equal(sum / count, response_up_to(c, lengths[k]), 5e-4);
        }
}

/* ---- Indices ---------------------------------------------------------------------- */

static void indices_are_those_of_the_equations(void **state)
{
    static const float lengths[4] = {0.4861327f, 0.6562725f, 0.4f, 0.55f};
    /* N-BK7 at the lines F and C, as its maker states; A + B / l^2; no dispersion. */
    static const double expected[4] = {1.52238, 1.51432, 1.5 + 0.004 / 0.16, 1.7};
    const cl_uint many = 4;
    float found[4];
    struct {
        rt_scene_header header;
        rt_material_data materials[4];
    } scene;
    (void)state;
    memset(&scene, 0, sizeof scene);
    scene.header.materials = sizeof scene.header / RT_SCENE_ROW;
    for (int i = 0; i < 2; i++) {
        scene.materials[i].flags = RT_MATERIAL_DISPERSIVE;
        assert_true(rt_glass_sellmeier(RT_GLASS_BK7, scene.materials[i].eta, scene.materials[i].k));
    }
    scene.materials[2].flags = RT_MATERIAL_DISPERSIVE | RT_MATERIAL_CAUCHY;
    scene.materials[2].eta[0] = 1.5f;
    scene.materials[2].eta[1] = 0.004f;
    scene.materials[3].ior = 1.7f;
    cl_kernel kernel = test_kernel("wavelength", "index_at");
    cl_mem s = test_buffer(sizeof scene, &scene), in = test_buffer(sizeof lengths, lengths);
    cl_mem out = test_buffer(sizeof found, NULL);
    rt_arg args[] = {RT_ARG(s), RT_ARG(many), RT_ARG(in), RT_ARG(out)};
    test_run(kernel, args, 4, 4);
    test_read(out, sizeof found, found);
    for (int i = 0; i < 4; i++)
        assert_float_equal(found[i], expected[i], 6e-6);
    rt_buffer_release(test_device(), s);
    rt_buffer_release(test_device(), in);
    rt_buffer_release(test_device(), out);
    rt_kernel_release(kernel);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(white_stays_white),
        cmocka_unit_test(weights_follow_the_responses),
        cmocka_unit_test(indices_are_those_of_the_equations),
    };
    return cmocka_run_group_tests_name("kernels/wavelength", tests, NULL, NULL);
}
