/* image_add.c - puts the channels of images beside those of another. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/image.h"

/* A channel of the new image, and which one of which image it is. */
typedef struct channel {
    char name[RT_IMAGE_NAME_SIZE];
    const rt_image *image;
    uint32_t index;
} channel;

/* Lists the channels of an image whose names are not there; returns how many there are then. */
static uint32_t list_channels(channel *channels, uint32_t count, const rt_image *image,
                              const char *layer)
{
    for (uint32_t i = 0, k; i < image->channel_count; i++) {
        channel *c = channels + count;
        if (layer && *layer && !strchr(image->names[i], '.'))
            snprintf(c->name, sizeof c->name, "%.127s.%.127s", layer, image->names[i]);
        else
            snprintf(c->name, sizeof c->name, "%s", image->names[i]);
        c->image = image;
        c->index = i;
        for (k = 0; strcmp(channels[k].name, c->name) != 0;)
            k++;
        count += k == count;
    }
    return count;
}

/* An image of these channels. */
static rt_status join(rt_image **out, const channel *channels, uint32_t count, rt_memory *memory,
                      rt_error *error)
{
    const char *names[RT_IMAGE_CHANNELS_MAX];
    const uint32_t width = channels->image->width, height = channels->image->height;
    if (count > RT_IMAGE_CHANNELS_MAX || RT_IMAGE_VALUES_MAX / count < (uint64_t)width * height)
        return rt_fail(error, RT_ERROR_USAGE, "an image of more than %u channels or 2^30 values",
                       RT_IMAGE_CHANNELS_MAX);
    for (uint32_t i = 0; i < count; i++)
        names[i] = channels[i].name;
    rt_status status = rt_image_create_in(out, memory, width, height, names, count, error);
    for (size_t p = 0; status == RT_OK && p < (size_t)width * height; p++)
        for (uint32_t i = 0; i < count; i++)
            (*out)->data[p * count + i] =
                channels[i].image->data[p * channels[i].image->channel_count + channels[i].index];
    return status;
}

rt_status rt_image_add(rt_image **image, rt_image *const *more, const char *const *layers,
                       uint32_t count, rt_memory *memory, rt_error *error)
{
    rt_image *const to = *image;
    size_t room = to->channel_count;
    for (uint32_t i = 0; i < count; room += more[i++]->channel_count)
        if (to->width != more[i]->width || to->height != more[i]->height)
            return rt_fail(error, RT_ERROR_USAGE, "images of %ux%u and %ux%u pixels", to->width,
                           to->height, more[i]->width, more[i]->height);
    channel *channels = calloc(room, sizeof *channels);
    if (!channels)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory: the channels of an image");
    uint32_t listed = list_channels(channels, 0, to, NULL);
    for (uint32_t i = 0; i < count; i++)
        listed = list_channels(channels, listed, more[i], layers[i]);
    rt_status status = join(image, channels, listed, memory, error);
    if (status == RT_OK) {
        rt_image_move_attributes(*image, to);
        rt_image_destroy(to);
    }
    free(channels);
    return status;
}
