/*
 * ppm_read.c - decodes the formats of grey and colour codes of Netpbm: P2, P3, P5 and P6.
 *
 * Reference: the manual pages ppm(5) and pgm(5) of Netpbm.
 */
#include <string.h>

#include "image/decode.h"
#include "image/netpbm.h"

#define CODE_MAX 65535u

/* A file being decoded. */
typedef struct reader {
    const rt_bytes *file;
    const char *name;
    size_t at;
    uint32_t width, height, channel_count;
    uint32_t top; /* the code of full intensity */
    int is_plain; /* codes are decimal numbers, not bytes */
} reader;

static rt_status fail_input(const reader *r, const char *what, rt_error *error)
{
    return rt_fail(error, RT_ERROR_INPUT, "cannot read %.350s: %s", r->name, what);
}

static int is_space(int c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

/*
 * The next character, or -1 at the end. A comment runs from '#' through the end of its line and
 * counts as if it were not there, even in the middle of a number: so says the manual.
 */
static int peek(reader *r)
{
    const uint8_t *data = r->file->data;
    size_t size = r->file->size;
    while (r->at < size && data[r->at] == '#') {
        while (r->at < size && data[r->at] != '\n' && data[r->at] != '\r')
            r->at++;
        if (r->at < size)
            r->at++;
    }
    return r->at < size ? data[r->at] : -1;
}

/*
 * Reads a decimal number of at most `most` behind at least one white space; stops at what follows
 * it.
 */
static int read_number(reader *r, uint32_t most, uint32_t *out)
{
    uint32_t value = 0, digits = 0;
    if (!is_space(peek(r)))
        return 0;
    while (is_space(peek(r)))
        r->at++;
    for (int c; (c = peek(r)) >= '0' && c <= '9'; r->at++, digits++) {
        value = 10 * value + (uint32_t)(c - '0');
        if (value > most)
            return 0;
    }
    *out = value;
    return digits > 0;
}

static rt_status read_header(reader *r, rt_error *error)
{
    if (r->file->size < 2 || r->file->data[0] != 'P' || !memchr("2356", r->file->data[1], 4))
        return fail_input(r, "it is not a PPM or PGM file", error);
    int kind = r->file->data[1];
    r->is_plain = kind == '2' || kind == '3';
    r->channel_count = kind == '2' || kind == '5' ? 1 : 3;
    r->at = 2;
    if (!read_number(r, RT_IMAGE_SIDE_MAX, &r->width) ||
        !read_number(r, RT_IMAGE_SIDE_MAX, &r->height) || r->width == 0 || r->height == 0)
        return rt_fail(error, RT_ERROR_INPUT,
                       "cannot read %.350s: its sides are not two numbers from 1 to %u", r->name,
                       RT_IMAGE_SIDE_MAX);
    if (!read_number(r, CODE_MAX, &r->top) || r->top == 0)
        return rt_fail(error, RT_ERROR_INPUT,
                       "cannot read %.350s: its greatest code is not a number from 1 to %u",
                       r->name, CODE_MAX);
    if (!is_space(peek(r)))
        return fail_input(r, "no white space ends its header", error);
    return RT_OK;
}

/* Checks that the file can hold what its header promises, before anything is allocated for it. */
static rt_status check_size(reader *r, uint64_t values, rt_error *error)
{
    uint64_t found = r->file->size - r->at;
    /*
     * A plain code takes a white space and a digit at least; the one behind the header is the
     * first.
     */
    uint64_t expected = r->is_plain ? 2 * values : 1 + values * (r->top > 255 ? 2 : 1);
    if (values > RT_IMAGE_VALUES_MAX)
        return fail_input(r, "it holds more than 2^30 values", error);
    if (found < expected)
        return rt_fail(error, RT_ERROR_INPUT,
                       "cannot read %.350s: cut short: %llu bytes of pixels instead of %s%llu",
                       r->name, (unsigned long long)found, r->is_plain ? "at least " : "",
                       (unsigned long long)expected);
    return RT_OK;
}

/* Reads the next code: a number, or one or two bytes, the high one first. */
static int read_code(reader *r, uint32_t *code)
{
    if (r->is_plain)
        return read_number(r, r->top, code);
    *code = r->file->data[r->at++];
    if (r->top > 255)
        *code = *code << 8 | r->file->data[r->at++];
    return *code <= r->top;
}

static rt_status read_codes(reader *r, rt_image *image, uint64_t values, rt_error *error)
{
    /* One white space ends the header; before a plain code it belongs to the code. */
    if (!r->is_plain)
        r->at++;
    for (uint64_t i = 0; i < values; i++) {
        uint32_t code;
        if (!read_code(r, &code))
            return rt_fail(error, RT_ERROR_INPUT,
                           "cannot read %.350s: value %llu is missing or not a number from 0 to %u",
                           r->name, (unsigned long long)i + 1, r->top);
        image->data[i] = (float)code / (float)r->top;
    }
    /* White space may end the file; a further picture, or anything else, may not. */
    while (r->at < r->file->size && is_space(r->file->data[r->at]))
        r->at++;
    return r->at == r->file->size ? RT_OK : fail_input(r, "something follows its pixels", error);
}

/*
 * Decodes a PPM or PGM, plain (P3, P2) or binary (P6, P5), of up to 16 bits, to the channels R, G,
 * B, or Y. Values are codes divided by the greatest one, and are marked as sRGB. Fails with
 * RT_ERROR_INPUT when the file is damaged or cut short, a code is over the greatest, or more than
 * white space follows the pixels; `name` stands for it in messages. The caller destroys *out.
 */
rt_status rt_ppm_decode(rt_image **out, const rt_bytes *file, const char *name, rt_error *error)
{
    static const char *const rgb[3] = {"R", "G", "B"}, *const grey[1] = {"Y"};
    reader r = {file, name, 0, 0, 0, 0, 0, 0};
    rt_image *image = NULL;
    rt_status status = read_header(&r, error);
    uint64_t values = (uint64_t)r.width * r.height * r.channel_count;
    if (status == RT_OK)
        status = check_size(&r, values, error);
    if (status == RT_OK)
        status = rt_image_create_in(&image, file->memory, r.width, r.height,
                                    r.channel_count == 3 ? rgb : grey, r.channel_count, error);
    if (status == RT_OK)
        status = read_codes(&r, image, values, error);
    if (status != RT_OK) {
        rt_image_destroy(image);
        return status;
    }
    image->is_srgb = 1;
    *out = image;
    return RT_OK;
}
