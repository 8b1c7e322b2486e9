/* Agreement block by block: it must pass noise and catch errors just past what is allowed. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/statistics.h"
#include "support.h"

#define SIDE 128u
#define VALUES (3u * SIDE * SIDE)
#define BLOCK 16u /* the default */
#define TINY 1e-12
#define RENDERS_MAX 8

static double uniform(uint64_t *state)
{
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(*state >> 11) / 9007199254740992.0;
}

/* Noise of mean 0 and variance 1 with a long tail to the bright side, as that of path tracing. */
static double noise(uint64_t *state)
{
    return -log(1.0 - uniform(state)) - 1.0;
}

/*
 * A picture with a slope and an edge, times `scale`, with noise of relative deviation `deviation`.
 */
static float *picture(double scale, double deviation, uint64_t seed)
{
    float *rgb = malloc(VALUES * sizeof *rgb);
    assert_non_null(rgb);
    seed = test_seed((uint32_t)seed);
    for (uint32_t i = 0; i < VALUES; i++) {
        uint32_t x = i / 3 % SIDE, y = i / 3 / SIDE;
        double exact = (0.2 + 0.01 * y + (x > 37 ? 1.0 : 0.0)) * (1 + i % 3);
        rgb[i] = (float)(scale * exact * (1.0 + deviation * noise(&seed)));
    }
    return rgb;
}

/* What a comparison found: its measures and its worst block, in the worst channel. */
typedef struct result {
    rt_comparison_info info;
    uint32_t x, y;
    double reference, error, excess;
} result;

/*
 * Renders of SIDE x SIDE against a reference of that size; a tolerance of almost 0 leaves the noise
 * alone.
 */
static result compare_renders(const float *const *renders, size_t count, const float *reference,
                              double tolerance)
{
    rt_image *images[RENDERS_MAX] = {0}, *exact = NULL;
    rt_comparison *comparison = NULL;
    rt_compare_options options = {.tolerance = tolerance};
    rt_error error;
    result r;
    size_t blocks;
    for (size_t i = 0; i < count; i++)
        expect_ok(rt_image_from_rgb(&images[i], renders[i], SIDE, SIDE, &error), &error);
    expect_ok(rt_image_from_rgb(&exact, reference, SIDE, SIDE, &error), &error);
    expect_ok(rt_image_compare(&comparison, (const rt_image *const *)images, count, exact, &options,
                               &error),
              &error);
    rt_comparison_get_info(comparison, &r.info);
    const rt_image_block *block = rt_comparison_blocks(comparison, &blocks) + r.info.worst;
    assert_int_equal(blocks, (SIDE / BLOCK) * (SIDE / BLOCK));
    r.x = block->x;
    r.y = block->y;
    r.reference = block->reference[r.info.worst_channel];
    r.error = block->error[r.info.worst_channel];
    r.excess = block->excess[r.info.worst_channel];
    rt_comparison_destroy(comparison);
    rt_image_destroy(exact);
    for (size_t i = 0; i < count; i++)
        rt_image_destroy(images[i]);
    return r;
}

static result compare(const float *render, const float *reference, double tolerance)
{
    return compare_renders(&render, 1, reference, tolerance);
}

static void equal_images_agree(void **state)
{
    (void)state;
    float *a = picture(1.0, 0.1, 1);
    result result = compare(a, a, TINY);
    assert_int_equal(result.info.off, 0);
    assert_true(result.info.rmse == 0.0 && result.info.ratio == 1.0 && result.excess == 0.0);
    free(a);
}

static void the_tolerance_is_where_it_says(void **state)
{
    (void)state;
    float *reference = picture(1.0, 0.0, 1), *within = picture(1.009, 0.0, 1),
          *beyond = picture(1.011, 0.0, 1);
    /*
     * Without noise but with an edge inside: the plane and the edge must not pass for noise of a
     * percent.
     */
    assert_int_equal(compare(within, reference, 0.01).info.off, 0);
    result result = compare(beyond, reference, 0.01);
    assert_true(result.info.off > result.info.blocks / 2);
    assert_true(fabs(result.info.ratio - 1.011) < 1e-5);
    free(beyond);
    free(within);
    free(reference);
}

static void noise_alone_agrees_and_is_measured(void **state)
{
    (void)state;
    float *reference = picture(1.0, 0.3, 1), *render = picture(1.0, 0.4, 2);
    result result = compare(render, reference, TINY);
    /* The noise has a tail: a block is off in one of 60 runs. */
    expect_close(result.info.off, 0, 1, "blocks that noise puts off");
    /* Relative error of a block's difference: sqrt(0.3^2 + 0.4^2) / 16. */
    assert_true(result.error / result.reference > 0.7 * 0.5 / 16);
    assert_true(result.error / result.reference < 1.4 * 0.5 / 16);
    free(render);
    free(reference);
}

static void an_error_above_the_noise_is_caught(void **state)
{
    (void)state;
    /* The noise of a block is 0.5 / 16 = 3.1 percent; 25 percent is eight times that. */
    float *reference = picture(1.0, 0.3, 1), *render = picture(1.25, 0.4, 2);
    result result = compare(render, reference, 0.01);
    assert_true(result.info.off > result.info.blocks / 2);
    free(render);
    free(reference);
}

static void one_wrong_block_is_found(void **state)
{
    (void)state;
    float *reference = picture(1.0, 0.01, 1), *render = picture(1.0, 0.01, 2);
    for (uint32_t y = 32; y < 48; y++)
        for (uint32_t x = 80; x < 96; x++)
            render[3 * (y * SIDE + x) + 1] *= 1.02f;
    result result = compare(render, reference, 0.01);
    assert_int_equal(result.info.off, 1);
    assert_int_equal(result.x, 80);
    assert_int_equal(result.y, 32);
    assert_int_equal(result.info.worst_channel, 1);
    assert_true(result.excess > 1.5 && result.excess < 2.5);
    free(render);
    free(reference);
}

static void what_is_not_finite_fails(void **state)
{
    (void)state;
    static const float bad[] = {NAN, INFINITY, -INFINITY};
    for (int i = 0; i < 3; i++) {
        float *reference = picture(1.0, 0.01, 1), *render = picture(1.0, 0.01, 2);
        render[3 * (20 * SIDE + 20)] = bad[i];
        result result = compare(render, reference, 0.01);
        assert_int_equal(result.info.off, 1);
        assert_int_equal(result.x, 16);
        assert_int_equal(result.y, 16);
        free(render);
        free(reference);
    }
}

static void black_agrees_with_black_alone(void **state)
{
    (void)state;
    float *black = calloc(VALUES, sizeof *black), *grey = picture(1.0, 0.0, 1);
    assert_non_null(black);
    assert_int_equal(compare(black, black, 0.01).info.off, 0);
    result result = compare(grey, black, 0.01);
    assert_true(result.info.off > result.info.blocks / 2);
    free(grey);
    free(black);
}

/* Noise that all pixels of a block share, of relative deviation 2 percent. */
static float *blotchy(double scale, uint64_t seed)
{
    float *rgb = picture(scale, 0.0, 1);
    seed = test_seed((uint32_t)seed);
    for (uint32_t row = 0; row < SIDE / BLOCK; row++)
        for (uint32_t column = 0; column < SIDE / BLOCK; column++) {
            double factor = 1.0 + 0.02 * noise(&seed);
            for (uint32_t i = 0; i < BLOCK * BLOCK; i++) {
                uint32_t x = column * BLOCK + i % BLOCK, y = row * BLOCK + i / BLOCK;
                for (int c = 0; c < 3; c++)
                    rgb[3 * (y * SIDE + x) + (uint32_t)c] *= (float)factor;
            }
        }
    return rgb;
}

static void shared_noise_is_measured_from_several_renders(void **state)
{
    (void)state;
    enum { COUNT = RENDERS_MAX };
    const float *renders[COUNT], *wrong[COUNT];
    float *reference = picture(1.0, 0.0, 1);
    for (int i = 0; i < COUNT; i++) {
        renders[i] = blotchy(1.0, 10 + (uint64_t)i);
        wrong[i] = blotchy(1.06, 30 + (uint64_t)i);
    }
    /*
     * One render alone does not show its noise; several do, and still an error of 6 percent is
     * seen.
     */
    result alone = compare_renders(renders, 1, reference, 0.005);
    result several = compare_renders(renders, COUNT, reference, 0.005);
    result off = compare_renders(wrong, COUNT, reference, 0.005);
    assert_true(alone.info.off > alone.info.blocks / 4);
    /* One is off in one of 6 runs: eight renders do not know their noise well. */
    expect_close(several.info.off, 0, 3, "blocks that shared noise puts off");
    assert_true(off.info.off > off.info.blocks / 2);
    for (int i = 0; i < COUNT; i++) {
        free((void *)renders[i]);
        free((void *)wrong[i]);
    }
    free(reference);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_images_agree),
        cmocka_unit_test(the_tolerance_is_where_it_says),
        statistical_test(noise_alone_agrees_and_is_measured),
        cmocka_unit_test(an_error_above_the_noise_is_caught),
        cmocka_unit_test(one_wrong_block_is_found),
        cmocka_unit_test(what_is_not_finite_fails),
        cmocka_unit_test(black_agrees_with_black_alone),
        statistical_test(shared_noise_is_measured_from_several_renders),
    };
    return cmocka_run_group_tests_name("lib/image/compare_blocks", tests, NULL, NULL);
}
