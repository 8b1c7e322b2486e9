#include "render/noise.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "render/replicates.h"
#include "render/student.h"

/* Length of the replicates at the first look that can end a render. */
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
    uint32_t next_look;   /* when they have this length */
    double error, bound;  /* at the last look, */
    uint32_t looked_at;   /* when they had this length; 0 before */
    rt_film_pixel *fresh; /* [pixels_a_read] */
    noise_pixel pixels[];
};

/* ---- Options ------------------------------------------------------------------ */

int rt_noise_wanted(const rt_render_options *options)
{
    return options->variance || options->target_error > 0;
}

rt_status rt_noise_check(const rt_render_options *o, rt_error *error)
{
    const char *field = o->target_error > 0 ? "target_error" : "variance";
    if (!rt_noise_wanted(o))
        return RT_OK;
    if (o->mode == RT_MODE_PHOTON && o->passes < 2)
        return rt_fail_field(
            error, RT_ERROR_USAGE, field,
            "the samples of one photon map share its photons, so that they cannot tell its error; "
            "give passes");
    if (o->mode != RT_MODE_PHOTON && o->mode != RT_MODE_PATH && o->mode != RT_MODE_DIRECT)
        return rt_fail_field(
            error, RT_ERROR_USAGE, field,
            "the error is that of light, and mode %s shows none (path, photon and direct do)",
            rt_mode_name(o->mode));
    if (o->mode != RT_MODE_PHOTON && o->spp < 2)
        return rt_fail_field(error, RT_ERROR_USAGE, field,
                             "one sample a pixel cannot tell its error");
    return RT_OK;
}

/* ---- Sums ----------------------------------------------------------------------- */

rt_status rt_noise_create(rt_noise **out, size_t pixels, rt_error *error)
{
    rt_noise *noise = calloc(1, sizeof *noise + pixels * sizeof *noise->pixels);
    if (noise)
        noise->fresh = malloc(pixels_a_read * sizeof *noise->fresh);
    if (!noise || !noise->fresh) {
        rt_noise_destroy(noise);
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for the variance of %zu pixels",
                       pixels);
    }
    noise->count = pixels;
    noise->next_look = 1;
    *out = noise;
    return RT_OK;
}

void rt_noise_destroy(rt_noise *noise)
{
    if (noise)
        free(noise->fresh);
    free(noise);
}

static double sum_of(const rt_film_pixel *pixel, int channel)
{
    return (double)pixel->sum[channel] - pixel->lost[channel];
}

rt_status rt_noise_read(rt_noise *noise, const rt_stretch *stretch, rt_device *device,
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
                p->sum[stretch->replicate][c] += (float)(sum_of(after, c) - sum_of(before, c));
            p->weight[stretch->replicate] += after->weight - before->weight;
            *before = *after;
        }
    }
    noise->samples += stretch->count;
    if (stretch->replicate >= noise->replicates)
        noise->replicates = stretch->replicate + 1;
    return status;
}

/* ---- What they tell ------------------------------------------------------------------- */

/*
 * A channel of a pixel by the replicates: its mean, its variance, and the part that each has in
 * that.
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

/* The relative error, and its bound. The parts of the replicates are q of the header by R^2. */
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
    double t = rt_student_quantile(RT_NORMAL_ONE_SIDE, replicates - 1);
    double error = variance > 0 ? sqrt(variance) / fabs(radiance) : 0;
    double deviation = variance > 0 ? sqrt(spread) * replicates / variance : 0;
    *bound = noise->replicates < RT_REPLICATES
                 ? INFINITY
                 : error * exp(0.5 * t * deviation * sqrt(1 + 1 / replicates));
    return error;
}

int rt_noise_look(rt_noise *noise, uint32_t length, double target)
{
    if (length != noise->next_look || noise->replicates < 2)
        return 0;
    noise->looked_at = length;
    noise->next_look = rt_replicate_grow(length);
    noise->error = relative_error(noise, &noise->bound);
    return target > 0 && noise->bound <= target && length >= fewest;
}

double rt_noise_last(const rt_noise *noise)
{
    return noise->looked_at && isfinite(noise->error) ? noise->error : -1;
}

double rt_noise_progress(const rt_noise *noise, double length, double target)
{
    if (noise->looked_at == 0 || target <= 0)
        return 0;
    /* The error falls with the root of the samples, or faster. */
    return fmin(pow(target / noise->bound, 2) * length / noise->looked_at, 1);
}

rt_status rt_noise_resolve(const rt_noise *noise, rt_film *film, rt_error *error)
{
    rt_film_stats *stats = &film->stats;
    if (noise->replicates < 2)
        return RT_OK;
    rt_status status = rt_film_add_layers(film, RT_FILM_VARIANCE, RT_FILM_VARIANCE, error);
    if (status != RT_OK)
        return status;
    for (size_t i = 0; i < 3 * noise->count; i++)
        film->layers[RT_FILM_VARIANCE][i] = (float)value_of(noise, i / 3, (int)(i % 3)).variance;
    stats->replicates = noise->replicates;
    stats->interval_factor = rt_student_quantile(RT_NORMAL_BOTH_SIDES, noise->replicates - 1.0);
    stats->relative_error = relative_error(noise, &stats->relative_error_bound);
    return RT_OK;
}
