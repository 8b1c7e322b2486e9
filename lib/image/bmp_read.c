/*
 * bmp_read.c - decodes BMP.
 *
 * Reference: "Bitmap Storage" and "BITMAPV5HEADER", Windows GDI, Microsoft; of OS/2 its header of
 *   12 bytes.
 */
#include <string.h>

#include "image/decode.h"

enum { file_header = 14, core_header = 12, info_header = 40, largest_header = 124 };
enum { plain = 0, rle8 = 1, rle4 = 2, by_masks = 3, by_alpha_masks = 6 };

/* The bits of a channel in a pixel. */
typedef struct mask {
    unsigned shift;
    uint32_t top; /* the greatest code; 0: there is no such channel */
} mask;

/* A file being decoded. */
typedef struct reader {
    const rt_bytes *file;
    const char *name;
    uint32_t width, height, bits, method, header, colours;
    int is_top_down;
    size_t pixels; /* offsets in the file */
    const uint8_t *palette;
    size_t palette_step;
    mask masks[4]; /* red, green, blue, alpha */
    uint32_t channels;
} reader;

static rt_status fail_input(const reader *r, const char *what, rt_error *error)
{
    return rt_fail(error, RT_ERROR_INPUT, "cannot read %.350s: %s", r->name, what);
}

static rt_status fail_short(const reader *r, rt_error *error)
{
    return fail_input(r, "it is cut short", error);
}

static uint32_t load16(const uint8_t *at)
{
    return (uint32_t)(at[0] | at[1] << 8);
}

static uint32_t load32(const uint8_t *at)
{
    return load16(at) | load16(at + 2) << 16;
}

/* ---- Headers ------------------------------------------------------------------- */

static rt_status read_sides(reader *r, rt_error *error)
{
    const uint8_t *h = r->file->data + file_header;
    const int is_core = r->header == core_header;
    r->width = is_core ? load16(h + 4) : load32(h + 4);
    r->height = is_core ? load16(h + 6) : load32(h + 8);
    r->bits = load16(h + (is_core ? 10 : 14));
    r->method = is_core ? plain : load32(h + 16);
    r->colours = is_core ? 0 : load32(h + 32);
    if (r->height >> 31) {
        r->is_top_down = 1;
        r->height = ~r->height + 1;
    }
    if (r->width - 1 >= RT_IMAGE_SIDE_MAX || r->height - 1 >= RT_IMAGE_SIDE_MAX)
        return rt_fail(error, RT_ERROR_INPUT,
                       "cannot read %.350s: its sides are not two numbers from 1 to %u", r->name,
                       RT_IMAGE_SIDE_MAX);
    return RT_OK;
}

/* Whether pixels of so many bits can be kept in that way. */
static int is_kind(const reader *r)
{
    if (r->method == rle8 || r->method == rle4)
        return r->bits == (r->method == rle8 ? 8 : 4) && !r->is_top_down;
    if (r->bits == 16 || r->bits == 32)
        return r->method == plain || r->method == by_masks || r->method == by_alpha_masks;
    return r->method == plain && (r->bits == 1 || r->bits == 4 || r->bits == 8 || r->bits == 24);
}

/* Bits side by side; 0 where they are not. */
static int read_mask(mask *out, uint32_t bits)
{
    out->shift = 0;
    while (bits && !(bits & 1)) {
        bits >>= 1;
        out->shift++;
    }
    out->top = bits;
    return (bits & (bits + 1)) == 0;
}

/* The masks of 16 and 32 bits: usual ones, or those that the file holds. */
static rt_status read_masks(reader *r, rt_error *error)
{
    static const uint32_t usual[2][3] = {{0x7c00, 0x3e0, 0x1f}, {0xff0000, 0xff00, 0xff}};
    const uint8_t *h = r->file->data + file_header + info_header;
    const int is_given = r->method == by_masks || r->method == by_alpha_masks;
    const size_t count = r->header >= 56 || r->method == by_alpha_masks ? 4 : 3;
    if (is_given && r->file->size < file_header + info_header + 4 * count)
        return fail_short(r, error);
    for (size_t c = 0; c < 3; c++) {
        const uint32_t bits = is_given ? load32(h + 4 * c) : usual[r->bits == 32][c];
        if (!read_mask(&r->masks[c], bits) || r->masks[c].top == 0)
            return fail_input(r, "a mask of its colours is empty or has gaps", error);
    }
    if (is_given && count == 4 && !read_mask(&r->masks[3], load32(h + 12)))
        return fail_input(r, "the mask of its alpha has gaps", error);
    r->channels = r->masks[3].top ? 4 : 3;
    return RT_OK;
}

static rt_status read_palette(reader *r, rt_error *error)
{
    const uint32_t most = 1u << r->bits;
    const size_t at = file_header + r->header;
    r->colours = r->colours == 0 || r->colours > most ? most : r->colours;
    r->palette_step = r->header == core_header ? 3 : 4;
    /* Some files have fewer entries than they say: the pixels begin there. */
    const size_t end = r->pixels < r->file->size ? r->pixels : r->file->size;
    const size_t room = end > at ? (end - at) / r->palette_step : 0;
    if (room < r->colours)
        r->colours = (uint32_t)room;
    if (r->colours == 0)
        return fail_input(r, "it has no palette", error);
    r->palette = r->file->data + at;
    return RT_OK;
}

static rt_status read_header(reader *r, rt_error *error)
{
    const uint8_t *data = r->file->data;
    if (r->file->size < 2 || memcmp(data, "BM", 2) != 0)
        return fail_input(r, "it is not a BMP file", error);
    if (r->file->size < file_header + core_header)
        return fail_short(r, error);
    r->pixels = load32(data + 10);
    r->header = load32(data + file_header);
    if (r->header != core_header && (r->header < info_header || r->header > largest_header))
        return fail_input(r, "its header is not of 12 or of 40 to 124 bytes", error);
    if (r->file->size < file_header + r->header)
        return fail_short(r, error);
    r->channels = 3;
    rt_status status = read_sides(r, error);
    if (status == RT_OK && (r->method == 4 || r->method == 5))
        return fail_input(r, r->method == 4 ? "it holds a JPEG" : "it holds a PNG", error);
    if (status == RT_OK && !is_kind(r))
        return rt_fail(error, RT_ERROR_INPUT,
                       "cannot read %.350s: %u bits a pixel by method %u%s are not of BMP", r->name,
                       r->bits, r->method, r->is_top_down ? " from the top down" : "");
    if (status != RT_OK || r->bits == 24)
        return status;
    return r->bits <= 8 ? read_palette(r, error) : read_masks(r, error);
}

/* Checks that the file can hold what its header promises, before anything is allocated for it. */
static rt_status check_size(const reader *r, rt_error *error)
{
    const uint64_t pixels = (uint64_t)r->width * r->height, values = pixels * r->channels;
    const uint64_t row = ((uint64_t)r->width * r->bits + 31) / 32 * 4;
    /* A run has two bytes for at most 255 pixels. */
    const uint64_t least =
        r->method == rle8 || r->method == rle4 ? pixels / 255 * 2 : row * r->height;
    if (values > RT_IMAGE_VALUES_MAX)
        return fail_input(r, "it holds more than 2^30 values", error);
    if (r->pixels < file_header + r->header || r->pixels + least > r->file->size)
        return rt_fail(error, RT_ERROR_INPUT,
                       "cannot read %.350s: cut short: its pixels, from byte %zu on, do not fit "
                       "into %zu",
                       r->name, r->pixels, r->file->size);
    if (rt_image_is_bomb(values, r->file->size))
        return fail_input(r, "it is too large for its length: more than 64 values a byte", error);
    return RT_OK;
}

/* ---- Pixels ---------------------------------------------------------------------- */

/* Row y of the file, which begins at the bottom unless it says otherwise. */
static float *row_of(const reader *r, rt_image *image, uint32_t y)
{
    const uint32_t row = r->is_top_down ? y : r->height - 1 - y;
    return image->data + (size_t)row * r->width * r->channels;
}

static int put_index(const reader *r, float *out, unsigned index)
{
    if (index >= r->colours)
        return 0;
    const uint8_t *entry = r->palette + index * r->palette_step;
    for (int c = 0; c < 3; c++)
        out[c] = (float)entry[2 - c] / 255.0f;
    return 1;
}

static void put_masked(const reader *r, float *out, uint32_t pixel)
{
    for (uint32_t c = 0; c < r->channels; c++)
        out[c] = (float)((double)(pixel >> r->masks[c].shift & r->masks[c].top) / r->masks[c].top);
}

static rt_status read_plain(const reader *r, rt_image *image, rt_error *error)
{
    const size_t row = ((size_t)r->width * r->bits + 31) / 32 * 4;
    for (uint32_t y = 0; y < r->height; y++) {
        const uint8_t *at = r->file->data + r->pixels + y * row;
        float *out = row_of(r, image, y);
        for (uint32_t x = 0; x < r->width; x++, out += r->channels) {
            const size_t bit = (size_t)x * r->bits;
            if (r->bits == 24)
                for (int c = 0; c < 3; c++)
                    out[c] = (float)at[bit / 8 + 2 - (size_t)c] / 255.0f;
            else if (r->bits > 8)
                put_masked(r, out, r->bits == 16 ? load16(at + bit / 8) : load32(at + bit / 8));
            else if (!put_index(r, out,
                                at[bit / 8] >> (8 - r->bits - bit % 8) & ((1u << r->bits) - 1)))
                return fail_input(r, "a pixel's colour is not in its palette", error);
        }
    }
    return RT_OK;
}

/* Where the runs have come to. */
typedef struct cursor {
    size_t at;
    uint32_t x, y;
} cursor;

/* `count` pixels in turn: of a run, whose byte has one or two indices, or one after the other. */
static rt_status put_run(const reader *r, rt_image *image, cursor *c, uint32_t count, int is_run,
                         rt_error *error)
{
    const uint8_t *data = r->file->data + c->at;
    const size_t used = is_run ? 1 : r->bits == 8 ? count : (count + 1) / 2;
    if (r->file->size - c->at < used)
        return fail_short(r, error);
    if (c->y >= r->height || count > r->width - c->x)
        return fail_input(r, "a run goes beyond its row", error);
    for (uint32_t i = 0; i < count; i++, c->x++) {
        const uint8_t byte = data[is_run ? 0 : r->bits == 8 ? i : i / 2];
        const unsigned index = r->bits == 8 ? byte : i % 2 ? byte & 15u : byte >> 4;
        if (!put_index(r, row_of(r, image, c->y) + (size_t)c->x * r->channels, index))
            return fail_input(r, "a pixel's colour is not in its palette", error);
    }
    c->at += used;
    return RT_OK;
}

/* What stands behind a count of 0; *is_end at the end of the picture. */
static rt_status read_escape(const reader *r, rt_image *image, cursor *c, int *is_end,
                             rt_error *error)
{
    const uint8_t code = r->file->data[c->at++];
    if (code == 0) {
        c->x = 0;
        c->y++;
    } else if (code == 1) {
        *is_end = 1;
    } else if (code == 2) {
        if (r->file->size - c->at < 2)
            return fail_short(r, error);
        c->x += r->file->data[c->at];
        c->y += r->file->data[c->at + 1];
        c->at += 2;
        if (c->x > r->width || c->y >= r->height)
            return fail_input(r, "a move goes beyond the picture", error);
    } else {
        const size_t start = c->at;
        const rt_status status = put_run(r, image, c, code, 0, error);
        if (status != RT_OK)
            return status;
        c->at += (c->at - start) % 2; /* pairs of bytes */
    }
    return RT_OK;
}

static rt_status read_runs(const reader *r, rt_image *image, rt_error *error)
{
    cursor c = {.at = r->pixels};
    int is_end = 0;
    for (uint64_t i = 0; i < (uint64_t)r->width * r->height; i++)
        put_index(r, image->data + (size_t)i * r->channels, 0);
    while (!is_end) {
        if (c.at > r->file->size || r->file->size - c.at < 2)
            return fail_short(r, error);
        const uint8_t count = r->file->data[c.at++];
        const rt_status status = count ? put_run(r, image, &c, count, 1, error)
                                       : read_escape(r, image, &c, &is_end, error);
        if (status != RT_OK)
            return status;
        if (c.y > r->height)
            return fail_input(r, "its runs have more rows than the picture", error);
    }
    return RT_OK;
}

/*
 * Decodes a BMP of 1, 4, 8, 16, 24 or 32 bits, by a palette or masks of bits, in runs (RLE4, RLE8)
 * or not, bottom-up or top-down, to the channels R, G, B, and A where there is a mask of it. Values
 * are codes divided by the greatest one, and are marked as sRGB; profiles are not followed. Pixels
 * that runs leave out have the first colour of the palette. Fails with RT_ERROR_INPUT when the file
 * is damaged, cut short or too large, or holds a JPEG or PNG; what follows its pixels is ignored.
 * `name` stands for it in messages. The caller destroys *out.
 */
rt_status rt_bmp_decode(rt_image **out, const rt_bytes *file, const char *name, rt_error *error)
{
    static const char *const rgba[4] = {"R", "G", "B", "A"};
    reader r = {.file = file, .name = name};
    rt_image *image = NULL;
    rt_status status = read_header(&r, error);
    if (status == RT_OK)
        status = check_size(&r, error);
    if (status == RT_OK)
        status =
            rt_image_create_in(&image, file->memory, r.width, r.height, rgba, r.channels, error);
    if (status == RT_OK)
        status = r.method == rle8 || r.method == rle4 ? read_runs(&r, image, error)
                                                      : read_plain(&r, image, error);
    if (status != RT_OK) {
        rt_image_destroy(image);
        return status;
    }
    image->is_srgb = 1;
    *out = image;
    return RT_OK;
}
