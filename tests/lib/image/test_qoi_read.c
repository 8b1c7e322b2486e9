/* QOI: every kind of chunk, alpha, both colour spaces, and every class of fault. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "damage.h"
#include "image/decode.h"

static const uint8_t mark[8] = {[7] = 1};

static void put(rt_bytes *file, const void *bytes, size_t size)
{
    assert_int_equal(rt_bytes_put(file, file->size, bytes, size, NULL), RT_OK);
}

static void put_header(rt_bytes *file, uint32_t width, uint32_t height, uint8_t channels,
                       uint8_t space)
{
    const uint8_t header[14] = {'q',
                                'o',
                                'i',
                                'f',
                                (uint8_t)(width >> 24),
                                (uint8_t)(width >> 16),
                                (uint8_t)(width >> 8),
                                (uint8_t)width,
                                (uint8_t)(height >> 24),
                                (uint8_t)(height >> 16),
                                (uint8_t)(height >> 8),
                                (uint8_t)height,
                                channels,
                                space};
    put(file, header, sizeof header);
}

/* A file of these chunks, with the mark of the end. */
static rt_bytes make_file(uint32_t width, uint32_t height, uint8_t channels, const void *chunks,
                          size_t size)
{
    rt_bytes file = {0};
    put_header(&file, width, height, channels, 0);
    put(&file, chunks, size);
    put(&file, mark, sizeof mark);
    return file;
}

static rt_image *decode(const rt_bytes *file, uint32_t width, uint32_t height, uint32_t channels)
{
    static const char *const names[4] = {"R", "G", "B", "A"};
    rt_image *image = NULL;
    rt_error error = {0};
    if (rt_qoi_decode(&image, file, "made", &error) != RT_OK)
        fail_msg("%s", error.message);
    assert_int_equal(image->width, width);
    assert_int_equal(image->height, height);
    assert_int_equal(image->channel_count, channels);
    for (uint32_t c = 0; c < channels; c++)
        assert_string_equal(image->names[c], names[c]);
    return image;
}

static void expect_codes(const rt_image *image, const uint8_t *codes, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (image->data[i] != (float)codes[i] / 255.0f)
            fail_msg("value %zu is %g, not %d/255", i, (double)image->data[i], codes[i]);
}

/* ---- Chunks by hand ------------------------------------------------------------ */

/* The page of the format says what each of these bytes means. */
static void every_kind_of_chunk_is_read(void **state)
{
    static const uint8_t chunks[] = {
        0xc0, /* black, opaque: what precedes the first pixel */
        0xfe,
        200,
        100,
        50,   /* a colour */
        0x7f, /* 1 more of each */
        0x40, /* 2 less of each */
        0x80 | 52,
        0xf0, /* 20 more of green, 27 more of red, 12 more of blue */
        0xff,
        1,
        2,
        3,
        4,         /* a colour and alpha */
        0xc2,      /* three times more */
        0x00 | 9,  /* that seen with the hash 9, black: none has been */
        0x00 | 53, /* the black one, opaque */
        0x00 | (600 + 500 + 350 + 11 * 255) % 64, /* the first colour */
    };
    static const uint8_t expected[12][4] = {
        {0, 0, 0, 255},      {200, 100, 50, 255}, {201, 101, 51, 255}, {199, 99, 49, 255},
        {226, 119, 61, 255}, {1, 2, 3, 4},        {1, 2, 3, 4},        {1, 2, 3, 4},
        {1, 2, 3, 4},        {0, 0, 0, 0},        {0, 0, 0, 255},      {200, 100, 50, 255}};
    (void)state;
    rt_bytes file = make_file(4, 3, 4, chunks, sizeof chunks);
    rt_image *image = decode(&file, 4, 3, 4);
    expect_codes(image, expected[0], 48);
    assert_true(image->is_srgb);
    rt_image_destroy(image);
    file.data[12] = 3; /* alpha that is not wanted is followed all the same */
    image = decode(&file, 4, 3, 3);
    for (size_t i = 0; i < 12; i++)
        for (size_t c = 0; c < 3; c++)
            assert_true(image->data[3 * i + c] == (float)expected[i][c] / 255.0f);
    rt_image_destroy(image);
    rt_bytes_free(&file);
}

static void sums_wrap_at_256(void **state)
{
    static const uint8_t chunks[] = {0x40, 0xbf, 0xff}, expected[] = {254, 254, 254, 36, 29, 36};
    (void)state;
    rt_bytes file = make_file(2, 1, 3, chunks, 3);
    rt_image *image = decode(&file, 2, 1, 3);
    expect_codes(image, expected, 6);
    rt_image_destroy(image);
    rt_bytes_free(&file);
}

static void the_header_says_the_colour_space(void **state)
{
    static const uint8_t grey[] = {0xfe, 7, 7, 7};
    (void)state;
    for (uint8_t space = 0; space < 2; space++) {
        float rgb[3];
        rt_bytes file = make_file(1, 1, 3, grey, sizeof grey);
        file.data[13] = space;
        rt_image *image = decode(&file, 1, 1, 3);
        assert_int_equal(image->is_srgb, space == 0);
        assert_int_equal(rt_image_get_rgb(rgb, image, NULL, NULL), RT_OK);
        assert_true(space ? rgb[1] == 7 / 255.0f : rgb[1] < 0.1f * 7 / 255.0f);
        rt_image_destroy(image);
        rt_bytes_free(&file);
    }
}

static void what_follows_the_end_is_ignored(void **state)
{
    (void)state;
    rt_bytes file = make_file(62, 2, 3, "\xfd\xfd", 2);
    put(&file, "more", 4);
    rt_image *image = decode(&file, 62, 2, 3);
    for (size_t i = 0; i < 3 * 124; i++)
        assert_true(image->data[i] == 0);
    rt_image_destroy(image);
    rt_bytes_free(&file);
}

/* ---- Pictures ------------------------------------------------------------------ */

/* The kinds of chunks that an encoder chose. */
enum { kind_run, kind_index, kind_difference, kind_green, kind_rgb, kind_rgba, kinds };

/* What an encoder keeps. */
typedef struct encoder {
    rt_bytes file;
    uint8_t seen[64][4], last[4];
    unsigned run, used[kinds];
} encoder;

static void put_run(encoder *e)
{
    const uint8_t byte = (uint8_t)(0xc0 | (e->run - 1));
    if (e->run == 0)
        return;
    put(&e->file, &byte, 1);
    e->used[kind_run]++;
    e->run = 0;
}

/* The shortest chunk of a pixel that differs from the last in its colours alone. */
static void put_colour(encoder *e, const uint8_t *pixel)
{
    const int8_t red = (int8_t)(pixel[0] - e->last[0]), green = (int8_t)(pixel[1] - e->last[1]),
                 blue = (int8_t)(pixel[2] - e->last[2]);
    const int by_red = red - green, by_blue = blue - green;
    const uint8_t whole[4] = {0xfe, pixel[0], pixel[1], pixel[2]};
    const uint8_t small = (uint8_t)(0x40 + 16 * (red + 2) + 4 * (green + 2) + blue + 2);
    const uint8_t two[2] = {(uint8_t)(0x80 + green + 32),
                            (uint8_t)(16 * (by_red + 8) + by_blue + 8)};
    if (abs(2 * red + 1) < 4 && abs(2 * green + 1) < 4 && abs(2 * blue + 1) < 4) {
        put(&e->file, &small, 1);
        e->used[kind_difference]++;
    } else if (green >= -32 && green < 32 && by_red >= -8 && by_red < 8 && by_blue >= -8 &&
               by_blue < 8) {
        put(&e->file, two, 2);
        e->used[kind_green]++;
    } else {
        put(&e->file, whole, 4);
        e->used[kind_rgb]++;
    }
}

static void put_pixel(encoder *e, const uint8_t *pixel)
{
    const uint8_t hash =
        (uint8_t)((pixel[0] * 3 + pixel[1] * 5 + pixel[2] * 7 + pixel[3] * 11) % 64);
    const uint8_t whole[5] = {0xff, pixel[0], pixel[1], pixel[2], pixel[3]};
    if (memcmp(pixel, e->last, 4) == 0) {
        if (++e->run == 62)
            put_run(e);
        return;
    }
    put_run(e);
    if (memcmp(pixel, e->seen[hash], 4) == 0) {
        put(&e->file, &hash, 1);
        e->used[kind_index]++;
    } else if (pixel[3] != e->last[3]) {
        put(&e->file, whole, 5);
        e->used[kind_rgba]++;
    } else {
        put_colour(e, pixel);
    }
    memcpy(e->seen[hash], pixel, 4);
    memcpy(e->last, pixel, 4);
}

/* Random steps of all sizes, repeated pixels, earlier ones, and changes of alpha. */
static void make_picture(uint8_t (*pixels)[4], size_t count, int has_alpha)
{
    uint32_t seed = 1;
    for (size_t i = 0; i < count; i++) {
        seed = seed * 1664525u + 1013904223u;
        const uint32_t choice = seed >> 29, step = choice < 3 ? 2 : choice < 5 ? 12 : 256;
        const size_t back = choice == 6 ? (seed >> 8) % 40 : 1;
        memcpy(pixels[i], i >= back ? pixels[i - back] : (const uint8_t[]){0, 0, 0, 255}, 4);
        if (choice == 6 || i % 300 > 200)
            continue;
        for (uint32_t c = 0; c < 3; c++)
            pixels[i][c] = (uint8_t)(pixels[i][c] + (seed >> (8 + 4 * c)) % step);
        if (has_alpha && choice == 7)
            pixels[i][3] = (uint8_t)(seed >> 12);
    }
}

static void pictures_are_read_back(void **state)
{
    enum { width = 61, height = 47 };
    static uint8_t pixels[width * height][4];
    (void)state;
    for (uint8_t channels = 3; channels <= 4; channels++) {
        encoder e = {.last = {0, 0, 0, 255}};
        make_picture(pixels, width * height, channels == 4);
        put_header(&e.file, width, height, channels, 0);
        for (size_t i = 0; i < width * height; i++)
            put_pixel(&e, pixels[i]);
        put_run(&e);
        put(&e.file, mark, sizeof mark);
        for (int kind = 0; kind < kinds; kind++)
            assert_true(e.used[kind] > 10 || (kind == kind_rgba && channels == 3));
        rt_image *image = decode(&e.file, width, height, channels);
        for (size_t i = 0; i < width * height; i++)
            for (uint32_t c = 0; c < channels; c++)
                assert_true(image->data[channels * i + c] == (float)pixels[i][c] / 255.0f);
        rt_image_destroy(image);
        rt_bytes_free(&e.file);
    }
}

/* ---- Faults -------------------------------------------------------------------- */

static void expect_refused(rt_bytes file, const char *cause)
{
    rt_image *image = NULL;
    rt_error error = {0};
    assert_int_equal(rt_qoi_decode(&image, &file, "made", &error), RT_ERROR_INPUT);
    if (!strstr(error.message, cause))
        fail_msg("'%s' does not tell '%s'", error.message, cause);
    rt_bytes_free(&file);
}

static rt_bytes with_byte(size_t at, uint8_t value)
{
    rt_bytes file = make_file(2, 1, 3,
                              "\xfe"
                              "abc"
                              "\xc0",
                              5);
    file.data[at] = value;
    return file;
}

static void faults_are_told(void **state)
{
    (void)state;
    expect_refused(with_byte(3, 'g'), "not a QOI file");
    expect_refused(with_byte(7, 0), "its sides are not two numbers from 1 to");
    expect_refused(with_byte(8, 0x80), "its sides are not two numbers from 1 to");
    expect_refused(with_byte(12, 2), "it has 2 channels, not 3 or 4");
    expect_refused(with_byte(12, 5), "it has 5 channels, not 3 or 4");
    expect_refused(with_byte(13, 2), "its colour space is 2, not 0 (sRGB) or 1 (linear)");
    expect_refused(with_byte(18, 0xc1), "a run goes beyond its last pixel");
    expect_refused(with_byte(7, 1), "no mark of the end"); /* a chunk too many */
    expect_refused(with_byte(26, 0), "no mark of the end");
    expect_refused(with_byte(20, 1), "no mark of the end");
    expect_refused(with_byte(7, 3), "cut short"); /* a pixel too few */
    expect_refused(make_file(1, 1, 4,
                             "\xff"
                             "abc",
                             4),
                   "cut short");
    expect_refused(make_file(63, 1, 3, "\xfd", 1), "cut short: 23 bytes instead of at least 24");
}

static void huge_sides_are_refused_before_memory_is_taken(void **state)
{
    (void)state;
    rt_bytes file = {0};
    put_header(&file, 65536, 65536, 4, 0);
    expect_refused(file, "more than 2^30 values");
    file = (rt_bytes){0};
    put_header(&file, 65536, 5461, 3, 0); /* 2^30 values in runs: a bomb */
    expect_refused(file, "instead of at least");
    file = (rt_bytes){0};
    put_header(&file, 65536, 5461, 3, 0);
    for (size_t i = 0; i < 5773000 / 250; i++) {
        uint8_t runs[250];
        memset(runs, 0xfd, sizeof runs);
        put(&file, runs, sizeof runs);
    }
    expect_refused(file, "more than 64 values a byte");
}

static void damage_is_survived(void **state)
{
    static const uint8_t chunks[] = {0xfe, 1, 2, 3, 0x7f, 0x90, 0x88, 0xff, 9, 8, 7, 6, 0xc3, 20};
    (void)state;
    for (uint8_t channels = 3; channels <= 4; channels++) {
        rt_bytes file = make_file(3, 3, channels, chunks, sizeof chunks);
        rt_image_destroy(decode(&file, 3, 3, channels));
        damage_truncate(&file, rt_qoi_decode);
        damage_flip(&file, rt_qoi_decode);
        rt_bytes_free(&file);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_of_chunk_is_read),
        cmocka_unit_test(sums_wrap_at_256),
        cmocka_unit_test(the_header_says_the_colour_space),
        cmocka_unit_test(what_follows_the_end_is_ignored),
        cmocka_unit_test(pictures_are_read_back),
        cmocka_unit_test(faults_are_told),
        cmocka_unit_test(huge_sides_are_refused_before_memory_is_taken),
        cmocka_unit_test(damage_is_survived),
    };
    return cmocka_run_group_tests_name("image/qoi_read", tests, NULL, NULL);
}
