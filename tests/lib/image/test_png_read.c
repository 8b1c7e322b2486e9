/* PNG: every colour type, depth and interlacing that libpng writes, and every class of fault. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <png.h>

#include "damage.h"
#include "image/decode.h"
#include "image/png.h"

/* What a file is made of. */
typedef struct form {
    int colour_type, depth, interlace;
    uint32_t width, height;
    int palette_size;    /* of PNG_COLOR_TYPE_PALETTE */
    int has_transparent; /* a tRNS chunk */
} form;

enum { ihdr_at = 8, ihdr_data = 16 };

static int samples_of(const form *f)
{
    static const int samples[] = {1, 0, 3, 1, 2, 0, 4};
    return samples[f->colour_type];
}

/* The code of a sample, of a pattern that has every code and no period of a small power of two. */
static unsigned code_at(const form *f, uint32_t x, uint32_t y, int sample)
{
    unsigned code = (x * 2654435761u + y * 40503u * 65537u + (unsigned)sample * 977u * 65539u) >>
                    (32 - f->depth);
    return f->colour_type == PNG_COLOR_TYPE_PALETTE ? code % (unsigned)f->palette_size : code;
}

static png_color palette_at(unsigned i)
{
    const png_color colour = {(png_byte)(7 * i + 1), (png_byte)(255 - i), (png_byte)(i * i)};
    return colour;
}

static void on_write(png_structp png, png_bytep data, size_t count)
{
    rt_bytes *bytes = png_get_io_ptr(png);
    assert_int_equal(rt_bytes_put(bytes, bytes->size, data, count, NULL), RT_OK);
}

static void on_flush(png_structp png)
{
    (void)png;
}

static void put_code(uint8_t *row, size_t sample, int depth, unsigned code)
{
    if (depth == 16) {
        row[2 * sample] = (uint8_t)(code >> 8);
        row[2 * sample + 1] = (uint8_t)code;
    } else {
        size_t bit = sample * (size_t)depth;
        row[bit / 8] |= (uint8_t)(code << (8 - depth - (int)(bit % 8)));
    }
}

static void write_chunks(png_structp png, png_infop info, const form *f)
{
    png_color palette[256];
    png_byte alpha[2] = {0, 128};
    png_color_16 transparent = {0, 1, 1, 1, 1};
    png_text comment = {PNG_TEXT_COMPRESSION_zTXt,
                        "Comment",
                        "compressed, compressed, compressed",
                        34,
                        0,
                        NULL,
                        NULL};
    png_set_IHDR(png, info, f->width, f->height, f->depth, f->colour_type, f->interlace,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    for (unsigned i = 0; i < 256; i++)
        palette[i] = palette_at(i);
    if (f->colour_type == PNG_COLOR_TYPE_PALETTE)
        png_set_PLTE(png, info, palette, f->palette_size);
    if (f->has_transparent && f->colour_type == PNG_COLOR_TYPE_PALETTE)
        png_set_tRNS(png, info, alpha, 2, NULL);
    else if (f->has_transparent)
        png_set_tRNS(png, info, NULL, 0, &transparent);
    png_set_gAMA(png, info, 1.0);
    png_set_text(png, info, &comment, 1);
    png_write_info(png, info);
}

/* A file of the form; libpng aborts the program when it fails. */
static rt_bytes make_file(const form *f)
{
    rt_bytes bytes = {0};
    size_t row_size = ((size_t)f->width * (size_t)(samples_of(f) * f->depth) + 7) / 8;
    uint8_t *row = malloc(row_size);
    assert_non_null(row);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(png, &bytes, on_write, on_flush);
    write_chunks(png, info, f);
    for (int pass = png_set_interlace_handling(png); pass > 0; pass--)
        for (uint32_t y = 0; y < f->height; y++) {
            memset(row, 0, row_size);
            for (uint32_t x = 0; x < f->width; x++)
                for (int s = 0; s < samples_of(f); s++)
                    put_code(row, (size_t)x * (size_t)samples_of(f) + (size_t)s, f->depth,
                             code_at(f, x, y, s));
            png_write_row(png, row);
        }
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    free(row);
    return bytes;
}

/* Alpha of the two ways in which a file without samples of it has it: by index, or by colour. */
static float expected_transparency(const form *f, uint32_t x, uint32_t y)
{
    const unsigned code = code_at(f, x, y, 0);
    if (f->colour_type == PNG_COLOR_TYPE_PALETTE)
        return code == 0 ? 0.0f : code == 1 ? 128.0f / 255.0f : 1.0f;
    for (int s = 0; s < samples_of(f); s++)
        if (code_at(f, x, y, s) != 1)
            return 1.0f;
    return 0.0f;
}

static float expected_value(const form *f, uint32_t x, uint32_t y, uint32_t channel)
{
    if (f->has_transparent && channel == (f->colour_type & PNG_COLOR_MASK_COLOR ? 3 : 1))
        return expected_transparency(f, x, y);
    unsigned code = code_at(f, x, y, f->colour_type == PNG_COLOR_TYPE_PALETTE ? 0 : (int)channel);
    png_color colour = palette_at(code);
    const png_byte parts[3] = {colour.red, colour.green, colour.blue};
    if (f->colour_type == PNG_COLOR_TYPE_PALETTE)
        return (float)parts[channel] / 255.0f;
    return (float)code / (float)((1u << f->depth) - 1);
}

static void check_form(const form *f)
{
    rt_bytes file = make_file(f);
    rt_image *image = NULL;
    rt_error error = {0};
    if (rt_png_decode(&image, &file, "made", &error) != RT_OK)
        fail_msg("type %d, depth %d: %s", f->colour_type, f->depth, error.message);
    assert_int_equal(image->width, f->width);
    assert_int_equal(image->height, f->height);
    const int has_alpha = f->has_transparent || (f->colour_type & PNG_COLOR_MASK_ALPHA);
    const uint32_t colours = f->colour_type & PNG_COLOR_MASK_COLOR ? 3 : 1;
    assert_int_equal(image->channel_count, has_alpha ? colours + 1 : colours);
    assert_string_equal(image->names[0], colours == 3 ? "R" : "Y");
    if (has_alpha)
        assert_string_equal(image->names[colours], "A");
    assert_true(image->is_srgb);
    const float *value = image->data;
    for (uint32_t y = 0; y < f->height; y++)
        for (uint32_t x = 0; x < f->width; x++)
            for (uint32_t c = 0; c < image->channel_count; c++, value++)
                if (*value != expected_value(f, x, y, c))
                    fail_msg("type %d, depth %d, interlace %d, %ux%u: wrong at (%u, %u)",
                             f->colour_type, f->depth, f->interlace, f->width, f->height, x, y);
    rt_image_destroy(image);
    rt_bytes_free(&file);
}

static const int kinds[][2] = {
    {PNG_COLOR_TYPE_GRAY, 1},        {PNG_COLOR_TYPE_GRAY, 2},      {PNG_COLOR_TYPE_GRAY, 4},
    {PNG_COLOR_TYPE_GRAY, 8},        {PNG_COLOR_TYPE_GRAY, 16},     {PNG_COLOR_TYPE_RGB, 8},
    {PNG_COLOR_TYPE_RGB, 16},        {PNG_COLOR_TYPE_PALETTE, 1},   {PNG_COLOR_TYPE_PALETTE, 2},
    {PNG_COLOR_TYPE_PALETTE, 4},     {PNG_COLOR_TYPE_PALETTE, 8},   {PNG_COLOR_TYPE_GRAY_ALPHA, 8},
    {PNG_COLOR_TYPE_GRAY_ALPHA, 16}, {PNG_COLOR_TYPE_RGB_ALPHA, 8}, {PNG_COLOR_TYPE_RGB_ALPHA, 16}};

enum { kind_count = sizeof kinds / sizeof *kinds };

static form form_of(int kind, uint32_t width, uint32_t height)
{
    form f = {kinds[kind][0], kinds[kind][1], PNG_INTERLACE_NONE, width, height, 0, 0};
    f.palette_size = 1 << (f.depth < 8 ? f.depth : 8);
    return f;
}

static void every_colour_type_and_depth_is_read(void **state)
{
    static const uint32_t sizes[][2] = {{1, 1}, {3, 2}, {2, 9}, {37, 41}};
    (void)state;
    for (int kind = 0; kind < kind_count; kind++)
        for (int interlace = PNG_INTERLACE_NONE; interlace <= PNG_INTERLACE_ADAM7; interlace++)
            for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
                form f = form_of(kind, sizes[s][0], sizes[s][1]);
                f.interlace = interlace;
                check_form(&f);
            }
}

static void transparent_colours_have_an_alpha(void **state)
{
    (void)state;
    for (int kind = 0; kind < kind_count; kind++) {
        form f = form_of(kind, 19, 5);
        f.has_transparent = !(f.colour_type & PNG_COLOR_MASK_ALPHA);
        check_form(&f);
    }
}

/* The CRC of the PNG specification, annex D. */
static uint32_t crc(const uint8_t *data, size_t size)
{
    uint32_t c = 0xffffffffu;
    for (size_t i = 0; i < size; i++) {
        c ^= data[i];
        for (int k = 0; k < 8; k++)
            c = c & 1 ? 0xedb88320u ^ c >> 1 : c >> 1;
    }
    return c ^ 0xffffffffu;
}

static void put32(uint8_t *at, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        at[i] = (uint8_t)(value >> (24 - 8 * i));
}

static void set_size(rt_bytes *file, uint32_t width, uint32_t height)
{
    put32(file->data + ihdr_data, width);
    put32(file->data + ihdr_data + 4, height);
    put32(file->data + ihdr_data + 13, crc(file->data + ihdr_at + 4, 17));
}

static void check_refused(const rt_bytes *file, const char *cause)
{
    rt_image *image = NULL;
    rt_error error = {0};
    assert_int_equal(rt_png_decode(&image, file, "made", &error), RT_ERROR_INPUT);
    assert_null(image);
    if (!strstr(error.message, cause) || !strstr(error.message, "made"))
        fail_msg("'%s' does not tell '%s'", error.message, cause);
}

/* A file of this form whose header states another size. */
static void check_size_refused(const form *f, uint32_t width, uint32_t height, const char *cause)
{
    rt_bytes file = make_file(f);
    set_size(&file, width, height);
    check_refused(&file, cause);
    rt_bytes_free(&file);
}

/* Sizes that the data cannot fill are refused before memory is taken for them. */
static void promises_are_checked_before_they_are_believed(void **state)
{
    const form rgb = form_of(5, 4, 4), grey = form_of(3, 4, 4), bits = form_of(0, 64, 4);
    (void)state;
    check_size_refused(&rgb, 0, 4, "IHDR");
    check_size_refused(&rgb, 65537, 4, "IHDR");
    check_size_refused(&rgb, 4, 0x7fffffff, "IHDR");
    check_size_refused(&rgb, 65536, 65536, "2^30");
    check_size_refused(&grey, 65536, 65536, "2^30");
    check_size_refused(&grey, 32768, 32768, "too short");
    check_size_refused(&bits, 32768, 32768, "too short");
    check_size_refused(&bits, 16384, 4096, "too short");
    check_size_refused(&rgb, 4, 5, "");
    check_size_refused(&grey, 64, 64, "");
}

/* Pixels that are all there, but more than 1 GiB of them out of 130 KB. */
static void a_bomb_is_refused(void **state)
{
    (void)state;
    form f = form_of(0, 32768, 8);
    rt_bytes file = make_file(&f), grown = {0};
    assert_int_equal(rt_bytes_put(&grown, 0, file.data, file.size, NULL), RT_OK);
    assert_int_equal(rt_bytes_put(&grown, 140000, "", 1, NULL), RT_OK);
    set_size(&grown, 32768, 32768);
    check_refused(&grown, "64 values a byte");
    rt_bytes_free(&grown);
    rt_bytes_free(&file);
}

static void an_index_outside_the_palette_is_refused(void **state)
{
    form f = form_of(10, 16, 16);
    (void)state;
    rt_bytes file = make_file(&f);
    /* Shorten the palette: the chunk states 100 colours, and what is behind them is cut out. */
    size_t at = 0;
    while (memcmp(file.data + at, "PLTE", 4) != 0)
        at++;
    memmove(file.data + at + 4 + 300, file.data + at + 4 + 768, file.size - at - 4 - 768);
    file.size -= 468;
    put32(file.data + at - 4, 300);
    put32(file.data + at + 304, crc(file.data + at, 304));
    check_refused(&file, "palette");
    rt_bytes_free(&file);
}

static void other_files_and_other_chunks_are_refused(void **state)
{
    form f = form_of(5, 4, 4);
    rt_bytes file = make_file(&f), empty = {0},
             text = {(uint8_t *)"not a picture at all", 20, 20, NULL};
    (void)state;
    check_refused(&empty, "cut short");
    check_refused(&text, "PNG");
    file.data[ihdr_data + 13] ^= 1;
    check_refused(&file, "CRC");
    file.data[ihdr_data + 13] ^= 1;
    /* A chunk that states more bytes than the file has. */
    size_t at = 0;
    while (memcmp(file.data + at, "zTXt", 4) != 0)
        at++;
    put32(file.data + at - 4, 0x7fffffff);
    check_refused(&file, "cut short");
    rt_bytes_free(&file);
}

static void damage_never_crashes(void **state)
{
    (void)state;
    for (int kind = 0; kind < kind_count; kind++) {
        form f = form_of(kind, 5, 3);
        f.palette_size = f.palette_size > 16 ? 16 : f.palette_size;
        f.interlace = kind % 2 ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE;
        rt_bytes file = make_file(&f);
        damage_truncate(&file, rt_png_decode);
        damage_flip(&file, rt_png_decode);
        rt_bytes_free(&file);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_colour_type_and_depth_is_read),
        cmocka_unit_test(transparent_colours_have_an_alpha),
        cmocka_unit_test(promises_are_checked_before_they_are_believed),
        cmocka_unit_test(a_bomb_is_refused),
        cmocka_unit_test(an_index_outside_the_palette_is_refused),
        cmocka_unit_test(other_files_and_other_chunks_are_refused),
        cmocka_unit_test(damage_never_crashes),
    };
    return cmocka_run_group_tests_name("image/png_read", tests, NULL, NULL);
}
