/*
 * tga_read.c - decodes TGA.
 *
 * Reference: "Truevision TGA File Format Specification, Version 2.0", Truevision, 1991.
 */
#include <string.h>

#include "image/decode.h"
#include "image/tga.h"

enum { header_size = 18, mapped = 1, true_colour = 2, grey = 3, runs = 8 };

/* A file being decoded. */
typedef struct reader {
    const rt_bytes *file;
    const char *name;
    size_t at;
    unsigned kind, is_packed; /* mapped, true_colour or grey; in runs */
    unsigned map_first, map_count, map_bits;
    unsigned width, height, bits, alpha_bits;
    int is_from_right, is_from_top;
    const uint8_t *map;
    uint32_t channels;
} reader;

static rt_status fail_input(const reader *r, const char *what, rt_error *error)
{
    return rt_fail(error, RT_ERROR_INPUT, "cannot read %.350s: %s", r->name, what);
}

static unsigned load16(const uint8_t *at)
{
    return (unsigned)(at[0] | at[1] << 8);
}

static int is_colour_size(unsigned bits)
{
    return bits == 15 || bits == 16 || bits == 24 || bits == 32;
}

/* The bits of alpha in a colour of so many bits, where the header has so many attributes. */
static unsigned alpha_of(unsigned bits, unsigned attributes)
{
    return bits == 32 && attributes == 8 ? 8 : bits == 16 && attributes == 1 ? 1 : 0;
}

/* Reads the header; 0 where it is not plausible. */
static int read_header(reader *r)
{
    static const uint8_t none[5] = {0};
    const uint8_t *h = r->file->data;
    if (r->file->size < header_size)
        return 0;
    r->kind = h[2] & ~(unsigned)runs;
    r->is_packed = h[2] & runs;
    r->map_first = load16(h + 3);
    r->map_count = load16(h + 5);
    r->map_bits = h[7];
    r->width = load16(h + 12);
    r->height = load16(h + 14);
    r->bits = h[16];
    const unsigned attributes = h[17] & 15u;
    r->is_from_right = (h[17] & 16) != 0;
    r->is_from_top = (h[17] & 32) != 0;
    r->at = header_size + (size_t)h[0];
    if (h[1] > 1 || r->kind < mapped || r->kind > grey || r->width == 0 || r->height == 0 ||
        h[17] >> 6 != 0 || (r->kind == mapped && !h[1]))
        return 0;
    if (h[1] ? !is_colour_size(r->map_bits) || r->map_count == 0 : memcmp(h + 3, none, 5) != 0)
        return 0;
    r->alpha_bits = alpha_of(r->kind == mapped ? r->map_bits : r->bits, attributes);
    if (r->kind == grey && r->bits == 16)
        r->alpha_bits = 8;
    r->channels = (r->kind == grey ? 1u : 3u) + (r->alpha_bits ? 1u : 0u);
    return r->kind == true_colour ? is_colour_size(r->bits) : r->bits == 8 || r->bits == 16;
}

int rt_tga_is_plausible(const rt_bytes *file)
{
    reader r = {.file = file};
    return read_header(&r);
}

static size_t bytes_of(unsigned bits)
{
    return (bits + 7) / 8;
}

/* Finds the map of colours, and checks that the file can hold the pixels. */
static rt_status check_size(reader *r, rt_error *error)
{
    const uint64_t map = (uint64_t)r->map_count * bytes_of(r->map_bits);
    const uint64_t pixels = (uint64_t)r->width * r->height, size = bytes_of(r->bits);
    /* A packet of one pixel's bytes has at most 128 of them. */
    const uint64_t least = r->is_packed ? (pixels + 127) / 128 * (1 + size) : pixels * size;
    if (pixels * r->channels > RT_IMAGE_VALUES_MAX)
        return fail_input(r, "it holds more than 2^30 values", error);
    if (r->at + map + least > r->file->size)
        return rt_fail(error, RT_ERROR_INPUT,
                       "cannot read %.350s: cut short: %zu bytes instead of %s%llu", r->name,
                       r->file->size, r->is_packed ? "at least " : "",
                       (unsigned long long)(r->at + map + least));
    if (rt_image_is_bomb(pixels * r->channels, r->file->size))
        return fail_input(r, "it is too large for its length: more than 64 values a byte", error);
    r->map = r->file->data + r->at;
    r->at += (size_t)map;
    return RT_OK;
}

/* A colour of 15, 16, 24 or 32 bits, blue first; 5 bits each in the short ones. */
static void put_colour(const reader *r, float *out, const uint8_t *at, unsigned bits)
{
    if (bits <= 16) {
        const unsigned code = load16(at);
        for (unsigned c = 0; c < 3; c++)
            out[c] = (float)(code >> (10 - 5 * c) & 31) / 31.0f;
        if (r->alpha_bits)
            out[3] = (float)(code >> 15);
        return;
    }
    for (unsigned c = 0; c < 3; c++)
        out[c] = (float)at[2 - c] / 255.0f;
    if (r->alpha_bits)
        out[3] = (float)at[3] / 255.0f;
}

static rt_status put_pixel(const reader *r, float *out, const uint8_t *at, rt_error *error)
{
    if (r->kind == true_colour) {
        put_colour(r, out, at, r->bits);
    } else if (r->kind == grey) {
        for (uint32_t c = 0; c < r->channels; c++)
            out[c] = (float)at[c] / 255.0f;
    } else {
        const unsigned index = r->bits == 8 ? at[0] : load16(at);
        if (index < r->map_first || index - r->map_first >= r->map_count)
            return fail_input(r, "a pixel's colour is not in its map", error);
        put_colour(r, out, r->map + (index - r->map_first) * bytes_of(r->map_bits), r->map_bits);
    }
    return RT_OK;
}

/* Where the i-th pixel of the file is kept. */
static float *place_of(const reader *r, rt_image *image, uint64_t i)
{
    const uint64_t x = i % r->width, y = i / r->width;
    const uint64_t column = r->is_from_right ? r->width - 1 - x : x;
    const uint64_t row = r->is_from_top ? y : r->height - 1 - y;
    return image->data + (size_t)(row * r->width + column) * r->channels;
}

static rt_status read_plain(reader *r, rt_image *image, rt_error *error)
{
    const uint64_t pixels = (uint64_t)r->width * r->height;
    rt_status status = RT_OK;
    for (uint64_t i = 0; i < pixels && status == RT_OK; i++, r->at += bytes_of(r->bits))
        status = put_pixel(r, place_of(r, image, i), r->file->data + r->at, error);
    return status;
}

/* Packets: a pixel and how often it comes, or how many pixels follow. They may cross rows. */
static rt_status read_runs(reader *r, rt_image *image, rt_error *error)
{
    const uint64_t pixels = (uint64_t)r->width * r->height;
    const size_t size = bytes_of(r->bits);
    for (uint64_t i = 0; i < pixels;) {
        if (r->at >= r->file->size)
            return fail_input(r, "it is cut short", error);
        const uint8_t head = r->file->data[r->at++];
        const uint64_t count = (head & 127u) + 1;
        const size_t used = (head & 128 ? 1 : (size_t)count) * size;
        if (count > pixels - i)
            return fail_input(r, "a run goes beyond its last pixel", error);
        if (used > r->file->size - r->at)
            return fail_input(r, "it is cut short", error);
        for (uint64_t k = 0; k < count; k++, i++) {
            const uint8_t *at = r->file->data + r->at + (head & 128 ? 0 : (size_t)k * size);
            const rt_status status = put_pixel(r, place_of(r, image, i), at, error);
            if (status != RT_OK)
                return status;
        }
        r->at += used;
    }
    return RT_OK;
}

/*
 * Decodes a TGA with a plausible header: true colour of 15, 16, 24 or 32 bits, grey of 8 or 16, or
 * by a map of colours, run-length encoded or not, of any of the four origins; to the channels R, G,
 * B, or Y, and A where the header has bits of it. Values are codes divided by the greatest one, and
 * are marked as sRGB. Fails with RT_ERROR_INPUT when the file is damaged, cut short or too large;
 * what follows its pixels is ignored. `name` stands for it in messages. The caller destroys *out.
 */
rt_status rt_tga_decode(rt_image **out, const rt_bytes *file, const char *name, rt_error *error)
{
    static const char *const rgba[4] = {"R", "G", "B", "A"}, *const ya[2] = {"Y", "A"};
    reader r = {.file = file, .name = name};
    rt_image *image = NULL;
    if (!read_header(&r))
        return fail_input(&r, "it has no plausible header of a TGA", error);
    rt_status status = check_size(&r, error);
    if (status == RT_OK)
        status = rt_image_create_in(&image, file->memory, r.width, r.height,
                                    r.kind == grey ? ya : rgba, r.channels, error);
    if (status == RT_OK)
        status = r.is_packed ? read_runs(&r, image, error) : read_plain(&r, image, error);
    if (status != RT_OK) {
        rt_image_destroy(image);
        return status;
    }
    image->is_srgb = 1;
    *out = image;
    return RT_OK;
}
