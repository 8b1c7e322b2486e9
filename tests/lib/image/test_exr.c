/* OpenEXR: every bit comes back under its name, and damaged files are refused. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "damage.h"
#include "exr_sample.h"
#include "image/decode.h"
#include "image/exr.h"
#include "scratch.h"

static rt_image *create(uint32_t width, uint32_t height, const char *const *names, uint32_t count)
{
    rt_image *image = NULL;
    assert_int_equal(rt_image_create(&image, width, height, names, count, NULL), RT_OK);
    return image;
}

/* Fills an image with random bits: every kind of float occurs, NaN payloads included. */
static void fill_with_bits(rt_image *image, uint64_t state)
{
    size_t count = (size_t)image->width * image->height * image->channel_count;
    for (size_t i = 0; i < count; i++) {
        state = state * UINT64_C(6364136223846793005) + 1;
        uint32_t bits = (uint32_t)(state >> 32);
        memcpy(&image->data[i], &bits, sizeof bits);
    }
}

static rt_bytes encode(const rt_image *image)
{
    rt_bytes bytes = {0};
    rt_error error = {0};
    assert_int_equal(rt_exr_encode(&bytes, image, &error), RT_OK);
    return bytes;
}

static rt_image *decode(const rt_bytes *bytes)
{
    rt_image *image = NULL;
    rt_error error = {0};
    if (rt_exr_decode(&image, bytes, "sample", &error) != RT_OK)
        fail_msg("%s", error.message);
    return image;
}

/* Whether both have the same channels, each with the same bits, wherever it stands. */
static void expect_same(const rt_image *a, const rt_image *b)
{
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    assert_int_equal(a->channel_count, b->channel_count);
    size_t pixel_count = (size_t)a->width * a->height;
    for (uint32_t c = 0; c < a->channel_count; c++) {
        uint32_t other = rt_image_channel(b, a->names[c]);
        assert_int_not_equal(other, RT_IMAGE_NO_CHANNEL);
        for (size_t i = 0; i < pixel_count; i++)
            if (memcmp(&a->data[i * a->channel_count + c], &b->data[i * b->channel_count + other],
                       sizeof(float)) != 0)
                fail_msg("channel %s differs at pixel %zu", a->names[c], i);
    }
}

static void every_bit_comes_back(void **state)
{
    (void)state;
    static const char *const rgb[3] = {"R", "G", "B"};
    static const uint32_t sizes[][2] = {{1, 1},   {3, 5},   {1, 100},   {100, 1},   {17, 16},
                                        {16, 17}, {33, 63}, {513, 257}, {65536, 1}, {1, 65536}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        rt_image *image = create(sizes[i][0], sizes[i][1], rgb, 3);
        fill_with_bits(image, 42);
        rt_bytes bytes = encode(image);
        rt_image *copy = decode(&bytes);
        expect_same(image, copy);
        rt_image_destroy(copy);
        rt_bytes_free(&bytes);
        rt_image_destroy(image);
    }
}

/* Noise with ever more zeros is just about compressed: at times to as many bytes as it has. */
static void what_hardly_compresses_comes_back(void **state)
{
    static const char *const rgb[3] = {"R", "G", "B"};
    (void)state;
    for (uint64_t trial = 0; trial < 2000; trial++) {
        const size_t zeros = 50 + trial % 100;
        rt_image *image = create(48, 16, rgb, 3);
        fill_with_bits(image, trial);
        memset(image->data, 0, zeros);
        rt_bytes bytes = encode(image);
        rt_image *copy = decode(&bytes);
        expect_same(image, copy);
        rt_image_destroy(copy);
        rt_bytes_free(&bytes);
        rt_image_destroy(image);
    }
}

static void special_values_come_back(void **state)
{
    (void)state;
    static const char *const y[1] = {"Y"};
    static const uint32_t patterns[] = {0x00000000, 0x80000000, 0x00000001, 0x807fffff,
                                        0x00800000, 0x7f7fffff, 0x7f800000, 0xff800000,
                                        0x7fc00000, 0x7f800001, 0xffffffff};
    rt_image *image = create(sizeof patterns / sizeof patterns[0], 1, y, 1);
    memcpy(image->data, patterns, sizeof patterns);
    rt_bytes bytes = encode(image);
    rt_image *copy = decode(&bytes);
    assert_memory_equal(copy->data, patterns, sizeof patterns);
    rt_image_destroy(copy);
    rt_bytes_free(&bytes);
    rt_image_destroy(image);
}

static void channels_are_bound_by_name(void **state)
{
    (void)state;
    static const char *const names[] = {
        "depth.Z",  "R",          "normal.X",
        "G",        "albedo.B",   "B",
        "albedo.R", "variance.R", "a.name.that.is.longer.than.the.thirty-one.bytes.of.a.short.one"};
    uint32_t count = sizeof names / sizeof names[0];
    rt_image *image = create(19, 35, names, count);
    for (size_t i = 0; i < (size_t)19 * 35 * count; i++)
        image->data[i] = (float)(i % count) + 0.001f * (float)(i / count);
    rt_bytes bytes = encode(image);
    rt_image *copy = decode(&bytes);
    expect_same(image, copy);
    rt_image_destroy(copy);
    rt_bytes_free(&bytes);
    rt_image_destroy(image);
}

static void attributes_come_back_in_order(void **state)
{
    (void)state;
    static const char *const rgb[3] = {"R", "G", "B"};
    char *command = malloc(20001);
    assert_non_null(command);
    memset(command, 'c', 20000);
    command[20000] = '\0';
    rt_image *image = create(2, 2, rgb, 3);
    assert_int_equal(rt_image_set_attribute(image, "scene", "K\xc3\xb6rper.rts", NULL), RT_OK);
    assert_int_equal(rt_image_set_attribute(image, "command", command, NULL), RT_OK);
    assert_int_equal(rt_image_set_attribute(image, "empty", "", NULL), RT_OK);
    assert_int_equal(rt_image_set_attribute(image, "a", "first by name, last by order", NULL),
                     RT_OK);
    rt_bytes bytes = encode(image);
    rt_image *copy = decode(&bytes);
    assert_int_equal(copy->attribute_count, image->attribute_count);
    for (size_t i = 0; i < image->attribute_count; i++) {
        assert_string_equal(copy->attributes[i].name, image->attributes[i].name);
        assert_string_equal(copy->attributes[i].value, image->attributes[i].value);
    }
    rt_image_destroy(copy);
    rt_bytes_free(&bytes);
    rt_image_destroy(image);
    free(command);
}

static void the_same_image_gives_the_same_bytes(void **state)
{
    (void)state;
    static const char *const rgb[3] = {"R", "G", "B"};
    rt_image *image = create(45, 67, rgb, 3);
    fill_with_bits(image, 42);
    assert_int_equal(rt_image_set_attribute(image, "scene", "box", NULL), RT_OK);
    rt_bytes once = encode(image), twice = encode(image);
    assert_int_equal(once.size, twice.size);
    assert_memory_equal(once.data, twice.data, once.size);
    rt_bytes_free(&twice);
    rt_bytes_free(&once);
    rt_image_destroy(image);
}

static void expect_sample(exr_sample sample)
{
    rt_bytes bytes = exr_sample_file(&sample);
    rt_image *image = decode(&bytes);
    assert_int_equal(image->width, sample.width);
    assert_int_equal(image->height, sample.height);
    const int count = sample.channels ? sample.channels : 3;
    assert_int_equal(image->channel_count, count);
    for (int c = 0; c < count; c++) {
        const uint32_t index = rt_image_channel(image, exr_sample_names[c]);
        assert_int_not_equal(index, RT_IMAGE_NO_CHANNEL);
        for (int y = 0; y < sample.height; y++)
            for (int x = 0; x < sample.width; x++)
                if (image->data[count * (y * sample.width + x) + (int)index] !=
                    exr_sample_value(x, y, c))
                    fail_msg("type %d compression %d storage %d: channel %d of %d differs at "
                             "(%d, %d)",
                             sample.type, sample.compression, sample.storage, c, count, x, y);
    }
    rt_image_destroy(image);
    rt_bytes_free(&bytes);
}

static void every_lossless_kind_is_read(void **state)
{
    (void)state;
    static const exr_compression_t compressions[] = {EXR_COMPRESSION_NONE, EXR_COMPRESSION_RLE,
                                                     EXR_COMPRESSION_ZIPS, EXR_COMPRESSION_ZIP,
                                                     EXR_COMPRESSION_PIZ};
    for (size_t i = 0; i < sizeof compressions / sizeof compressions[0]; i++)
        for (int type = EXR_PIXEL_UINT; type <= EXR_PIXEL_FLOAT; type++) {
            exr_sample sample = {
                EXR_STORAGE_SCANLINE, EXR_PIXEL_FLOAT, compressions[i], -7, 11, 41, 39, 16, 0, 1};
            sample.type = (exr_pixel_type_t)type;
            for (; sample.channels < EXR_SAMPLE_CHANNELS; sample.channels++) {
                sample.storage = EXR_STORAGE_SCANLINE;
                expect_sample(sample);
                sample.storage = EXR_STORAGE_TILED;
                expect_sample(sample);
            }
        }
}

/* What B44 would not make smaller is stored as it is. */
static void what_b44_makes_longer_is_read(void **state)
{
    static const int sizes[][2] = {{1, 64}, {64, 1}, {5, 5}, {2, 5}, {1, 1}};
    (void)state;
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        for (int is_tiled = 0; is_tiled < 2; is_tiled++) {
            const exr_sample sample = {is_tiled ? EXR_STORAGE_TILED : EXR_STORAGE_SCANLINE,
                                       EXR_PIXEL_HALF,
                                       EXR_COMPRESSION_B44,
                                       0,
                                       0,
                                       sizes[i][0],
                                       sizes[i][1],
                                       16,
                                       0,
                                       4};
            rt_bytes bytes = exr_sample_file(&sample);
            rt_image *image = decode(&bytes);
            for (int p = 0; p < 4 * sample.width * sample.height; p++) {
                const int x = p / 4 % sample.width, y = p / 4 / sample.width;
                const char *name = image->names[p % 4];
                int c = 0;
                while (strcmp(exr_sample_names[c], name) != 0)
                    c++;
                if (image->data[p] != exr_sample_value(x, y, c))
                    fail_msg("tiles %d, %dx%d: channel %s is %g at (%d, %d)", is_tiled,
                             sample.width, sample.height, name, (double)image->data[p], x, y);
            }
            rt_image_destroy(image);
            rt_bytes_free(&bytes);
        }
}

static void expect_refused(exr_sample sample, const char *reason)
{
    rt_bytes bytes = exr_sample_file(&sample);
    rt_image *image = NULL;
    rt_error error = {0};
    assert_int_equal(rt_exr_decode(&image, &bytes, "sample.exr", &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "sample.exr"));
    assert_non_null(strstr(error.message, reason));
    assert_null(image);
    rt_bytes_free(&bytes);
}

static void deep_and_subsampled_files_are_refused(void **state)
{
    (void)state;
    exr_sample sample = {
        EXR_STORAGE_SCANLINE, EXR_PIXEL_HALF, EXR_COMPRESSION_ZIPS, 0, 0, 8, 8, 0, 2, 0};
    expect_refused(sample, "subsampled");
    sample.sampling = 0;
    sample.storage = EXR_STORAGE_DEEP_SCANLINE;
    expect_refused(sample, "deep");
}

static void damaged_files_never_crash(void **state)
{
    (void)state;
    static const char *const rgb[3] = {"R", "G", "B"};
    rt_image *image = create(9, 18, rgb, 3);
    for (size_t i = 0; i < 9 * 18 * 3; i++)
        image->data[i] = (float)(i % 7);
    assert_int_equal(rt_image_set_attribute(image, "scene", "box", NULL), RT_OK);
    rt_bytes bytes = encode(image);
    damage_truncate(&bytes, rt_exr_decode);
    damage_flip(&bytes, rt_exr_decode);
    rt_bytes_free(&bytes);
    rt_image_destroy(image);
}

static void damaged_tiles_never_crash(void **state)
{
    (void)state;
    exr_sample sample = {
        EXR_STORAGE_TILED, EXR_PIXEL_HALF, EXR_COMPRESSION_ZIP, 0, 0, 11, 6, 8, 0, 0};
    rt_bytes bytes = exr_sample_file(&sample);
    damage_truncate(&bytes, rt_exr_decode);
    damage_flip(&bytes, rt_exr_decode);
    rt_bytes_free(&bytes);
}

static void what_is_no_exr_is_refused(void **state)
{
    (void)state;
    static const char *const texts[] = {"", "P6 1 1 255 abc", "v/1\x01", "v/1\x01\x02",
                                        "\x76\x2f\x31\x01"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        rt_bytes bytes = {0};
        rt_image *image = NULL;
        rt_error error = {0};
        assert_int_equal(rt_bytes_put(&bytes, 0, texts[i], strlen(texts[i]), NULL), RT_OK);
        assert_int_equal(rt_exr_decode(&image, &bytes, "text", &error), RT_ERROR_INPUT);
        assert_true(error.message[0] != '\0');
        rt_bytes_free(&bytes);
    }
}

/* Where the value of a box attribute of the header begins. */
static uint8_t *find_box(const rt_bytes *file, const char *name)
{
    size_t length = strlen(name) + 1;
    for (size_t at = 0; at + length + 10 < file->size; at++)
        if (memcmp(file->data + at, name, length) == 0)
            return file->data + at + length + sizeof "box2i" + 4;
    fail_msg("the file has no %s", name);
    return NULL;
}

/* 2^14 x 2^14 pixels of three channels, 3 GiB of floats, in a few hundred bytes. */
static void a_small_file_takes_little_memory(void **state)
{
    (void)state;
    exr_sample sample = {
        EXR_STORAGE_SCANLINE, EXR_PIXEL_HALF, EXR_COMPRESSION_ZIP, 0, 0, 4, 4, 0, 0, 0};
    rt_bytes bytes = exr_sample_file(&sample);
    rt_image *image = NULL;
    rt_error error = {0};
    uint8_t *window = find_box(&bytes, "dataWindow");
    window[8] = window[12] = 0xff;
    window[9] = window[13] = 0x3f;
    assert_int_equal(rt_exr_decode(&image, &bytes, "bomb", &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "too large for its length"));
    rt_bytes_free(&bytes);
}

/* Sets the display window of a file. */
static void show(const rt_bytes *bytes, const int box[4])
{
    uint8_t *at = find_box(bytes, "displayWindow");
    for (int i = 0; i < 16; i++)
        at[i] = (uint8_t)((uint32_t)box[i / 4] >> 8 * (i % 4) & 0xff);
}

/* Display windows around, within and across a data window from (-3, 5) to (6, 11). */
static void the_picture_is_the_display_window(void **state)
{
    static const int boxes[][4] = {
        {-3, 5, 6, 11}, {-5, 0, 20, 14}, {0, 6, 2, 8}, {4, -2, 9, 5}, {-9, 11, -3, 12}};
    (void)state;
    for (size_t i = 0; i < sizeof boxes / sizeof *boxes; i++) {
        const int *box = boxes[i], width = box[2] - box[0] + 1, height = box[3] - box[1] + 1;
        exr_sample sample = {
            EXR_STORAGE_SCANLINE, EXR_PIXEL_HALF, EXR_COMPRESSION_ZIP, -3, 5, 10, 7, 0, 0, 0};
        rt_bytes bytes = exr_sample_file(&sample);
        show(&bytes, box);
        rt_image *image = decode(&bytes);
        assert_int_equal(image->width, width);
        assert_int_equal(image->height, height);
        uint32_t rgb[3];
        assert_int_equal(rt_image_rgb_channels(rgb, image, NULL), RT_OK);
        for (int y = 0; y < height; y++)
            for (int x = 0; x < width; x++) {
                const int u = x + box[0] + 3, v = y + box[1] - 5;
                const int is_there = u >= 0 && u < 10 && v >= 0 && v < 7;
                for (int c = 0; c < 3; c++)
                    assert_true(image->data[3 * (y * width + x) + (int)rgb[c]] ==
                                (is_there ? exr_sample_value(u, v, c) : 0));
            }
        rt_image_destroy(image);
        rt_bytes_free(&bytes);
    }
}

static void expect_window_refused(const int box[4], const char *reason)
{
    exr_sample sample = {
        EXR_STORAGE_SCANLINE, EXR_PIXEL_HALF, EXR_COMPRESSION_ZIP, 0, 0, 4, 4, 0, 0, 0};
    rt_bytes bytes = exr_sample_file(&sample);
    rt_image *image = NULL;
    rt_error error = {0};
    show(&bytes, box);
    assert_int_equal(rt_exr_decode(&image, &bytes, "shown", &error), RT_ERROR_INPUT);
    if (!strstr(error.message, reason))
        fail_msg("'%s' does not tell '%s'", error.message, reason);
    rt_bytes_free(&bytes);
}

static void impossible_display_windows_are_refused(void **state)
{
    (void)state;
    expect_window_refused((const int[]){0, 0, 16383, 16383}, "too large for its length");
    expect_window_refused((const int[]){0, 0, 65536, 3}, "the display window is empty or");
}

/* Rather than a black picture, or none. */
static void pixels_outside_of_the_display_window_are_the_picture(void **state)
{
    static const int boxes[][4] = {{4, 0, 7, 3}, {0, -9, 3, -1}, {-9, 0, -1, 3}, {0, 4, 3, 5}};
    (void)state;
    for (size_t i = 0; i < sizeof boxes / sizeof *boxes; i++) {
        exr_sample sample = {
            EXR_STORAGE_SCANLINE, EXR_PIXEL_HALF, EXR_COMPRESSION_ZIP, 0, 0, 4, 4, 0, 0, 0};
        rt_bytes bytes = exr_sample_file(&sample);
        rt_image *plain = NULL, *image = NULL;
        assert_int_equal(rt_exr_decode(&plain, &bytes, "plain", NULL), RT_OK);
        show(&bytes, boxes[i]);
        assert_int_equal(rt_exr_decode(&image, &bytes, "shown", NULL), RT_OK);
        assert_int_equal(image->width, 4);
        assert_int_equal(image->height, 4);
        assert_memory_equal(image->data, plain->data,
                            (size_t)16 * plain->channel_count * sizeof(float));
        rt_image_destroy(image);
        rt_image_destroy(plain);
        rt_bytes_free(&bytes);
    }
}

static void parts_are_layers_by_their_names(void **state)
{
    static const char *const names[] = {"beauty", "right", "left"};
    (void)state;
    exr_sample sample = {
        EXR_STORAGE_SCANLINE, EXR_PIXEL_FLOAT, EXR_COMPRESSION_ZIP, 2, 3, 9, 8, 0, 0, 0};
    rt_bytes bytes = exr_sample_parts(&sample, names, 3);
    rt_image *image = decode(&bytes);
    assert_int_equal(image->channel_count, 9);
    float rgb[9 * 8 * 3];
    for (int part = 0; part < 3; part++) {
        assert_int_equal(rt_image_get_rgb(rgb, image, part ? names[part] : NULL, NULL), RT_OK);
        for (int i = 0; i < 9 * 8 * 3; i++)
            assert_true(rgb[i] == (float)(part + 1) * exr_sample_value(i / 3 % 9, i / 27, i % 3));
    }
    rt_image_destroy(image);
    rt_bytes_free(&bytes);
}

/* Also where depth stands before it. */
static void the_part_with_colours_is_the_picture(void **state)
{
    static const char *const names[] = {"depth", "beauty"};
    const exr_sample sample = {
        EXR_STORAGE_SCANLINE, EXR_PIXEL_HALF, EXR_COMPRESSION_ZIP, 2, 3, 9, 8, 0, 0, 4};
    rt_bytes bytes = exr_sample_parts(&sample, names, 2);
    rt_image *image = decode(&bytes);
    float rgb[9 * 8 * 3];
    (void)state;
    assert_int_equal(rt_image_get_rgb(rgb, image, NULL, NULL), RT_OK);
    for (int i = 0; i < 9 * 8 * 3; i++)
        assert_true(rgb[i] == 2 * exr_sample_value(i / 3 % 9, i / 27, i % 3));
    const uint32_t z = rt_image_channel(image, "depth.Z");
    assert_int_equal(image->channel_count, 5);
    assert_int_not_equal(z, RT_IMAGE_NO_CHANNEL);
    for (uint32_t i = 0; i < 9 * 8; i++)
        assert_true(image->data[5 * i + z] == exr_sample_value((int)i % 9, (int)i / 9, 4));
    rt_image_destroy(image);
    rt_bytes_free(&bytes);
}

enum { PARTS = 100 };

/* So many parts; those behind the first have headers of 127 * 2^8 x 64 pixels, not all there. */
static rt_bytes file_of_parts(int count, int wide)
{
    static char text[PARTS][16];
    const char *names[PARTS];
    const exr_sample sample = {
        EXR_STORAGE_SCANLINE, EXR_PIXEL_FLOAT, EXR_COMPRESSION_ZIP, 0, 0, 64, 64, 0, 0, 0};
    for (int i = 0; i < count; i++) {
        snprintf(text[i], sizeof text[i], "p%d", i);
        names[i] = text[i];
    }
    rt_bytes bytes = exr_sample_parts(&sample, names, count), rest = bytes;
    for (int i = 0; i <= wide; i++) {
        uint8_t *window = find_box(&rest, "dataWindow");
        if (i > 0) {
            window[8] = 0xff;
            window[9] = 126;
        }
        rest.size -= (size_t)(window - rest.data);
        rest.data = window;
    }
    return bytes;
}

static void expect_channels(rt_bytes bytes, uint32_t count)
{
    rt_image *image = decode(&bytes);
    assert_int_equal(image->channel_count, count);
    rt_image_destroy(image);
    rt_bytes_free(&bytes);
}

/*
 * The first part and 43 wide ones have 2^28 values, the most of a short file, but for 4096: the
 * last part, which is good, is too much.
 */
static void parts_are_limited_together(void **state)
{
    (void)state;
    expect_channels(file_of_parts(PARTS, 0), 3 * 85); /* of 256 */
    expect_channels(file_of_parts(45, 42), 3 * 3);
    expect_channels(file_of_parts(45, 43), 3);
}

/*
 * OpenEXRCore 3.1 decodes no DWAA, which has as many lines in a chunk as PIZ, takes B44 of float
 * channels for something else, and none knows 77.
 */
static void codecs_that_are_not_read_say_how_to_convert(void **state)
{
    static const char key[] = "compression\0compression";
    static const struct {
        uint8_t code;
        const char *says;
    } codecs[] = {{EXR_COMPRESSION_DWAA, "DWAA"},
                  {EXR_COMPRESSION_B44, "B44, is not read for channels that are no half floats"},
                  {77, "a newer one"}};
    (void)state;
    for (size_t i = 0; i < sizeof codecs / sizeof *codecs; i++) {
        exr_sample sample = {
            EXR_STORAGE_SCANLINE, EXR_PIXEL_FLOAT, EXR_COMPRESSION_PIZ, 0, 0, 64, 64, 0, 0, 0};
        rt_bytes bytes = exr_sample_file(&sample);
        rt_image *image = NULL;
        rt_error error = {0};
        size_t at = 0;
        while (memcmp(bytes.data + at, key, sizeof key) != 0)
            at++;
        bytes.data[at + sizeof key + 4] = codecs[i].code;
        if (rt_exr_decode(&image, &bytes, "coded", &error) != RT_OK) {
            if (!strstr(error.message, codecs[i].says))
                fail_msg("'%s' does not tell '%s'", error.message, codecs[i].says);
            assert_non_null(strstr(error.message, "oiiotool FILE --compression zip -o NEW.exr"));
        } else {
            assert_int_equal(codecs[i].code, EXR_COMPRESSION_DWAA); /* by a later OpenEXRCore */
        }
        rt_image_destroy(image);
        rt_bytes_free(&bytes);
    }
}

static void coding_touches_no_file(void **state)
{
    (void)state;
    static const char *const rgb[3] = {"R", "G", "B"};
    rt_image *image = create(4, 4, rgb, 3);
    scratch_write("(memory)", "a user's file");
    rt_bytes bytes = encode(image);
    bytes.size /= 2;
    rt_image *copy = NULL;
    assert_int_equal(rt_exr_decode(&copy, &bytes, "half", NULL), RT_ERROR_INPUT);
    scratch_expect("(memory)", "a user's file");
    assert_int_equal(scratch_count(), 1);
    rt_bytes_free(&bytes);
    rt_image_destroy(image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_bit_comes_back),
        cmocka_unit_test(what_hardly_compresses_comes_back),
        cmocka_unit_test(special_values_come_back),
        cmocka_unit_test(channels_are_bound_by_name),
        cmocka_unit_test(attributes_come_back_in_order),
        cmocka_unit_test(the_same_image_gives_the_same_bytes),
        cmocka_unit_test(every_lossless_kind_is_read),
        cmocka_unit_test(what_b44_makes_longer_is_read),
        cmocka_unit_test(the_part_with_colours_is_the_picture),
        cmocka_unit_test(deep_and_subsampled_files_are_refused),
        cmocka_unit_test(damaged_files_never_crash),
        cmocka_unit_test(damaged_tiles_never_crash),
        cmocka_unit_test(what_is_no_exr_is_refused),
        cmocka_unit_test(a_small_file_takes_little_memory),
        cmocka_unit_test(the_picture_is_the_display_window),
        cmocka_unit_test(impossible_display_windows_are_refused),
        cmocka_unit_test(pixels_outside_of_the_display_window_are_the_picture),
        cmocka_unit_test(parts_are_layers_by_their_names),
        cmocka_unit_test(parts_are_limited_together),
        cmocka_unit_test(codecs_that_are_not_read_say_how_to_convert),
        cmocka_unit_test_setup_teardown(coding_touches_no_file, scratch_enter, scratch_leave),
    };
    return cmocka_run_group_tests_name("image/exr", tests, NULL, NULL);
}
