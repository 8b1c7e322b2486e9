/*
 * png_read.c - decodes PNG through libpng.
 *
 * Reference: "Portable Network Graphics (PNG) Specification (Second Edition)", W3C, 2003.
 */
#include <png.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

#include "image/decode.h"
#include "image/png.h"

#define CHUNK_MEMORY_MAX 65536 /* bytes that libpng may allocate for one chunk */
/* maximum expansion: a match of 258 bytes takes at least two bits */
#define DEFLATE_RATIO_MAX 1032

/* A file being decoded. What must be freed is here, for libpng leaves by longjmp when it fails. */
typedef struct reader {
    const rt_bytes *file;
    const char *name;
    size_t at;
    rt_error error;
    rt_image *image;
    uint8_t *rows; /* all rows of an interlaced file, which come in several passes; else one */
} reader;

/* Notes the first error and leaves libpng. */
static void on_error(png_structp png, png_const_charp message)
{
    reader *r = png_get_error_ptr(png);
    if (r->error.status == RT_OK)
        rt_fail(&r->error, RT_ERROR_INPUT, "cannot read %.350s: %s", r->name, message);
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

static void on_read(png_structp png, png_bytep data, size_t count)
{
    reader *r = png_get_io_ptr(png);
    if (count > r->file->size - r->at)
        png_error(png, "it is cut short");
    memcpy(data, r->file->data + r->at, count);
    r->at += count;
}

/* Leaves libpng by an error that is already in r. */
static void leave(png_structp png, const reader *r)
{
    png_error(png, r->error.message);
}

/* Whether it has a channel of alpha, or a chunk that says what is transparent. */
static int has_alpha(png_structp png, png_infop info)
{
    return (png_get_color_type(png, info) & PNG_COLOR_MASK_ALPHA) != 0 ||
           png_get_valid(png, info, PNG_INFO_tRNS) != 0;
}

/* Checks what the header promises before anything is allocated for it, and makes the image. */
static void create_image(png_structp png, png_infop info, reader *r)
{
    static const char *const rgba[4] = {"R", "G", "B", "A"}, *const ya[2] = {"Y", "A"};
    uint32_t width = png_get_image_width(png, info), height = png_get_image_height(png, info);
    int is_colour = (png_get_color_type(png, info) & PNG_COLOR_MASK_COLOR) != 0;
    uint32_t channels = (is_colour ? 3u : 1u) + (has_alpha(png, info) ? 1u : 0u);
    uint64_t values = (uint64_t)width * height * channels;
    uint64_t bits =
        (uint64_t)width * height * png_get_channels(png, info) * png_get_bit_depth(png, info);
    if (values > RT_IMAGE_VALUES_MAX)
        png_error(png, "it holds more than 2^30 values");
    if (bits / 8 / DEFLATE_RATIO_MAX > r->file->size)
        png_error(png, "it is too short for the size that it states");
    if (rt_image_is_bomb(values, r->file->size))
        png_error(png, "it is too large for its length: more than 64 values a byte");
    if (rt_image_create_in(&r->image, r->file->memory, width, height, is_colour ? rgba : ya,
                           channels, &r->error) != RT_OK)
        leave(png, r);
}

/*
 * Has libpng hand over whole bytes, with alpha where a colour is transparent; a palette stays as
 * indices, which are checked here.
 */
static int choose_transformations(png_structp png, png_infop info)
{
    if (png_get_color_type(png, info) == PNG_COLOR_TYPE_PALETTE)
        png_set_packing(png);
    else if (png_get_valid(png, info, PNG_INFO_tRNS))
        png_set_tRNS_to_alpha(png);
    if (png_get_color_type(png, info) == PNG_COLOR_TYPE_GRAY && png_get_bit_depth(png, info) < 8)
        png_set_expand_gray_1_2_4_to_8(png);
    int passes = png_set_interlace_handling(png);
    png_read_update_info(png, info);
    return passes;
}

static void convert_palette(png_structp png, png_infop info, reader *r, const uint8_t *row,
                            float *out)
{
    png_colorp palette = NULL;
    png_bytep alpha = NULL;
    int count = 0, alpha_count = 0;
    const uint32_t channels = r->image->channel_count;
    png_get_PLTE(png, info, &palette, &count);
    png_get_tRNS(png, info, &alpha, &alpha_count, NULL);
    for (uint32_t x = 0; x < r->image->width; x++, out += channels) {
        if (row[x] >= count)
            png_error(png, "a pixel's colour is not in its palette");
        out[0] = (float)palette[row[x]].red / 255.0f;
        out[1] = (float)palette[row[x]].green / 255.0f;
        out[2] = (float)palette[row[x]].blue / 255.0f;
        if (channels == 4)
            out[3] = row[x] < alpha_count ? (float)alpha[row[x]] / 255.0f : 1.0f;
    }
}

static void convert_row(png_structp png, png_infop info, reader *r, const uint8_t *row, uint32_t y)
{
    size_t count = (size_t)r->image->width * r->image->channel_count;
    float *out = r->image->data + y * count;
    if (png_get_color_type(png, info) == PNG_COLOR_TYPE_PALETTE)
        convert_palette(png, info, r, row, out);
    else if (png_get_bit_depth(png, info) == 16)
        for (size_t i = 0; i < count; i++)
            out[i] = (float)(row[2 * i] << 8 | row[2 * i + 1]) / 65535.0f;
    else
        for (size_t i = 0; i < count; i++)
            out[i] = (float)row[i] / 255.0f;
}

/* Each pass adds pixels to every row, so a row is converted in the last. */
static void read_rows(png_structp png, png_infop info, reader *r, int passes)
{
    uint32_t height = r->image->height;
    size_t row_size = png_get_rowbytes(png, info);
    r->rows = rt_memory_zeroed(r->file->memory, passes > 1 ? height : 1, row_size,
                               "the rows of an image", &r->error);
    if (!r->rows)
        leave(png, r);
    for (int pass = 1; pass <= passes; pass++)
        for (uint32_t y = 0; y < height; y++) {
            uint8_t *row = r->rows + (passes > 1 ? y * row_size : 0);
            png_read_row(png, row, NULL);
            if (pass == passes)
                convert_row(png, info, r, row, y);
        }
}

/*
 * Runs libpng. No local variable changes after setjmp, so nothing is lost when it leaves by
 * longjmp.
 */
static int decode(png_structp png, png_infop info, reader *r)
{
    if (setjmp(png_jmpbuf(png)))
        return 0;
    png_set_read_fn(png, r, on_read);
    png_set_user_limits(png, RT_IMAGE_SIDE_MAX, RT_IMAGE_SIDE_MAX);
    png_set_chunk_malloc_max(png, CHUNK_MEMORY_MAX);
    /* Chunks that pixels do not need, such as texts and profiles, are skipped unread. */
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, NULL, -1);
    png_read_info(png, info);
    create_image(png, info, r);
    read_rows(png, info, r, choose_transformations(png, info));
    png_read_end(png, NULL);
    return 1;
}

/*
 * Decodes a PNG of any colour type and depth, interlaced or not, to the channels R, G, B, or Y of a
 * grey one, and A where something may be transparent. Values are codes divided by the greatest one,
 * and are marked as sRGB. Colours are not multiplied by alpha; chunks that describe another gamma
 * or profile are not followed. Fails with RT_ERROR_INPUT when the file is damaged, cut short or too
 * large, or holds more than 2^28 values in less than a byte for each 64; `name` stands for it in
 * messages. The caller destroys *out.
 */
rt_status rt_png_decode(rt_image **out, const rt_bytes *file, const char *name, rt_error *error)
{
    reader r;
    memset(&r, 0, sizeof r);
    r.file = file;
    r.name = name;
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &r, on_error, on_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    rt_status status = RT_OK;
    if (!info)
        status = rt_fail(error, RT_ERROR_MEMORY, "out of memory: a PNG decoder");
    else if (!decode(png, info, &r))
        status = rt_fail(error, r.error.status, "%s", r.error.message);
    png_destroy_read_struct(&png, &info, NULL);
    rt_memory_free(r.rows);
    if (status == RT_OK) {
        r.image->is_srgb = 1;
        *out = r.image;
    } else {
        rt_image_destroy(r.image);
    }
    return status;
}
