/* The 8-bit picture: sRGB, exposure and tone maps against their formulas. */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "image/display.h"
#include "image/srgb.h"

static const char *const bgr[3] = {"B", "G", "R"};

/* The linear value of an sRGB value, by the inverse formula of the standard. */
static double srgb_decode(double value)
{
    return value <= 0.04045 ? value / 12.92 : pow((value + 0.055) / 1.055, 2.4);
}

static void show(uint8_t out[3], float r, float g, float b, float exposure, rt_tonemap tonemap)
{
    rt_image *image = NULL;
    uint8_t *rgb8 = NULL;
    rt_image_options options = {0};
    options.exposure = exposure;
    options.tonemap = tonemap;
    assert_int_equal(rt_image_create(&image, 1, 1, bgr, 3, NULL), RT_OK);
    image->data[0] = b;
    image->data[1] = g;
    image->data[2] = r;
    assert_int_equal(rt_display_rgb8(&rgb8, image, &options, NULL), RT_OK);
    memcpy(out, rgb8, 3);
    free(rgb8);
    rt_image_destroy(image);
}

static void expect(float r, float g, float b, float exposure, rt_tonemap tonemap, int r8, int g8,
                   int b8)
{
    uint8_t out[3];
    show(out, r, g, b, exposure, tonemap);
    assert_int_equal(out[0], r8);
    assert_int_equal(out[1], g8);
    assert_int_equal(out[2], b8);
}

static void every_code_is_the_nearest_to_its_interval(void **state)
{
    (void)state;
    for (int code = 0; code < 256; code++) {
        assert_int_equal(rt_srgb_quantise(srgb_decode(code / 255.0)), code);
        /*
         * The steps lie in the middle between codes: just inside either end the code still holds.
         */
        if (code > 0)
            assert_int_equal(rt_srgb_quantise(srgb_decode((code - 0.5 + 1e-9) / 255.0)), code);
        if (code < 255)
            assert_int_equal(rt_srgb_quantise(srgb_decode((code + 0.5 - 1e-9) / 255.0)), code);
    }
}

static void encoding_is_continuous_and_rises(void **state)
{
    (void)state;
    double last = -1.0;
    for (int i = 0; i <= 100000; i++) {
        double value = rt_srgb_encode(i / 100000.0);
        assert_true(value > last && value - last < 0.01 + (i == 0));
        last = value;
    }
    assert_true(rt_srgb_encode(1.0) == 1.0);
}

static void values_without_a_colour_have_a_defined_one(void **state)
{
    (void)state;
    for (int map = RT_TONEMAP_NONE; map <= RT_TONEMAP_ACES; map++) {
        expect(NAN, -1.0f, -INFINITY, 0.0f, (rt_tonemap)map, 0, 0, 0);
        expect(INFINITY, INFINITY, INFINITY, 0.0f, (rt_tonemap)map, 255, 255, 255);
        expect(FLT_MAX, FLT_MAX, FLT_MAX, 1000.0f, (rt_tonemap)map, 255, 255, 255);
        expect(1.0f, 1.0f, 1.0f, -1000.0f, (rt_tonemap)map, 0, 0, 0);
    }
    expect(0.0f, -0.0f, FLT_MIN / 2, 0.0f, RT_TONEMAP_NONE, 0, 0, 0);
}

static void exposure_counts_stops(void **state)
{
    (void)state;
    /* 0.18 is 117.6 of 255, 0.36 is 161.5 and 0.09 is 84.9 (IEC 61966-2-1). */
    expect(0.18f, 0.18f, 0.18f, 0.0f, RT_TONEMAP_NONE, 118, 118, 118);
    expect(0.18f, 0.045f, 1.0f, 1.0f, RT_TONEMAP_NONE, rt_srgb_quantise(2 * (double)0.18f),
           rt_srgb_quantise(2 * (double)0.045f), 255);
    expect(0.18f, 0.18f, 0.18f, -1.0f, RT_TONEMAP_NONE, 85, 85, 85);
}

static void reinhard_maps_luminance_and_keeps_hue(void **state)
{
    (void)state;
    /* L = 1 becomes 1/2, which is 187.5 of 255 and a little. */
    expect(1.0f, 1.0f, 1.0f, 0.0f, RT_TONEMAP_REINHARD, 188, 188, 188);
    double red = 2.0 / (1.0 + 0.2126 * 2.0);
    double green = 0.5 / (1.0 + 0.7152 * 0.5);
    expect(0.0f, 0.5f, 0.0f, 0.0f, RT_TONEMAP_REINHARD, 0, rt_srgb_quantise(green), 0);
    expect(2.0f, 0.0f, 0.0f, 0.0f, RT_TONEMAP_REINHARD, rt_srgb_quantise(red), 0, 0);
}

static void aces_follows_its_fit(void **state)
{
    (void)state;
    /* x = 1: 2.54 / 3.16; x = 0.25: 0.164375 / 0.439375. */
    expect(1.0f, 0.25f, 0.0f, 0.0f, RT_TONEMAP_ACES, rt_srgb_quantise(2.54 / 3.16),
           rt_srgb_quantise(0.164375 / 0.439375), 0);
}

static void wrong_options_and_missing_channels_are_refused(void **state)
{
    (void)state;
    const char *const depth[1] = {"depth.Z"};
    rt_image *image = NULL;
    uint8_t *rgb8 = NULL;
    rt_image_options options = {0};
    rt_error error = {0};
    assert_int_equal(rt_image_create(&image, 1, 1, depth, 1, NULL), RT_OK);
    assert_int_equal(rt_display_rgb8(&rgb8, image, &options, NULL), RT_ERROR_USAGE);
    rt_image_destroy(image);
    assert_int_equal(rt_image_create(&image, 1, 1, bgr, 3, NULL), RT_OK);
    options.exposure = NAN;
    assert_int_equal(rt_display_rgb8(&rgb8, image, &options, &error), RT_ERROR_USAGE);
    assert_string_equal(error.field, "exposure");
    options.exposure = 0.0f;
    options.tonemap = (rt_tonemap)7;
    assert_int_equal(rt_display_rgb8(&rgb8, image, &options, &error), RT_ERROR_USAGE);
    assert_string_equal(error.field, "tonemap");
    assert_null(rgb8);
    rt_image_destroy(image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_code_is_the_nearest_to_its_interval),
        cmocka_unit_test(encoding_is_continuous_and_rises),
        cmocka_unit_test(values_without_a_colour_have_a_defined_one),
        cmocka_unit_test(exposure_counts_stops),
        cmocka_unit_test(reinhard_maps_luminance_and_keeps_hue),
        cmocka_unit_test(aces_follows_its_fit),
        cmocka_unit_test(wrong_options_and_missing_channels_are_refused),
    };
    return cmocka_run_group_tests_name("image/display", tests, NULL, NULL);
}
