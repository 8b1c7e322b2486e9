/* PNG: what libpng reads back is the exact sRGB quantisation of the image. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <png.h>

#include "image/display.h"
#include "image/png.h"

static const char *const gbr[3] = {"G", "B", "R"};

/* Values from -0.1 to 1.4 in an order without pattern, and some that are no colour. */
static rt_image *scattered(uint32_t width, uint32_t height)
{
    rt_image *image = NULL;
    uint32_t state = 1;
    assert_int_equal(rt_image_create(&image, width, height, gbr, 3, NULL), RT_OK);
    for (size_t i = 0; i < (size_t)3 * width * height; i++) {
        state = state * 1664525u + 1013904223u;
        image->data[i] = -0.1f + 1.5f * (float)(state >> 8) / 16777216.0f;
    }
    image->data[0] = NAN;
    image->data[1] = INFINITY;
    image->data[2] = -INFINITY;
    return image;
}

static uint8_t *read_back(const rt_bytes *file, uint32_t width, uint32_t height)
{
    png_image reader;
    memset(&reader, 0, sizeof reader);
    reader.version = PNG_IMAGE_VERSION;
    assert_true(png_image_begin_read_from_memory(&reader, file->data, file->size));
    assert_int_equal(reader.width, width);
    assert_int_equal(reader.height, height);
    assert_int_equal(reader.format, PNG_FORMAT_RGB);
    uint8_t *rgb8 = malloc(PNG_IMAGE_SIZE(reader));
    assert_non_null(rgb8);
    assert_true(png_image_finish_read(&reader, NULL, rgb8, 0, NULL));
    return rgb8;
}

static void check_size(uint32_t width, uint32_t height)
{
    rt_image *image = scattered(width, height);
    rt_image_options options = {0};
    rt_bytes bytes = {0}, again = {0};
    uint8_t *expected = NULL;
    options.exposure = 0.5f;
    assert_int_equal(rt_png_encode(&bytes, image, &options, NULL), RT_OK);
    assert_int_equal(rt_png_encode(&again, image, &options, NULL), RT_OK);
    assert_int_equal(bytes.size, again.size);
    assert_memory_equal(bytes.data, again.data, bytes.size);
    assert_int_equal(rt_display_rgb8(&expected, image, &options, NULL), RT_OK);
    uint8_t *found = read_back(&bytes, width, height);
    assert_memory_equal(found, expected, (size_t)3 * width * height);
    free(found);
    free(expected);
    rt_bytes_free(&again);
    rt_bytes_free(&bytes);
    rt_image_destroy(image);
}

static void pixels_come_back_at_every_size(void **state)
{
    (void)state;
    check_size(1, 1);
    check_size(7, 3);
    check_size(1, 200);
    check_size(333, 101);
}

/*
 * The value of sRGB code 0 to 255 nearest to a linear one, by search over the standard's inverse.
 */
static int nearest_code(double linear)
{
    for (int code = 0; code < 255; code++) {
        double middle = (code + 0.5) / 255.0;
        if (linear < (middle <= 0.04045 ? middle / 12.92 : pow((middle + 0.055) / 1.055, 2.4)))
            return code;
    }
    return 255;
}

static void a_pixel_is_the_nearest_srgb_code(void **state)
{
    (void)state;
    rt_image *image = scattered(64, 64);
    rt_image_options options = {0};
    rt_bytes bytes = {0};
    assert_int_equal(rt_png_encode(&bytes, image, &options, NULL), RT_OK);
    uint8_t *found = read_back(&bytes, 64, 64);
    /* The data holds G, B, R; pixel 0 holds no colours and is checked elsewhere. */
    for (size_t i = 1; i < 64 * 64; i++) {
        assert_int_equal(found[3 * i], nearest_code(image->data[3 * i + 2]));
        assert_int_equal(found[3 * i + 1], nearest_code(image->data[3 * i]));
        assert_int_equal(found[3 * i + 2], nearest_code(image->data[3 * i + 1]));
    }
    free(found);
    rt_bytes_free(&bytes);
    rt_image_destroy(image);
}

static void the_file_says_that_it_is_srgb(void **state)
{
    (void)state;
    rt_image *image = scattered(2, 2);
    rt_image_options options = {0};
    rt_bytes bytes = {0};
    int intent = -1;
    assert_int_equal(rt_png_encode(&bytes, image, &options, NULL), RT_OK);
    FILE *file = tmpfile();
    assert_non_null(file);
    assert_int_equal(fwrite(bytes.data, 1, bytes.size, file), bytes.size);
    rewind(file);
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_read_info(png, info);
    assert_int_equal(png_get_sRGB(png, info, &intent), PNG_INFO_sRGB);
    assert_int_equal(png_get_valid(png, info, PNG_INFO_tIME), 0);
    png_destroy_read_struct(&png, &info, NULL);
    fclose(file);
    rt_bytes_free(&bytes);
    rt_image_destroy(image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pixels_come_back_at_every_size),
        cmocka_unit_test(a_pixel_is_the_nearest_srgb_code),
        cmocka_unit_test(the_file_says_that_it_is_srgb),
    };
    return cmocka_run_group_tests_name("image/png", tests, NULL, NULL);
}
