/* layers.c - launches the kernel first_hit beside a mode, and makes the layers from its sums. */
#include "mode/first_hit/layers.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "render/prepare.h"

/* ---- On the device ---------------------------------------------------------- */

rt_status rt_first_hit_layers_prepare(rt_first_hit_layers *out, rt_renderer *renderer,
                                      rt_film *film, rt_stage_progress *progress, rt_error *error)
{
    size_t pixels = rt_film_pixels(film), count = RT_LAYER_COUNT * pixels;
    rt_params none;
    memset(&none, 0, sizeof none);

    out->renderer = renderer;
    out->device = renderer->device;
    if (!film->layer_sums)
        film->layer_sums = calloc(count, sizeof *film->layer_sums);
    if (!film->layer_sums)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for the layers of %zu pixels",
                       pixels);
    rt_status status = rt_buffer_create(renderer->device, &out->sums, CL_MEM_READ_WRITE,
                                        count * sizeof *film->layer_sums, film->layer_sums,
                                        "the buffer of the film's layers", error);
    rt_arg args[] = {RT_ARG(none), RT_ARG(renderer->scene), RT_ARG(out->sums)};
    if (status == RT_OK)
        status = rt_kernel_prepare(renderer->device, &out->kernel, "first_hit", "first_hit", args,
                                   3, progress, error);
    return status;
}

void rt_first_hit_layers_release(rt_first_hit_layers *layers)
{
    rt_kernel_release(layers->kernel);
    rt_buffer_release(layers->device, layers->sums);
    memset(layers, 0, sizeof *layers);
}

rt_status rt_first_hit_layers_add(rt_first_hit_layers *layers, const rt_params *params,
                                  rt_error *error)
{
    rt_arg first = {sizeof *params, params};
    if (!layers->kernel)
        return RT_OK;
    rt_status status = rt_kernel_args(layers->kernel, &first, 1, error);
    return status == RT_OK
               ? rt_launch(layers->renderer->device, layers->kernel, params->item_count, error)
               : status;
}

static size_t bytes_of(const rt_film *film)
{
    return RT_LAYER_COUNT * rt_film_pixels(film) * sizeof *film->layer_sums;
}

rt_status rt_first_hit_layers_write(const rt_first_hit_layers *layers, const rt_film *film,
                                    rt_error *error)
{
    return layers->kernel ? rt_buffer_write(layers->renderer->device, layers->sums, 0,
                                            bytes_of(film), film->layer_sums, error)
                          : RT_OK;
}

rt_status rt_first_hit_layers_read(const rt_first_hit_layers *layers, rt_film *film,
                                   rt_error *error)
{
    const size_t bytes = bytes_of(film);
    return layers->kernel ? rt_buffer_read(layers->renderer->device, layers->sums, 0, bytes,
                                           film->layer_sums, error)
                          : RT_OK;
}

/* ---- In the film ------------------------------------------------------------ */

/* How a channel is computed from its sums. */
typedef enum rule {
    MEAN,         /* over the film's divisor: the sum of the filter's weights */
    MEAN_OF_HITS, /* over the number of samples that hit; 0 without any */
    FIRST_ID      /* that of one sample; -1 without any */
} rule;

/* The sums that a layer is made from: channels from `channel` on of one of RT_LAYER_COUNT. */
typedef struct source {
    rt_film_layer_id layer;
    rt_u32 sums;
    uint32_t channel;
    rule rule;
} source;

static const source sources[] = {
    {RT_FILM_ALBEDO, RT_LAYER_ALBEDO, 0, MEAN},
    {RT_FILM_NORMAL, RT_LAYER_NORMAL, 0, MEAN},
    {RT_FILM_DEPTH, RT_LAYER_DEPTH, 0, MEAN_OF_HITS},
    {RT_FILM_POSITION, RT_LAYER_POSITION, 0, MEAN_OF_HITS},
    {RT_FILM_UV, RT_LAYER_UV, 0, MEAN_OF_HITS},
    {RT_FILM_SHAPE, RT_LAYER_IDS, 0, FIRST_ID},
    {RT_FILM_MATERIAL, RT_LAYER_IDS, 1, FIRST_ID},
};

/* The value of a channel of a pixel that has samples; hits: how many of them hit. */
static double value_of(const source *source, const rt_film_pixel *sums, uint32_t channel,
                       double hits)
{
    const int of = (int)(source->channel + channel);
    switch (source->rule) {
    case MEAN:
        return rt_film_sum(sums, of) / rt_film_divisor(sums->weight, sums->count);
    case MEAN_OF_HITS:
        return hits > 0 ? rt_film_sum(sums, of) / hits : 0;
    case FIRST_ID:
        return hits > 0 ? (double)sums->high[of] : -1;
    }
    return 0;
}

void rt_first_hit_layers_resolve(rt_film *film)
{
    size_t pixels = rt_film_pixels(film);
    if (!film->layer_sums)
        return;
    const rt_film_pixel *depth = film->layer_sums + RT_LAYER_DEPTH * pixels;
    for (size_t s = 0; s < sizeof sources / sizeof *sources; s++) {
        const rt_film_pixel *sums = film->layer_sums + sources[s].sums * pixels;
        uint32_t channels = rt_layer_infos[sources[s].layer].channels;
        float *layer = film->layers.data[sources[s].layer];
        for (size_t i = 0; i < channels * pixels; i++) {
            size_t pixel = i / channels;
            if (sums[pixel].count > 0)
                layer[i] = (float)value_of(sources + s, sums + pixel, (uint32_t)(i % channels),
                                           rt_film_sum(depth + pixel, 1));
        }
    }
}
