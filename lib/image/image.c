/* image.c - creates images, and finds their channels and attributes. */
#include "image/image.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static rt_status check_size(uint32_t width, uint32_t height, uint32_t channel_count,
                            rt_error *error)
{
    if (width == 0 || height == 0)
        return rt_fail(error, RT_ERROR_USAGE, "an image of %ux%u pixels has no pixels", width,
                       height);
    if (width > RT_IMAGE_SIDE_MAX || height > RT_IMAGE_SIDE_MAX)
        return rt_fail(error, RT_ERROR_USAGE,
                       "an image of %ux%u pixels is too large: at most %u a side", width, height,
                       RT_IMAGE_SIDE_MAX);
    if (channel_count == 0 || channel_count > RT_IMAGE_CHANNELS_MAX)
        return rt_fail(error, RT_ERROR_USAGE, "an image has 1 to %u channels, not %u",
                       RT_IMAGE_CHANNELS_MAX, channel_count);
    return RT_OK;
}

static rt_status check_names(const char *const *names, uint32_t count, rt_error *error)
{
    for (uint32_t i = 0; i < count; i++) {
        if (names[i][0] == '\0' || strlen(names[i]) >= RT_IMAGE_NAME_SIZE)
            return rt_fail(error, RT_ERROR_USAGE, "a channel's name has 1 to %u bytes: '%.40s'",
                           RT_IMAGE_NAME_SIZE - 1, names[i]);
        for (uint32_t j = 0; j < i; j++)
            if (strcmp(names[i], names[j]) == 0)
                return rt_fail(error, RT_ERROR_USAGE, "two channels have the name '%.40s'",
                               names[i]);
    }
    return RT_OK;
}

rt_status rt_image_create(rt_image **out, uint32_t width, uint32_t height, const char *const *names,
                          uint32_t channel_count, rt_error *error)
{
    return rt_image_create_in(out, NULL, width, height, names, channel_count, error);
}

rt_status rt_image_create_in(rt_image **out, rt_memory *memory, uint32_t width, uint32_t height,
                             const char *const *names, uint32_t channel_count, rt_error *error)
{
    char what[96];
    rt_status status = check_size(width, height, channel_count, error);
    if (status == RT_OK)
        status = check_names(names, channel_count, error);
    if (status != RT_OK)
        return status;

    snprintf(what, sizeof what, "an image of %ux%u pixels and %u channels", width, height,
             channel_count);
    rt_image *image = rt_memory_zeroed(NULL, 1, sizeof *image, what, error);
    if (image) {
        image->names = rt_memory_zeroed(NULL, channel_count, sizeof *image->names, what, error);
        image->data = rt_memory_zeroed(memory, (size_t)width * height,
                                       channel_count * sizeof(float), what, error);
    }
    if (!image || !image->names || !image->data) {
        rt_image_destroy(image);
        return RT_ERROR_MEMORY;
    }
    image->width = width;
    image->height = height;
    image->channel_count = channel_count;
    for (uint32_t i = 0; i < channel_count; i++)
        memcpy(image->names[i], names[i], strlen(names[i]));
    *out = image;
    return RT_OK;
}

int rt_image_is_bomb(uint64_t values, size_t file_size)
{
    return values > RT_IMAGE_VALUES_UNCHECKED && values / RT_IMAGE_VALUES_PER_BYTE > file_size;
}

void rt_image_destroy(rt_image *image)
{
    if (!image)
        return;
    for (size_t i = 0; i < image->attribute_count; i++)
        free(image->attributes[i].value);
    free(image->attributes);
    rt_memory_free(image->names);
    rt_memory_free(image->data);
    rt_memory_free(image);
}

uint32_t rt_image_channel(const rt_image *image, const char *name)
{
    for (uint32_t i = 0; i < image->channel_count; i++)
        if (strcmp(image->names[i], name) == 0)
            return i;
    return RT_IMAGE_NO_CHANNEL;
}

rt_status rt_image_rgb_channels(uint32_t rgb[3], const rt_image *image, rt_error *error)
{
    static const char *const names[3] = {"R", "G", "B"};
    for (int c = 0; c < 3; c++) {
        rgb[c] = rt_image_channel(image, names[c]);
        if (rgb[c] == RT_IMAGE_NO_CHANNEL)
            return rt_fail(error, RT_ERROR_USAGE, "the image has no channel %s", names[c]);
    }
    return RT_OK;
}

static rt_image_attribute *find_attribute(const rt_image *image, const char *name)
{
    for (size_t i = 0; i < image->attribute_count; i++)
        if (strcmp(image->attributes[i].name, name) == 0)
            return &image->attributes[i];
    return NULL;
}

static rt_image_attribute *add_attribute(rt_image *image, const char *name)
{
    rt_image_attribute *grown =
        realloc(image->attributes, (image->attribute_count + 1) * sizeof *grown);
    if (!grown)
        return NULL;
    image->attributes = grown;
    rt_image_attribute *attribute = &grown[image->attribute_count++];
    memset(attribute, 0, sizeof *attribute);
    memcpy(attribute->name, name, strlen(name));
    return attribute;
}

rt_status rt_image_set_attribute(rt_image *image, const char *name, const char *value,
                                 rt_error *error)
{
    if (name[0] == '\0' || strlen(name) >= RT_IMAGE_NAME_SIZE)
        return rt_fail(error, RT_ERROR_USAGE, "an attribute's name has 1 to %u bytes: '%.40s'",
                       RT_IMAGE_NAME_SIZE - 1, name);
    size_t size = strlen(value) + 1;
    char *copy = malloc(size);
    rt_image_attribute *attribute = copy ? find_attribute(image, name) : NULL;
    if (copy && !attribute)
        attribute = add_attribute(image, name);
    if (!attribute) {
        free(copy);
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory: attribute '%.40s'", name);
    }
    memcpy(copy, value, size);
    free(attribute->value);
    attribute->value = copy;
    return RT_OK;
}

void rt_image_move_attributes(rt_image *to, rt_image *from)
{
    to->attributes = from->attributes;
    to->attribute_count = from->attribute_count;
    from->attributes = NULL;
    from->attribute_count = 0;
}

const char *rt_image_attribute_value(const rt_image *image, const char *name)
{
    const rt_image_attribute *attribute = find_attribute(image, name);
    return attribute ? attribute->value : NULL;
}
