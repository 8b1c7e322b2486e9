/* layers.c - launches the kernel first_hit beside a mode, and makes the layers from its sums. */
#include "mode/first_hit/layers.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "render/prepare.h"

/* ---- On the device ---------------------------------------------------------- */

static size_t bytes_of(const rt_film *film)
{
    return rt_film_pixels(film) * sizeof *film->first_hits;
}

rt_status rt_first_hit_layers_prepare(rt_first_hit_layers *out, rt_renderer *renderer,
                                      rt_film *film, rt_stage_progress *progress, rt_error *error)
{
    const char *name = RT_PROGRAM_OF(renderer, "first_hit");
    rt_params none;
    memset(&none, 0, sizeof none);

    out->renderer = renderer;
    out->device = renderer->device;
    rt_status status = rt_film_make_first_hits(film, error);
    if (status == RT_OK)
        status = rt_mirror_create(renderer->device, &out->sums, bytes_of(film), film->first_hits,
                                  "the buffer of the film's layers", error);
    rt_arg args[] = {RT_ARG(none), RT_ARG(renderer->scene), RT_ARG(out->sums)};
    if (status == RT_OK)
        status =
            rt_kernel_prepare(renderer->device, &out->kernel, name, name, args, 3, progress, error);
    return status;
}

void rt_first_hit_layers_release(rt_first_hit_layers *layers)
{
    if (layers->device)
        rt_device_settle(layers->device); /* it may work on the film in place */
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

rt_status rt_first_hit_layers_write(const rt_first_hit_layers *layers, const rt_film *film,
                                    rt_error *error)
{
    return layers->kernel ? rt_mirror_write(layers->device, layers->sums, bytes_of(film),
                                            film->first_hits, error)
                          : RT_OK;
}

rt_status rt_first_hit_layers_read(const rt_first_hit_layers *layers, rt_film *film,
                                   rt_error *error)
{
    return layers->kernel ? rt_mirror_read(layers->device, layers->sums, bytes_of(film),
                                           film->first_hits, error)
                          : RT_OK;
}

/* ---- In the film ------------------------------------------------------------ */

/* How a channel is computed from the sums of a pixel that has samples. */
typedef enum rule {
    FIXED, /* the mean of what lies in [-1, 1], over the film's divisor: the sum of weights */
    HITS,  /* the mean over the samples that hit; 0 without any */
    SHAPE, /* ids of one sample; -1 without any */
    MATERIAL
} rule;

/* The sums that a layer is made from: channels from `first` on. */
typedef struct source {
    rt_film_layer_id layer;
    rule rule;
    int first;
} source;

static const source sources[] = {
    {RT_FILM_ALBEDO, FIXED, 0},          {RT_FILM_NORMAL, FIXED, 3},
    {RT_FILM_DEPTH, HITS, RT_HIT_DEPTH}, {RT_FILM_POSITION, HITS, RT_HIT_POSITION},
    {RT_FILM_UV, HITS, RT_HIT_UV},       {RT_FILM_SHAPE, SHAPE, 0},
    {RT_FILM_MATERIAL, MATERIAL, 0},
};

static double value_of(rule rule, const rt_first_hits *sums, int channel)
{
    const int64_t *fixed = channel < 3 ? sums->albedo + channel : sums->normal + (channel - 3);
    switch (rule) {
    case FIXED:
        return (double)*fixed / RT_FIRST_HIT_UNIT / rt_film_divisor(sums->weight, sums->count);
    case HITS:
        return sums->hits > 0 ? rt_first_hits_sum(sums, channel) / sums->hits : 0;
    case SHAPE:
        return sums->hits > 0 ? (double)sums->shape : -1;
    case MATERIAL:
        return sums->hits > 0 ? (double)sums->material : -1;
    }
    return 0;
}

void rt_first_hit_layer_value(float *out, const rt_first_hits *sums, int layer)
{
    const source *from = sources;
    while ((int)from->layer != layer)
        from++;
    for (int c = 0; c < (int)rt_layer_infos[layer].channels; c++)
        out[c] = sums->count > 0 ? (float)value_of(from->rule, sums, from->first + c) : 0;
}

void rt_first_hit_layers_resolve(rt_film *film)
{
    size_t pixels = rt_film_pixels(film);
    if (!film->first_hits)
        return;
    for (size_t s = 0; s < sizeof sources / sizeof *sources; s++) {
        const rt_film_layer_id id = sources[s].layer;
        for (size_t i = 0; i < pixels; i++)
            rt_first_hit_layer_value(film->layers.data[id] + rt_layer_infos[id].channels * i,
                                     film->first_hits + i, (int)id);
    }
}
