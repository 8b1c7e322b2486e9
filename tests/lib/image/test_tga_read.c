/* TGA: every kind and depth, all origins, runs, and every class of fault. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "damage.h"
#include "image/decode.h"
#include "image/tga.h"

/* What a file is made of: 3 x 2 pixels. */
typedef struct form {
    uint8_t type, map_bits, bits, descriptor;
    const uint8_t *pixels;
    size_t size;
} form;

static const uint8_t map[] = {10, 20, 30, 40, 50, 60}; /* entries 5 and 6: blue, green, red */

/* With a comment of two bytes behind the header. */
static rt_bytes make_file(const form *f)
{
    const uint8_t has_map = f->map_bits != 0;
    const uint8_t header[20] = {2,       has_map,
                                f->type, has_map ? 5 : 0,
                                0,       has_map ? 2 : 0,
                                0,       f->map_bits,
                                0,       0,
                                0,       0,
                                3,       0,
                                2,       0,
                                f->bits, f->descriptor,
                                'h',     'i'};
    rt_bytes file = {0};
    assert_int_equal(rt_bytes_put(&file, 0, header, sizeof header, NULL), RT_OK);
    if (has_map)
        assert_int_equal(rt_bytes_put(&file, file.size, map, sizeof map, NULL), RT_OK);
    assert_int_equal(rt_bytes_put(&file, file.size, f->pixels, f->size, NULL), RT_OK);
    return file;
}

static rt_image *decode(const form *f, uint32_t channels)
{
    rt_bytes file = make_file(f);
    rt_image *image = NULL;
    rt_error error = {0};
    assert_true(rt_tga_is_plausible(&file));
    if (rt_tga_decode(&image, &file, "made", &error) != RT_OK)
        fail_msg("type %d: %s", f->type, error.message);
    assert_int_equal(image->width, 3);
    assert_int_equal(image->height, 2);
    assert_int_equal(image->channel_count, channels);
    assert_true(image->is_srgb);
    assert_string_equal(image->names[0], channels > 2 ? "R" : "Y");
    if (channels % 2 == 0)
        assert_string_equal(image->names[channels - 1], "A");
    rt_bytes_free(&file);
    return image;
}

static const uint8_t six[] = {0, 51, 102, 153, 204, 255};

/* Greys 0 to 5 from the first pixel on, which is where the descriptor says. */
static void every_origin_is_upright(void **state)
{
    static const int expected[4][6] = {
        {3, 4, 5, 0, 1, 2}, {5, 4, 3, 2, 1, 0}, {0, 1, 2, 3, 4, 5}, {2, 1, 0, 5, 4, 3}};
    (void)state;
    for (int origin = 0; origin < 4; origin++) {
        const form f = {3, 0, 8, (uint8_t)(16 * origin), six, 6};
        rt_image *image = decode(&f, 1);
        for (int i = 0; i < 6; i++)
            assert_true(image->data[i] == (float)(51 * expected[origin][i]) / 255.0f);
        rt_image_destroy(image);
    }
}

static void every_depth_of_colour_is_read(void **state)
{
    static const uint8_t short_colours[12] = {0x00, 0x7c, 0xe0, 0x03, 0x1f, 0x80, 0x42, 0x88},
                         three[18] = {1, 2, 3, 4, 5, 6}, four[24] = {1, 2, 3, 128, 4, 5, 6, 255};
    (void)state;
    const form forms[] = {{2, 0, 15, 32, short_colours, 12}, {2, 0, 16, 33, short_colours, 12},
                          {2, 0, 16, 32, short_colours, 12}, {2, 0, 24, 32, three, 18},
                          {2, 0, 32, 40, four, 24},          {2, 0, 32, 32, four, 24}};
    static const uint32_t channels[] = {3, 4, 3, 3, 4, 3};
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) {
        rt_image *image = decode(&forms[i], channels[i]);
        const float *first = image->data, *second = first + channels[i],
                    *third = second + channels[i], *fourth = third + channels[i];
        if (forms[i].bits < 24) {
            assert_true(first[0] == 1 && first[1] == 0 && second[1] == 1 && third[2] == 1);
            assert_true(fourth[0] == 2 / 31.0f && fourth[1] == 2 / 31.0f && fourth[2] == 2 / 31.0f);
        } else {
            assert_true(first[0] == 3 / 255.0f && first[1] == 2 / 255.0f && first[2] == 1 / 255.0f);
            assert_true(second[0] == 6 / 255.0f && second[2] == 4 / 255.0f);
        }
        if (forms[i].descriptor == 33)
            assert_true(first[3] == 0 && third[3] == 1 && fourth[3] == 1);
        if (forms[i].descriptor == 40)
            assert_true(first[3] == 128 / 255.0f && second[3] == 1);
        rt_image_destroy(image);
    }
}

static void greys_may_have_alpha(void **state)
{
    static const uint8_t pairs[12] = {10, 20, 30, 40};
    const form f = {3, 0, 16, 40, pairs, 12};
    (void)state;
    rt_image *image = decode(&f, 2);
    assert_true(image->data[2] == 30 / 255.0f && image->data[3] == 40 / 255.0f);
    rt_image_destroy(image);
}

static void maps_are_looked_up(void **state)
{
    static const uint8_t narrow[6] = {5, 6, 5, 6, 6, 6},
                         wide[12] = {5, 0, 6, 0, 5, 0, 6, 0, 6, 0, 6, 0};
    const form forms[] = {{1, 24, 8, 32, narrow, 6}, {1, 24, 16, 32, wide, 12}};
    (void)state;
    for (int i = 0; i < 2; i++) {
        rt_image *image = decode(&forms[i], 3);
        assert_true(image->data[0] == 30 / 255.0f && image->data[5] == 40 / 255.0f);
        rt_image_destroy(image);
    }
}

/* A run of four, which crosses the row, and two pixels as they are. */
static const uint8_t packed[] = {0x83, 1, 2, 3, 0x01, 4, 5, 6, 7, 8, 9};

static void runs_are_read(void **state)
{
    const form f = {10, 0, 24, 32, packed, sizeof packed};
    (void)state;
    rt_image *image = decode(&f, 3);
    for (int i = 0; i < 4; i++)
        assert_true(image->data[3 * i] == 3 / 255.0f);
    assert_true(image->data[12] == 6 / 255.0f && image->data[17] == 7 / 255.0f);
    rt_image_destroy(image);
}

static void expect_refused(const form *f, const char *cause)
{
    rt_bytes file = make_file(f);
    rt_image *image = NULL;
    rt_error error = {0};
    assert_int_equal(rt_tga_decode(&image, &file, "made", &error), RT_ERROR_INPUT);
    if (!strstr(error.message, cause))
        fail_msg("'%s' does not tell '%s'", error.message, cause);
    rt_bytes_free(&file);
}

static void faults_are_told(void **state)
{
    static const uint8_t below[6] = {4}, above[6] = {5, 7};
    static const uint8_t over[] = {0x86, 1, 2, 3}, over_raw[] = {0x06, 1, 2, 3, 4, 5, 6, 7};
    static const char header[] = "no plausible header", cut[] = "cut short";
    const struct {
        form form;
        const char *cause;
    } faults[] = {{{0, 0, 8, 0, six, 6}, header},
                  {{4, 0, 8, 0, six, 6}, header},
                  {{32, 0, 8, 0, six, 6}, header},
                  {{1, 0, 8, 0, six, 6}, header},
                  {{3, 0, 24, 0, six, 6}, header},
                  {{2, 0, 8, 0, six, 6}, header},
                  {{3, 0, 8, 64, six, 6}, header},
                  {{1, 23, 8, 0, six, 6}, header},
                  {{3, 0, 8, 0, six, 5}, cut},
                  {{1, 24, 8, 0, below, 6}, "not in its map"},
                  {{1, 24, 8, 0, above, 6}, "not in its map"},
                  {{11, 0, 8, 0, over, 4}, "beyond its last pixel"},
                  {{11, 0, 8, 0, over_raw, 8}, "beyond its last pixel"},
                  {{10, 0, 24, 0, packed, 10}, cut}};
    (void)state;
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++)
        expect_refused(&faults[i].form, faults[i].cause);
}

static void huge_sides_are_refused_before_memory_is_taken(void **state)
{
    const form f = {10, 0, 24, 32, packed, sizeof packed};
    (void)state;
    rt_bytes file = make_file(&f);
    rt_image *image = NULL;
    rt_error error = {0};
    memset(file.data + 12, 0xff, 4);
    assert_int_equal(rt_tga_decode(&image, &file, "made", &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "more than 2^30 values"));
    file.data[15] = 0;
    assert_int_equal(rt_tga_decode(&image, &file, "made", &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "instead of at least"));
    rt_bytes_free(&file);
}

static void damage_is_survived(void **state)
{
    const form forms[] = {{10, 0, 24, 32, packed, sizeof packed}, {1, 24, 8, 0, six, 6}};
    (void)state;
    for (int i = 0; i < 2; i++) {
        rt_bytes file = make_file(&forms[i]);
        damage_truncate(&file, rt_tga_decode);
        damage_flip(&file, rt_tga_decode);
        rt_bytes_free(&file);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_origin_is_upright),
        cmocka_unit_test(every_depth_of_colour_is_read),
        cmocka_unit_test(greys_may_have_alpha),
        cmocka_unit_test(maps_are_looked_up),
        cmocka_unit_test(runs_are_read),
        cmocka_unit_test(faults_are_told),
        cmocka_unit_test(huge_sides_are_refused_before_memory_is_taken),
        cmocka_unit_test(damage_is_survived),
    };
    return cmocka_run_group_tests_name("image/tga_read", tests, NULL, NULL);
}
