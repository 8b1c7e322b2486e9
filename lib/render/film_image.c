/* film_image.c - rt_film_write: a film as an image file. */
#include <stdio.h>
#include <string.h>

#include "error.h"
#include "image/image_file.h"
#include "render/film.h"

static rt_status set_number(rt_image *image, const char *name, double value, rt_error *error)
{
    char text[32];
    snprintf(text, sizeof text, "%.17g", value);
    return rt_image_set_attribute(image, name, text, error);
}

/* What is needed to make the picture again. */
static rt_status describe(rt_image *image, const rt_film *film, const rt_image_options *options, rt_error *error)
{
    const rt_render_options *o = &film->options;
    rt_status status = rt_image_set_attribute(image, "librt.version", rt_version(), error);
    if (status == RT_OK && options && options->scene)
        status = rt_image_set_attribute(image, "librt.scene", options->scene, error);
    if (status == RT_OK && options && options->command)
        status = rt_image_set_attribute(image, "librt.command", options->command, error);
    if (status == RT_OK)
        status = rt_image_set_attribute(image, "librt.mode", o->mode == RT_MODE_PHOTON ? "photon" : "path", error);
    if (status == RT_OK)
        status = set_number(image, "librt.seed", o->seed, error);
    if (status == RT_OK)
        status = set_number(image, "librt.samples", film->stats.spp, error);
    if (status == RT_OK && o->mode == RT_MODE_PHOTON)
        status = set_number(image, "librt.photons", (double)film->stats.photons_emitted, error);
    return status;
}

rt_status rt_film_write(const rt_film *film, const char *path, const rt_image_options *options, rt_error *error)
{
    const char *names[3 + RT_PHOTON_LAYERS] = {"R", "G", "B"};
    const rt_render_options *o = &film->options;
    rt_image *image = NULL;
    size_t pixels = (size_t)o->width * o->height;
    uint32_t layers = film->photon_layers ? RT_PHOTON_LAYERS : 0;

    for (uint32_t i = 0; i < layers; i++)
        names[3 + i] = rt_photon_layer_names[i];
    rt_status status = rt_image_create(&image, o->width, o->height, names, 3 + layers, error);
    if (status != RT_OK)
        return status;
    for (size_t i = 0; i < pixels; i++) {
        float *pixel = image->data + i * (3 + layers);
        memcpy(pixel, film->rgb + 3 * i, 3 * sizeof *pixel);
        for (uint32_t layer = 0; layer < layers; layer++)
            pixel[3 + layer] = film->photon_layers[layer * pixels + i];
    }
    status = describe(image, film, options, error);
    if (status == RT_OK)
        status = rt_image_write(image, path, options, error);
    rt_image_destroy(image);
    return status;
}
