/* denoise.c - rt_film_denoise: guides from the device, and the filter that they guide. */
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "denoise/oidn.h"
#include "film/film.h"
#include "render/renderer.h"

enum {
    guide_samples = 8,       /* of a pixel; guides are nearly free of noise */
    pixels_at_once = 1 << 16 /* in a launch */
};

static const rt_denoise_options no_options;

rt_status rt_denoise_options_check(const rt_render_options *options, rt_error *error)
{
    if (rt_is_missing(options, "options", error))
        return RT_ERROR_USAGE;
    if (options->mode != RT_MODE_PATH && options->mode != RT_MODE_DIRECT &&
        options->mode != RT_MODE_PHOTON && options->mode != RT_MODE_VCM)
        return rt_fail_field(error, RT_ERROR_USAGE, "denoise", "mode %s shows no light",
                             rt_mode_name(options->mode));
    return RT_OK;
}

rt_status rt_denoiser_check(char *version, const rt_denoise_options *options, rt_error *error)
{
    const rt_denoise_options *o = options ? options : &no_options;
    rt_oidn *oidn = NULL;
    rt_status status = rt_oidn_open(&oidn, o->library, error);
    if (status == RT_OK)
        rt_oidn_version(version, oidn);
    rt_oidn_close(oidn);
    return status;
}

/* ---- Guides ---------------------------------------------------------------------------------- */

/* Launches the kernel over the film, a part at a time, so that a progress callback can cancel. */
static rt_status launch_guides(rt_renderer *renderer, cl_kernel kernel, cl_mem guides,
                               const rt_render_options *o, rt_error *error)
{
    rt_params params = rt_params_make(o);
    const uint32_t pixels = o->width * o->height;
    rt_status status = RT_OK;
    params.sample_count = o->spp < guide_samples ? o->spp : guide_samples;
    for (uint32_t first = 0; first < pixels && status == RT_OK; first += pixels_at_once) {
        const uint32_t left = pixels - first;
        params.first_item = first;
        params.item_count = left < pixels_at_once ? left : pixels_at_once;
        rt_arg args[] = {RT_ARG(params), RT_ARG(renderer->scene), RT_ARG(guides)};
        status = rt_kernel_args(kernel, args, 3, error);
        if (status == RT_OK)
            status = rt_launch(renderer->device, kernel, params.item_count, error);
        if (status == RT_OK)
            status = rt_device_finish(renderer->device, error);
    }
    return status;
}

/* Makes the guides of all pixels. */
static rt_status make_guides(rt_guide *out, rt_renderer *renderer, const rt_film *film,
                             const rt_hooks *hooks, rt_error *error)
{
    rt_device *device = renderer->device;
    const char *name = RT_PROGRAM_OF(renderer, "guides");
    const size_t bytes = rt_film_pixels(film) * sizeof *out;
    cl_kernel kernel = NULL;
    cl_mem guides = NULL;
    rt_status status = rt_renderer_aim(renderer, &film->options, error);
    if (status == RT_OK)
        status = rt_buffer_create(device, &guides, CL_MEM_WRITE_ONLY, bytes, NULL,
                                  "the buffer of the denoiser's guides", error);
    if (status == RT_OK)
        status = rt_device_kernel(device, &kernel, name, name, hooks, error);
    if (status == RT_OK)
        status = launch_guides(renderer, kernel, guides, &film->options, error);
    if (status == RT_OK)
        status = rt_buffer_read(device, guides, 0, bytes, out, error);
    rt_kernel_release(kernel);
    rt_buffer_release(device, guides);
    return status;
}

/* ---- The layer ------------------------------------------------------------------------------- */

static rt_status denoise(rt_film *film, rt_guide *guides, rt_oidn *oidn, rt_error *error)
{
    const rt_oidn_image images[] = {
        {"color", film->rgb, 3 * sizeof(float)},
        {"albedo", guides->albedo, sizeof *guides},
        {"normal", guides->normal, sizeof *guides},
        {"output", film->layers.data[RT_FILM_DENOISED], 3 * sizeof(float)},
    };
    return rt_oidn_run(oidn, images, sizeof images / sizeof *images, film->options.width,
                       film->options.height, error);
}

/* Room for the layer, which counts in the film's memory as long as the film lives. */
static rt_status add_layer(rt_film *film, rt_error *error)
{
    const size_t pixels = rt_film_pixels(film);
    const uint64_t bytes = 3 * pixels * sizeof(float);
    rt_status status = rt_memory_foresee(film->memory, (double)bytes, "the layer denoised", error);
    if (status == RT_OK)
        status = rt_memory_take(film->memory, bytes, rt_film_owner, error);
    if (status != RT_OK)
        return status;
    status = rt_film_layers_add(&film->layers, RT_LAYERS_DENOISED, pixels, error);
    if (status == RT_OK)
        film->reserved += bytes;
    else
        rt_memory_give(film->memory, bytes, rt_film_owner);
    return status;
}

static const char guides_owner[] = "the denoiser's guides";

/* Makes guides and filters. */
static rt_status fill_layer(rt_film *film, rt_renderer *renderer, rt_oidn *oidn,
                            const rt_hooks *hooks, rt_error *error)
{
    const uint64_t bytes = rt_film_pixels(film) * sizeof(rt_guide);
    rt_status status = rt_memory_take(film->memory, bytes, guides_owner, error);
    if (status != RT_OK)
        return status;
    rt_guide *guides = malloc(bytes);
    if (!guides)
        status = rt_fail(error, RT_ERROR_MEMORY, "out of memory for the denoiser's guides");
    if (status == RT_OK)
        status = make_guides(guides, renderer, film, hooks, error);
    if (status == RT_OK)
        status = denoise(film, guides, oidn, error);
    free(guides);
    rt_memory_give(film->memory, bytes, guides_owner);
    return status;
}

static void drop_layer(rt_film *film)
{
    const uint64_t bytes = 3 * rt_film_pixels(film) * sizeof(float);
    if (!film->layers.data[RT_FILM_DENOISED])
        return;
    free(film->layers.data[RT_FILM_DENOISED]);
    film->layers.data[RT_FILM_DENOISED] = NULL;
    film->reserved -= bytes;
    rt_memory_give(film->memory, bytes, rt_film_owner);
}

rt_status rt_film_denoise(rt_film *film, rt_renderer *renderer, const rt_denoise_options *options,
                          rt_error *error)
{
    const rt_denoise_options *o = options ? options : &no_options;
    rt_oidn *oidn = NULL;
    if (rt_is_missing(film, "film", error) || rt_is_missing(renderer, "renderer", error))
        return RT_ERROR_USAGE;
    if (!rt_film_rgb(film))
        return rt_fail_field(error, RT_ERROR_USAGE, "film", "the film is not resolved");
    drop_layer(film);
    rt_status status = rt_denoise_options_check(&film->options, error);
    if (status == RT_OK)
        status = rt_oidn_open(&oidn, o->library, error);
    if (status == RT_OK)
        status = add_layer(film, error);
    if (status == RT_OK && film->options.mode == RT_MODE_PHOTON)
        rt_warn(o->hooks, "the denoiser may leave the noise of photons, which neighbouring pixels "
                          "share; more photons or passes lower it");
    if (status == RT_OK)
        status = fill_layer(film, renderer, oidn, o->hooks, error);
    if (status != RT_OK)
        drop_layer(film);
    rt_oidn_close(oidn);
    return status;
}
