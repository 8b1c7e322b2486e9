/* layers.c - sums of what was gathered, and the layers photon.count and so on. */
#include "mode/photon/layers.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

static double mean3(const float rgb[3])
{
    return ((double)rgb[0] + rgb[1] + rgb[2]) / 3;
}

/* Adds a sample of this value, and of this bias. */
static void add_sample(rt_photon_sums *sum, double value, double bias)
{
    if (!(isfinite(value) && isfinite(bias)))
        return;
    sum->samples++;
    rt_exact_sum_add(&sum->bias, bias);
    rt_exact_sum_add(&sum->value, value);
    rt_exact_sum_add(&sum->square, value * value);
}

void rt_photon_layers_add(rt_photon_sums *sums, const rt_gather_point *points,
                          const rt_gather_disc *discs, const double *biases, size_t count,
                          size_t split, const rt_gather_point *earlier, size_t rows, size_t stride)
{
    double value = 0, bias = 0;
    for (size_t i = 0; i < count; i++) {
        rt_photon_sums *sum = sums + points[i].pixel;
        const double area = pi * discs[i].squared_radius;
        value += mean3(points[i].radiance);
        bias += biases[i];
        for (size_t row = 0; row < rows; row++)
            value += mean3(earlier[row * stride + i].radiance);
        if (i % split == split - 1) {
            add_sample(sum, value, bias);
            value = bias = 0;
        }
        if (!discs[i].is_query)
            continue;
        sum->asked++;
        sum->photons += discs[i].count;
        rt_exact_sum_add(&sum->radius, sqrt(discs[i].squared_radius));
        rt_exact_sum_add(&sum->density, area > 0 ? discs[i].count / area : 0);
    }
}

/* The variance of the mean of the samples. */
static double variance_of(const rt_photon_sums *s)
{
    const double n = (double)s->samples, value = rt_exact_sum_value(&s->value),
                 square = rt_exact_sum_value(&s->square);
    const double variance = n > 1 ? (square - value * value / n) / (n - 1) : 0;
    return variance > 0 ? variance / n : 0;
}

float rt_photon_layer_value(const rt_photon_sums *s, int layer)
{
    const double n = (double)s->samples, asked = (double)s->asked;
    if (layer == RT_FILM_PHOTON_VARIANCE)
        return (float)variance_of(s);
    if (layer == RT_FILM_PHOTON_BIAS)
        return (float)(n > 0 ? rt_exact_sum_value(&s->bias) / n : 0);
    if (s->asked == 0)
        return 0;
    return (float)((layer == RT_FILM_PHOTON_COUNT    ? (double)s->photons
                    : layer == RT_FILM_PHOTON_RADIUS ? rt_exact_sum_value(&s->radius)
                                                     : rt_exact_sum_value(&s->density)) /
                   asked);
}

rt_status rt_photon_layers_resolve(rt_film *film, rt_error *error)
{
    const size_t pixels = rt_film_pixels(film);
    float **layers = film->layers.data;
    rt_status status = rt_film_layers_add(&film->layers, RT_LAYERS_PHOTON, pixels, error);
    if (status != RT_OK)
        return status;
    for (int layer = RT_FILM_PHOTON_COUNT; layer <= RT_FILM_PHOTON_BIAS; layer++)
        for (size_t i = 0; i < pixels; i++)
            layers[layer][i] = rt_photon_layer_value(film->photon_sums + i, layer);
    return RT_OK;
}
