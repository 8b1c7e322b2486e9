/* FLIP, against closed forms and the values of the authors' own program. */
#include <math.h>

#include "image/flip.h"
#include "lib/image/pictures.h"
#include "support.h"

/* distance of green and blue to the power 0.7, from the formulas in float64 */
#define LARGEST 41.2765726

static double difference(const float *a, const float *b)
{
    double value = 0.0;
    assert_int_equal(rt_flip(&value, a, b, WIDTH, HEIGHT, 0.0, NULL), RT_OK);
    return value;
}

static void fill(float *rgb, float r, float g, float b)
{
    for (size_t i = 0; i < VALUES; i += 3) {
        rgb[i] = r;
        rgb[i + 1] = g;
        rgb[i + 2] = b;
    }
}

static void equal_pictures_do_not_differ(void **state)
{
    (void)state;
    float a[VALUES];
    picture_texture(a);
    assert_true(difference(a, a) == 0.0);
}

/*
 * Even greys have no features and no chroma: L* = 116 Y^(1/3) - 16, and small distances count by
 * their power 0.7.
 */
static void greys_differ_by_their_lightness(void **state)
{
    (void)state;
    float a[VALUES], b[VALUES], c[VALUES];
    fill(a, 0.5f, 0.5f, 0.5f);
    fill(b, 0.75f, 0.75f, 0.75f);
    fill(c, 0.55f, 0.55f, 0.55f);
    double wide = 116.0 * (cbrt(0.75) - cbrt(0.5)), narrow = 116.0 * (cbrt(0.55) - cbrt(0.5));
    expect_measure(difference(b, a), 0.95 * pow(wide, 0.7) / (0.4 * LARGEST), 1e-6);
    expect_measure(difference(c, a), 0.95 * pow(narrow, 0.7) / (0.4 * LARGEST), 1e-6);
}

static void green_and_blue_differ_most(void **state)
{
    (void)state;
    float green[VALUES], blue[VALUES], black[VALUES], white[VALUES];
    fill(green, 0.0f, 1.0f, 0.0f);
    fill(blue, 0.0f, 0.0f, 1.0f);
    fill(black, 0.0f, 0.0f, 0.0f);
    fill(white, 1.0f, 1.0f, 1.0f);
    expect_measure(difference(green, blue), 1.0, 1e-5);
    /* Beyond 0.4 of the largest, the rest of the scale is the last twentieth. */
    expect_measure(difference(black, white),
                   0.95 + 0.05 * (pow(100.0, 0.7) - 0.4 * LARGEST) / (0.6 * LARGEST), 1e-6);
}

/*
 * Values by flip-evaluator 1.7, LDR-FLIP of linear pictures; it computes in float, where even areas
 * have features.
 */
static void the_authors_program_agrees(void **state)
{
    (void)state;
    float a[VALUES], tint[VALUES], dot[VALUES], step[VALUES];
    picture_texture(a);
    picture_changed(tint, dot, step);
    expect_measure(difference(tint, a), 0.276229, 5e-5);
    expect_measure(difference(dot, a), 0.00167083, 2e-6);
    expect_measure(difference(step, a), 0.229748, 5e-5);
    expect_measure(difference(a, step), difference(step, a), 1e-9);
}

static void what_a_display_cannot_show_is_clamped(void **state)
{
    (void)state;
    float a[VALUES], b[VALUES];
    picture_texture(a);
    picture_texture(b);
    a[3] = 1.0f;
    b[3] = INFINITY;
    a[100] = 0.0f;
    b[100] = NAN;
    a[200] = 0.0f;
    b[200] = -5.0f;
    assert_true(difference(a, b) == 0.0);
}

/* A picture of several tiles is no other than one of its parts: the border goes on as it ends. */
static void tiles_do_not_show(void **state)
{
    (void)state;
    enum { WIDE = 150, HIGH = 70 };
    static float a[3 * WIDE * HIGH], b[3 * WIDE * HIGH];
    double value;
    for (size_t i = 0; i < 3 * WIDE * HIGH; i++) {
        a[i] = 0.5f;
        b[i] = i / 3 % WIDE == 64 ? 0.9f : 0.5f;
    }
    /* A line at a tile's border has the difference of the same line inside a tile. */
    assert_int_equal(rt_flip(&value, a, b, WIDE, HIGH, 0.0, NULL), RT_OK);
    double at_border = value;
    for (size_t i = 0; i < 3 * WIDE * HIGH; i++)
        b[i] = i / 3 % WIDE == 96 ? 0.9f : 0.5f;
    assert_int_equal(rt_flip(&value, a, b, WIDE, HIGH, 0.0, NULL), RT_OK);
    assert_true(value > 0.001);
    expect_measure(at_border, value, 1e-6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_pictures_do_not_differ),
        cmocka_unit_test(greys_differ_by_their_lightness),
        cmocka_unit_test(green_and_blue_differ_most),
        cmocka_unit_test(the_authors_program_agrees),
        cmocka_unit_test(what_a_display_cannot_show_is_clamped),
        cmocka_unit_test(tiles_do_not_show),
    };
    return cmocka_run_group_tests_name("lib/image/flip", tests, NULL, NULL);
}
