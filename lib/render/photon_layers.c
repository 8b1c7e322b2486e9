#include "render/photon_layers.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "error.h"

static const double pi = 3.14159265358979323846;

const char *const rt_photon_layer_names[RT_PHOTON_LAYERS] = {"photon.count", "photon.radius", "photon.density",
                                                             "photon.variance"};

rt_status rt_photon_layers_create(rt_photon_layer_sum **out, size_t pixels, rt_error *error)
{
    rt_photon_layer_sum *sums = calloc(pixels, sizeof *sums);
    if (!sums)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for the photon layers of %zu pixels", pixels);
    *out = sums;
    return RT_OK;
}

static double mean3(const float rgb[3])
{
    return ((double)rgb[0] + rgb[1] + rgb[2]) / 3;
}

void rt_photon_layers_add(rt_photon_layer_sum *sums, const rt_gather_point *points, const rt_gather_disc *discs,
                          size_t count, const rt_gather_point *caustics, size_t rows, size_t stride)
{
    for (size_t i = 0; i < count; i++) {
        rt_photon_layer_sum *sum = sums + points[i].pixel;
        double value = mean3(points[i].radiance), area = pi * discs[i].squared_radius;
        for (size_t row = 0; row < rows; row++)
            value += mean3(caustics[row * stride + i].radiance);
        if (isfinite(value)) {
            sum->samples++;
            sum->value += value;
            sum->square += value * value;
        }
        if (!discs[i].asked)
            continue;
        sum->asked++;
        sum->photons += discs[i].count;
        sum->radius += sqrt(discs[i].squared_radius);
        sum->density += area > 0 ? discs[i].count / area : 0;
    }
}

rt_status rt_photon_layers_resolve(rt_film *film, const rt_photon_layer_sum *sums, rt_error *error)
{
    size_t pixels = (size_t)film->options.width * film->options.height;
    film->photon_layers = calloc(RT_PHOTON_LAYERS * pixels, sizeof *film->photon_layers);
    if (!film->photon_layers)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for the photon layers of %zu pixels", pixels);
    for (size_t i = 0; i < pixels; i++) {
        const rt_photon_layer_sum *s = sums + i;
        double n = s->samples, spread = n > 1 ? (s->square - s->value * s->value / n) / (n - 1) : 0;
        float *layers = film->photon_layers + i;
        if (s->asked > 0) {
            layers[0] = (float)(s->photons / s->asked);
            layers[pixels] = (float)(s->radius / s->asked);
            layers[2 * pixels] = (float)(s->density / s->asked);
        }
        layers[3 * pixels] = (float)(spread > 0 ? spread / n : 0);
    }
    return RT_OK;
}
