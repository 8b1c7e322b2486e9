/* Comparison of images: measures whose values are known in closed form, and what is refused. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "image/image.h"
#include "image/srgb.h"
#include "scratch.h"
#include "support.h"

#define WIDTH 40u
#define HEIGHT 24u
#define VALUES (3u * WIDTH * HEIGHT)

static rt_image *image_of(const float *rgb)
{
    rt_image *image = NULL;
    assert_int_equal(rt_image_from_rgb(&image, rgb, WIDTH, HEIGHT, NULL), RT_OK);
    return image;
}

static rt_comparison *compare_with(const float *a, const float *b,
                                   const rt_compare_options *options)
{
    rt_image *x = image_of(a), *y = image_of(b);
    const rt_image *renders[1] = {x};
    rt_comparison *comparison = NULL;
    rt_error error;
    expect_ok(rt_image_compare(&comparison, renders, 1, y, options, &error), &error);
    rt_image_destroy(x);
    rt_image_destroy(y);
    return comparison;
}

static rt_comparison_info compare(const float *a, const float *b)
{
    rt_comparison_info info;
    rt_comparison *comparison = compare_with(a, b, NULL);
    rt_comparison_get_info(comparison, &info);
    rt_comparison_destroy(comparison);
    return info;
}

/* All values alike. */
static void fill(float *rgb, float value)
{
    for (size_t i = 0; i < VALUES; i++)
        rgb[i] = value;
}

/* A picture of many values in 0..1, the same in all three channels. */
static void texture(float *rgb)
{
    for (size_t i = 0; i < VALUES; i++) {
        double x = (double)(i / 3 % WIDTH), y = (double)(i / 3 / WIDTH);
        rgb[i] = (float)(0.5 + 0.3 * sin(0.7 * x) * cos(0.4 * y) + 0.005 * x);
    }
}

static void assert_close(double found, double expected, double relative)
{
    if (!(fabs(found - expected) <= relative * fabs(expected)))
        fail_msg("%.12g instead of %.12g", found, expected);
}

/* ---- Measures ----------------------------------------------------------------- */

static void equal_pictures_differ_in_nothing(void **state)
{
    (void)state;
    float a[VALUES];
    texture(a);
    rt_comparison_info info = compare(a, a);
    assert_int_equal(info.width, WIDTH);
    assert_int_equal(info.height, HEIGHT);
    assert_true(info.mse == 0.0 && info.rmse == 0.0 && info.relmse == 0.0 && info.typical == 0.0);
    assert_true(info.ratio == 1.0 && info.ratio_error == 0.0 && info.ssim == 1.0 &&
                info.flip == 0.0);
    assert_int_equal(info.blocks, 6);
    assert_int_equal(info.off, 0);
}

static void a_constant_offset_has_its_measures(void **state)
{
    (void)state;
    float a[VALUES], b[VALUES];
    fill(a, 0.75f);
    fill(b, 0.5f);
    rt_comparison_info info = compare(a, b);
    assert_close(info.mse, 0.0625, 1e-12);
    assert_close(info.rmse, 0.25, 1e-12);
    assert_close(info.relmse, 0.0625 / 0.26, 1e-12);
    assert_close(info.ratio, 1.5, 1e-12);
    assert_close(info.typical, 0.25, 0.01);
    assert_int_equal(info.off, info.blocks);
    /* The variances are zero: what is left is the comparison of means. */
    double x = rt_srgb_encode(0.75), y = rt_srgb_encode(0.5);
    assert_close(info.ssim, (2 * x * y + 1e-4) / (x * x + y * y + 1e-4), 1e-9);
}

static void channels_are_told_apart(void **state)
{
    (void)state;
    float a[VALUES], b[VALUES];
    fill(a, 1.0f);
    fill(b, 1.0f);
    for (size_t i = 0; i < VALUES; i += 3) {
        a[i] = 2.0f;
        a[i + 2] = 0.5f;
    }
    rt_comparison_info info = compare(a, b);
    assert_close(info.mse, 1.25 / 3.0, 1e-12);
    assert_close(info.ratio_rgb[0], 2.0, 1e-12);
    assert_close(info.ratio_rgb[1], 1.0, 1e-12);
    assert_close(info.ratio_rgb[2], 0.5, 1e-12);
    assert_int_equal(info.worst_channel, 0);
}

static void exposure_is_what_a_person_sees(void **state)
{
    (void)state;
    float a[VALUES], b[VALUES];
    rt_compare_options options = {.exposure = -2.0};
    rt_comparison_info info;
    fill(a, 4.0f);
    fill(b, 2.0f);
    info = compare(a, b);
    assert_true(info.ssim == 1.0 && info.flip == 0.0);
    rt_comparison *comparison = compare_with(a, b, &options);
    rt_comparison_get_info(comparison, &info);
    double y = rt_srgb_encode(0.5);
    assert_close(info.ssim, (2 * y + 1e-4) / (1 + y * y + 1e-4), 1e-9);
    assert_true(info.flip > 0.1);
    assert_close(info.rmse, 2.0, 1e-12);
    rt_comparison_destroy(comparison);
}

static void small_pictures_have_no_ssim(void **state)
{
    (void)state;
    rt_image *image = NULL;
    rt_comparison *comparison = NULL;
    rt_comparison_info info;
    float rgb[3 * 10 * 11] = {0};
    assert_int_equal(rt_image_from_rgb(&image, rgb, 10, 11, NULL), RT_OK);
    const rt_image *renders[1] = {image};
    assert_int_equal(rt_image_compare(&comparison, renders, 1, image, NULL, NULL), RT_OK);
    rt_comparison_get_info(comparison, &info);
    assert_true(isnan(info.ssim) && isnan(info.ratio));
    assert_true(info.mse == 0.0);
    rt_comparison_destroy(comparison);
    rt_image_destroy(image);
}

static void what_is_not_finite_is_counted_and_left_out(void **state)
{
    (void)state;
    float a[VALUES], b[VALUES];
    fill(a, 0.75f);
    fill(b, 0.5f);
    a[3 * 5] = NAN;
    a[3 * 5 + 1] = INFINITY;
    a[3 * 90 + 2] = -INFINITY;
    b[3 * 200] = NAN;
    rt_comparison_info info = compare(a, b);
    assert_int_equal(info.not_finite[0], 2);
    assert_int_equal(info.not_finite[1], 1);
    assert_close(info.mse, 0.0625, 1e-12);
    assert_close(info.ratio, 1.5, 1e-12);
    assert_true(isfinite(info.ssim) && isfinite(info.ratio_error));
}

/* ---- Blocks --------------------------------------------------------------------- */

static void blocks_cover_the_picture(void **state)
{
    (void)state;
    float a[VALUES];
    rt_compare_options options = {.block = 7};
    size_t count, pixels = 0;
    texture(a);
    rt_comparison *comparison = compare_with(a, a, &options);
    const rt_image_block *blocks = rt_comparison_blocks(comparison, &count);
    assert_int_equal(count, 6 * 4);
    for (size_t i = 0; i < count; i++) {
        assert_int_equal(blocks[i].x, 7 * (i % 6));
        assert_int_equal(blocks[i].y, 7 * (i / 6));
        pixels += blocks[i].width * blocks[i].height;
    }
    assert_int_equal(pixels, WIDTH * HEIGHT);
    rt_comparison_destroy(comparison);
}

/* An image with a layer that says how noisy each pixel is. */
static rt_image *image_with_variance(float value, float variance)
{
    static const char *const names[] = {"variance.B", "B", "variance.G", "G", "variance.R", "R"};
    rt_image *image = NULL;
    assert_int_equal(rt_image_create(&image, WIDTH, HEIGHT, names, 6, NULL), RT_OK);
    for (size_t i = 0; i < 2 * VALUES; i += 2) {
        image->data[i] = variance;
        image->data[i + 1] = value;
    }
    return image;
}

static void known_variance_is_the_noise(void **state)
{
    (void)state;
    rt_image *a = image_with_variance(0.54f, 0.03f), *b = image_with_variance(0.5f, 0.01f),
             *plain = NULL;
    rt_comparison *comparison = NULL;
    rt_comparison_info info;
    float rgb[VALUES];
    size_t count;
    fill(rgb, 0.5f);
    plain = image_of(rgb);
    const rt_image *one[1] = {a}, *two[2] = {a, a};
    /*
     * A difference of 0.04 with a standard error of 0.2 / 16, in the smaller blocks below 0.2 / 11.
     */
    assert_int_equal(rt_image_compare(&comparison, one, 1, b, NULL, NULL), RT_OK);
    rt_comparison_get_info(comparison, &info);
    assert_close(rt_comparison_blocks(comparison, &count)[0].error[1], 0.2 / 16.0, 1e-6);
    assert_int_equal(info.off, 0);
    assert_close(info.worst ? 0.0 : info.ratio_error, 0.2 / sqrt(WIDTH * HEIGHT) / 0.5, 1e-6);
    rt_comparison_destroy(comparison);
    /* Of two renders the mean has half the variance: 0.015 and 0.01. */
    assert_int_equal(rt_image_compare(&comparison, two, 2, b, NULL, NULL), RT_OK);
    assert_close(rt_comparison_blocks(comparison, &count)[0].error[1], sqrt(0.025) / 16.0, 1e-6);
    rt_comparison_destroy(comparison);
    /* Where one image does not know its noise, none is assumed known. */
    assert_int_equal(rt_image_compare(&comparison, one, 1, plain, NULL, NULL), RT_OK);
    assert_true(rt_comparison_blocks(comparison, &count)[0].error[1] < 1e-6);
    rt_comparison_destroy(comparison);
    rt_image_destroy(plain);
    rt_image_destroy(a);
    rt_image_destroy(b);
}

/* ---- Layers and files ------------------------------------------------------------- */

static void layers_are_found_by_name(void **state)
{
    (void)state;
    static const char *const names[] = {"A",   "B",       "G",     "R",    "n.Z", "n.Y",
                                        "n.X", "depth.Z", "a.b.R", "uv.V", "uv.U"};
    rt_image *image = NULL;
    rt_error error;
    float rgb[3];
    assert_int_equal(rt_image_create(&image, 1, 1, names, 11, NULL), RT_OK);
    for (int i = 0; i < 11; i++)
        image->data[i] = (float)i;
    expect_ok(rt_image_get_rgb(rgb, image, NULL, &error), &error);
    assert_true(rgb[0] == 3 && rgb[1] == 2 && rgb[2] == 1);
    expect_ok(rt_image_get_rgb(rgb, image, "n", &error), &error);
    assert_true(rgb[0] == 6 && rgb[1] == 5 && rgb[2] == 4);
    expect_ok(rt_image_get_rgb(rgb, image, "depth", &error), &error);
    assert_true(rgb[0] == 7 && rgb[1] == 7 && rgb[2] == 7);
    expect_ok(rt_image_get_rgb(rgb, image, "a.b", &error), &error);
    assert_true(rgb[0] == 8);
    expect_ok(rt_image_get_rgb(rgb, image, "n.Y", &error), &error);
    assert_true(rgb[0] == 5 && rgb[2] == 5);
    expect_ok(rt_image_get_rgb(rgb, image, "uv", &error), &error);
    assert_true(rgb[0] == 10 && rgb[1] == 9 && rgb[2] == 0);
    assert_int_equal(rt_image_get_rgb(rgb, image, "detph", &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "(did you mean 'depth'?)"));
    assert_int_equal(rt_image_get_rgb(rgb, image, "a", &error), RT_ERROR_INPUT);
    assert_int_equal(rt_image_get_rgb(rgb, image, "albedo", &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "albedo"));
    assert_non_null(strstr(error.message, "depth.Z"));
    rt_image_destroy(image);
}

static void formats_of_one_picture_agree(void **state)
{
    (void)state;
    static const char *const names[] = {"a.exr", "a.pfm", "a.png", "a.ppm"};
    rt_image *image, *copy = NULL;
    float a[VALUES], b[VALUES];
    texture(a);
    image = image_of(a);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(rt_image_write(image, names[i], NULL, NULL), RT_OK);
        assert_int_equal(rt_image_read(&copy, names[i], NULL), RT_OK);
        assert_int_equal(rt_image_get_rgb(b, copy, NULL, NULL), RT_OK);
        rt_image_destroy(copy);
        if (i < 2)
            assert_memory_equal(a, b, sizeof a);
        /*
         * Half a step of 1/255; the sRGB curve is nowhere steeper than 2.4 / 1.055 in linear
         * values.
         */
        for (size_t k = 0; k < VALUES; k++)
            assert_true(fabs(a[k] - b[k]) <= 0.5 / 255.0 * 2.4 / 1.055 * 1.001);
    }
    rt_image_destroy(image);
}

static void the_difference_is_signed_and_coloured(void **state)
{
    (void)state;
    float a[VALUES], b[VALUES], d[VALUES];
    rt_image *image = NULL;
    fill(a, 0.5f);
    fill(b, 0.5f);
    a[1] = 0.75f;
    a[3 + 2] = 0.375f;
    a[6] = NAN;
    rt_comparison *comparison = compare_with(a, b, NULL);
    assert_int_equal(rt_comparison_write_difference(comparison, "d.exr", 0.0, NULL), RT_OK);
    assert_int_equal(rt_image_read(&image, "d.exr", NULL), RT_OK);
    assert_int_equal(rt_image_get_rgb(d, image, NULL, NULL), RT_OK);
    rt_image_destroy(image);
    assert_true(d[0] == 0.0f && d[1] == 0.25f && d[5] == -0.125f && isnan(d[6]));

    static const double expected[4][3] = {{1, 0, 0}, {0.5, 0.5, 1}, {0, 0, 0}, {1, 1, 1}};
    assert_int_equal(rt_comparison_write_difference(comparison, "d.png", 0.25, NULL), RT_OK);
    assert_int_equal(rt_image_read(&image, "d.png", NULL), RT_OK);
    for (int i = 0; i < 4; i++)
        for (int c = 0; c < 3; c++)
            assert_true(fabs(image->data[3 * i + c] - expected[i][c]) < 0.003);
    rt_image_destroy(image);
    /* Two pixels of many differ: full is the largest difference. */
    rt_comparison_info info;
    rt_comparison_get_info(comparison, &info);
    assert_close(info.typical, 0.25, 0.01);

    assert_int_equal(rt_comparison_write_difference(comparison, "missing/d.png", 0.0, NULL),
                     RT_ERROR_OUTPUT);
    assert_int_equal(rt_comparison_write_difference(comparison, "d.tiff", 0.0, NULL),
                     RT_ERROR_USAGE);
    assert_int_equal(rt_comparison_write_difference(comparison, "d.png", -1.0, NULL),
                     RT_ERROR_USAGE);
    rt_comparison_destroy(comparison);
}

static void what_cannot_be_compared_is_refused(void **state)
{
    (void)state;
    float rgb[VALUES] = {0};
    rt_image *image = image_of(rgb), *turned = NULL;
    rt_comparison *comparison = NULL;
    rt_error error;
    assert_int_equal(rt_image_from_rgb(&turned, rgb, HEIGHT, WIDTH, NULL), RT_OK);
    const rt_image *renders[2] = {image, turned};
    assert_int_equal(rt_image_compare(&comparison, renders, 2, image, NULL, &error),
                     RT_ERROR_INPUT);
    assert_string_equal(error.message, "image 2 has 24x40 pixels but the reference 40x24");
    assert_int_equal(rt_image_compare(&comparison, renders, 0, image, NULL, &error),
                     RT_ERROR_USAGE);
    static const rt_compare_options bad[] = {{.tolerance = -0.1},
                                             {.tolerance = NAN},
                                             {.tolerance = 1.5},
                                             {.exposure = INFINITY},
                                             {.exposure = NAN}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_int_equal(rt_image_compare(&comparison, renders, 1, image, &bad[i], &error),
                         RT_ERROR_USAGE);
        assert_string_equal(error.field, i < 3 ? "tolerance" : "exposure");
    }
    rt_compare_options missing = {.layer = "albedo"};
    assert_int_equal(rt_image_compare(&comparison, renders, 1, image, &missing, &error),
                     RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "the reference has no layer 'albedo'"));
    assert_null(comparison);
    rt_image_destroy(image);
    rt_image_destroy(turned);
}

int main(void)
{
#define IN_SCRATCH(test) cmocka_unit_test_setup_teardown(test, scratch_enter, scratch_leave)
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_pictures_differ_in_nothing),
        cmocka_unit_test(a_constant_offset_has_its_measures),
        cmocka_unit_test(channels_are_told_apart),
        cmocka_unit_test(exposure_is_what_a_person_sees),
        cmocka_unit_test(small_pictures_have_no_ssim),
        cmocka_unit_test(what_is_not_finite_is_counted_and_left_out),
        cmocka_unit_test(blocks_cover_the_picture),
        cmocka_unit_test(known_variance_is_the_noise),
        cmocka_unit_test(layers_are_found_by_name),
        IN_SCRATCH(formats_of_one_picture_agree),
        IN_SCRATCH(the_difference_is_signed_and_coloured),
        cmocka_unit_test(what_cannot_be_compared_is_refused),
    };
    return cmocka_run_group_tests_name("lib/image/compare", tests, NULL, NULL);
}
