/* image_add.c - puts the channels of an image beside those of another. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/image.h"

/* The channels of the new image: those of `to`, then some of `more`. */
typedef struct channel_list {
    const char **names;
    uint32_t *from; /* of those of `more`, which one it is there */
    char (*made)[RT_IMAGE_NAME_SIZE];
    uint32_t count;
} channel_list;

static void free_list(channel_list *list)
{
    free(list->names);
    free(list->from);
    free(list->made);
}

/* Lists all that have different names. Returns 0 without memory. */
static int make_list(channel_list *list, const rt_image *to, const rt_image *more,
                     const char *layer)
{
    list->names = calloc((size_t)to->channel_count + more->channel_count, sizeof *list->names);
    list->from = calloc(more->channel_count, sizeof *list->from);
    list->made = calloc(more->channel_count, sizeof *list->made);
    if (!list->names || !list->from || !list->made)
        return 0;
    for (uint32_t i = 0; i < to->channel_count; i++)
        list->names[list->count++] = to->names[i];
    for (uint32_t i = 0; i < more->channel_count; i++) {
        const char *const name = more->names[i];
        if (layer && *layer && !strchr(name, '.'))
            snprintf(list->made[i], sizeof list->made[i], "%.127s.%.127s", layer, name);
        else
            snprintf(list->made[i], sizeof list->made[i], "%s", name);
        if (rt_image_channel(to, list->made[i]) != RT_IMAGE_NO_CHANNEL)
            continue;
        list->from[list->count - to->channel_count] = i;
        list->names[list->count++] = list->made[i];
    }
    return 1;
}

static void copy_pixels(rt_image *out, const rt_image *to, const rt_image *more,
                        const uint32_t *from)
{
    const size_t pixels = (size_t)to->width * to->height, first = to->channel_count;
    for (size_t p = 0; p < pixels; p++) {
        float *const pixel = out->data + p * out->channel_count;
        memcpy(pixel, to->data + p * first, first * sizeof *pixel);
        for (size_t i = first; i < out->channel_count; i++)
            pixel[i] = more->data[p * more->channel_count + from[i - first]];
    }
}

rt_status rt_image_add(rt_image **image, const rt_image *more, const char *layer, rt_memory *memory,
                       rt_error *error)
{
    rt_image *const to = *image;
    rt_image *made = NULL;
    channel_list list = {NULL, NULL, NULL, 0};
    rt_status status;
    if (to->width != more->width || to->height != more->height)
        return rt_fail(error, RT_ERROR_USAGE, "images of %ux%u and %ux%u pixels", to->width,
                       to->height, more->width, more->height);
    if (!make_list(&list, to, more, layer))
        status = rt_fail(error, RT_ERROR_MEMORY, "out of memory: the channels of an image");
    else if (RT_IMAGE_VALUES_MAX / list.count < (uint64_t)to->width * to->height)
        status = rt_fail(error, RT_ERROR_USAGE, "an image of more than 2^30 values");
    else
        status =
            rt_image_create_in(&made, memory, to->width, to->height, list.names, list.count, error);
    if (status == RT_OK) {
        copy_pixels(made, to, more, list.from);
        rt_image_move_attributes(made, to);
        rt_image_destroy(to);
        *image = made;
    }
    free_list(&list);
    return status;
}
