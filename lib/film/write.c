/* write.c - rt_film_write: a film as an image file. */
#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "image/image_file.h"
#include "film/film.h"

static rt_status set_number(rt_image *image, const char *name, double value, rt_error *error)
{
    char text[32];
    snprintf(text, sizeof text, "%.17g", value);
    return rt_image_set_attribute(image, name, text, error);
}

/* Records what is needed to render the picture again. */
static rt_status describe(rt_image *image, const rt_film *film, const rt_image_options *options,
                          rt_error *error)
{
    const rt_render_options *o = &film->options;
    rt_status status = rt_image_set_attribute(image, "librt.version", rt_version(), error);
    if (status == RT_OK && options && options->scene)
        status = rt_image_set_attribute(image, "librt.scene", options->scene, error);
    if (status == RT_OK && options && options->command)
        status = rt_image_set_attribute(image, "librt.command", options->command, error);
    if (status == RT_OK)
        status = rt_image_set_attribute(image, "librt.mode", rt_mode_name(o->mode), error);
    if (status == RT_OK)
        status = set_number(image, "librt.seed", o->seed, error);
    if (status == RT_OK)
        status = set_number(image, "librt.samples", film->stats.spp, error);
    if (status == RT_OK && film->stats.replicates > 0)
        status = set_number(image, "librt.replicates", film->stats.replicates, error);
    if (status == RT_OK && film->stats.replicates > 0)
        status = set_number(image, "librt.relative_error", film->stats.relative_error, error);
    if (status == RT_OK && film->stats.photons_emitted > 0)
        status = set_number(image, "librt.photons", (double)film->stats.photons_emitted, error);
    return status;
}

/* Copies `from` [pixels][channels] to the channels of the image from `first` on. */
static void fill(rt_image *image, uint32_t first, const float *from, uint32_t channels)
{
    size_t pixels = (size_t)image->width * image->height;
    for (size_t i = 0; i < pixels; i++)
        memcpy(image->data + i * image->channel_count + first, from + i * channels,
               channels * sizeof *from);
}

rt_status rt_film_write(const rt_film *film, const char *path, const rt_image_options *options,
                        rt_error *error)
{
    if (rt_is_missing(film, "film", error))
        return RT_ERROR_USAGE;
    if (!film->is_resolved)
        return rt_fail(error, RT_ERROR_USAGE,
                       "the film was loaded or added to: rt_film_resolve makes its means");
    const char *names[3 + RT_LAYER_CHANNELS_MAX * RT_FILM_LAYER_COUNT] = {"R", "G", "B"};
    const rt_render_options *o = &film->options;
    uint32_t channels = 3;
    rt_image_format format;
    rt_image *image = NULL;

    rt_status status = rt_image_format_of(&format, path, error);
    if (status != RT_OK)
        return status;
    int has_layers = format == RT_IMAGE_EXR;
    for (int i = 0; i < RT_FILM_LAYER_COUNT && has_layers; i++)
        for (uint32_t c = 0; c < rt_layer_infos[i].channels && film->layers.data[i]; c++)
            names[channels++] = rt_layer_infos[i].channel[c];
    status = rt_image_create(&image, o->width, o->height, names, channels, error);
    if (status != RT_OK)
        return status;
    fill(image, 0, film->rgb, 3);
    channels = 3;
    for (int i = 0; i < RT_FILM_LAYER_COUNT && has_layers; i++)
        if (film->layers.data[i]) {
            fill(image, channels, film->layers.data[i], rt_layer_infos[i].channels);
            channels += rt_layer_infos[i].channels;
        }
    status = describe(image, film, options, error);
    if (status == RT_OK)
        status = rt_image_write(image, path, options, error);
    rt_image_destroy(image);
    return status;
}
