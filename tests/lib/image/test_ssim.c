/* Structural similarity, against closed forms and an independent program. */
#include <math.h>

#include "image/ssim.h"
#include "image/srgb.h"
#include "lib/image/pictures.h"
#include "support.h"

static double similarity(const float *a, const float *b)
{
    double value = 0.0;
    assert_int_equal(rt_ssim(&value, a, b, WIDTH, HEIGHT, 0.0, NULL), RT_OK);
    return value;
}

static void equal_pictures_are_similar(void **state)
{
    (void)state;
    float a[VALUES];
    picture_texture(a);
    assert_true(similarity(a, a) == 1.0);
}

static void contrast_counts_by_the_formula(void **state)
{
    (void)state;
    float a[VALUES], b[VALUES];
    /* Of a checkerboard's two kinds of pixel a window sees shares that its weights give. */
    double weights[11], sum = 0.0, even = 0.0;
    for (int i = 0; i < 11; i++)
        sum += weights[i] = exp(-0.5 * (i - 5) * (i - 5) / 2.25);
    for (int i = 0; i < 11; i += 2)
        even += weights[i] / sum;
    /* of the kind in its middle and corners */
    double share = even * even + (1.0 - even) * (1.0 - even);
    for (size_t i = 0; i < VALUES; i++) {
        int odd = (int)((i / 3 % WIDTH + i / 3 / WIDTH) % 2);
        a[i] = (float)rt_srgb_decode(odd ? 0.75 : 0.25);
        b[i] = (float)rt_srgb_decode(odd ? 0.6 : 0.4);
    }
    double expected = 0.0;
    for (int kind = 0; kind < 2; kind++) {
        double p = kind ? share : 1.0 - share, mx = 0.25 + 0.5 * p, my = 0.4 + 0.2 * p;
        double vx = 0.25 * p * (1 - p), vy = 0.04 * p * (1 - p), cov = 0.1 * p * (1 - p);
        expected += 0.5 * (2 * mx * my + 1e-4) * (2 * cov + 9e-4) /
                    ((mx * mx + my * my + 1e-4) * (vx + vy + 9e-4));
    }
    expect_measure(similarity(a, b), expected, 1e-5);
}

/* Values by structural_similarity of scikit-image 0.26, with the paper's window and moments. */
static void an_independent_program_agrees(void **state)
{
    (void)state;
    float a[VALUES], tint[VALUES], dot[VALUES], step[VALUES];
    picture_texture(a);
    picture_changed(tint, dot, step);
    expect_measure(similarity(tint, a), 0.99854417, 1e-6);
    expect_measure(similarity(dot, a), 0.99356491, 1e-6);
    expect_measure(similarity(step, a), 0.90649719, 1e-6);
    expect_measure(similarity(a, step), 0.90649719, 1e-6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_pictures_are_similar),
        cmocka_unit_test(contrast_counts_by_the_formula),
        cmocka_unit_test(an_independent_program_agrees),
    };
    return cmocka_run_group_tests_name("lib/image/ssim", tests, NULL, NULL);
}
