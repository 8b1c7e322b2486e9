/* image_rgb.c - an image from three channels, and three channels from a layer of an image. */
#include <stdio.h>
#include <string.h>

#include "image/image.h"
#include "image/srgb.h"

rt_status rt_image_from_rgb(rt_image **out, const float *rgb, uint32_t width, uint32_t height,
                            rt_error *error)
{
    static const char *const names[3] = {"R", "G", "B"};
    rt_image *image = NULL;
    rt_status status = rt_image_create(&image, width, height, names, 3, error);
    if (status != RT_OK)
        return status;
    memcpy(image->data, rgb, 3 * (size_t)width * height * sizeof *rgb);
    *out = image;
    return RT_OK;
}

void rt_image_get_size(const rt_image *image, uint32_t *width, uint32_t *height)
{
    *width = image->width;
    *height = image->height;
}

/* The channel's name within its layer, or NULL when it is of another one. */
static const char *name_in_layer(const char *name, const char *layer)
{
    if (!layer)
        return strchr(name, '.') ? NULL : name;
    size_t length = strlen(layer);
    if (strncmp(name, layer, length) != 0 || name[length] != '.' || strchr(name + length + 1, '.'))
        return NULL;
    return name + length + 1;
}

static uint32_t find_in_layer(const rt_image *image, const char *layer, const char *wanted)
{
    for (uint32_t i = 0; i < image->channel_count; i++) {
        const char *name = name_in_layer(image->names[i], layer);
        if (name && strcmp(name, wanted) == 0)
            return i;
    }
    return RT_IMAGE_NO_CHANNEL;
}

/*
 * The channel called as the layer, or its grey channel Y, or the only one that it has, or
 * RT_IMAGE_NO_CHANNEL.
 */
static uint32_t find_single(const rt_image *image, const char *layer)
{
    uint32_t found = layer ? rt_image_channel(image, layer) : RT_IMAGE_NO_CHANNEL;
    if (found == RT_IMAGE_NO_CHANNEL)
        found = find_in_layer(image, layer, "Y");
    if (found != RT_IMAGE_NO_CHANNEL)
        return found;
    for (uint32_t i = 0; i < image->channel_count; i++) {
        if (!name_in_layer(image->names[i], layer))
            continue;
        if (found != RT_IMAGE_NO_CHANNEL)
            return RT_IMAGE_NO_CHANNEL;
        found = i;
    }
    return found;
}

/*
 * Whether there is such a layer; then the channels that stand for red, green and blue. The third of
 * a pair is RT_IMAGE_NO_CHANNEL.
 */
static int find_channels(uint32_t channels[3], const rt_image *image, const char *layer)
{
    static const char *const sets[][3] = {
        {"R", "G", "B"}, {"X", "Y", "Z"}, {"U", "V", NULL}, {"X", "Y", NULL}};
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++) {
        int missing = 0;
        for (int c = 0; c < 3; c++) {
            channels[c] =
                sets[i][c] ? find_in_layer(image, layer, sets[i][c]) : RT_IMAGE_NO_CHANNEL;
            missing += sets[i][c] && channels[c] == RT_IMAGE_NO_CHANNEL;
        }
        if (!missing && (sets[i][2] || layer))
            return 1;
    }
    channels[0] = channels[1] = channels[2] = find_single(image, layer);
    return channels[0] != RT_IMAGE_NO_CHANNEL;
}

int rt_image_is_coded(const rt_image *image, uint32_t channel)
{
    const char *const name = image->names[channel], *const dot = strrchr(name, '.');
    return image->is_srgb && strcmp(dot ? dot + 1 : name, "A") != 0;
}

/* " (did you mean 'albedo'?)", or "" where no layer's name is near. */
static void suggest_layer(char *out, size_t size, const rt_image *image, const char *layer)
{
    rt_nearest search;
    rt_nearest_begin(&search, layer, strlen(layer));
    for (uint32_t i = 0; i < image->channel_count; i++) {
        const char *name = image->names[i], *dot = strrchr(name, '.');
        rt_nearest_offer(&search, name, dot ? (size_t)(dot - name) : strlen(name));
        rt_nearest_offer(&search, name, strlen(name));
    }
    out[0] = '\0';
    if (search.best)
        snprintf(out, size, " (did you mean '%.*s'?)", (int)search.best_length, search.best);
}

/* "R, G, B", as many as there is room for. */
static void list_channels(char *out, size_t size, const rt_image *image)
{
    size_t used = 0;
    out[0] = '\0';
    for (uint32_t i = 0; i < image->channel_count; i++) {
        const int is_last = i + 1 == image->channel_count;
        if (used + strlen(image->names[i]) + (is_last ? 3 : 8) > size) {
            snprintf(out + used, size - used, "%s...", i ? ", " : "");
            return;
        }
        used += (size_t)snprintf(out + used, size - used, "%s%s", i ? ", " : "", image->names[i]);
    }
}

/* Writes the first layer that holds colours, or one channel; returns 0 where there is none. */
static int first_layer(char out[RT_IMAGE_NAME_SIZE], const rt_image *image)
{
    uint32_t channels[3];
    for (uint32_t i = 0; i < image->channel_count; i++) {
        const char *const dot = strrchr(image->names[i], '.');
        snprintf(out, RT_IMAGE_NAME_SIZE, "%.*s", dot ? (int)(dot - image->names[i]) : 0,
                 image->names[i]);
        if (dot && find_channels(channels, image, out))
            return 1;
    }
    return 0;
}

static rt_status fail_layer(const rt_image *image, const char *layer, rt_error *error)
{
    char names[256], hint[RT_IMAGE_NAME_SIZE + 32] = "", first[RT_IMAGE_NAME_SIZE];
    list_channels(names, sizeof names, image);
    if (layer)
        suggest_layer(hint, sizeof hint, image, layer);
    if (layer && !strchr(names, '.'))
        return rt_fail_field(error, RT_ERROR_INPUT, "layer",
                             "no layer '%.60s': the image holds no layers beside %s", layer, names);
    if (layer)
        return rt_fail_field(error, RT_ERROR_INPUT, "layer",
                             "no layer '%.60s'%s of colours, of U and V or of one channel among "
                             "%s",
                             layer, hint, names);
    if (first_layer(first, image))
        snprintf(hint, sizeof hint, ": choose a layer, such as %.80s", first);
    return rt_fail(error, RT_ERROR_INPUT, "no picture, of R, G and B or of one channel, among %s%s",
                   names, hint);
}

rt_status rt_image_colour_channels(uint32_t channels[3], const rt_image *image, const char *layer,
                                   rt_error *error)
{
    int is_found = layer
                       ? find_channels(channels, image, layer) && channels[2] != RT_IMAGE_NO_CHANNEL
                       : rt_image_rgb_channels(channels, image, NULL) == RT_OK;
    if (!is_found && !layer) {
        channels[0] = image->channel_count == 1 ? 0 : find_single(image, NULL);
        channels[1] = channels[2] = channels[0];
        is_found = channels[0] != RT_IMAGE_NO_CHANNEL;
    }
    return is_found ? RT_OK : fail_layer(image, layer, error);
}

rt_status rt_image_alpha_channel(uint32_t *channel, const rt_image *image, const char *layer,
                                 rt_error *error)
{
    char names[256];
    *channel = find_in_layer(image, layer, "A");
    if (*channel != RT_IMAGE_NO_CHANNEL)
        return RT_OK;
    list_channels(names, sizeof names, image);
    return rt_fail_field(error, RT_ERROR_INPUT, "channel", "no alpha, A, among %s", names);
}

int rt_image_has_layer(const rt_image *image, const char *layer)
{
    uint32_t channels[3];
    return find_channels(channels, image, layer);
}

rt_status rt_image_get_rgb(float *rgb, const rt_image *image, const char *layer, rt_error *error)
{
    if (rt_is_missing(image, "image", error))
        return RT_ERROR_USAGE;
    uint32_t channels[3];
    if (!find_channels(channels, image, layer))
        return fail_layer(image, layer, error);
    int is_coded[3];
    for (size_t c = 0; c < 3; c++)
        is_coded[c] = channels[c] != RT_IMAGE_NO_CHANNEL && rt_image_is_coded(image, channels[c]);
    size_t pixel_count = (size_t)image->width * image->height;
    for (size_t i = 0; i < pixel_count; i++)
        for (size_t c = 0; c < 3; c++) {
            float value = channels[c] == RT_IMAGE_NO_CHANNEL
                              ? 0.0f
                              : image->data[i * image->channel_count + channels[c]];
            rgb[3 * i + c] = is_coded[c] ? (float)rt_srgb_decode(value) : value;
        }
    return RT_OK;
}
