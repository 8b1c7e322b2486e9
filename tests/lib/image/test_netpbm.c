/* PPM and PFM: layout, bits, and damaged files. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "damage.h"
#include "image/decode.h"
#include "image/netpbm.h"
#include "image/srgb.h"

static const char *const brg[3] = {"B", "R", "G"};

/* Pixel i, from the top left, has R = 10 i, G = 10 i + 1, B = 10 i + 2, times scale. */
static rt_image *numbered(uint32_t width, uint32_t height, float scale)
{
    rt_image *image = NULL;
    assert_int_equal(rt_image_create(&image, width, height, brg, 3, NULL), RT_OK);
    for (uint32_t i = 0; i < width * height; i++)
        for (int c = 0; c < 3; c++)
            image->data[3 * i + c] = scale * (float)(10 * i + (unsigned)(c + 2) % 3);
    return image;
}

static rt_bytes text(const char *characters, size_t size)
{
    rt_bytes bytes = {0};
    assert_int_equal(rt_bytes_put(&bytes, 0, characters, size, NULL), RT_OK);
    return bytes;
}

static rt_status decode_text(const char *characters, size_t size)
{
    rt_bytes bytes = text(characters, size);
    rt_image *image = NULL;
    rt_status status = rt_pfm_decode(&image, &bytes, "text", NULL);
    rt_image_destroy(image);
    rt_bytes_free(&bytes);
    return status;
}

static void ppm_is_rgb_from_the_top_left(void **state)
{
    (void)state;
    static const char header[] = "P6\n3 2\n255\n";
    rt_image *image = numbered(3, 2, 0.01f);
    rt_image_options options = {0};
    rt_bytes bytes = {0};
    assert_int_equal(rt_ppm_encode(&bytes, image, &options, NULL), RT_OK);
    assert_int_equal(bytes.size, strlen(header) + 18);
    assert_memory_equal(bytes.data, header, strlen(header));
    for (unsigned i = 0; i < 18; i++) {
        float linear = 0.01f * (float)(10 * (i / 3) + i % 3);
        assert_int_equal(bytes.data[strlen(header) + i], rt_srgb_quantise(linear));
    }
    rt_bytes_free(&bytes);
    rt_image_destroy(image);
}

static void pfm_is_little_endian_from_the_bottom_left(void **state)
{
    (void)state;
    static const char header[] = "PF\n2 3\n-1.0\n";
    rt_image *image = numbered(2, 3, 1.0f);
    rt_bytes bytes = {0};
    assert_int_equal(rt_pfm_encode(&bytes, image, NULL), RT_OK);
    assert_int_equal(bytes.size, strlen(header) + 72);
    assert_memory_equal(bytes.data, header, strlen(header));
    /* The first value is R of pixel 4, the left one of the bottom row: 40 = 0x42200000. */
    assert_memory_equal(bytes.data + strlen(header), "\x00\x00\x20\x42", 4);
    /* The last is B of pixel 1: 12 = 0x41400000. */
    assert_memory_equal(bytes.data + bytes.size - 4, "\x00\x00\x40\x41", 4);
    rt_bytes_free(&bytes);
    rt_image_destroy(image);
}

static void pfm_keeps_every_bit(void **state)
{
    (void)state;
    static const uint32_t patterns[] = {0x00000000, 0x80000000, 0x00000001, 0x807fffff,
                                        0x00800000, 0x3f800001, 0x7f7fffff, 0x7f800000,
                                        0xff800000, 0x7fc00000, 0x7fc12345, 0x12345678};
    rt_image *image = NULL, *copy = NULL;
    rt_bytes bytes = {0};
    assert_int_equal(rt_image_create(&image, 2, 2, brg, 3, NULL), RT_OK);
    memcpy(image->data, patterns, sizeof patterns);
    assert_int_equal(rt_pfm_encode(&bytes, image, NULL), RT_OK);
    assert_int_equal(rt_pfm_decode(&copy, &bytes, "copy", NULL), RT_OK);
    for (int c = 0; c < 3; c++) {
        uint32_t channel = rt_image_channel(copy, brg[c]);
        for (int i = 0; i < 4; i++)
            assert_memory_equal(&copy->data[3 * i + (int)channel], &image->data[3 * i + c],
                                sizeof(float));
    }
    rt_image_destroy(copy);
    rt_image_destroy(image);
    rt_bytes_free(&bytes);
}

static void pfm_of_the_other_byte_order_and_grey_is_read(void **state)
{
    (void)state;
    static const char file[] = "Pf 1\t2\r\n+2.5e0 \x40\x00\x00\x00\xc0\x40\x00\x00";
    rt_bytes bytes = text(file, sizeof file - 1);
    rt_image *image = NULL;
    assert_int_equal(rt_pfm_decode(&image, &bytes, "grey", NULL), RT_OK);
    assert_int_equal(image->channel_count, 1);
    assert_string_equal(image->names[0], "Y");
    assert_true(image->data[0] == -3.0f);
    assert_true(image->data[1] == 2.0f);
    rt_image_destroy(image);
    rt_bytes_free(&bytes);
}

#define REFUSED(literal) assert_int_equal(decode_text(literal, sizeof literal - 1), RT_ERROR_INPUT)

static void pfm_that_is_wrong_is_refused(void **state)
{
    (void)state;
    assert_int_equal(decode_text("Pf 1 1 -1 1234", 14), RT_OK);
    REFUSED("");
    REFUSED("P6 1 1 255 123");
    REFUSED("Pf 0 1 -1 ");
    REFUSED("Pf 1 0 -1 ");
    REFUSED("Pf -1 1 -1 1234");
    REFUSED("Pf 1.0 1 -1 1234");
    REFUSED("Pf 65537 1 -1 1234");
    REFUSED("Pf 4294967297 1 -1 1234");
    REFUSED("Pf 99999999999999999999999999999999999999999 1 -1 1234");
    REFUSED("Pf 65536 65536 -1 1234");
    REFUSED("Pf 1 1 0 1234");
    REFUSED("Pf 1 1 -0.0e5 1234");
    REFUSED("Pf 1 1 nan 1234");
    REFUSED("Pf 1 1 - 1234");
    REFUSED("Pf 1 1 -1 123");
    REFUSED("Pf 1 1 -1 12345");
    REFUSED("Pf 1 1 -1");
}

static void damaged_pfm_never_crashes(void **state)
{
    (void)state;
    rt_image *image = numbered(3, 2, 1.0f);
    rt_bytes bytes = {0};
    assert_int_equal(rt_pfm_encode(&bytes, image, NULL), RT_OK);
    damage_truncate(&bytes, rt_pfm_decode);
    damage_flip(&bytes, rt_pfm_decode);
    rt_bytes_free(&bytes);
    rt_image_destroy(image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ppm_is_rgb_from_the_top_left),
        cmocka_unit_test(pfm_is_little_endian_from_the_bottom_left),
        cmocka_unit_test(pfm_keeps_every_bit),
        cmocka_unit_test(pfm_of_the_other_byte_order_and_grey_is_read),
        cmocka_unit_test(pfm_that_is_wrong_is_refused),
        cmocka_unit_test(damaged_pfm_never_crashes),
    };
    return cmocka_run_group_tests_name("image/netpbm", tests, NULL, NULL);
}
