/* Images packed as texels: the format chosen, the order of rows, decoding, and what is refused. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/half.h"
#include "image/srgb.h"
#include "texture/texture.h"

enum { codes = 256 };

static const char *const gbr[3] = {"G", "B", "R"}, *const grey[1] = {"Y"};

/* An image of one value everywhere; three channels in an unusual order, or one. */
static rt_image *uniform(uint32_t width, uint32_t height, uint32_t channel_count, float value)
{
    rt_image *image = NULL;
    assert_int_equal(rt_image_create(&image, width, height, channel_count == 3 ? gbr : grey,
                                     channel_count, NULL),
                     RT_OK);
    for (size_t i = 0; i < (size_t)width * height * channel_count; i++)
        image->data[i] = value;
    return image;
}

static rt_texture_data pack(rt_bytes *texels, const rt_image *image, int is_linear)
{
    rt_texture_data texture;
    rt_error error = {0};
    if (rt_texture_pack(&texture, texels, image, &(rt_texture){.path = "made", .linear = is_linear},
                        &error) != RT_OK)
        fail_msg("%s", error.message);
    return texture;
}

static const void *texels_of(const rt_bytes *texels, const rt_texture_data *texture)
{
    return texels->data + (size_t)texture->texels * RT_SCENE_ROW;
}

static void codes_keep_their_value_and_rows_go_up(void **state)
{
    (void)state;
    rt_image *image = uniform(2, 3, 3, 0.0f);
    rt_bytes texels = {0};
    image->is_srgb = 1;
    for (int i = 0; i < 18; i++)
        image->data[i] = (float)(10 * (i / 3) + i % 3) / 255.0f;
    rt_texture_data texture = pack(&texels, image, 0);
    assert_int_equal(texture.kind, RT_TEXTURE_IMAGE);
    assert_int_equal(texture.wrap, RT_WRAP_REPEAT);
    assert_int_equal(texture.format, RT_TEXELS_CODE8);
    assert_int_equal(texture.width, 2);
    assert_int_equal(texture.height, 3);
    assert_true(texture.scale[0] == 1.0f && texture.scale[1] == 1.0f);
    assert_true(texture.offset[0] == 0.0f && texture.offset[1] == 0.0f);

    const float *decode = texels_of(&texels, &texture);
    const uint8_t *texel = (const uint8_t *)(decode + codes);
    for (int i = 0; i < codes; i++)
        assert_true(decode[i] == (float)rt_srgb_decode(i / 255.0));
    /*
     * Pixel i of the image holds G = 10 i, B = 10 i + 1, R = 10 i + 2. The bottom row is pixels 4
     * and 5.
     */
    const uint8_t expected[24] = {42, 40, 41, 0, 52, 50, 51, 0, 22, 20, 21, 0,
                                  32, 30, 31, 0, 2,  0,  1,  0, 12, 10, 11, 0};
    assert_memory_equal(texel, expected, sizeof expected);
    rt_bytes_free(&texels);
    rt_image_destroy(image);
}

static void codes_are_not_decoded_when_linear_is_asked_or_stored(void **state)
{
    (void)state;
    for (int is_srgb = 0; is_srgb < 2; is_srgb++) {
        rt_image *image = uniform(1, 1, 1, 51.0f / 255.0f);
        rt_bytes texels = {0};
        image->is_srgb = is_srgb;
        rt_texture_data texture = pack(&texels, image, is_srgb);
        const float *decode = texels_of(&texels, &texture);
        assert_int_equal(texture.format, RT_TEXELS_CODE8);
        for (int i = 0; i < codes; i++)
            assert_true(decode[i] == (float)i / 255.0f);
        assert_int_equal(((const uint8_t *)(decode + codes))[0], 51);
        rt_bytes_free(&texels);
        rt_image_destroy(image);
    }
}

/* Whatever its depth, a code that is a multiple of 1/255 is found to be one. */
static void shallow_codes_are_multiples_of_eight_bit_ones(void **state)
{
    static const unsigned tops[] = {1, 3, 5, 15, 17, 51, 85, 255};
    (void)state;
    for (size_t t = 0; t < sizeof tops / sizeof *tops; t++) {
        rt_image *image = uniform(tops[t] + 1, 1, 1, 0.0f);
        rt_bytes texels = {0};
        for (unsigned i = 0; i <= tops[t]; i++)
            image->data[i] = (float)i / (float)tops[t];
        assert_int_equal(pack(&texels, image, 0).format, RT_TEXELS_CODE8);
        rt_bytes_free(&texels);
        rt_image_destroy(image);
    }
}

static void deep_grey_keeps_every_bit(void **state)
{
    (void)state;
    rt_image *image = uniform(1, 2, 3, 0.2500153f);
    rt_bytes texels = {0};
    for (int c = 0; c < 3; c++)
        image->data[3 + c] = -3e30f;
    rt_texture_data texture = pack(&texels, image, 0);
    const float *value = texels_of(&texels, &texture);
    assert_int_equal(texture.format, RT_TEXELS_GREY);
    assert_true(value[0] == -3e30f);
    assert_true(value[1] == 0.2500153f);
    rt_bytes_free(&texels);
    rt_image_destroy(image);
}

static void deep_srgb_is_decoded(void **state)
{
    (void)state;
    rt_image *image = uniform(1, 1, 1, 12345.0f / 65535.0f);
    rt_bytes texels = {0};
    image->is_srgb = 1;
    rt_texture_data texture = pack(&texels, image, 0);
    assert_int_equal(texture.format, RT_TEXELS_GREY);
    assert_true(*(const float *)texels_of(&texels, &texture) ==
                (float)rt_srgb_decode(12345.0f / 65535.0f));
    rt_bytes_free(&texels);

    image->data[0] = 0.5001f;
    texels = (rt_bytes){0};
    rt_image *colour = uniform(1, 1, 3, 0.5001f);
    colour->is_srgb = 1;
    colour->data[0] = 0.25f;
    texture = pack(&texels, colour, 0);
    assert_int_equal(texture.format, RT_TEXELS_HALF);
    const uint16_t *half = texels_of(&texels, &texture);
    assert_int_equal(half[0], rt_half_from_float((float)rt_srgb_decode(0.5001f) / texture.unit));
    assert_int_equal(half[1], rt_half_from_float((float)rt_srgb_decode(0.25) / texture.unit));
    rt_bytes_free(&texels);
    rt_image_destroy(colour);
    rt_image_destroy(image);
}

static double half_value(uint16_t bits)
{
    int e = bits >> 10 & 31, m = bits & 1023;
    double magnitude = e ? ldexp(1024 + m, e - 25) : ldexp(m, -24);
    return bits & 0x8000 ? -magnitude : magnitude;
}

/* Colours from the brightest down: what is above 2^-28 of it keeps 11 bits, whatever it is. */
static void deep_colour_keeps_its_range(void **state)
{
    static const double tops[] = {1e-25, 1e-10, 0.7, 1.0, 65504.0, 70000.0, 1e20, 3.4e38};
    (void)state;
    for (size_t t = 0; t < sizeof tops / sizeof *tops; t++) {
        rt_image *image = uniform(27, 1, 3, 0.0f);
        rt_bytes texels = {0};
        for (int i = 0; i < 27; i++)
            for (int c = 0; c < 3; c++)
                image->data[3 * i + c] =
                    (float)ldexp((c == 0 ? -1.0 : 1.0 / (c + 1)) * tops[t], -i);
        rt_texture_data texture = pack(&texels, image, 0);
        int exponent;
        assert_int_equal(texture.format, RT_TEXELS_HALF);
        assert_true(frexp(texture.unit, &exponent) == 0.5);
        const uint16_t *half = texels_of(&texels, &texture);
        for (int i = 0; i < 27; i++) {
            const double expected[3] = {image->data[3 * i + 2], image->data[3 * i],
                                        image->data[3 * i + 1]};
            for (int c = 0; c < 3; c++)
                assert_true(fabs(half_value(half[4 * i + c]) * texture.unit - expected[c]) <=
                            fabs(expected[c]) / 2048);
        }
        rt_bytes_free(&texels);
        rt_image_destroy(image);
    }
}

/* Of R, G, B and A each alone, in a file of sRGB: alpha is no code. */
static void one_channel_is_grey_and_alpha_linear(void **state)
{
    static const char *const rgba[4] = {"R", "G", "B", "A"};
    (void)state;
    rt_image *image = NULL;
    assert_int_equal(rt_image_create(&image, 1, 1, rgba, 4, NULL), RT_OK);
    image->is_srgb = 1;
    for (int c = 0; c < 4; c++)
        image->data[c] = (float)(10 * c + 20) / 255.0f;
    for (int c = 0; c < 4; c++) {
        const rt_texture from = {.path = "made",
                                 .channel = (rt_texture_channel)(RT_TEXTURE_CHANNEL_R + c)};
        rt_texture_data texture;
        rt_bytes texels = {0};
        assert_int_equal(rt_texture_pack(&texture, &texels, image, &from, NULL), RT_OK);
        const float *decode = texels_of(&texels, &texture);
        const uint8_t *texel = (const uint8_t *)(decode + codes);
        for (int i = 0; i < 3; i++)
            assert_int_equal(texel[i], 10 * c + 20);
        assert_true(decode[90] == (c == 3 ? 90.0f / 255.0f : (float)rt_srgb_decode(90 / 255.0)));
        rt_bytes_free(&texels);
    }
    rt_image_destroy(image);
}

static void a_channel_that_is_not_there_is_refused(void **state)
{
    (void)state;
    rt_image *image = uniform(1, 1, 3, 0.5f);
    const rt_texture from = {.path = "made.png", .channel = RT_TEXTURE_CHANNEL_A};
    rt_texture_data texture;
    rt_bytes texels = {0};
    rt_error error = {0};
    assert_int_equal(rt_texture_pack(&texture, &texels, image, &from, &error), RT_ERROR_INPUT);
    assert_string_equal(error.message,
                        "cannot use made.png as a texture: no alpha, A, among G, B, R");
    assert_string_equal(error.field, "channel");
    rt_image_destroy(image);
}

/* In each format: the power is of the linear value. */
static void a_power_is_of_linear_values(void **state)
{
    (void)state;
    const rt_texture from = {.path = "made", .power = 2};
    for (int format = 0; format < 3; format++) {
        rt_image *image = uniform(2, 1, 3, 51.0f / 255.0f);
        rt_texture_data texture;
        rt_bytes texels = {0};
        rt_error error = {0};
        image->is_srgb = format == 0;
        if (format > 0)
            for (int i = 0; i < 3; i++)
                image->data[i] = 300.25f;
        if (format == 2)
            image->data[5] = 40.25f;
        assert_int_equal(rt_texture_pack(&texture, &texels, image, &from, NULL), RT_OK);
        const void *at = texels_of(&texels, &texture);
        assert_int_equal(texture.format, format);
        if (format == 0)
            assert_float_equal(((const float *)at)[51], pow(rt_srgb_decode(0.2), 2), 1e-9);
        if (format == 1)
            assert_true(((const float *)at)[0] == 300.25f * 300.25f);
        if (format == 2)
            assert_float_equal(half_value(((const uint16_t *)at)[4]) * texture.unit, 40.25 * 40.25,
                               40.25 * 40.25 / 2048);
        rt_bytes_free(&texels);
        image->data[0] = -1;
        texels = (rt_bytes){0};
        assert_int_equal(rt_texture_pack(&texture, &texels, image, &from, &error), RT_ERROR_INPUT);
        assert_string_equal(error.message, "cannot use made with a power: pixel (0, 0) from the "
                                           "top left is -1.000000");
        rt_image_destroy(image);
    }
}

static void textures_share_the_table_row_by_row(void **state)
{
    (void)state;
    rt_image *first = uniform(3, 1, 1, 0.3f), *second = uniform(5, 7, 1, 0.61f);
    rt_bytes texels = {0};
    rt_texture_data a = pack(&texels, first, 0), b = pack(&texels, second, 0),
                    c = pack(&texels, first, 0);
    assert_int_equal(a.texels, 0);
    assert_int_equal(b.texels, 1);
    assert_int_equal(c.texels, 1 + (5 * 7 * 4 + RT_SCENE_ROW - 1) / RT_SCENE_ROW);
    assert_int_equal(texels.size, (c.texels + 1) * RT_SCENE_ROW);
    const float *value = texels_of(&texels, &b);
    for (int i = 0; i < 35; i++)
        assert_true(value[i] == 0.61f);
    for (int i = 0; i < 3; i++) {
        assert_true(((const float *)texels_of(&texels, &a))[i] == 0.3f);
        assert_true(((const float *)texels_of(&texels, &c))[i] == 0.3f);
    }
    rt_bytes_free(&texels);
    rt_image_destroy(second);
    rt_image_destroy(first);
}

static void check_refused(const rt_image *image, const char *cause)
{
    rt_texture_data texture;
    rt_bytes texels = {0};
    rt_error error = {0};
    assert_int_equal(
        rt_texture_pack(&texture, &texels, image, &(rt_texture){.path = "made.exr"}, &error),
        RT_ERROR_INPUT);
    assert_int_equal(texels.size, 0);
    assert_non_null(strstr(error.message, "made.exr"));
    if (!strstr(error.message, cause))
        fail_msg("'%s' does not tell '%s'", error.message, cause);
}

static void values_that_are_not_finite_are_refused(void **state)
{
    static const float wrong[] = {NAN, INFINITY, -INFINITY};
    (void)state;
    for (int i = 0; i < 3; i++) {
        rt_image *image = uniform(4, 3, 3, 0.5f);
        image->data[3 * (2 * 4 + 1) + 1] = wrong[i];
        check_refused(image, "pixel (1, 2)");
        rt_image_destroy(image);
    }
}

static void images_without_colour_are_refused(void **state)
{
    static const char *const two[2] = {"R", "G"}, *const alpha[2] = {"A", "Y"},
                             *const depth[1] = {"Z"};
    (void)state;
    rt_image *image = NULL;
    rt_bytes texels = {0};
    assert_int_equal(rt_image_create(&image, 1, 1, two, 2, NULL), RT_OK);
    check_refused(image, "no picture, of R, G and B or of one channel, among R, G");
    rt_image_destroy(image);
    assert_int_equal(rt_image_create(&image, 1, 1, alpha, 2, NULL), RT_OK);
    image->data[1] = 0.3f;
    rt_texture_data texture = pack(&texels, image, 0);
    assert_true(*(const float *)texels_of(&texels, &texture) == 0.3f);
    rt_image_destroy(image);
    assert_int_equal(rt_image_create(&image, 1, 1, depth, 1, NULL), RT_OK);
    image->data[0] = 7.0f;
    texture = pack(&texels, image, 0);
    assert_true(*(const float *)texels_of(&texels, &texture) == 7.0f);
    rt_image_destroy(image);
    rt_bytes_free(&texels);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(codes_keep_their_value_and_rows_go_up),
        cmocka_unit_test(codes_are_not_decoded_when_linear_is_asked_or_stored),
        cmocka_unit_test(shallow_codes_are_multiples_of_eight_bit_ones),
        cmocka_unit_test(deep_grey_keeps_every_bit),
        cmocka_unit_test(deep_srgb_is_decoded),
        cmocka_unit_test(deep_colour_keeps_its_range),
        cmocka_unit_test(one_channel_is_grey_and_alpha_linear),
        cmocka_unit_test(a_channel_that_is_not_there_is_refused),
        cmocka_unit_test(a_power_is_of_linear_values),
        cmocka_unit_test(textures_share_the_table_row_by_row),
        cmocka_unit_test(values_that_are_not_finite_are_refused),
        cmocka_unit_test(images_without_colour_are_refused),
    };
    return cmocka_run_group_tests_name("texture/texture", tests, NULL, NULL);
}
