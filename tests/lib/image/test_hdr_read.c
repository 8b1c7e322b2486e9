/* Radiance HDR: values, both schemes of runs, all orientations, and every class of fault. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "damage.h"
#include "image/decode.h"

#define HEAD "#?RADIANCE\n# made\nEXPOSURE=4\nFORMAT=32-bit_rle_rgbe\n\n"

static void put(rt_bytes *out, const void *data, size_t size)
{
    assert_int_equal(rt_bytes_put(out, out->size, data, size, NULL), RT_OK);
}

static void put_text(rt_bytes *out, const char *text)
{
    put(out, text, strlen(text));
}

static rt_image *expect_image(const rt_bytes *file)
{
    rt_image *image = NULL;
    rt_error error = {0};
    if (rt_hdr_decode(&image, file, "made", &error) != RT_OK)
        fail_msg("%s", error.message);
    assert_false(image->is_srgb);
    assert_int_equal(image->channel_count, 3);
    assert_string_equal(image->names[2], "B");
    return image;
}

static void expect_refused(const char *head, const void *pixels, size_t size, const char *cause)
{
    rt_bytes file = {0};
    rt_image *image = NULL;
    rt_error error = {0};
    put_text(&file, head);
    put(&file, pixels, size);
    assert_int_equal(rt_hdr_decode(&image, &file, "made", &error), RT_ERROR_INPUT);
    assert_null(image);
    if (!strstr(error.message, cause))
        fail_msg("'%s' does not tell '%s'", error.message, cause);
    rt_bytes_free(&file);
}

/* m 2^(e - 136), and 0 where the exponent is. */
static void mantissas_share_their_exponent(void **state)
{
    static const uint8_t pixels[16] = {255, 1, 0, 136, 128, 64, 32, 129,
                                       9,   9, 9, 0,   200, 2,  7,  255};
    static const float expected[12] = {255, 1, 0, 1, 0.5f, 0.25f, 0, 0, 0};
    (void)state;
    rt_bytes file = {0};
    put_text(&file, HEAD "-Y 1 +X 4\n");
    put(&file, pixels, sizeof pixels);
    rt_image *image = expect_image(&file);
    for (int i = 0; i < 9; i++)
        assert_true(image->data[i] == expected[i]);
    assert_true(image->data[9] == ldexpf(200, 119) && image->data[10] == ldexpf(2, 119));
    rt_image_destroy(image);
    rt_bytes_free(&file);
}

/* The pixel at x from the left and y from the top has the red x and the green y. */
static void every_orientation_is_upright(void **state)
{
    static const char *const forms[8] = {"-Y 3 +X 2\n", "-Y 3 -X 2\n", "+Y 3 -X 2\n",
                                         "+Y 3 +X 2\n", "+X 2 -Y 3\n", "-X 2 -Y 3\n",
                                         "-X 2 +Y 3\n", "+X 2 +Y 3\n"};
    (void)state;
    for (int form = 0; form < 8; form++) {
        const char *const line = forms[form];
        const int is_column = line[1] == 'X';
        const char x_sign = line[is_column ? 0 : 5], y_sign = line[is_column ? 5 : 0];
        rt_bytes file = {0};
        put_text(&file, HEAD);
        put_text(&file, line);
        for (int j = 0; j < (is_column ? 2 : 3); j++)
            for (int i = 0; i < (is_column ? 3 : 2); i++) {
                const int x = is_column ? j : i, y = is_column ? i : j;
                const uint8_t pixel[4] = {(uint8_t)(x_sign == '+' ? x : 1 - x),
                                          (uint8_t)(y_sign == '-' ? y : 2 - y), 7, 136};
                put(&file, pixel, 4);
            }
        rt_image *image = expect_image(&file);
        assert_int_equal(image->width, 2);
        assert_int_equal(image->height, 3);
        for (int i = 0; i < 6; i++)
            if (image->data[3 * i] != (float)(i % 2) || image->data[3 * i + 1] != (float)(i / 2))
                fail_msg("%s is not upright", line);
        rt_image_destroy(image);
        rt_bytes_free(&file);
    }
}

/* A picture of 9 x 2: a line in runs by component, and one by pixels with two runs. */
static void put_runs(rt_bytes *file)
{
    static const uint8_t by_component[] = {2, 2, 0, 9, 137, 5, 1, 6, 131, 7, 5, 1, 2,   3,
                                           4, 5, 9, 0, 1,   2, 3, 4, 5,   6, 7, 8, 137, 136};
    static const uint8_t by_pixel[] = {3, 4, 5, 136, 1, 1, 1, 6, 6, 7, 8, 136, 1, 1, 1, 1};
    put_text(file, HEAD "-Y 2 +X 9\n");
    put(file, by_component, sizeof by_component);
    put(file, by_pixel, sizeof by_pixel);
}

static void both_schemes_of_runs_are_read(void **state)
{
    static const float green[9] = {6, 7, 7, 7, 1, 2, 3, 4, 5};
    (void)state;
    rt_bytes file = {0};
    put_runs(&file);
    rt_image *image = expect_image(&file);
    for (int x = 0; x < 9; x++) {
        const float *top = image->data + 3 * x, *bottom = image->data + 27 + 3 * x;
        assert_true(top[0] == 5 && top[1] == green[x] && top[2] == (float)x);
        assert_true(bottom[0] == (x < 7 ? 3 : 6) && bottom[2] == (x < 7 ? 5 : 8));
    }
    rt_image_destroy(image);
    rt_bytes_free(&file);
}

/* 1, 1, 1, n again: 256 times as many. */
static void runs_of_runs_are_longer(void **state)
{
    static const uint8_t pixels[] = {3, 4, 5, 136, 1, 1, 1, 2, 1, 1, 1, 1, 9, 9, 9, 136};
    (void)state;
    rt_bytes file = {0};
    put_text(&file, HEAD "-Y 1 +X 260\n");
    put(&file, pixels, sizeof pixels);
    rt_image *image = expect_image(&file);
    assert_true(image->data[3 * 258] == 3 && image->data[3 * 259] == 9);
    rt_image_destroy(image);
    rt_bytes_free(&file);
}

static void faults_are_told(void **state)
{
    static const uint8_t zero[64] = {0};
    static const uint8_t first_run[] = {1, 1, 1, 2, 0, 0, 0, 0};
    static const uint8_t long_run[] = {3, 3, 3, 3, 1, 1, 1, 9, 0, 0, 0, 0};
    static const uint8_t endless[] = {3, 3, 3, 3, 1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 0,
                                      1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 0};
    static const uint8_t over[] = {2, 2, 0, 8, 137, 5, 0, 0}, over_raw[] = {2, 2, 0, 8, 9, 1, 2, 3};
    static const uint8_t empty[] = {2, 2, 0, 8, 0, 0, 0, 0}, other[] = {2, 2, 0, 9, 137, 1, 1, 1};
    (void)state;
    expect_refused("#RADIANCE\n\n", zero, 8, "it is not a Radiance picture");
    expect_refused("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n", zero, 8, "ra_xyze");
    expect_refused("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n", zero, 0, "its header has no end");
    expect_refused("#?RADIANCE\n\n", zero, 0, "it has no resolution");
    expect_refused(HEAD "-Y 1 +Y 1\n", zero, 8, "its resolution");
    expect_refused(HEAD "-Y 0 +X 1\n", zero, 8, "its resolution");
    expect_refused(HEAD "-Y 1 +X 65537\n", zero, 8, "its resolution");
    expect_refused(HEAD "-Y 1 +X 99999999999999\n", zero, 8, "its resolution");
    expect_refused(HEAD "-Y 1 +X 1 \n", zero, 8, "its resolution");
    expect_refused(HEAD "-Y 65536 +X 65536\n", zero, 8, "more than 2^30 values");
    expect_refused(HEAD "-Y 9 +X 2\n", zero, 64, "too short for the size");
    expect_refused(HEAD "-Y 2 +X 9\n", zero, 64, "it is cut short");
    expect_refused(HEAD "-Y 1 +X 2\n", first_run, 8, "a run has no pixel before it");
    expect_refused(HEAD "-Y 1 +X 3\n", long_run, 12, "a run goes beyond its scan line");
    expect_refused(HEAD "-Y 1 +X 3\n", endless, sizeof endless, "a run goes beyond");
    expect_refused(HEAD "-Y 1 +X 8\n", over, 8, "a run goes beyond its scan line");
    expect_refused(HEAD "-Y 1 +X 8\n", over_raw, 8, "a run goes beyond its scan line");
    expect_refused(HEAD "-Y 1 +X 8\n", empty, 8, "a run is empty");
    expect_refused(HEAD "-Y 1 +X 8\n", other, 8, "another length than the picture");
}

static void damage_is_survived(void **state)
{
    (void)state;
    rt_bytes file = {0};
    put_runs(&file);
    damage_truncate(&file, rt_hdr_decode);
    damage_flip(&file, rt_hdr_decode);
    rt_bytes_free(&file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mantissas_share_their_exponent),
        cmocka_unit_test(every_orientation_is_upright),
        cmocka_unit_test(both_schemes_of_runs_are_read),
        cmocka_unit_test(runs_of_runs_are_longer),
        cmocka_unit_test(faults_are_told),
        cmocka_unit_test(damage_is_survived),
    };
    return cmocka_run_group_tests_name("image/hdr_read", tests, NULL, NULL);
}
