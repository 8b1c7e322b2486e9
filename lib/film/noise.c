/* noise.c - sums of a film by replicate, and the error estimated from them. */
#include "film/noise.h"

#include <math.h>

#include "film/bias.h"
#include "film/student_t.h"

/* ---- The error -------------------------------------------------------------- */

/*
 * A channel of a pixel: its mean, its variance, and the contribution of each replicate to the
 * variance.
 */
typedef struct noise_value {
    double mean, variance, part[RT_REPLICATES];
} noise_value;

/* How many replicates have samples: in pixel 0, which is the first to get them. */
static uint32_t replicates_of(const rt_film *film)
{
    uint32_t replicates = 0;
    for (uint32_t r = 0; r < film->units.replicates; r++) {
        const rt_film_pixel *p = film->pixels + r * rt_film_pixels(film);
        replicates += p->count > 0 || p->bins >> RT_FILM_REJECTED > 0;
    }
    return replicates;
}

static noise_value value_of(const rt_film *film, size_t pixel, int channel)
{
    double sums[RT_REPLICATES], sum = 0, weight = 0, count = 0, replicates = 0;
    const rt_film_pixel *first = film->pixels + pixel;
    noise_value value = {0};

    for (uint32_t r = 0; r < film->units.replicates; r++) {
        const rt_film_pixel *p = first + r * rt_film_pixels(film);
        sums[r] = rt_film_sum(p, channel);
        sum += sums[r];
        weight += p->weight;
        count += p->count;
        replicates += p->count > 0;
    }
    const double divisor = rt_film_divisor(weight, count);
    if (replicates < 2)
        return value;
    value.mean = sum / divisor;
    for (uint32_t r = 0; r < film->units.replicates; r++) {
        const double z = (sums[r] - value.mean * first[r * rt_film_pixels(film)].weight) / divisor;
        value.part[r] = replicates / (replicates - 1) * z * z;
        value.variance += value.part[r];
    }
    return value;
}

/* Sums over the film; for each value, but for the squares. */
typedef struct noise_sums {
    double radiance, variance;
    double parts[RT_REPLICATES]; /* q_r */
    double squares;              /* of v_i, of each pixel */
} noise_sums;

static noise_sums sums_of(const rt_film *film)
{
    const size_t pixels = rt_film_pixels(film);
    noise_sums sums = {0};
    for (size_t i = 0; i < pixels; i++) {
        double of_pixel = 0;
        for (int c = 0; c < 3; c++) {
            const noise_value value = value_of(film, i, c);
            for (uint32_t r = 0; r < film->units.replicates; r++)
                sums.parts[r] += value.part[r];
            sums.radiance += value.mean;
            of_pixel += value.variance;
        }
        sums.variance += of_pixel;
        sums.squares += of_pixel * of_pixel;
    }
    return sums;
}

/* How far the logarithm of the mean squared error may be above that of its estimate. */
static double log_bound(const noise_sums *sums, uint32_t replicates)
{
    const double n = replicates, mean = sums->variance / n;
    double spread = 0;
    if (replicates == RT_REPLICATES_FEW)
        return RT_NORMAL_ONE_SIDE * sqrt(4.0 / 3 * sums->squares) / sums->variance;
    for (uint32_t r = 0; r < replicates; r++)
        spread += pow(sums->parts[r] / mean - 1, 2) / (n - 1);
    return rt_student_t_quantile(RT_NORMAL_ONE_SIDE, n - 1) * sqrt(spread * (1 + 1 / n));
}

/* The relative error, and its bound. */
static double relative_error(const rt_film *film, double *bound)
{
    const noise_sums sums = sums_of(film);
    const double values = 3 * (double)rt_film_pixels(film);
    /* Of a black picture nothing was measured. */
    *bound = INFINITY;
    if (sums.radiance == 0)
        return INFINITY;
    const double error = sqrt(sums.variance * values) / fabs(sums.radiance);
    if (replicates_of(film) == film->units.replicates)
        *bound = error > 0 ? error * exp(0.5 * log_bound(&sums, film->units.replicates)) : 0;
    return error;
}

rt_noise rt_noise_begin(uint32_t length)
{
    rt_noise noise = {.next_test = 1};
    while (noise.next_test < length)
        noise.next_test = rt_units_next_test(noise.next_test);
    return noise;
}

int rt_noise_is_due(const rt_noise *noise, uint32_t length)
{
    return length == noise->next_test;
}

int rt_noise_test(rt_noise *noise, const rt_film *film, uint32_t length, double target)
{
    if (replicates_of(film) < 2)
        return 0;
    noise->tested_at = length;
    noise->next_test = rt_units_next_test(length);
    noise->error = relative_error(film, &noise->bound);
    noise->bound = hypot(noise->bound, rt_film_find_bias(film).bound);
    /* A picture that is black so far may be so for ever. */
    return target > 0 && (noise->bound <= target || isinf(noise->error)) &&
           length >= RT_NOISE_FEWEST;
}

double rt_noise_last(const rt_noise *noise)
{
    return noise->tested_at && isfinite(noise->error) ? noise->error : -1;
}

double rt_noise_progress(const rt_noise *noise, double length, double target)
{
    if (noise->tested_at == 0 || target <= 0)
        return 0;
    /* The error falls with the root of the samples, or faster. */
    return fmin(pow(target / noise->bound, 2) * length / noise->tested_at, 1);
}

void rt_noise_variance(float rgb[3], const rt_film *film, size_t i)
{
    for (int c = 0; c < 3; c++)
        rgb[c] = (float)value_of(film, i, c).variance;
}

rt_status rt_noise_resolve(rt_film *film, rt_error *error)
{
    const uint32_t replicates = replicates_of(film);
    const size_t pixels = rt_film_pixels(film);
    rt_film_stats *stats = &film->stats;
    if (replicates < 2)
        return RT_OK;
    rt_status status = rt_film_layers_add(&film->layers, RT_LAYERS_ERROR, pixels, error);
    if (status != RT_OK)
        return status;
    for (size_t i = 0; i < pixels; i++)
        rt_noise_variance(film->layers.data[RT_FILM_VARIANCE] + 3 * i, film, i);
    stats->replicates = replicates;
    stats->interval_factor = rt_student_t_quantile(RT_NORMAL_BOTH_SIDES, replicates - 1.0);
    stats->relative_error = relative_error(film, &stats->relative_error_bound);
    return RT_OK;
}
