/* render_say.c - tells a person what became of a render. */
#include "render_say.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "message.h"
#include "recorded.h"

/* "a", "a and b", "a, b and c". */
static void join_outputs(char *out, size_t size, const output_list *outputs)
{
    out[0] = '\0';
    for (size_t i = 0; i < outputs->count; i++) {
        size_t used = strlen(out);
        const char *before = i == 0 ? "" : i + 1 == outputs->count ? " and " : ", ";
        snprintf(out + used, size - used, "%s%s", before, outputs->paths[i]);
    }
}

/* Whether pixels have different numbers of samples. */
static int is_adaptive(const rt_render_options *o)
{
    return o->sampling == RT_SAMPLING_ADAPTIVE &&
           (o->mode == RT_MODE_PATH || o->mode == RT_MODE_DIRECT);
}

void render_say_written(const render_job *job, int interrupted)
{
    char names[1024], seconds[32], part[64] = "", samples[64];
    uint32_t width, height;
    rt_film_stats stats;
    rt_film_info info;
    rt_film_get_stats(job->film, &stats);
    rt_film_get_info(job->film, &info);
    rt_film_get_size(job->film, &width, &height);
    join_outputs(names, sizeof names, &job->outputs);
    snprintf(samples, sizeof samples, "%u sample%s a pixel%s", (unsigned)stats.spp,
             stats.spp == 1 ? "" : "s", is_adaptive(&job->options) ? " on average" : "");
    if (job->parts > 1) {
        snprintf(part, sizeof part, "part %u of %u, ", (unsigned)job->part, (unsigned)job->parts);
        snprintf(samples, sizeof samples, "%.4g samples a pixel on average",
                 info.done * info.samples);
    }
    /* A film adds up the time of all devices, which pass theirs side by side. */
    const int is_shared = job->crew.count > 1 || job->session.arguments->team;
    progress_format_time(seconds, sizeof seconds, is_shared ? job->seconds : info.seconds);
    message_note("%swrote %s: %s%u x %u, %s, rendered in %s", interrupted ? "interrupted; " : "",
                 names, part, (unsigned)width, (unsigned)height, samples, seconds);
}

/* Whether mode vcm merged vertices, which has a bias. */
static int has_merged(const rt_render_options *o)
{
    return o->mode == RT_MODE_VCM &&
           (o->techniques == RT_TECHNIQUES_VCM || o->techniques == RT_TECHNIQUES_BPM ||
            o->techniques == RT_TECHNIQUES_MERGING);
}

/* The relative error, and what it is below, if that is known. */
static void say_error(const rt_film_stats *stats, const rt_render_options *options)
{
    const int is_photon = options->mode == RT_MODE_PHOTON;
    char bound[64];
    if (isinf(stats->relative_error)) {
        message_note("relative error unknown: the picture is black");
        return;
    }
    if (isfinite(stats->relative_error_bound))
        snprintf(bound, sizeof bound, "below %.3g %% with 95 %% confidence",
                 100.0 * stats->relative_error_bound);
    else
        snprintf(bound, sizeof bound, "without a bound, which takes 8 %s",
                 is_photon ? "passes" : "samples a pixel");
    message_note("relative error %.3g %%, %s (root mean square over mean radiance%s)",
                 100.0 * stats->relative_error, bound,
                 is_photon             ? "; of the noise alone, not of the bias of gathering"
                 : has_merged(options) ? "; of the noise alone, not of the bias of merging"
                                       : "");
}

/*
 * Of progressive photon passes and of merging; the noise where the line before does not tell it
 * better. Of a bias that noise hides, below 1.645 standard errors of its square, the bound is all
 * that is known.
 */
static void say_bias(const rt_film_stats *stats, const char *what)
{
    char noise[64] = "", bias[32] = "";
    if (stats->replicates == 0)
        snprintf(noise, sizeof noise, ", noise about %.3g %%", 100.0 * stats->relative_noise);
    if (pow(stats->relative_bias_bound, 2) < 2 * pow(stats->relative_bias, 2))
        snprintf(bias, sizeof bias, "%.3g %%, ", 100.0 * stats->relative_bias);
    message_note("bias of %s at surfaces %sbelow %.3g %% with 95 %% confidence%s (root mean square "
                 "over mean radiance)",
                 what, bias, 100.0 * stats->relative_bias_bound, noise);
}

/*
 * Where the camera gathers from few of the photon paths, and importance would make them five times
 * as many: less pays for the longer paths seldom (dsl/reference.md). Of one map with a fixed k more
 * photons lower the bias alone.
 */
static void say_paths_seen(const rt_film_stats *stats, const rt_render_options *options)
{
    const double seen = stats->paths_seen, by_importance = stats->paths_seen_by_importance;
    const int has_no_passes = options->area == RT_AREA_HULL || options->gather == RT_GATHER_FLANN ||
                              options->irradiance_step > 0;
    if (options->photon_importance || has_no_passes || seen <= 0 || by_importance < 5 * seen)
        return;
    message_note("the camera gathers photons of about %.2g %% of the photon paths", 100 * seen);
    message_hint("with %s--photon-importance it would be about %.2g %%, in up to twice the time: "
                 "this pays where most of the noise is that of photons",
                 options->passes > 1 ? "" : "--passes 32 and ", 100 * by_importance);
}

/* What target_error is about. */
static double bound_of(const rt_film_stats *stats)
{
    return stats->replicates > 0 ? hypot(stats->relative_error_bound, stats->relative_bias_bound)
                                 : INFINITY;
}

void render_say_error(const render_job *job)
{
    double target = job->options.target_error;
    const char *what = job->options.mode == RT_MODE_VCM ? "merging" : "gathering";
    rt_film_stats stats;
    rt_film_get_stats(job->film, &stats);
    if (stats.rejected > 0)
        message_warning("samples left out because they were not finite: %llu",
                        (unsigned long long)stats.rejected);
    if (stats.replicates > 0)
        say_error(&stats, &job->options);
    if (stats.relative_bias_bound > 0 && isfinite(stats.relative_bias_bound))
        say_bias(&stats, what);
    else if (isinf(stats.relative_bias_bound) && isfinite(stats.relative_noise))
        message_warning("the bias of %s is unknown, and large: discs are larger than what is lit; "
                        "lower `radius`",
                        what);
    say_paths_seen(&stats, &job->options);
    if (target > 0.0 && !(bound_of(&stats) <= target))
        message_warning("the target error of %.3g %% was not reached", 100.0 * target);
}

/* A single map is gathered only once it is whole. */
void render_say_nothing(const rt_render_options *options)
{
    message_note("interrupted before the first sample; nothing was written");
    if (options->mode == RT_MODE_PHOTON && options->passes < 2 && !options->photon_map &&
        !options->resume)
        message_hint("with --passes N each pass emits photons and adds to the picture, so that an "
                     "interrupt loses one pass; `rtc photons SCENE --out MAP.rtp` keeps photons in "
                     "a file");
}

void render_say_left(const render_job *job)
{
    char word[RECORDED_WORD_SIZE];
    rt_film_info info = {0};
    const double part =
        job->film && job->parts > 1 ? rt_film_part_done(job->film, job->part, job->parts) : 1;
    if (job->film)
        rt_film_get_info(job->film, &info);
    if (part < 1)
        message_note("%.3g %% of part %u of %u is done", 100 * part, (unsigned)job->part,
                     (unsigned)job->parts);
    else if (job->film && job->parts > 1 && info.units_done == 0)
        message_warning("part %u of %u is empty: the picture has fewer pieces of work",
                        (unsigned)job->part, (unsigned)job->parts);
    if (job->checkpoint.saved > 0 && (!job->film || info.units_done < info.units))
        message_note("`rtc --resume %s` goes on", recorded_word(word, job->checkpoint.path));
}
