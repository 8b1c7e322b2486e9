/* texture.c - chooses the form in which texels are stored, and writes them. */
#include "texture/texture.h"

#include <math.h>
#include <string.h>

#include "base/half.h"
#include "image/srgb.h"

enum { codes = 256, half_top_exponent = 14 };

/* An image being packed. */
typedef struct packing {
    const rt_image *image;
    const char *name;
    rt_texture_reading reading;
    int is_code8;  /* every value is a multiple of 1/255 */
    int is_grey;   /* the channels are equal everywhere */
    float largest; /* greatest magnitude of a value, decoded or not: both have the same bounds */
    rt_texture_data texture;
} packing;

rt_status rt_texture_read_as(rt_texture_reading *out, const rt_image *image, const rt_texture *from,
                             rt_error *error)
{
    rt_error why;
    uint32_t *const channels = out->channels;
    const int is_alpha = from->channel == RT_TEXTURE_CHANNEL_A;
    const rt_status status = is_alpha
                                 ? rt_image_alpha_channel(channels, image, from->layer, &why)
                                 : rt_image_colour_channels(channels, image, from->layer, &why);
    if (status != RT_OK)
        return rt_fail_field(error, status, why.field, "cannot use %.150s as a texture: %s",
                             from->path, why.message);
    if (is_alpha)
        channels[1] = channels[2] = channels[0];
    else if (from->channel != RT_TEXTURE_CHANNEL_ALL)
        channels[0] = channels[1] = channels[2] = channels[from->channel - RT_TEXTURE_CHANNEL_R];
    out->is_srgb = image->is_srgb && !from->linear && !is_alpha;
    out->power = from->power == 0 ? 1 : from->power;
    return RT_OK;
}

double rt_texture_linear(const rt_texture_reading *reading, double value)
{
    const double linear = reading->is_srgb ? rt_srgb_decode(value) : value;
    return reading->power == 1 ? linear : pow(linear, reading->power);
}

static int is_code(float value)
{
    return value >= 0.0f && value <= 1.0f && (float)(int)(255.0f * value + 0.5f) / 255.0f == value;
}

/* Finds what the choice of format depends on, and what no format can hold. */
static rt_status survey(packing *p, rt_error *error)
{
    const rt_image *image = p->image;
    const float *pixel = image->data;
    p->is_code8 = p->is_grey = 1;
    for (uint32_t y = 0; y < image->height; y++)
        for (uint32_t x = 0; x < image->width; x++, pixel += image->channel_count) {
            const float rgb[3] = {pixel[p->reading.channels[0]], pixel[p->reading.channels[1]],
                                  pixel[p->reading.channels[2]]};
            for (int c = 0; c < 3; c++) {
                if (!isfinite(rgb[c]))
                    return rt_fail(
                        error, RT_ERROR_INPUT,
                        "cannot use %.300s as a texture: pixel (%u, %u) from the top left is %f",
                        p->name, x, y, (double)rgb[c]);
                if (rgb[c] < 0 && p->reading.power != 1)
                    return rt_fail_field(
                        error, RT_ERROR_INPUT, "power",
                        "cannot use %.300s with a power: pixel (%u, %u) from the top left is %f",
                        p->name, x, y, (double)rgb[c]);
                p->is_code8 = p->is_code8 && is_code(rgb[c]);
                p->largest = fabsf(rgb[c]) > p->largest ? fabsf(rgb[c]) : p->largest;
            }
            p->is_grey = p->is_grey && rgb[0] == rgb[1] && rgb[1] == rgb[2];
        }
    return RT_OK;
}

/* Chooses the format; returns the bytes it takes. */
static uint64_t choose_format(packing *p)
{
    rt_texture_data *t = &p->texture;
    uint64_t count = (uint64_t)p->image->width * p->image->height;
    t->kind = RT_TEXTURE_IMAGE;
    t->wrap = RT_WRAP_REPEAT;
    t->scale[0] = t->scale[1] = t->turn[0] = 1.0f;
    t->width = p->image->width;
    t->height = p->image->height;
    t->unit = 1.0f;
    t->format = p->is_code8 ? RT_TEXELS_CODE8 : p->is_grey ? RT_TEXELS_GREY : RT_TEXELS_HALF;
    if (t->format == RT_TEXELS_CODE8)
        return codes * sizeof(float) + 4 * count;
    if (t->format == RT_TEXELS_GREY)
        return sizeof(float) * count;
    /*
     * Bring the brightest value close under the greatest half: what is dark then keeps most bits.
     */
    const int exponent =
        p->reading.is_srgb ? 0 : ilogbf((float)rt_texture_linear(&p->reading, p->largest));
    t->unit = ldexpf(1.0f, exponent < -112 ? -126 : exponent - half_top_exponent);
    return 4 * sizeof(uint16_t) * count;
}

/*
 * Lengthens the table to a whole number of rows with room for size bytes, all zero; *row is the
 * first.
 */
static rt_status reserve(rt_bytes *texels, uint64_t size, rt_u32 *row, rt_error *error)
{
    uint64_t first = ((uint64_t)texels->size + RT_SCENE_ROW - 1) / RT_SCENE_ROW;
    uint64_t count = (size + RT_SCENE_ROW - 1) / RT_SCENE_ROW;
    if (first + count > UINT32_MAX)
        return rt_fail(error, RT_ERROR_MEMORY,
                       "out of memory: textures of more than 2^32 rows of %u bytes", RT_SCENE_ROW);
    *row = (rt_u32)first;
    return rt_bytes_put(texels, (first + count) * RT_SCENE_ROW - 1, "", 1, error);
}

static void write_code_table(const packing *p, float *decode)
{
    for (int i = 0; i < codes; i++)
        decode[i] = (float)rt_texture_linear(&p->reading, i / 255.0);
}

/* Writes one texel at its place in the image. */
static void write_texel(const packing *p, void *image, size_t place, const float rgb[3])
{
    if (p->texture.format == RT_TEXELS_CODE8) {
        uint8_t *texel = (uint8_t *)((float *)image + codes) + 4 * place;
        for (int c = 0; c < 3; c++)
            texel[c] = (uint8_t)(255.0f * rgb[c] + 0.5f);
    } else if (p->texture.format == RT_TEXELS_GREY) {
        ((float *)image)[place] = (float)rt_texture_linear(&p->reading, rgb[0]);
    } else {
        uint16_t *texel = (uint16_t *)image + 4 * place;
        for (int c = 0; c < 3; c++)
            texel[c] =
                rt_half_from_float((float)rt_texture_linear(&p->reading, rgb[c]) / p->texture.unit);
    }
}

/* Writes all texels. The image begins with its top row, the texture with the bottom one. */
static void write_texels(const packing *p, void *image)
{
    const float *pixel = p->image->data;
    size_t width = p->image->width;
    if (p->texture.format == RT_TEXELS_CODE8)
        write_code_table(p, image);
    for (size_t row = p->image->height; row-- > 0;)
        for (size_t x = 0; x < width; x++, pixel += p->image->channel_count) {
            const float rgb[3] = {pixel[p->reading.channels[0]], pixel[p->reading.channels[1]],
                                  pixel[p->reading.channels[2]]};
            write_texel(p, image, row * width + x, rgb);
        }
}

rt_status rt_texture_pack(rt_texture_data *out, rt_bytes *texels, const rt_image *image,
                          const rt_texture *from, rt_error *error)
{
    packing p;
    memset(&p, 0, sizeof p);
    p.image = image;
    p.name = from->path;
    rt_status status = rt_texture_read_as(&p.reading, image, from, error);
    if (status == RT_OK)
        status = survey(&p, error);
    if (status == RT_OK)
        status = reserve(texels, choose_format(&p), &p.texture.texels, error);
    if (status != RT_OK)
        return status;
    write_texels(&p, texels->data + (size_t)p.texture.texels * RT_SCENE_ROW);
    *out = p.texture;
    return RT_OK;
}
