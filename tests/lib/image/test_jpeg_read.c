/* JPEG: values of every kind that is read, the kinds that are not, and every class of fault. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "damage.h"
#include "image/decode.h"
#include "image/srgb.h"
#include "jpeg_sample.h"
#include "rt.h"
#include "scratch.h"

/* A constant grey of code 188 in 8 x 8 pixels, byte by byte as T.81 has it. */
static const uint8_t grey_file[] = {
    0xff, 0xd8, 0xff, 0xdb, 0, 67, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1,
    1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1,
    1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1,
    /* 8 bits, 8 x 8, one component by table 0 */
    0xff, 0xc0, 0, 11, 8, 0, 8, 0, 8, 1, 1, 0x11, 0,
    /* one code of one bit for each kind of coefficient: a DC one of 9 bits, the end of a block */
    0xff, 0xc4, 0, 20, 0x00, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 9, 0xff, 0xc4, 0, 20,
    0x10, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xff, 0xda, 0, 8, 1, 1, 0, 0, 63, 0,
    /* 0, then 480 = 8 (188 - 128) in nine bits, then 0, then ones */
    0x78, 0x1f, 0xff, 0xd9};

static rt_image *expect_read(const rt_bytes *file)
{
    rt_image *image = NULL;
    rt_error error = {0};
    if (rt_jpeg_decode(&image, file, "made", &error) != RT_OK)
        fail_msg("%s", error.message);
    return image;
}

static void check_refused(const rt_bytes *file, const char *cause)
{
    rt_image *image = NULL;
    rt_error error = {0};
    assert_int_equal(rt_jpeg_decode(&image, file, "made", &error), RT_ERROR_INPUT);
    assert_null(image);
    if (!strstr(error.message, cause) || !strstr(error.message, "cannot read made: "))
        fail_msg("'%s' does not tell '%s'", error.message, cause);
}

/* Chroma of half the size is interpolated, which at borders moves a slope by a pixel's step. */
static int tolerance_of(const jpeg_sample *sample)
{
    return sample->colours == JPEG_GREY ? 1 : sample->colours == JPEG_420 ? 5 : 2;
}

static void check_sample(const jpeg_sample *sample)
{
    rt_bytes file = jpeg_sample_file(sample);
    rt_image *image = expect_read(&file);
    const int channels = sample->colours == JPEG_GREY ? 1 : 3;
    const float *value = image->data;
    assert_int_equal(image->width, sample->width);
    assert_int_equal(image->height, sample->height);
    assert_int_equal(image->channel_count, channels);
    assert_string_equal(image->names[0], channels == 1 ? "Y" : "R");
    assert_true(image->is_srgb);
    for (uint32_t y = 0; y < sample->height; y++)
        for (uint32_t x = 0; x < sample->width; x++)
            for (int c = 0; c < channels; c++, value++) {
                const int code = (int)(*value * 255.0f + 0.5f);
                assert_true(*value == (float)code / 255.0f);
                if (abs(code - jpeg_sample_code(x, y, c)) > tolerance_of(sample))
                    fail_msg("colours %d, %ux%u: %d at (%u, %u), not %d", (int)sample->colours,
                             sample->width, sample->height, code, x, y, jpeg_sample_code(x, y, c));
            }
    rt_image_destroy(image);
    rt_bytes_free(&file);
}

static void every_kind_is_read(void **state)
{
    static const uint32_t sizes[][2] = {{1, 1}, {3, 2}, {8, 8}, {17, 9}, {37, 41}};
    (void)state;
    for (jpeg_colours colours = JPEG_GREY; colours <= JPEG_RGB; colours++)
        for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
            jpeg_sample sample = {.colours = colours, .width = sizes[s][0], .height = sizes[s][1]};
            check_sample(&sample);
            sample.restart = 1;
            check_sample(&sample);
            sample.is_apart = jpeg_sample_channels(colours) == 3;
            check_sample(&sample);
            sample.is_apart = 0;
            sample.is_progressive = 1;
            check_sample(&sample);
        }
}

/* A file of known bytes is one code, and linear light as that code of a PNG is. */
static void codes_are_srgb(void **state)
{
    float rgb[64 * 3];
    (void)state;
    FILE *stream = fopen("grey.png", "wb"); /* its name does not matter */
    assert_non_null(stream);
    assert_int_equal(fwrite(grey_file, 1, sizeof grey_file, stream), sizeof grey_file);
    assert_int_equal(fclose(stream), 0);
    rt_image *image = NULL;
    rt_error error;
    assert_int_equal(rt_image_read(&image, "grey.png", &error), RT_OK);
    assert_int_equal(rt_image_get_rgb(rgb, image, NULL, &error), RT_OK);
    for (int i = 0; i < 64 * 3; i++)
        assert_true(rgb[i] == (float)rt_srgb_decode(188.0 / 255.0));
    rt_image_destroy(image);
}

static void other_kinds_are_refused(void **state)
{
    static const struct {
        jpeg_sample sample;
        const char *cause;
    } kinds[] = {
        {{.colours = JPEG_CMYK}, "CMYK colours: convert it, as by `oiiotool FILE -o NEW.png`"},
        {{.colours = JPEG_YCCK}, "CMYK colours: convert it"},
        {{.colours = JPEG_YCCK, .is_progressive = 1}, "CMYK colours: convert it"},
        {{.colours = JPEG_PAIR}, "neither one component"},
        {{.colours = JPEG_YCBCR, .is_arithmetic = 1},
         "arithmetic coding: convert it, as by `jpegtran -outfile NEW.jpg FILE`"},
        {{.colours = JPEG_GREY, .is_arithmetic = 1, .is_progressive = 1}, "arithmetic coding"}};
    (void)state;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        jpeg_sample sample = kinds[i].sample;
        sample.width = sample.height = 16;
        rt_bytes file = jpeg_sample_file(&sample);
        check_refused(&file, kinds[i].cause);
        rt_bytes_free(&file);
    }
}

/* The place of a segment: of its marker's second byte. */
static size_t find_segment(const rt_bytes *file, uint8_t marker)
{
    size_t at = 3;
    while (file->data[at] != marker) {
        at += 2 + (size_t)(file->data[at + 1] << 8 | file->data[at + 2]);
        assert_true(at < file->size);
    }
    return at;
}

static void put16(uint8_t *at, uint32_t value)
{
    at[0] = (uint8_t)(value >> 8);
    at[1] = (uint8_t)value;
}

/* A file whose header states another depth or size. */
static void check_header_refused(const jpeg_sample *sample, int bits, uint32_t width,
                                 uint32_t height, const char *cause)
{
    rt_bytes file = jpeg_sample_file(sample);
    uint8_t *header = file.data + find_segment(&file, sample->is_progressive ? 0xc2 : 0xc0) + 3;
    header[0] = (uint8_t)bits;
    put16(header + 1, height);
    put16(header + 3, width);
    check_refused(&file, cause);
    rt_bytes_free(&file);
}

/* Sizes that the data cannot fill are refused before memory is taken for them. */
static void promises_are_checked_before_they_are_believed(void **state)
{
    const jpeg_sample rgb = {.colours = JPEG_YCBCR, .width = 16, .height = 16},
                      grey = {.width = 16, .height = 16},
                      progressive = {
                          .colours = JPEG_YCBCR, .width = 16, .height = 16, .is_progressive = 1};
    (void)state;
    check_header_refused(&rgb, 12, 16, 16, "12 bits a sample, not 8: convert it, as by `djpeg");
    check_header_refused(&grey, 8, 0, 16, "Empty");
    check_header_refused(&grey, 8, 16, 0, "Empty");
    check_header_refused(&grey, 8, 65535, 16, "65500");
    check_header_refused(&rgb, 8, 65500, 65500, "2^30");
    check_header_refused(&grey, 8, 65500, 65500, "2^30");
    check_header_refused(&grey, 8, 32767, 32767, "too short");
    check_header_refused(&progressive, 8, 16383, 16383, "too short");
    check_header_refused(&progressive, 8, 2048, 2048, "too short");
    check_header_refused(&grey, 8, 24, 24, "");
}

/* Pixels that are all there, but more than 1 GiB of them out of 3 MB. */
static void a_bomb_is_refused(void **state)
{
    const jpeg_sample grey = {.width = 16, .height = 16};
    (void)state;
    rt_bytes file = jpeg_sample_file(&grey);
    put16(file.data + find_segment(&file, 0xc0) + 4, 32000);
    put16(file.data + find_segment(&file, 0xc0) + 6, 32000);
    assert_int_equal(rt_bytes_put(&file, 3000000, "", 1, NULL), RT_OK);
    check_refused(&file, "64 values a byte");
    rt_bytes_free(&file);
}

/* Each scan of one more, of which none is wrong. */
static void scans_are_limited(void **state)
{
    const jpeg_sample sample = {.colours = JPEG_YCBCR, .width = 16, .height = 16, .is_apart = 1};
    (void)state;
    for (int more = 97; more <= 98; more++) {
        rt_bytes file = jpeg_sample_file(&sample);
        size_t from = file.size - 4;
        while (file.data[from] != 0xff || file.data[from + 1] != 0xda)
            from--;
        const size_t size = file.size - 2 - from;
        uint8_t *scan = malloc(size);
        assert_non_null(scan);
        memcpy(scan, file.data + from, size);
        file.size -= 2;
        for (int i = 0; i < more; i++)
            assert_int_equal(rt_bytes_put(&file, file.size, scan, size, NULL), RT_OK);
        assert_int_equal(rt_bytes_put(&file, file.size, "\xff\xd9", 2, NULL), RT_OK);
        if (more == 97)
            rt_image_destroy(expect_read(&file));
        else
            check_refused(&file, "more than 100 scans");
        free(scan);
        rt_bytes_free(&file);
    }
}

static void what_is_missing_is_told(void **state)
{
    const jpeg_sample apart = {.colours = JPEG_YCBCR, .width = 16, .height = 16, .is_apart = 1};
    rt_bytes file = jpeg_sample_file(&apart), empty = {0},
             text = {(uint8_t *)"not a picture at all", 20, 20, NULL};
    (void)state;
    check_refused(&empty, "cut short");
    check_refused(&text, "JPEG");
    /* End it before the scan of its last component. */
    size_t at = file.size - 4;
    while (file.data[at] != 0xff || file.data[at + 1] != 0xda)
        at--;
    file.data[at + 1] = 0xd9;
    check_refused(&file, "no scan of one of its components");
    /* A segment that states more bytes than the file has. */
    put16(file.data + find_segment(&file, 0xe0) + 1, 65535);
    check_refused(&file, "cut short");
    rt_bytes_free(&file);
}

/* Data that ends early is an error, bytes between segments and behind the end are none. */
static void lost_pixels_are_errors_and_stray_bytes_are_not(void **state)
{
    const jpeg_sample sample = {.colours = JPEG_YCBCR, .width = 32, .height = 32};
    rt_bytes file = jpeg_sample_file(&sample), stray = {0};
    (void)state;
    assert_int_equal(rt_bytes_put(&stray, 0, file.data, 2, NULL), RT_OK);
    assert_int_equal(rt_bytes_put(&stray, 2, "stray", 5, NULL), RT_OK);
    assert_int_equal(rt_bytes_put(&stray, 7, file.data + 2, file.size - 2, NULL), RT_OK);
    assert_int_equal(rt_bytes_put(&stray, stray.size, "behind", 6, NULL), RT_OK);
    rt_image_destroy(expect_read(&stray));
    memmove(file.data + file.size - 102, file.data + file.size - 2, 2);
    file.size -= 100;
    check_refused(&file, "premature end of data segment");
    rt_bytes_free(&stray);
    rt_bytes_free(&file);
}

/* What libjpeg keeps of several scans counts while it is there. */
static void coefficients_count_as_memory(void **state)
{
    const jpeg_sample sample = {.width = 256, .height = 256, .is_progressive = 1};
    (void)state;
    rt_bytes file = jpeg_sample_file(&sample);
    for (uint64_t limit = 380 << 10; limit <= 400 << 10; limit += 20 << 10) {
        rt_memory *memory = NULL;
        rt_image *image = NULL;
        rt_error error;
        assert_int_equal(rt_memory_create(&memory, limit, &error), RT_OK);
        const rt_bytes counted = {file.data, file.size, file.size, memory};
        const rt_status status = rt_jpeg_decode(&image, &counted, "made", &error);
        /* 256 KiB of floats and 128 of coefficients */
        assert_int_equal(status, limit < 384 << 10 ? RT_ERROR_MEMORY : RT_OK);
        rt_memory_info info;
        rt_image_destroy(image);
        rt_memory_get_info(memory, &info);
        assert_int_equal(info.used, 0);
        rt_memory_destroy(memory);
    }
    rt_bytes_free(&file);
}

static void damage_never_crashes(void **state)
{
    (void)state;
    for (jpeg_colours colours = JPEG_GREY; colours <= JPEG_RGB; colours++) {
        jpeg_sample sample = {.colours = colours, .width = 5, .height = 3};
        sample.is_progressive = colours % 2 == 0;
        rt_bytes file = jpeg_sample_file(&sample);
        damage_truncate(&file, rt_jpeg_decode);
        damage_flip(&file, rt_jpeg_decode);
        rt_bytes_free(&file);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_is_read),
        cmocka_unit_test_setup_teardown(codes_are_srgb, scratch_enter, scratch_leave),
        cmocka_unit_test(other_kinds_are_refused),
        cmocka_unit_test(promises_are_checked_before_they_are_believed),
        cmocka_unit_test(a_bomb_is_refused),
        cmocka_unit_test(scans_are_limited),
        cmocka_unit_test(what_is_missing_is_told),
        cmocka_unit_test(lost_pixels_are_errors_and_stray_bytes_are_not),
        cmocka_unit_test(coefficients_count_as_memory),
        cmocka_unit_test(damage_never_crashes),
    };
    return cmocka_run_group_tests_name("image/jpeg_read", tests, NULL, NULL);
}
