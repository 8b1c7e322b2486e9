/* Images in memory: sizes, names and attributes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "image/image.h"

static const char *const rgb[3] = {"R", "G", "B"};

static rt_status create(uint32_t width, uint32_t height, const char *const *names, uint32_t count)
{
    rt_image *image = NULL;
    rt_error error = {0};
    rt_status status = rt_image_create(&image, width, height, names, count, &error);
    assert_int_equal(status == RT_OK, image != NULL);
    assert_int_equal(error.status, status);
    rt_image_destroy(image);
    return status;
}

static void a_new_image_is_black(void **state)
{
    (void)state;
    rt_image *image = NULL;
    assert_int_equal(rt_image_create(&image, 5, 3, rgb, 3, NULL), RT_OK);
    assert_int_equal(image->width, 5);
    assert_int_equal(image->height, 3);
    assert_int_equal(image->channel_count, 3);
    for (int i = 0; i < 45; i++)
        assert_true(image->data[i] == 0.0f);
    rt_image_destroy(image);
    rt_image_destroy(NULL);
}

static void impossible_sizes_are_refused(void **state)
{
    (void)state;
    assert_int_equal(create(1, 1, rgb, 3), RT_OK);
    assert_int_equal(create(0, 1, rgb, 3), RT_ERROR_USAGE);
    assert_int_equal(create(1, 0, rgb, 3), RT_ERROR_USAGE);
    assert_int_equal(create(1, 1, rgb, 0), RT_ERROR_USAGE);
    assert_int_equal(create(RT_IMAGE_SIDE_MAX + 1, 1, rgb, 3), RT_ERROR_USAGE);
    assert_int_equal(create(1, UINT32_MAX, rgb, 3), RT_ERROR_USAGE);
    /* 2^31 x 2^31 pixels of 4 channels wrap to zero bytes in 64 bits. */
    assert_int_equal(create(UINT32_C(1) << 31, UINT32_C(1) << 31, rgb, 3), RT_ERROR_USAGE);
    assert_int_equal(create(1, 1, rgb, RT_IMAGE_CHANNELS_MAX + 1), RT_ERROR_USAGE);
}

static void channels_are_found_by_name(void **state)
{
    (void)state;
    const char *const names[] = {"B", "albedo.R", "R", "depth.Z"}, *const twice[] = {"R", "G", "R"};
    char long_name[RT_IMAGE_NAME_SIZE + 1];
    const char *bad[] = {long_name}, *empty[] = {""};
    uint32_t found[3];
    rt_image *image = NULL;
    rt_error error = {0};
    assert_int_equal(rt_image_create(&image, 1, 1, names, 4, NULL), RT_OK);
    assert_int_equal(rt_image_channel(image, "B"), 0);
    assert_int_equal(rt_image_channel(image, "depth.Z"), 3);
    assert_int_equal(rt_image_channel(image, "depth"), RT_IMAGE_NO_CHANNEL);
    assert_int_equal(rt_image_rgb_channels(found, image, &error), RT_ERROR_USAGE);
    assert_non_null(strstr(error.message, "channel G"));
    rt_image_destroy(image);

    memset(long_name, 'x', sizeof long_name - 1);
    long_name[sizeof long_name - 1] = '\0';
    assert_int_equal(create(1, 1, twice, 3), RT_ERROR_USAGE);
    assert_int_equal(create(1, 1, empty, 1), RT_ERROR_USAGE);
    assert_int_equal(create(1, 1, bad, 1), RT_ERROR_USAGE);
    long_name[RT_IMAGE_NAME_SIZE - 1] = '\0';
    assert_int_equal(create(1, 1, bad, 1), RT_OK);
}

/* An image of one pixel with these channels, whose values are 1, 2, ... */
static rt_image *pixel(const char *const *names, uint32_t count)
{
    rt_image *image = NULL;
    assert_int_equal(rt_image_create(&image, 1, 1, names, count, NULL), RT_OK);
    for (uint32_t i = 0; i < count; i++)
        image->data[i] = (float)(i + 1);
    return image;
}

static void expect_colours(const rt_image *image, const char *layer, uint32_t r, uint32_t g,
                           uint32_t b)
{
    uint32_t found[3];
    assert_int_equal(rt_image_colour_channels(found, image, layer, NULL), RT_OK);
    assert_true(found[0] == r && found[1] == g && found[2] == b);
}

static void expect_no_colours(const rt_image *image, const char *layer, const char *says)
{
    uint32_t found[3];
    rt_error error = {0};
    assert_int_equal(rt_image_colour_channels(found, image, layer, &error), RT_ERROR_INPUT);
    assert_string_equal(error.field, layer ? "layer" : "");
    if (!strstr(error.message, says))
        fail_msg("'%s' does not tell '%s'", error.message, says);
}

static void colours_of_a_layer_are_found(void **state)
{
    static const char *const blender[] = {"V.Combined.A", "V.Combined.B", "V.Combined.G",
                                          "V.Combined.R", "V.Depth.Z"},
                             *const grey[] = {"A", "Y"}, *const one[] = {"V.Depth.Z"},
                             *const pair[] = {"uv.U", "uv.V", "R", "G", "B"};
    (void)state;
    rt_image *image = pixel(blender, 5);
    expect_colours(image, "V.Combined", 3, 2, 1);
    expect_colours(image, "V.Depth", 4, 4, 4);
    expect_colours(image, "V.Combined.A", 0, 0, 0);
    expect_no_colours(image, NULL, "V.Combined.R, V.Depth.Z: choose a layer, such as V.Combined");
    expect_no_colours(image, "V.Combind", "did you mean 'V.Combined'?");
    expect_no_colours(image, "V", "no layer 'V'");
    rt_image_destroy(image);
    image = pixel(grey, 2);
    expect_colours(image, NULL, 1, 1, 1);
    expect_no_colours(image, "albedo", "the image holds no layers beside A, Y");
    rt_image_destroy(image);
    image = pixel(one, 1);
    expect_colours(image, NULL, 0, 0, 0);
    rt_image_destroy(image);
    image = pixel(pair, 5);
    expect_colours(image, NULL, 2, 3, 4);
    expect_no_colours(image, "uv", "no layer 'uv'");
    rt_image_destroy(image);
}

static void channels_of_another_image_are_added(void **state)
{
    static const char *const more[] = {"R", "mask.Y", "depth.Z", "Z"};
    static const char *const all[] = {"R", "G", "B", "left.R", "mask.Y", "depth.Z", "left.Z", "Z"};
    static const char *const layers[] = {"left", NULL};
    rt_error error = {0};
    (void)state;
    rt_image *image = pixel(rgb, 3), *other = pixel(more, 4);
    assert_int_equal(rt_image_set_attribute(image, "owner", "me", NULL), RT_OK);
    rt_image *const both[] = {other, other};
    assert_int_equal(rt_image_add(&image, both, layers, 2, NULL, &error), RT_OK);
    assert_int_equal(image->channel_count, 8); /* Z; the others are there */
    for (uint32_t i = 0; i < 8; i++) {
        assert_int_equal(rt_image_channel(image, all[i]), i);
        assert_true(image->data[i] == (float)(i < 3 ? i + 1 : i < 7 ? i - 2 : 4));
    }
    assert_string_equal(rt_image_attribute_value(image, "owner"), "me");
    rt_image_destroy(other);
    other = NULL;
    assert_int_equal(rt_image_create(&other, 2, 1, rgb, 3, NULL), RT_OK);
    assert_int_equal(rt_image_add(&image, &other, layers, 1, NULL, &error), RT_ERROR_USAGE);
    assert_int_equal(image->channel_count, 8);
    rt_image_destroy(other);
    rt_image_destroy(image);
}

static void attributes_are_set_and_replaced(void **state)
{
    (void)state;
    rt_image *image = NULL;
    assert_int_equal(rt_image_create(&image, 1, 1, rgb, 3, NULL), RT_OK);
    assert_null(rt_image_attribute_value(image, "seed"));
    assert_int_equal(rt_image_set_attribute(image, "seed", "1", NULL), RT_OK);
    assert_int_equal(rt_image_set_attribute(image, "scene", "box", NULL), RT_OK);
    assert_int_equal(rt_image_set_attribute(image, "seed", "22", NULL), RT_OK);
    assert_int_equal(rt_image_set_attribute(image, "", "1", NULL), RT_ERROR_USAGE);
    assert_int_equal(image->attribute_count, 2);
    assert_string_equal(image->attributes[0].name, "seed");
    assert_string_equal(rt_image_attribute_value(image, "seed"), "22");
    assert_string_equal(rt_image_attribute_value(image, "scene"), "box");
    rt_image_destroy(image);
}

static void alpha_is_no_code(void **state)
{
    static const char *const names[2] = {"Y", "A"};
    rt_image *image = NULL;
    float rgb[3];
    (void)state;
    assert_int_equal(rt_image_create(&image, 1, 1, names, 2, NULL), RT_OK);
    image->is_srgb = 1;
    image->data[0] = image->data[1] = 0.5f;
    assert_int_equal(rt_image_get_rgb(rgb, image, NULL, NULL), RT_OK);
    assert_float_equal(rgb[0], 0.2140411, 1e-6);
    assert_int_equal(rt_image_get_rgb(rgb, image, "A", NULL), RT_OK);
    assert_true(rgb[0] == 0.5f);
    rt_image_destroy(image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_new_image_is_black),
        cmocka_unit_test(impossible_sizes_are_refused),
        cmocka_unit_test(channels_are_found_by_name),
        cmocka_unit_test(colours_of_a_layer_are_found),
        cmocka_unit_test(channels_of_another_image_are_added),
        cmocka_unit_test(attributes_are_set_and_replaced),
        cmocka_unit_test(alpha_is_no_code),
    };
    return cmocka_run_group_tests_name("image/image", tests, NULL, NULL);
}
