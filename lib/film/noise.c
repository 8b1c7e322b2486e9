/* noise.c - sums of a film by replicate, and the error estimated from them. */
#include "film/noise.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "film/student_t.h"

/* Length of the replicates at the first test that can end a render. */
enum { fewest = 4 };

/* Pixels of the film that are read at a time. */
enum { pixels_a_read = 1 << 15 };

/* The sums of a pixel by replicate. */
typedef struct noise_pixel {
    float sum[RT_REPLICATES][3], weight[RT_REPLICATES];
} noise_pixel;

struct rt_noise {
    size_t count;
    uint32_t replicates;  /* that have samples */
    uint32_t samples;     /* of all replicates */
    uint32_t next_test;   /* when they have this length */
    double error, bound;  /* at the last test, */
    uint32_t tested_at;   /* when they had this length; 0 before */
    rt_film_pixel *fresh; /* [pixels_a_read] */
    noise_pixel pixels[];
};

int rt_noise_wanted(const rt_render_options *options)
{
    return options->variance || options->target_error > 0;
}

/* ---- Sums ------------------------------------------------------------------- */

rt_status rt_noise_create(rt_noise **out, size_t pixels, rt_memory *memory, rt_error *error)
{
    static const char what[] = "the variance of the film";
    rt_noise *noise =
        rt_memory_zeroed(memory, 1, sizeof *noise + pixels * sizeof *noise->pixels, what, error);
    if (noise)
        noise->fresh = rt_memory_alloc(memory, pixels_a_read, sizeof *noise->fresh, what, error);
    if (!noise || !noise->fresh) {
        rt_noise_destroy(noise);
        return RT_ERROR_MEMORY;
    }
    noise->count = pixels;
    noise->next_test = 1;
    *out = noise;
    return RT_OK;
}

void rt_noise_destroy(rt_noise *noise)
{
    if (noise)
        rt_memory_free(noise->fresh);
    rt_memory_free(noise);
}

rt_status rt_noise_read(rt_noise *noise, const rt_sample_range *range, rt_device *device,
                        cl_mem pixels, rt_film *film, rt_error *error)
{
    rt_status status = RT_OK;
    for (size_t first = 0, count; first < noise->count && status == RT_OK; first += count) {
        count = noise->count - first < pixels_a_read ? noise->count - first : pixels_a_read;
        status = rt_buffer_read(device, pixels, first * sizeof *film->pixels,
                                count * sizeof *film->pixels, noise->fresh, error);
        for (size_t i = 0; i < count && status == RT_OK; i++) {
            rt_film_pixel *before = film->pixels + first + i, *after = noise->fresh + i;
            noise_pixel *p = noise->pixels + first + i;
            for (int c = 0; c < 3; c++)
                p->sum[range->replicate][c] +=
                    (float)(rt_film_sum(after, c) - rt_film_sum(before, c));
            p->weight[range->replicate] += after->weight - before->weight;
            *before = *after;
        }
    }
    noise->samples += range->count;
    if (range->replicate >= noise->replicates)
        noise->replicates = range->replicate + 1;
    return status;
}

/* ---- The error -------------------------------------------------------------- */

/*
 * A channel of a pixel: its mean, its variance, and the contribution of each replicate to the
 * variance.
 */
typedef struct noise_value {
    double mean, variance, part[RT_REPLICATES];
} noise_value;

static noise_value value_of(const rt_noise *noise, size_t pixel, int channel)
{
    const noise_pixel *p = noise->pixels + pixel;
    rt_film_pixel all = {.count = noise->samples};
    double sum = 0, replicates = noise->replicates;
    noise_value value = {0};

    for (uint32_t r = 0; r < noise->replicates; r++) {
        sum += p->sum[r][channel];
        all.weight += p->weight[r];
    }
    double divisor = rt_film_divisor(&all);
    value.mean = sum / divisor;
    for (uint32_t r = 0; r < noise->replicates; r++) {
        double z = (p->sum[r][channel] - value.mean * p->weight[r]) / divisor;
        value.part[r] = replicates / (replicates - 1) * z * z;
        value.variance += value.part[r];
    }
    return value;
}

/* The relative error, and its bound. parts[r] is q_r of noise.h. */
static double relative_error(const rt_noise *noise, double *bound)
{
    double parts[RT_REPLICATES] = {0}, radiance = 0, variance = 0, spread = 0,
           replicates = noise->replicates;
    double values = 3.0 * (double)noise->count;
    for (size_t i = 0; i < 3 * noise->count; i++) {
        noise_value value = value_of(noise, i / 3, (int)(i % 3));
        for (uint32_t r = 0; r < noise->replicates; r++)
            parts[r] += value.part[r] / values;
        radiance += value.mean / values;
    }
    for (uint32_t r = 0; r < noise->replicates; r++)
        variance += parts[r];
    for (uint32_t r = 0; r < noise->replicates; r++)
        spread += pow(parts[r] - variance / replicates, 2) / (replicates - 1);
    double t = rt_student_t_quantile(RT_NORMAL_ONE_SIDE, replicates - 1);
    double error = variance > 0 ? sqrt(variance) / fabs(radiance) : 0;
    double deviation = variance > 0 ? sqrt(spread) * replicates / variance : 0;
    *bound = noise->replicates < RT_REPLICATES
                 ? INFINITY
                 : error * exp(0.5 * t * deviation * sqrt(1 + 1 / replicates));
    return error;
}

int rt_noise_test(rt_noise *noise, uint32_t length, double target)
{
    if (length != noise->next_test || noise->replicates < 2)
        return 0;
    noise->tested_at = length;
    noise->next_test = rt_replicate_grow(length);
    noise->error = relative_error(noise, &noise->bound);
    return target > 0 && noise->bound <= target && length >= fewest;
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

rt_status rt_noise_resolve(const rt_noise *noise, rt_film *film, rt_error *error)
{
    rt_film_stats *stats = &film->stats;
    if (noise->replicates < 2)
        return RT_OK;
    rt_status status = rt_film_layers_add(&film->layers, RT_LAYERS_ERROR, noise->count, error);
    if (status != RT_OK)
        return status;
    for (size_t i = 0; i < 3 * noise->count; i++)
        film->layers.data[RT_FILM_VARIANCE][i] =
            (float)value_of(noise, i / 3, (int)(i % 3)).variance;
    stats->replicates = noise->replicates;
    stats->interval_factor = rt_student_t_quantile(RT_NORMAL_BOTH_SIDES, noise->replicates - 1.0);
    stats->relative_error = relative_error(noise, &stats->relative_error_bound);
    return RT_OK;
}
