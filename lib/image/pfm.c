/* pfm.c - encodes and decodes PFM. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/decode.h"
#include "image/netpbm.h"

#define TOKEN_SIZE 32

static void store_little_endian(uint8_t bytes[4], float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 4; i++)
        bytes[i] = (uint8_t)(bits >> (8 * i));
}

static float load(const uint8_t bytes[4], int is_little_endian)
{
    uint32_t bits = 0;
    float value;
    for (int i = 0; i < 4; i++)
        bits |= (uint32_t)bytes[i] << (8 * (is_little_endian ? i : 3 - i));
    memcpy(&value, &bits, sizeof value);
    return value;
}

static rt_status put_rows(rt_bytes *bytes, const rt_image *image, const uint32_t rgb[3],
                          uint8_t *row, rt_error *error)
{
    rt_status status = RT_OK;
    /* The bottom row comes first. */
    for (uint32_t y = image->height; status == RT_OK && y-- > 0;) {
        const float *pixel = image->data + (size_t)y * image->width * image->channel_count;
        for (uint32_t x = 0; x < image->width; x++, pixel += image->channel_count)
            for (int c = 0; c < 3; c++)
                store_little_endian(row + 12 * (size_t)x + 4 * c, pixel[rgb[c]]);
        status = rt_bytes_put(bytes, bytes->size, row, 12 * (size_t)image->width, error);
    }
    return status;
}

rt_status rt_pfm_encode(rt_bytes *out, const rt_image *image, rt_error *error)
{
    uint32_t rgb[3];
    rt_status status = rt_image_rgb_channels(rgb, image, error);
    if (status != RT_OK)
        return status;
    uint8_t *row = malloc(12 * (size_t)image->width);
    if (!row)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory: a row of %u pixels", image->width);
    char header[64];
    int length = snprintf(header, sizeof header, "PF\n%u %u\n-1.0\n", image->width, image->height);
    rt_bytes bytes = {0};
    status = rt_bytes_put(&bytes, 0, header, (size_t)length, error);
    if (status == RT_OK)
        status = put_rows(&bytes, image, rgb, row, error);
    free(row);
    if (status == RT_OK)
        *out = bytes;
    else
        rt_bytes_free(&bytes);
    return status;
}

/* A header being read. */
typedef struct header {
    uint32_t width, height, channel_count;
    int is_little_endian;
    size_t size; /* bytes of the header, with the one white space that ends it */
} header;

static int is_space(uint8_t c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

/*
 * Reads the next word at *at and the one white space behind it; 0 when there is none or it is too
 * long.
 */
static int next_token(char token[TOKEN_SIZE], size_t *at, const rt_bytes *file)
{
    size_t length = 0, i = *at;
    while (i < file->size && is_space(file->data[i]))
        i++;
    while (i < file->size && !is_space(file->data[i]) && length < TOKEN_SIZE - 1)
        token[length++] = (char)file->data[i++];
    token[length] = '\0';
    if (length == 0 || i >= file->size || !is_space(file->data[i]))
        return 0;
    *at = i + 1;
    return 1;
}

static int parse_side(uint32_t *out, const char *token)
{
    uint32_t value = 0;
    for (const char *c = token; *c; c++) {
        if (*c < '0' || *c > '9')
            return 0;
        value = 10 * value + (uint32_t)(*c - '0');
        if (value > RT_IMAGE_SIDE_MAX)
            return 0;
    }
    *out = value;
    return value > 0;
}

/* Only the scale's sign counts. Read by hand: strtod would follow the locale. */
static int parse_scale(int *is_little_endian, const char *token)
{
    *is_little_endian = token[0] == '-';
    const char *digits = token[0] == '-' || token[0] == '+' ? token + 1 : token;
    size_t mantissa = strcspn(digits, "eE");
    return digits[0] != '\0' && digits[strspn(digits, "0123456789.eE+-")] == '\0' &&
           strcspn(digits, "123456789") < mantissa;
}

static int parse_header(header *h, const rt_bytes *file)
{
    char token[TOKEN_SIZE];
    size_t at = 0;
    if (file->size == 0 || is_space(file->data[0]) || !next_token(token, &at, file))
        return 0;
    if (strcmp(token, "PF") == 0)
        h->channel_count = 3;
    else if (strcmp(token, "Pf") == 0)
        h->channel_count = 1;
    else
        return 0;
    if (!next_token(token, &at, file) || !parse_side(&h->width, token) ||
        !next_token(token, &at, file) || !parse_side(&h->height, token) ||
        !next_token(token, &at, file) || !parse_scale(&h->is_little_endian, token))
        return 0;
    h->size = at;
    return 1;
}

/*
 * Decodes a PFM of either byte order to the channels R, G, B, or Y when it has only one; the
 * magnitude of its scale is not applied. Fails with RT_ERROR_INPUT when the file is damaged, cut
 * short or too long; `name` stands for it in messages. The caller destroys *out.
 */
rt_status rt_pfm_decode(rt_image **out, const rt_bytes *file, const char *name, rt_error *error)
{
    static const char *const rgb[3] = {"R", "G", "B"}, *const grey[1] = {"Y"};
    header h;
    if (!parse_header(&h, file))
        return rt_fail(error, RT_ERROR_INPUT, "cannot read %.350s: its PFM header is damaged",
                       name);
    uint64_t expected = (uint64_t)h.width * h.height * h.channel_count * 4,
             found = file->size - h.size;
    if (found != expected)
        return rt_fail(error, RT_ERROR_INPUT,
                       "cannot read %.350s: %llu bytes of pixels instead of %llu", name,
                       (unsigned long long)found, (unsigned long long)expected);

    rt_image *image = NULL;
    rt_status status =
        rt_image_create_in(&image, file->memory, h.width, h.height,
                           h.channel_count == 3 ? rgb : grey, h.channel_count, error);
    if (status != RT_OK)
        return status;
    const uint8_t *source = file->data + h.size;
    size_t row_values = (size_t)h.width * h.channel_count;
    /* The bottom row comes first. */
    for (uint32_t y = h.height; y-- > 0;)
        for (size_t i = 0; i < row_values; i++, source += 4)
            image->data[y * row_values + i] = load(source, h.is_little_endian);
    *out = image;
    return RT_OK;
}
