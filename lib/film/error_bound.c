/* error_bound.c - bias and noise of each pixel together. */
#include "film/error_bound.h"

#include <math.h>

rt_status rt_error_bound_resolve(rt_film *film, rt_error *error)
{
    const rt_film_stats *stats = &film->stats;
    const float *variance = film->layers.data[RT_FILM_VARIANCE];
    const size_t pixels = rt_film_pixels(film);
    if (stats->replicates < 2)
        return RT_OK;
    rt_status status = rt_film_layers_add(&film->layers, RT_LAYERS_BOUND, pixels, error);
    if (status != RT_OK)
        return status;
    const double ratio =
                     stats->relative_bias > 0 ? stats->relative_bias / stats->relative_error : 0,
                 factor = stats->interval_factor * hypot(1, ratio);
    for (size_t i = 0; i < 3 * pixels; i++)
        film->layers.data[RT_FILM_ERROR_BOUND][i] =
            (float)(isinf(factor) ? INFINITY : factor * sqrt(variance[i]));
    return RT_OK;
}
