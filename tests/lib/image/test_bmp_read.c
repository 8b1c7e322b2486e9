/* BMP: every depth, both directions of rows, palettes, masks, runs, and every class of fault. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "damage.h"
#include "image/decode.h"

/* What a file is made of; what stands between its header and its pixels is a palette or masks. */
typedef struct form {
    uint32_t header, width;
    int32_t height;
    uint32_t bits, method;
    const uint8_t *extra;
    size_t extra_size;
    const uint8_t *pixels;
    size_t size;
} form;

static void put32(uint8_t *at, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        at[i] = (uint8_t)(value >> (8 * i));
}

static rt_bytes make_file(const form *f)
{
    uint8_t head[14 + 124] = {'B', 'M'}, *const info = head + 14;
    rt_bytes file = {0};
    put32(info, f->header);
    if (f->header == 12) {
        info[4] = (uint8_t)f->width;
        info[6] = (uint8_t)f->height;
        info[8] = 1;
        info[10] = (uint8_t)f->bits;
    } else {
        put32(info + 4, f->width);
        put32(info + 8, (uint32_t)f->height);
        info[12] = 1;
        info[14] = (uint8_t)f->bits;
        put32(info + 16, f->method);
    }
    size_t size = 14 + f->header;
    if (f->header > 40 && f->extra_size)
        memcpy(info + 40, f->extra, f->extra_size); /* masks are part of it */
    else
        size += f->extra_size;
    put32(head + 10, (uint32_t)size);
    assert_int_equal(rt_bytes_put(&file, 0, head, 14 + f->header, NULL), RT_OK);
    if (f->header <= 40 && f->extra_size)
        assert_int_equal(rt_bytes_put(&file, file.size, f->extra, f->extra_size, NULL), RT_OK);
    assert_int_equal(rt_bytes_put(&file, file.size, f->pixels, f->size, NULL), RT_OK);
    return file;
}

static rt_image *decode(const form *f, uint32_t channels)
{
    rt_bytes file = make_file(f);
    rt_image *image = NULL;
    rt_error error = {0};
    if (rt_bmp_decode(&image, &file, "made", &error) != RT_OK)
        fail_msg("%u bits: %s", f->bits, error.message);
    assert_int_equal(image->width, f->width);
    assert_int_equal(image->height, f->height < 0 ? -f->height : f->height);
    assert_int_equal(image->channel_count, channels);
    assert_true(image->is_srgb);
    rt_bytes_free(&file);
    return image;
}

/* Entry i is red 10 i, green 10 i + 1, blue 10 i + 2. */
static const uint8_t palette4[16 * 4] = {2,  1,  0,  0, 12, 11, 10, 0, 22, 21, 20, 0,
                                         32, 31, 30, 0, 42, 41, 40, 0, 52, 51, 50, 0};
static const uint8_t palette3[2 * 3] = {2, 1, 0, 12, 11, 10};

/* The indices of the picture, row by row from the top. */
static void expect_indices(const form *f, const int *indices)
{
    rt_image *image = decode(f, 3);
    for (size_t i = 0; i < (size_t)image->width * image->height; i++)
        for (int c = 0; c < 3; c++)
            if (image->data[3 * i + (size_t)c] != (float)(10 * indices[i] + c) / 255.0f)
                fail_msg("%u bits: pixel %zu is wrong", f->bits, i);
    rt_image_destroy(image);
}

static void palettes_of_every_depth_are_read_in_both_directions(void **state)
{
    static const uint8_t one[] = {0xa0, 0, 0, 0, 0x40, 0, 0, 0},
                         four[] = {0x12, 0x30, 0, 0, 0x45, 0x00, 0, 0},
                         eight[] = {1, 2, 3, 0, 4, 5, 0, 0};
    static const int bits_up[] = {0, 1, 0, 1, 0, 1}, up[] = {4, 5, 0, 1, 2, 3},
                     down[] = {1, 2, 3, 4, 5, 0};
    const form one_up = {40, 3, 2, 1, 0, palette4, 8, one, 8},
               core = {12, 3, 2, 1, 0, palette3, 6, one, 8},
               four_up = {40, 3, 2, 4, 0, palette4, 64, four, 8},
               four_down = {40, 3, -2, 4, 0, palette4, 64, four, 8},
               eight_up = {40, 3, 2, 8, 0, palette4, 64, eight, 8},
               eight_down = {40, 3, -2, 8, 0, palette4, 64, eight, 8};
    (void)state;
    expect_indices(&one_up, bits_up);
    expect_indices(&core, bits_up);
    expect_indices(&four_up, up);
    expect_indices(&four_down, down);
    expect_indices(&eight_up, up);
    expect_indices(&eight_down, down);
}

static void colours_of_16_to_32_bits_are_read(void **state)
{
    static const uint8_t deep[] = {3, 2, 1, 6, 5, 4, 0, 0}, wide[] = {3, 2, 1, 9, 6, 5, 4, 9},
                         narrow[] = {0x00, 0x7c, 0x5f, 0x00};
    const form by24 = {40, 2, 1, 24, 0, NULL, 0, deep, 8},
               by32 = {40, 2, -1, 32, 0, NULL, 0, wide, 8},
               by16 = {40, 2, 1, 16, 0, NULL, 0, narrow, 4};
    const form *const forms[] = {&by24, &by32};
    (void)state;
    for (int i = 0; i < 2; i++) {
        rt_image *image = decode(forms[i], 3);
        for (int k = 0; k < 6; k++)
            assert_true(image->data[k] == (float)(k + 1) / 255.0f);
        rt_image_destroy(image);
    }
    rt_image *image = decode(&by16, 3);
    assert_true(image->data[0] == 1 && image->data[1] == 0 && image->data[2] == 0);
    assert_true(image->data[3] == 0 && image->data[4] == 2 / 31.0f && image->data[5] == 1);
    rt_image_destroy(image);
}

/* 5, 6 and 5 bits, 10 each, and with alpha; in the header or behind it. */
static void masks_say_where_the_bits_are(void **state)
{
    static const uint8_t m565[12] = {0, 0xf8, 0, 0, 0xe0, 7, 0, 0, 0x1f},
                         alpha[16] = {0xff, 0, 0, 0, 0, 0xff, 0, 0, 0, 0, 0xff, 0, 0, 0, 0, 0xff};
    static const uint8_t narrow[4] = {0xe0, 0x07, 0x00, 0x80}, wide[4] = {51, 102, 153, 204};
    const form by16 = {40, 2, 1, 16, 3, m565, 12, narrow, 4},
               by32 = {40, 1, 1, 32, 6, alpha, 16, wide, 4},
               later = {124, 1, 1, 32, 3, alpha, 16, wide, 4};
    (void)state;
    rt_image *image = decode(&by16, 3);
    assert_true(image->data[0] == 0 && image->data[1] == 1 && image->data[3] == (float)(16 / 31.0));
    rt_image_destroy(image);
    const form *const forms[] = {&by32, &later};
    for (int i = 0; i < 2; i++) {
        image = decode(forms[i], 4);
        for (int c = 0; c < 4; c++)
            assert_true(image->data[c] == (float)(51 * (c + 1)) / 255.0f);
        assert_string_equal(image->names[3], "A");
        rt_image_destroy(image);
    }
}

/* A run, three as they are with a byte that pads them, a move, and an early end. */
static const uint8_t runs8[] = {2, 4, 0, 3, 1, 2, 3, 0, 0, 0, 0, 2, 2, 1, 1, 5, 0, 1},
                     runs4[] = {3, 0x12, 0, 4, 0x34, 0x50, 0, 0, 2, 0x11, 0, 1};

static void runs_are_read(void **state)
{
    static const int eight[15] = {0, 0, 5, 0, 0, 0, 0, 0, 0, 0, 4, 4, 1, 2, 3},
                     four[14] = {1, 1, 0, 0, 0, 0, 0, 1, 2, 1, 3, 4, 5, 0};
    const form f8 = {40, 5, 3, 8, 1, palette4, 64, runs8, sizeof runs8},
               f4 = {40, 7, 2, 4, 2, palette4, 64, runs4, sizeof runs4};
    (void)state;
    expect_indices(&f8, eight);
    expect_indices(&f4, four);
}

static void expect_refused(const form *f, const char *cause)
{
    rt_bytes file = make_file(f);
    rt_image *image = NULL;
    rt_error error = {0};
    assert_int_equal(rt_bmp_decode(&image, &file, "made", &error), RT_ERROR_INPUT);
    if (!strstr(error.message, cause))
        fail_msg("'%s' does not tell '%s'", error.message, cause);
    rt_bytes_free(&file);
}

static void faults_are_told(void **state)
{
    static const uint8_t zero[64] = {0}, over[] = {6, 1, 0, 1}, raw[] = {0, 6, 1, 2, 3, 4, 5, 6},
                         away[] = {0, 2, 9, 0, 0, 1}, rows[] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 1},
                         endless[] = {1, 1, 1, 1}, beyond[] = {1, 7, 0, 1}, index[] = {7, 0, 0, 0},
                         gap[12] = {5, 0, 0, 0, 2, 0, 0, 0, 8}, none[12] = {5};
    const struct {
        form form;
        const char *cause;
    } faults[] = {
        {{40, 0, 1, 8, 0, palette4, 64, zero, 64}, "its sides"},
        {{40, 65537, 1, 8, 0, palette4, 64, zero, 64}, "its sides"},
        {{40, 1, 0, 8, 0, palette4, 64, zero, 64}, "its sides"},
        {{40, 1, INT32_MIN, 8, 0, palette4, 64, zero, 64}, "its sides"},
        {{41 - 2, 1, 1, 8, 0, palette4, 64, zero, 64}, "its header is not of 12"},
        {{40, 1, 1, 7, 0, palette4, 64, zero, 64}, "7 bits a pixel by method 0 are not of BMP"},
        {{40, 1, -1, 8, 1, palette4, 64, zero, 64}, "method 1 from the top down"},
        {{40, 1, 1, 24, 4, NULL, 0, zero, 64}, "it holds a JPEG"},
        {{40, 1, 1, 24, 5, NULL, 0, zero, 64}, "it holds a PNG"},
        {{40, 1, 1, 8, 0, NULL, 0, zero, 64}, "it has no palette"},
        {{40, 4, 17, 8, 0, palette4, 64, zero, 64}, "cut short"},
        {{40, 4, 1, 8, 0, palette4, 24, index, 4}, "is not in its palette"},
        {{40, 65535, 65535, 24, 0, NULL, 0, zero, 64}, "more than 2^30 values"},
        {{40, 16000, 16000, 8, 1, palette4, 24, zero, 64}, "cut short"},
        {{40, 2, 1, 16, 3, gap, 12, zero, 4}, "is empty or has gaps"},
        {{40, 2, 1, 16, 3, none, 12, zero, 4}, "is empty or has gaps"},
        {{40, 5, 3, 8, 1, palette4, 24, over, 4}, "a run goes beyond its row"},
        {{40, 5, 3, 8, 1, palette4, 24, raw, 8}, "a run goes beyond its row"},
        {{40, 5, 3, 8, 1, palette4, 24, away, 6}, "a move goes beyond the picture"},
        {{40, 5, 3, 8, 1, palette4, 24, rows, 10}, "more rows than the picture"},
        {{40, 5, 3, 8, 1, palette4, 24, endless, 4}, "cut short"},
        {{40, 5, 3, 8, 1, palette4, 24, beyond, 4}, "is not in its palette"}};
    (void)state;
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++)
        expect_refused(&faults[i].form, faults[i].cause);
}

static void damage_is_survived(void **state)
{
    static const uint8_t eight[] = {1, 2, 3, 0, 4, 5, 0, 0};
    const form forms[] = {{40, 5, 3, 8, 1, palette4, 64, runs8, sizeof runs8},
                          {40, 7, 2, 4, 2, palette4, 64, runs4, sizeof runs4},
                          {40, 3, 2, 8, 0, palette4, 64, eight, 8}};
    (void)state;
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) {
        rt_bytes file = make_file(&forms[i]);
        damage_truncate(&file, rt_bmp_decode);
        damage_flip(&file, rt_bmp_decode);
        rt_bytes_free(&file);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(palettes_of_every_depth_are_read_in_both_directions),
        cmocka_unit_test(colours_of_16_to_32_bits_are_read),
        cmocka_unit_test(masks_say_where_the_bits_are),
        cmocka_unit_test(runs_are_read),
        cmocka_unit_test(faults_are_told),
        cmocka_unit_test(damage_is_survived),
    };
    return cmocka_run_group_tests_name("image/bmp_read", tests, NULL, NULL);
}
