/*
 * qoi_read.c - decodes QOI.
 *
 * Reference: Dominic Szablewski, "The Quite OK Image Format, Specification Version 1.0", 2022.
 */
#include <string.h>

#include "image/decode.h"

enum { header_size = 14, end_size = 8, run_max = 62 };

/* The first byte of a chunk: all of it, or its two upper bits. */
enum { rgb = 0xfe, rgba = 0xff, index_of = 0, difference = 1, by_green = 2, run = 3 };

/* A file being decoded. */
typedef struct reader {
    const rt_bytes *file;
    const char *name;
    size_t at;
    uint32_t width, height, channels;
    int is_linear;
    uint8_t pixel[4];    /* the latest: red, green, blue, alpha */
    uint8_t seen[64][4]; /* the latest ones, by their hash */
} reader;

static rt_status fail_input(const reader *r, const char *what, rt_error *error)
{
    return rt_fail(error, RT_ERROR_INPUT, "cannot read %.350s: %s", r->name, what);
}

static uint32_t load32(const uint8_t *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

static rt_status read_header(reader *r, rt_error *error)
{
    const uint8_t *h = r->file->data;
    if (r->file->size < 4 || memcmp(h, "qoif", 4) != 0)
        return fail_input(r, "it is not a QOI file", error);
    if (r->file->size < header_size)
        return fail_input(r, "it is cut short", error);
    r->width = load32(h + 4);
    r->height = load32(h + 8);
    r->channels = h[12];
    r->is_linear = h[13];
    if (r->width - 1 >= RT_IMAGE_SIDE_MAX || r->height - 1 >= RT_IMAGE_SIDE_MAX)
        return rt_fail(error, RT_ERROR_INPUT,
                       "cannot read %.350s: its sides are not two numbers from 1 to %u", r->name,
                       RT_IMAGE_SIDE_MAX);
    if (h[12] != 3 && h[12] != 4)
        return rt_fail(error, RT_ERROR_INPUT, "cannot read %.350s: it has %u channels, not 3 or 4",
                       r->name, h[12]);
    if (h[13] > 1)
        return rt_fail(error, RT_ERROR_INPUT,
                       "cannot read %.350s: its colour space is %u, not 0 (sRGB) or 1 (linear)",
                       r->name, h[13]);
    return RT_OK;
}

/* Checks that the file can hold the pixels. */
static rt_status check_size(const reader *r, rt_error *error)
{
    const uint64_t pixels = (uint64_t)r->width * r->height;
    const uint64_t least = header_size + (pixels + run_max - 1) / run_max + end_size;
    if (pixels * r->channels > RT_IMAGE_VALUES_MAX)
        return fail_input(r, "it holds more than 2^30 values", error);
    if (least > r->file->size)
        return rt_fail(error, RT_ERROR_INPUT,
                       "cannot read %.350s: cut short: %zu bytes instead of at least %llu", r->name,
                       r->file->size, (unsigned long long)least);
    if (rt_image_is_bomb(pixels * r->channels, r->file->size))
        return fail_input(r, "it is too large for its length: more than 64 values a byte", error);
    return RT_OK;
}

/* How many bytes follow the first one of a chunk. */
static size_t bytes_behind(uint8_t first)
{
    return first == rgba ? 4 : first == rgb ? 3 : first >> 6 == by_green ? 1 : 0;
}

/* Adds to the colour of the latest pixel, modulo 256. */
static void add(reader *r, int red, int green, int blue)
{
    r->pixel[0] = (uint8_t)(r->pixel[0] + red);
    r->pixel[1] = (uint8_t)(r->pixel[1] + green);
    r->pixel[2] = (uint8_t)(r->pixel[2] + blue);
}

/* The pixel of a chunk follows the latest one; returns how often it comes. */
static uint32_t read_chunk(reader *r, const uint8_t *chunk)
{
    const int first = chunk[0], low = first & 63;
    if (first == rgb || first == rgba) {
        memcpy(r->pixel, chunk + 1, first == rgb ? 3 : 4);
    } else if (first >> 6 == index_of) {
        memcpy(r->pixel, r->seen[low], 4);
    } else if (first >> 6 == difference) {
        add(r, (low >> 4) - 2, (low >> 2 & 3) - 2, (low & 3) - 2);
    } else if (first >> 6 == by_green) {
        const int green = low - 32;
        add(r, green + (chunk[1] >> 4) - 8, green, green + (chunk[1] & 15) - 8);
    }
    const uint8_t *p = r->pixel;
    memcpy(r->seen[(3 * p[0] + 5 * p[1] + 7 * p[2] + 11 * p[3]) % 64], p, 4);
    return first < rgb && first >> 6 == run ? (uint32_t)low + 1 : 1;
}

static rt_status read_pixels(reader *r, rt_image *image, rt_error *error)
{
    const uint64_t pixels = (uint64_t)r->width * r->height;
    const size_t end = r->file->size - end_size; /* chunks stand before the mark of the end */
    float *out = image->data;
    for (uint64_t i = 0; i < pixels;) {
        const uint8_t *chunk = r->file->data + r->at;
        if (r->at >= end || bytes_behind(chunk[0]) >= end - r->at)
            return fail_input(r, "it is cut short", error);
        r->at += 1 + bytes_behind(chunk[0]);
        const uint32_t count = read_chunk(r, chunk);
        if (count > pixels - i)
            return fail_input(r, "a run goes beyond its last pixel", error);
        i += count;
        for (uint32_t k = 0; k < count; k++)
            for (uint32_t c = 0; c < r->channels; c++)
                *out++ = (float)r->pixel[c] / 255.0f;
    }
    return RT_OK;
}

/* The mark stands behind the last pixel: so no chunk is missing, and none is too many. */
static rt_status check_end(const reader *r, rt_error *error)
{
    static const uint8_t mark[end_size] = {0, 0, 0, 0, 0, 0, 0, 1};
    if (memcmp(r->file->data + r->at, mark, end_size) != 0)
        return fail_input(r, "no mark of the end, 7 bytes of 0 and one of 1, follows its pixels",
                          error);
    return RT_OK;
}

/*
 * Decodes a QOI to the channels R, G, B, and A where its header has 4. Values are codes divided by
 * 255, and are marked as sRGB unless the header says that they are linear. Fails with
 * RT_ERROR_INPUT when the file is damaged, cut short or too large; what follows the mark of its end
 * is ignored. `name` stands for it in messages. The caller destroys *out.
 */
rt_status rt_qoi_decode(rt_image **out, const rt_bytes *file, const char *name, rt_error *error)
{
    static const char *const names[4] = {"R", "G", "B", "A"};
    reader r = {.file = file, .name = name, .at = header_size, .pixel = {0, 0, 0, 255}};
    rt_image *image = NULL;
    rt_status status = read_header(&r, error);
    if (status == RT_OK)
        status = check_size(&r, error);
    if (status == RT_OK)
        status =
            rt_image_create_in(&image, file->memory, r.width, r.height, names, r.channels, error);
    if (status == RT_OK)
        status = read_pixels(&r, image, error);
    if (status == RT_OK)
        status = check_end(&r, error);
    if (status != RT_OK) {
        rt_image_destroy(image);
        return status;
    }
    image->is_srgb = !r.is_linear;
    *out = image;
    return RT_OK;
}
