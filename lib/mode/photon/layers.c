/* layers.c - sums of what was gathered, and the layers photon.count and so on. */
#include "mode/photon/layers.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"

static const double pi = 3.14159265358979323846;

rt_status rt_photon_layers_create(rt_photon_layer_sum **out, size_t pixels, rt_memory *memory,
                                  rt_error *error)
{
    rt_photon_layer_sum *sums =
        rt_memory_zeroed(memory, pixels, sizeof *sums, "the list of sums of photon layers", error);
    if (!sums)
        return RT_ERROR_MEMORY;
    *out = sums;
    return RT_OK;
}

static double mean3(const float rgb[3])
{
    return ((double)rgb[0] + rgb[1] + rgb[2]) / 3;
}

void rt_photon_layers_add(rt_photon_layer_sum *sums, const rt_gather_point *points,
                          const rt_gather_disc *discs, const double *biases, size_t count,
                          const rt_gather_point *earlier, size_t rows, size_t stride)
{
    for (size_t i = 0; i < count; i++) {
        rt_photon_layer_sum *sum = sums + points[i].pixel;
        double value = mean3(points[i].radiance), area = pi * discs[i].squared_radius;
        for (size_t row = 0; row < rows; row++)
            value += mean3(earlier[row * stride + i].radiance);
        if (isfinite(value) && isfinite(biases[i])) {
            sum->samples++;
            sum->bias += biases[i];
            sum->value += value;
            sum->square += value * value;
        }
        if (!discs[i].is_query)
            continue;
        sum->asked++;
        sum->photons += discs[i].count;
        sum->radius += sqrt(discs[i].squared_radius);
        sum->density += area > 0 ? discs[i].count / area : 0;
    }
}

rt_status rt_photon_layers_resolve(rt_film *film, const rt_photon_layer_sum *sums, rt_error *error)
{
    size_t pixels = rt_film_pixels(film);
    float **layers = film->layers.data;
    rt_status status = rt_film_layers_add(&film->layers, RT_LAYERS_PHOTON, pixels, error);
    if (status != RT_OK)
        return status;
    for (size_t i = 0; i < pixels; i++) {
        const rt_photon_layer_sum *s = sums + i;
        double n = s->samples,
               variance = n > 1 ? (s->square - s->value * s->value / n) / (n - 1) : 0;
        if (s->asked > 0) {
            layers[RT_FILM_PHOTON_COUNT][i] = (float)(s->photons / s->asked);
            layers[RT_FILM_PHOTON_RADIUS][i] = (float)(s->radius / s->asked);
            layers[RT_FILM_PHOTON_DENSITY][i] = (float)(s->density / s->asked);
        }
        layers[RT_FILM_PHOTON_VARIANCE][i] = (float)(variance > 0 ? variance / n : 0);
        layers[RT_FILM_PHOTON_BIAS][i] = (float)(n > 0 ? s->bias / n : 0);
    }
    return RT_OK;
}
