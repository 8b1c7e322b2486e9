/* error_bound.c - bias and noise of each pixel together. */
#include "film/error_bound.h"

#include <math.h>

#include "film/student_t.h"

/* B^2, of the mean radiance over all pixels and channels. */
static double squared_bias(const rt_film *film)
{
    const size_t values = 3 * rt_film_pixels(film);
    double radiance = 0;
    for (size_t i = 0; i < values; i++)
        radiance += film->rgb[i];
    return pow(film->stats.relative_bias * radiance / (double)values, 2);
}

static double bound_of(double variance, double squared_bias, double freedom)
{
    const double both = variance + squared_bias, part = variance / both;
    if (!(both > 0) || isinf(both))
        return both;
    return rt_student_t_quantile(RT_NORMAL_BOTH_SIDES, freedom / (part * part)) * sqrt(both);
}

rt_status rt_error_bound_resolve(rt_film *film, rt_error *error)
{
    const uint32_t replicates = film->stats.replicates;
    const float *variance = film->layers.data[RT_FILM_VARIANCE];
    const size_t pixels = rt_film_pixels(film);
    if (replicates < 2)
        return RT_OK;
    rt_status status = rt_film_layers_add(&film->layers, RT_LAYERS_BOUND, pixels, error);
    if (status != RT_OK)
        return status;
    const double squared = squared_bias(film);
    for (size_t i = 0; i < 3 * pixels; i++)
        film->layers.data[RT_FILM_ERROR_BOUND][i] =
            (float)bound_of(variance[i], squared, replicates - 1.0);
    return RT_OK;
}
