/* preview.c - what a film shows before its render has ended, made without a change of it. */
#include <string.h>
#include <unistd.h>

#include "base/error.h"
#include "base/parallel.h"
#include "film/noise.h"
#include "mode/modes.h"
#include "mode/photon/layers.h"

/* Pixels that a thread makes at a time, and the most threads. */
enum { BAND = 8192, THREADS_MAX = 16 };

/* In place of a layer: the radiance. */
enum { RADIANCE = -1 };

typedef struct preview {
    const rt_film *film;
    const rt_mode_class *mode;
    int layer;
    uint32_t channels;
    float *out;
} preview;

static int has_group(const rt_film *film, rt_layer_group group)
{
    switch (group) {
    case RT_LAYERS_FIRST_HIT:
        return film->first_hits != NULL;
    case RT_LAYERS_ERROR:
        return rt_noise_wanted(&film->options);
    case RT_LAYERS_DENOISED: /* of whole pictures alone, as the other */
    case RT_LAYERS_BOUND:
        return 0;
    case RT_LAYERS_PHOTON:
        return film->photon_sums != NULL;
    }
    return 0;
}

static void show_radiance(float rgb[3], const preview *p, size_t i)
{
    if (!p->mode->show)
        rt_film_mean(rgb, p->film, i);
    else if (p->film->first_hits && p->film->first_hits[i].count > 0)
        p->mode->show(rgb, p->film->first_hits + i);
    else
        memset(rgb, 0, 3 * sizeof *rgb);
}

static void show_pixel(float *out, const preview *p, size_t i)
{
    if (p->layer == RADIANCE) {
        show_radiance(out, p, i);
        return;
    }
    switch (rt_layer_infos[p->layer].group) {
    case RT_LAYERS_FIRST_HIT:
        rt_first_hit_layer_value(out, p->film->first_hits + i, p->layer);
        break;
    case RT_LAYERS_ERROR:
        rt_noise_variance(out, p->film, i);
        break;
    case RT_LAYERS_DENOISED:
    case RT_LAYERS_BOUND:
        break;
    case RT_LAYERS_PHOTON:
        *out = rt_photon_layer_value(p->film->photon_sums + i, p->layer);
        break;
    }
}

static void show_band(void *user, uint32_t band)
{
    const preview *p = user;
    const size_t pixels = rt_film_pixels(p->film), first = (size_t)band * BAND;
    const size_t end = pixels - first < BAND ? pixels : first + BAND;
    for (size_t i = first; i < end; i++)
        show_pixel(p->out + p->channels * i, p, i);
}

/* The layer of a name that a film has or will have, RADIANCE for NULL; RT_FILM_LAYER_COUNT: none.
 */
static int find(const rt_film *film, const char *name)
{
    int layer = name ? 0 : RADIANCE;
    while (layer >= 0 && layer < RT_FILM_LAYER_COUNT &&
           (strcmp(name, rt_layer_infos[layer].name) != 0 ||
            !has_group(film, rt_layer_infos[layer].group)))
        layer++;
    return layer;
}

const char *rt_film_preview_name(const rt_film *film, size_t index)
{
    for (int i = 0; i < RT_FILM_LAYER_COUNT; i++)
        if (has_group(film, rt_layer_infos[i].group) && index-- == 0)
            return rt_layer_infos[i].name;
    return NULL;
}

rt_status rt_film_preview(float *out, const rt_film *film, const char *layer, uint32_t *channels,
                          rt_error *error)
{
    if (rt_is_missing(film, "film", error))
        return RT_ERROR_USAGE;
    preview p = {film, rt_mode_class_of(film->options.mode), find(film, layer), 3, out};
    if (p.layer == RT_FILM_LAYER_COUNT)
        return rt_fail(error, RT_ERROR_USAGE, "the film has no layer '%.64s'", layer);
    if (p.layer != RADIANCE)
        p.channels = rt_layer_infos[p.layer].channels;
    if (channels)
        *channels = p.channels;
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    const uint32_t threads = cores < 1 ? 1 : cores < THREADS_MAX ? (uint32_t)cores : THREADS_MAX;
    if (out)
        rt_parallel(threads, (uint32_t)((rt_film_pixels(film) + BAND - 1) / BAND), show_band, &p);
    return RT_OK;
}
