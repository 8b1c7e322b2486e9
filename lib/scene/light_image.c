/* light_image.c - reads the image of a light. */
#include "scene/light_image.h"

#include <stdio.h>

#include "base/error.h"
#include "base/file.h"
#include "image/image_file.h"
#include "image/srgb.h"

/* Copies the image's colours, decoded. */
static rt_status copy_texels(rt_light_image *out, const rt_image *image, const char *path,
                             const char *layer, const char *who, rt_memory *memory, rt_error *error)
{
    uint32_t channels[3];
    rt_error why;
    size_t count = (size_t)image->width * image->height;
    if (rt_image_colour_channels(channels, image, layer, &why) != RT_OK)
        return rt_fail_field(error, RT_ERROR_INPUT, why.field, "%s: %.150s: %s", who, path,
                             why.message);
    out->texels =
        rt_memory_zeroed(memory, count, 4 * sizeof *out->texels, "the image of a light", error);
    if (!out->texels)
        return RT_ERROR_MEMORY;
    for (size_t i = 0; i < count; i++)
        for (int c = 0; c < 3; c++) {
            float value = image->data[i * image->channel_count + channels[c]];
            if (!(value >= 0 && value <= 1e30f))
                return rt_fail(error, RT_ERROR_INPUT,
                               "%s: %.300s has the value %g at pixel "
                               "(%zu, %zu)",
                               who, path, value, i % image->width, i / image->width);
            out->texels[4 * i + (size_t)c] = image->is_srgb ? (float)rt_srgb_decode(value) : value;
        }
    out->width = image->width;
    out->height = image->height;
    return RT_OK;
}

rt_status rt_light_image_read(rt_light_image *out, const char *path, const char *layer,
                              const char *who, rt_memory *memory, rt_error *error)
{
    rt_light_image made = {0, 0, NULL};
    rt_image *image = NULL;
    rt_status status = rt_file_check_regular(path, error);
    if (status == RT_OK)
        status = rt_image_read_in(&image, path, memory, error);
    if (status == RT_OK)
        status = copy_texels(&made, image, path, layer, who, memory, error);
    if (status == RT_OK)
        *out = made;
    else
        rt_memory_free(made.texels);
    if (status != RT_OK && error && !error->field[0])
        snprintf(error->field, sizeof error->field, "path");
    rt_image_destroy(image);
    return rt_at_file(status, path, error);
}
