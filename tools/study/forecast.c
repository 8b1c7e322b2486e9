/* forecast.c - trial renders of a reference, and what they say of the time that it takes. */
#include "forecast.h"

#include <math.h>
#include <stdio.h>

#include "../message.h"

/* Samples of the first trial, and how many times as many the next has. */
enum { FIRST = 8, FACTOR = 4 };

/* A trial of so many seconds is the last: what is still unknown then takes far longer. */
static const double enough = 0.4;

/* The error falls with the samples at least to this power, and at most to that. */
static const double slowest = 0.3, fastest = 1.0;

typedef struct trial {
    double samples, seconds, error; /* error: the bound that ends a reference */
} trial;

static int run_trial(trial *out, rt_renderer *renderer, progress_display *progress,
                     const rt_render_options *reference, uint32_t samples)
{
    rt_render_options options = *reference;
    rt_film *film = NULL;
    rt_film_info info;
    rt_film_stats stats;
    options.spp = samples;
    options.target_error = 0;
    options.variance = 1;
    const rt_status result = rt_render(&film, renderer, &options, NULL);
    progress_clear(progress);
    if (result == RT_OK) {
        rt_film_get_info(film, &info);
        rt_film_get_stats(film, &stats);
        *out = (trial){samples, info.seconds,
                       isfinite(stats.relative_error_bound) ? stats.relative_error_bound
                                                            : stats.relative_error};
    }
    rt_film_destroy(film);
    return result == RT_OK;
}

/* The samples that a target takes, by the latest two trials; their errors may be infinite. */
static double samples_for(const trial *before, const trial *last, double target)
{
    if (last->error <= target)
        return last->samples;
    const double power = log(before->error / last->error) / log(last->samples / before->samples);
    return last->samples * pow(last->error / target, 1 / fmin(fmax(power, slowest), fastest));
}

void forecast_tell(rt_renderer *renderer, progress_display *progress, const char *label,
                   const rt_render_options *reference)
{
    trial before, last;
    char time[32], limit[128];
    uint32_t tried = FIRST;
    if (!run_trial(&last, renderer, progress, reference, tried))
        return;
    do {
        before = last;
        tried *= FACTOR;
        if (!run_trial(&last, renderer, progress, reference, tried))
            return;
    } while (last.seconds <= enough && last.error > reference->target_error &&
             tried * FACTOR <= reference->spp);
    const double needed = samples_for(&before, &last, reference->target_error);
    const double each = fmax(last.seconds - before.seconds, 0) / (last.samples - before.samples);
    const int is_short = needed > reference->spp;
    const double samples = is_short ? reference->spp : needed;
    if (is_short)
        snprintf(limit, sizeof limit, "which is its limit, with more than the error of %.3g %%",
                 100 * reference->target_error);
    else
        snprintf(limit, sizeof limit, "to an error of %.3g %%, or to its limit, %u samples",
                 100 * reference->target_error, (unsigned)reference->spp);
    progress_format_time(time, sizeof time, last.seconds + fmax(samples - last.samples, 0) * each);
    message_note("the %s is rendered by mode %s, in about %s and %.0f samples a pixel, %s; "
                 "--reference FILE takes an image, --reference-error E says how exact it is to be",
                 label, rt_mode_name(reference->mode), time, samples, limit);
}
