/* PPM and PGM: values, comments, and every class of fault. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "damage.h"
#include "image/decode.h"
#include "image/netpbm.h"

/* Decodes an exact copy, so that a memory checker sees a read past its end. */
static rt_status decode(rt_image **out, const char *characters, size_t size, rt_error *error)
{
    rt_bytes bytes = {malloc(size ? size : 1), size, size, NULL};
    assert_non_null(bytes.data);
    memcpy(bytes.data, characters, size);
    rt_status status = rt_ppm_decode(out, &bytes, "text", error);
    rt_bytes_free(&bytes);
    return status;
}

/* The codes, each over the greatest, are what a file holds. */
static void check_codes(const char *characters, size_t size, uint32_t width, uint32_t height,
                        uint32_t channel_count, const unsigned *codes, unsigned top)
{
    rt_image *image = NULL;
    rt_error error = {0};
    if (decode(&image, characters, size, &error) != RT_OK)
        fail_msg("%s", error.message);
    assert_int_equal(image->width, width);
    assert_int_equal(image->height, height);
    assert_int_equal(image->channel_count, channel_count);
    assert_true(image->is_srgb);
    assert_string_equal(image->names[0], channel_count == 3 ? "R" : "Y");
    for (uint32_t i = 0; i < width * height * channel_count; i++)
        assert_true(image->data[i] == (float)codes[i] / (float)top);
    rt_image_destroy(image);
}

#define CODES(literal, width, height, channels, codes, top)                                        \
    check_codes(literal, sizeof literal - 1, width, height, channels, codes, top)

static void every_kind_is_read(void **state)
{
    static const unsigned six[] = {0, 1, 2, 253, 254, 255}, wide[] = {0, 1, 256, 258, 999, 1000};
    static const unsigned deep[] = {0x0000, 0x00ff, 0xff00, 0x1234, 0xfffe, 0xffff},
                          bits[] = {1, 0, 0, 1, 1, 0};
    (void)state;
    CODES("P2 3 2 255\n0 1 2 253 254 255\n", 3, 2, 1, six, 255);
    CODES("P3 2 1 255\n0 1 2 253 254 255\n", 2, 1, 3, six, 255);
    CODES("P5 2 3 255\n\x00\x01\x02\xfd\xfe\xff", 2, 3, 1, six, 255);
    CODES("P6 1 2 255\n\x00\x01\x02\xfd\xfe\xff", 1, 2, 3, six, 255);
    CODES("P5 6 1 1000\n\x00\x00\x00\x01\x01\x00\x01\x02\x03\xe7\x03\xe8", 6, 1, 1, wide, 1000);
    CODES("P3 1 2 1000 0 1 256 258 999 1000", 1, 2, 3, wide, 1000);
    CODES("P6 2 1 65535\n\x00\x00\x00\xff\xff\x00\x12\x34\xff\xfe\xff\xff", 2, 1, 3, deep, 65535);
    CODES("P2 2 3 1\n1 0 0 1 1 0", 2, 3, 1, bits, 1);
}

static void a_comment_counts_as_if_it_were_not_there(void **state)
{
    static const unsigned six[] = {35, 1, 2, 253, 254, 255};
    (void)state;
    CODES("P6\n# made by hand\n1 2\n255\n#\x01\x02\xfd\xfe\xff", 1, 2, 3, six, 255);
    CODES("P6 # one\r# two\n 1# in a number\n 2 25#here too\n5 #\x01\x02\xfd\xfe\xff", 1, 2, 3, six,
          255);
    CODES("P3 1 2 255 35 1 # between\n 2 253 254 25#and inside\n5#at the end\n", 1, 2, 3, six, 255);
}

static void white_space_may_surround_and_end(void **state)
{
    static const unsigned six[] = {0, 1, 2, 10, 32, 13};
    (void)state;
    CODES("P5\t\v\f\r\n3 \n\n2\r\n255\n\x00\x01\x02\x0a\x20\x0d", 3, 2, 1, six, 255);
    CODES("P5 3 2 255\n\x00\x01\x02\x0a\x20\x0d\n \n", 3, 2, 1, six, 255);
    CODES("P2 3 2 255\n 0\t1\r2\n10 032 000000000013 \n", 3, 2, 1, six, 255);
}

/* The message tells the cause. */
static void check_refused(const char *characters, size_t size, const char *cause)
{
    rt_image *image = NULL;
    rt_error error = {0};
    assert_int_equal(decode(&image, characters, size, &error), RT_ERROR_INPUT);
    assert_null(image);
    if (!strstr(error.message, cause) || !strstr(error.message, "text"))
        fail_msg("'%s' does not tell '%s'", error.message, cause);
}

#define REFUSED(literal, cause) check_refused(literal, sizeof literal - 1, cause)

static void damaged_headers_are_refused(void **state)
{
    (void)state;
    REFUSED("", "not a PPM");
    REFUSED("P", "not a PPM");
    REFUSED("P\0 1 1 255 1", "not a PPM");
    REFUSED("P1 1 1 1", "not a PPM");
    REFUSED("P4 1 1 1", "not a PPM");
    REFUSED("P7 1 1 255 1", "not a PPM");
    REFUSED("p2 1 1 255 1", "not a PPM");
    REFUSED("P2", "sides");
    REFUSED("P21 1 255 1", "sides");
    REFUSED("P2 1", "sides");
    REFUSED("P2 0 1 255 1", "sides");
    REFUSED("P2 1 0 255 1", "sides");
    REFUSED("P2 -1 1 255 1", "sides");
    REFUSED("P2 +1 1 255 1", "sides");
    REFUSED("P2 1.0 1 255 1", "sides");
    REFUSED("P2 0x1 1 255 1", "sides");
    REFUSED("P2 65537 1 255 1", "sides");
    REFUSED("P2 4294967297 1 255 1", "sides");
    REFUSED("P2 1 99999999999999999999999999999999 255 1", "sides");
    REFUSED("P2 1 1 0 1", "greatest code");
    REFUSED("P2 1 1 65536 1", "greatest code");
    REFUSED("P2 1 1 x 1", "greatest code");
    REFUSED("P2 1 1 # no end", "greatest code");
    REFUSED("P2 1 1 255", "white space");
    REFUSED("P5 1 1 255x", "white space");
    REFUSED("P5 1 1 255# a comment does not end the header\n", "white space");
}

static void wrong_pixels_are_refused(void **state)
{
    (void)state;
    REFUSED("P5 2 2 255\n123", "cut short");
    REFUSED("P5 1 1 256\n1", "cut short");
    REFUSED("P6 1 1 255\n12", "cut short");
    REFUSED("P5 1 1 255\n12", "follows");
    REFUSED("P5 1 1 255\n1P5 1 1 255\n1", "follows");
    REFUSED("P5 1 2 100\n\x01\x65", "value 2");
    REFUSED("P5 1 2 256\n\x01\x00\x01\x01", "value 2");
    REFUSED("P2 2 1 255 1 ", "cut short");
    REFUSED("P2 2 1 255 12 #4", "value 2");
    REFUSED("P2 2 1 255 1 256", "value 2");
    REFUSED("P2 2 1 255 1 -1", "value 2");
    REFUSED("P2 2 1 255 1 1.5", "follows");
    REFUSED("P2 2 1 255 1 x", "value 2");
    REFUSED("P2 2 1 255 1 4294967296", "value 2");
    REFUSED("P2 2 1 255 1 2 3", "follows");
}

/*
 * A short file that states a large size is refused for its length, without memory for the pixels.
 */
static void promises_are_checked_before_they_are_believed(void **state)
{
    (void)state;
    REFUSED("P6 65536 65536 255\n123", "2^30");
    REFUSED("P5 65536 65536 255\n123", "2^30");
    REFUSED("P5 32768 32768 65535\n123", "instead of 2147483649");
    REFUSED("P2 32768 32768 65535\n123", "instead of at least 2147483648");
}

static void damage_never_crashes(void **state)
{
    static char binary[] = "P6\n#c\n2 2\n255\nabcdefghijkl",
                plain[] = "P3\n#c\n2 1\n999\n1 22 333#\n 44 5 6";
    const rt_bytes files[] = {{(uint8_t *)binary, sizeof binary - 1, 0, NULL},
                              {(uint8_t *)plain, sizeof plain - 1, 0, NULL}};
    (void)state;
    for (int i = 0; i < 2; i++) {
        damage_truncate(&files[i], rt_ppm_decode);
        damage_flip(&files[i], rt_ppm_decode);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_is_read),
        cmocka_unit_test(a_comment_counts_as_if_it_were_not_there),
        cmocka_unit_test(white_space_may_surround_and_end),
        cmocka_unit_test(damaged_headers_are_refused),
        cmocka_unit_test(wrong_pixels_are_refused),
        cmocka_unit_test(promises_are_checked_before_they_are_believed),
        cmocka_unit_test(damage_never_crashes),
    };
    return cmocka_run_group_tests_name("image/ppm_read", tests, NULL, NULL);
}
