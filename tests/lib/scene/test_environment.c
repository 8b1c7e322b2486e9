/* test_environment.c - the distribution of an environment's image. */
#include "support.h"

#include <math.h>
#include <string.h>

#include "scene/environment.h"

enum { width = 8, height = 6 };
static const double pi = 3.14159265358979323846;

/* An image with bright and black pixels and a black row. */
static void make_image(float texels[height * width][4])
{
    memset(texels, 0, height * width * 4 * sizeof(float));
    for (int i = 0; i < height * width; i++)
        for (int c = 0; c < 3 && i / width != 2; c++)
            texels[i][c] = (float)((i * 7 + c * 3) % 11 < 4 ? 0 : (i * 5 + c) % 13);
    texels[4 * width + 3][1] = 500;
}

static void pixels_are_chosen_by_radiance_and_sine(void **state)
{
    static float texels[height * width][4], conditional[height][width + 1], marginal[height + 1];
    double weight[height][width], total = 0;
    (void)state;
    make_image(texels);
    double integral =
        rt_environment_tabulate(conditional[0], marginal, texels[0], width, height, 0);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            const float *t = texels[y * width + x];
            weight[y][x] = (t[0] + t[1] + t[2]) / 3.0 * sin(pi * (y + 0.5) / height);
            total += weight[y][x];
        }
    assert_float_equal(integral, total / (width * height), 1e-5 * total);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            double row = marginal[y + 1] - marginal[y],
                   pixel = conditional[y][x + 1] - conditional[y][x];
            assert_true(row >= 0 && pixel >= 0);
            assert_float_equal(row * pixel, weight[y][x] / total, 1e-6);
        }
}

static void distributions_run_from_zero_to_one(void **state)
{
    static float texels[height * width][4], conditional[height][width + 1], marginal[height + 1];
    (void)state;
    for (int black = 0; black < 2; black++) {
        make_image(texels);
        if (black)
            memset(texels, 0, sizeof texels);
        rt_environment_tabulate(conditional[0], marginal, texels[0], width, height, 0);
        assert_true(marginal[0] == 0 && marginal[height] == 1);
        for (int y = 0; y < height; y++)
            assert_true(conditional[y][0] == 0 && conditional[y][width] == 1);
    }
}

/* With a floor, radiance counts above it; below, a pixel is not chosen. */
static void radiance_counts_above_the_floor(void **state)
{
    static float texels[height * width][4], above[height * width][4];
    static float conditional[2][height][width + 1], marginal[2][height + 1];
    (void)state;
    for (int i = 0; i < height * width; i++)
        for (int c = 0; c < 3; c++) {
            texels[i][c] = (float)(i % 7);
            above[i][c] = fmaxf(texels[i][c] - 4, 0);
        }
    double a = rt_environment_tabulate(conditional[0][0], marginal[0], texels[0], width, height, 4);
    double b = rt_environment_tabulate(conditional[1][0], marginal[1], above[0], width, height, 0);
    assert_true(a == b && a > 0);
    assert_memory_equal(conditional[0], conditional[1], sizeof conditional[0]);
    assert_memory_equal(marginal[0], marginal[1], sizeof marginal[0]);
    assert_true(
        rt_environment_tabulate(conditional[0][0], marginal[0], texels[0], width, height, 6) == 0);
}

/* The same radiance from everywhere has itself as its mean; a white upper half has one half. */
static void the_mean_is_over_the_sphere(void **state)
{
    static float texels[height * width][4];
    float mean[3];
    (void)state;
    for (int i = 0; i < height * width; i++) {
        texels[i][0] = 3;
        texels[i][1] = i < height * width / 2;
    }
    rt_environment_mean(mean, texels[0], width, height);
    assert_float_equal(mean[0], 3, 1e-6);
    assert_float_equal(mean[1], 0.5, 1e-6);
    assert_true(mean[2] == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pixels_are_chosen_by_radiance_and_sine),
        cmocka_unit_test(distributions_run_from_zero_to_one),
        cmocka_unit_test(radiance_counts_above_the_floor),
        cmocka_unit_test(the_mean_is_over_the_sphere),
    };
    return cmocka_run_group_tests_name("lib/scene/environment", tests, NULL, NULL);
}
