/* join.c - films of the same picture, compared and added. */
#include "film/rates.h"
#include "film/join.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "camera/film_sum.h"
#include "film/noise.h"

/* ---- The same picture --------------------------------------------------------- */

/* Settings that may differ between a film and the one that continues it. */
static int may_differ(const char *name, int is_continued)
{
    static const char *const names[] = {"time", "spp", "passes", "target_error"};
    const size_t count = is_continued ? sizeof names / sizeof *names : 1;
    for (size_t i = 0; i < count; i++)
        if (strcmp(name, names[i]) == 0)
            return 1;
    return 0;
}

/* Fails where two films differ in a setting. */
static rt_status compare_setting(const rt_film *a, const rt_film *b, const rt_setting *setting,
                                 int is_continued, rt_error *error)
{
    char x[64], y[64];
    rt_setting_get(x, sizeof x, setting, &a->options);
    rt_setting_get(y, sizeof y, setting, &b->options);
    if (strcmp(x, y) == 0 || may_differ(setting->field.name, is_continued))
        return RT_OK;
    return rt_fail_field(error, RT_ERROR_USAGE, setting->field.name,
                         is_continued ? "%s is %s, and %s in the film to be continued"
                                      : "%s is %s in one film and %s in the other",
                         setting->field.name, x, y);
}

/* A picture of another size is another one. */
static rt_status fail_scene(const rt_film *a, const rt_film *b, rt_error *error)
{
    static const char text[] = "the film is of another scene, or of this one before it was changed";
    const rt_render_options *x = &a->options, *y = &b->options;
    if (x->width == y->width && x->height == y->height)
        return rt_fail(error, RT_ERROR_USAGE, "%s", text);
    return rt_fail(error, RT_ERROR_USAGE, "%s; it has %u x %u pixels, not %u x %u", text, y->width,
                   y->height, x->width, x->height);
}

/*
 * Fails where two films are of different scenes or have different settings; others follow from the
 * mode, which goes first.
 */
static rt_status compare_settings(const rt_film *a, const rt_film *b, int is_continued,
                                  rt_error *error)
{
    size_t count;
    const rt_setting *settings = rt_settings(&count);
    rt_status status = compare_setting(a, b, rt_setting_find("mode"), is_continued, error);
    if (status == RT_OK && a->scene != b->scene)
        status = fail_scene(a, b, error);
    for (size_t i = 0; i < count && status == RT_OK; i++)
        status = compare_setting(a, b, settings + i, is_continued, error);
    return status;
}

/* Fails where two films are not of the same picture. */
static rt_status compare(const rt_film *a, const rt_film *b, int is_continued, rt_error *error)
{
    rt_status status = compare_settings(a, b, is_continued, error);
    if (status != RT_OK)
        return status;
    if (a->light != b->light)
        return rt_fail(error, RT_ERROR_USAGE,
                       "the film was made with another photon map, or with other light shares");
    if (a->units.replicates != b->units.replicates)
        return rt_fail_field(error, RT_ERROR_USAGE, "target_error",
                             "the film has %u sequence%s of samples, for which target_error must "
                             "be %s",
                             b->units.replicates, b->units.replicates == 1 ? "" : "s",
                             b->units.replicates == 1 ? "off" : "on");
    return RT_OK;
}

/* ---- Sums --------------------------------------------------------------------- */

static void add_layers(rt_film *film, const rt_film *from)
{
    const size_t pixels = from->first_hits ? rt_film_pixels(film) : 0;
    for (size_t i = 0; i < pixels; i++)
        first_hits_join(film->first_hits + i, from->first_hits + i);
}

/* Photons of passes add up; without passes all films have those of the same map. */
static rt_status add_photons(rt_film *film, const rt_film *from, rt_error *error)
{
    rt_film_stats *stats = &film->stats;
    if (!film->units.in_passes && film->ledger.count > 0)
        return RT_OK;
    rt_status status =
        from->ledger.count > 0 ? rt_ledger_add(&film->ledger, &from->ledger, error) : RT_OK;
    if (status != RT_OK)
        return status;
    stats->photons_emitted += from->stats.photons_emitted;
    stats->photons_stored += from->stats.photons_stored;
    stats->photons_rejected += from->stats.photons_rejected;
    return RT_OK;
}

static void add_stats(rt_film_stats *stats, const rt_film_stats *from)
{
    stats->passes += from->passes;
    stats->gathers += from->gathers;
    stats->gathers_at_ends += from->gathers_at_ends;
    stats->gathers_empty += from->gathers_empty;
    /* A film from a file or from another machine does not tell. */
    stats->light_power = fmax(stats->light_power, from->light_power);
    stats->build_seconds += from->build_seconds;
    stats->compile_seconds += from->compile_seconds;
    stats->emit_seconds += from->emit_seconds;
    stats->gather_seconds += from->gather_seconds;
    stats->render_seconds += from->render_seconds;
}

/* Adds all that is summed, or nothing. */
static rt_status add_sums(rt_film *film, const rt_film *from, rt_error *error)
{
    film->is_resolved = 0;
    const size_t pixels = rt_film_pixels(film);
    rt_status status = rt_rates_join(film, from, error);
    if (status == RT_OK && from->first_hits)
        status = rt_film_make_first_hits(film, error);
    if (status == RT_OK)
        status = add_photons(film, from, error);
    if (status != RT_OK)
        return status;
    add_layers(film, from);
    rt_film_join_pixels(film->pixels, from->pixels, pixels * film->units.replicates);
    if (film->moments && from->moments)
        rt_film_join_pixels(film->moments, from->moments, RT_MOMENTS * pixels);
    if (film->photon_sums && from->photon_sums)
        rt_photon_sums_join(film->photon_sums, from->photon_sums, pixels);
    add_stats(&film->stats, &from->stats);
    return RT_OK;
}

/* ---- Continuing and adding ------------------------------------------------------ */

/* The end of the last unit that a film has. */
static uint64_t end_of(const rt_film *film)
{
    const rt_coverage *done = &film->done;
    if (done->count == 0)
        return 0;
    return done->ranges[done->count - 1].first + done->ranges[done->count - 1].count;
}

static rt_status continue_passes(rt_film *film, const rt_film *from, rt_error *error)
{
    const unsigned long long last = end_of(from);
    if (last <= film->units.count)
        return rt_coverage_join(&film->done, &from->done, error);
    return film->options.mode == RT_MODE_PHOTON
               ? rt_fail_field(error, RT_ERROR_USAGE, "passes",
                               "the film has pass %llu already: they cannot be fewer", last)
               : rt_fail_field(error, RT_ERROR_USAGE, "spp",
                               "the film has sample %llu of its pixels already: they cannot be "
                               "fewer",
                               last);
}

/*
 * The units that a film has left when it continues another, of as many samples or others. Those of
 * the other film stay what they are where none is of a block that the end of either cuts short.
 */
static rt_status continue_units(rt_film *film, const rt_film *from, rt_error *error)
{
    const uint32_t has = from->units.samples, wants = film->units.samples;
    const int is_finished =
        rt_coverage_units(&from->done) == from->units.count && !from->lacks_base;
    if (film->units.in_passes)
        return continue_passes(film, from, error);
    if (wants >= from->units.base &&
        (wants == has || end_of(from) <= rt_units_shared(&from->units, wants))) {
        film->units = rt_units_of(&film->options, from->units.base);
        film->lacks_base = from->lacks_base;
        return rt_coverage_join(&film->done, &from->done, error);
    }
    if (wants < has)
        return rt_fail_field(error, RT_ERROR_USAGE, "spp",
                             "some pixels of the film have more than %u samples, or are in a block "
                             "of samples that goes beyond: they cannot be fewer",
                             wants);
    if (!is_finished)
        return rt_fail_field(error, RT_ERROR_USAGE, "spp",
                             "a film of %u samples a pixel that has begun the last ones cannot be "
                             "raised to %u: finish it first",
                             has, wants);
    film->units = rt_units_of(&film->options, has);
    return RT_OK;
}

rt_status rt_film_continue(rt_film *film, const rt_film *from, rt_error *error)
{
    rt_status status = rt_film_check_exact(from, "continued or joined", error);
    if (status == RT_OK)
        status = compare(film, from, 1, error);
    if (status == RT_OK && film->options.passes == 1 && from->options.passes > 1)
        status = rt_fail_field(error, RT_ERROR_USAGE, "passes", "the film is one of passes");
    if (status == RT_OK && film->units.in_passes && film->options.mode == RT_MODE_PHOTON &&
        film->options.spp != from->options.spp)
        status = rt_fail_field(error, RT_ERROR_USAGE, "spp",
                               "the passes of the film have %u samples a pixel", from->options.spp);
    if (status == RT_OK)
        status = continue_units(film, from, error);
    return status == RT_OK ? add_sums(film, from, error) : status;
}

/* Fails where two films that raise a finished one do not go together. */
static rt_status compare_base(const rt_film *film, const rt_film *from, rt_error *error)
{
    const uint32_t a = film->units.base, b = from->units.base;
    if (a != b)
        return rt_fail(error, RT_ERROR_USAGE,
                       "the films raise others, of %u and of %u samples a pixel", a, b);
    return RT_OK;
}

/* Fails where two films are not parts of one picture. */
static rt_status compare_parts(const rt_film *film, const rt_film *from, rt_error *error)
{
    if (rt_is_missing(film, "film", error) || rt_is_missing(from, "other", error))
        return RT_ERROR_USAGE;
    rt_status status = rt_film_check_exact(film, "continued or joined", error);
    if (status == RT_OK)
        status = rt_film_check_exact(from, "continued or joined", error);
    if (status == RT_OK)
        status = compare(film, from, 0, error);
    if (status == RT_OK)
        status = compare_base(film, from, error);
    if (status == RT_OK && film->ledger.count > 0 && from->ledger.count > 0 &&
        !rt_ledger_matches(&film->ledger, &from->ledger))
        status = rt_fail(error, RT_ERROR_USAGE, "the films are of other lights");
    return status;
}

rt_status rt_film_covers(const rt_film *film, const rt_film *other, rt_error *error)
{
    rt_status status = compare_parts(film, other, error);
    if (status == RT_OK && ((film->lacks_base && !other->lacks_base) ||
                            !rt_coverage_includes(&film->done, &other->done)))
        status = rt_fail(error, RT_ERROR_USAGE, "it has other parts too");
    return status;
}

rt_status rt_film_add(rt_film *film, const rt_film *from, rt_error *error)
{
    rt_status status = compare_parts(film, from, error);
    if (status == RT_OK && film->units.base > 0 && !film->lacks_base && !from->lacks_base)
        status = rt_fail(error, RT_ERROR_USAGE,
                         "both films have the %u samples a pixel of the one that they raise",
                         film->units.base);
    /* The film stays as it was where something fails: what is left after the sums cannot. */
    if (status == RT_OK)
        status = rt_coverage_prepare(&film->done, &from->done, error);
    if (status == RT_OK)
        status = add_sums(film, from, error);
    if (status != RT_OK)
        return status;
    film->lacks_base = film->lacks_base && from->lacks_base;
    return rt_coverage_join(&film->done, &from->done, error);
}
