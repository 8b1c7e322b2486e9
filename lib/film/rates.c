/* rates.c - finds how many samples pixels have. */
#include "film/rates.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "film/noise.h"

/* Pixels to each side that a rate is taken from; the part that is the same for all; the most. */
enum { REACH = 4 };
static const double even = 0.5, most = 8;

int rt_rates_are_known(const rt_film *film)
{
    return !film->rates || film->rates[0] > 0;
}

int rt_rates_are_needed(const rt_film *film, uint64_t unit)
{
    const rt_sample_block block = rt_units_block(&film->units, unit);
    return film->units.pilot > 0 && block.first + block.count > film->units.pilot;
}

int rt_rates_can_be_found(const rt_film *film)
{
    const rt_units *units = &film->units;
    const uint64_t pilot = rt_units_shared(units, units->pilot * units->replicates);
    return units->base == 0 && rt_coverage_prefix(&film->done) == pilot &&
           rt_coverage_units(&film->done) == pilot;
}

/* The mean of the variances around a pixel, its own left out. */
static double mean_around(const double *variances, uint32_t width, uint32_t height, uint32_t x,
                          uint32_t y)
{
    const uint32_t left = x < REACH ? 0 : x - REACH, top = y < REACH ? 0 : y - REACH;
    const uint32_t right = x + REACH < width ? x + REACH : width - 1;
    const uint32_t bottom = y + REACH < height ? y + REACH : height - 1;
    double sum = 0, count = 0;
    for (uint32_t j = top; j <= bottom; j++)
        for (uint32_t i = left; i <= right; i++)
            if (i != x || j != y) {
                sum += variances[(size_t)j * width + i];
                count++;
            }
    return count > 0 ? sum / count : 0;
}

/* Makes numbers of mean 1 of those in [0, inf); all 1 where they are all 0. */
static void normalize(double *numbers, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += numbers[i];
    for (size_t i = 0; i < count; i++)
        numbers[i] = sum > 0 ? numbers[i] / (sum / (double)count) : 1;
}

rt_status rt_rates_find(rt_film *film, const rt_film *pilot, rt_error *error)
{
    const uint32_t width = film->options.width, height = film->options.height;
    const size_t count = rt_film_pixels(film);
    double *const variances = rt_memory_alloc(film->memory, count, 2 * sizeof *variances,
                                              "the variances of pixels", error);
    if (!variances)
        return RT_ERROR_MEMORY;
    double *const rates = variances + count;
    for (size_t i = 0; i < count; i++) {
        float rgb[3];
        rt_noise_variance(rgb, pilot, i);
        const double variance = (double)rgb[0] + rgb[1] + rgb[2];
        variances[i] = variance < HUGE_VAL ? variance : 0;
    }
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++)
            rates[(size_t)y * width + x] = sqrt(mean_around(variances, width, height, x, y));
    normalize(rates, count);
    for (size_t i = 0; i < count; i++)
        rates[i] = fmin(even + (1 - even) * rates[i], most);
    normalize(rates, count);
    for (size_t i = 0; i < count; i++)
        film->rates[i] = (rt_u32)fmax(1, nearbyint(rates[i] * RT_RATE_UNIT));
    rt_memory_free(variances);
    return RT_OK;
}

rt_status rt_rates_join(rt_film *film, const rt_film *from, rt_error *error)
{
    if (!film->rates || !from->rates || from->rates[0] == 0)
        return RT_OK;
    const size_t bytes = rt_film_pixels(film) * sizeof *film->rates;
    if (film->rates[0] == 0)
        memcpy(film->rates, from->rates, bytes);
    else if (memcmp(film->rates, from->rates, bytes) != 0)
        return rt_fail(error, RT_ERROR_USAGE,
                       "the films share out their samples among the pixels by other rates");
    return RT_OK;
}
