#include "render/aov.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"

static size_t film_pixels(const rt_film *film)
{
    return (size_t)film->options.width * film->options.height;
}

static int is_layer_mode(rt_mode mode)
{
    return mode == RT_MODE_NORMALS || mode == RT_MODE_ALBEDO || mode == RT_MODE_DEPTH;
}

int rt_aov_wanted(const rt_render_options *options)
{
    return options->aov || is_layer_mode(options->mode);
}

/* ---- On the device ---------------------------------------------------------- */

rt_status rt_aov_begin(rt_aov *out, rt_renderer *renderer, rt_film *film,
                       rt_stage_progress *progress, rt_error *error)
{
    size_t count = film_pixels(film), bytes = RT_LAYER_COUNT * count * sizeof *film->layer_sums;
    rt_params none;
    memset(&none, 0, sizeof none);

    film->layer_sums = calloc(RT_LAYER_COUNT * count, sizeof *film->layer_sums);
    if (!film->layer_sums)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for the layers of %zu pixels", count);
    rt_status status = rt_film_add_layers(film, RT_FILM_ALBEDO, RT_FILM_DEPTH, error);
    if (status == RT_OK)
        status = rt_buffer_create(renderer->device, &out->films, CL_MEM_READ_WRITE, bytes,
                                  film->layer_sums, "the layers of the film", error);
    rt_arg args[] = {RT_ARG(none), RT_ARG(renderer->scene), RT_ARG(out->films)};
    if (status == RT_OK)
        status = rt_kernel_prepare(renderer->device, &out->kernel, "aov", "aov", args, 3, progress,
                                   error);
    return status;
}

rt_status rt_aov_add(rt_aov *layers, rt_renderer *renderer, const rt_params *params,
                     rt_error *error)
{
    rt_arg first = {sizeof *params, params};
    if (!layers->kernel)
        return RT_OK;
    rt_status status = rt_kernel_args(layers->kernel, &first, 1, error);
    return status == RT_OK ? rt_launch(renderer->device, layers->kernel, params->item_count, error)
                           : status;
}

rt_status rt_aov_read(const rt_aov *layers, rt_renderer *renderer, rt_film *film, rt_error *error)
{
    size_t bytes = RT_LAYER_COUNT * film_pixels(film) * sizeof *film->layer_sums;
    return layers->films
               ? rt_buffer_read(renderer->device, layers->films, 0, bytes, film->layer_sums, error)
               : RT_OK;
}

void rt_aov_free(rt_aov *layers)
{
    rt_kernel_release(layers->kernel);
    rt_buffer_release(layers->films);
}

/* ---- In the film ------------------------------------------------------------ */

static double total(const rt_film_pixel *pixel, int channel)
{
    return (double)pixel->sum[channel] - pixel->lost[channel];
}

/* What the mode shows of a pixel, which has samples. */
static void show(float rgb[3], const rt_film *film, size_t i)
{
    const rt_film_pixel *normal = film->layer_sums + RT_LAYER_NORMAL * film_pixels(film) + i;
    const rt_film_pixel *depth = film->layer_sums + RT_LAYER_DEPTH * film_pixels(film) + i;
    float covered = (float)(total(depth, 2) / rt_film_divisor(normal));
    for (int c = 0; c < 3; c++) {
        if (film->options.mode == RT_MODE_ALBEDO)
            rgb[c] = film->layers[RT_FILM_ALBEDO][3 * i + c];
        else if (film->options.mode == RT_MODE_NORMALS)
            rgb[c] = 0.5f * (film->layers[RT_FILM_NORMAL][3 * i + c] + covered);
        else
            rgb[c] = film->layers[RT_FILM_DEPTH][i];
    }
}

void rt_aov_resolve(rt_film *film)
{
    size_t count = film_pixels(film);
    if (!film->layer_sums)
        return;
    const rt_film_pixel *albedo = film->layer_sums + RT_LAYER_ALBEDO * count;
    const rt_film_pixel *normal = film->layer_sums + RT_LAYER_NORMAL * count;
    const rt_film_pixel *depth = film->layer_sums + RT_LAYER_DEPTH * count;
    for (size_t i = 0; i < count; i++) {
        if (albedo[i].count == 0)
            continue;
        for (int c = 0; c < 3; c++) {
            film->layers[RT_FILM_ALBEDO][3 * i + c] =
                (float)(total(albedo + i, c) / rt_film_divisor(albedo + i));
            film->layers[RT_FILM_NORMAL][3 * i + c] =
                (float)(total(normal + i, c) / rt_film_divisor(normal + i));
        }
        double hits = total(depth + i, 1);
        film->layers[RT_FILM_DEPTH][i] = hits > 0 ? (float)(total(depth + i, 0) / hits) : 0;
        if (is_layer_mode(film->options.mode))
            show(film->rgb + 3 * i, film, i);
    }
}
