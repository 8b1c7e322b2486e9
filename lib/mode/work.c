/* work.c - goes through the units of a render. */
#include "mode/work.h"

#include <math.h>

#include "film/extent.h"

/* ---- What comes next --------------------------------------------------------- */

/* Samples that all replicates have in common. */
static uint32_t length_done(const rt_film *film)
{
    return rt_units_length(&film->units, rt_coverage_prefix(&film->done));
}

/* A film that is continued where the error is tested has to be: it may be small enough. */
static void begin_tests(rt_work *work)
{
    const uint32_t length = length_done(work->film);
    work->noise = rt_noise_begin(length);
    if (rt_work_test_is_due(work))
        rt_work_test(work);
    else if (length > 0 && rt_noise_is_due(&work->noise, length))
        work->noise = rt_noise_begin(length + 1); /* it was tested before what came after it */
}

rt_work rt_work_begin(rt_film *film, const rt_render_options *options)
{
    rt_work work = {.options = options, .film = film};
    const double parts = options->parts > 1 ? options->parts : 1;
    work.is_whole = options->parts <= 1 && !options->next_units;
    work.end = work.is_whole || options->parts > 1 ? film->units.count : 0;
    work.all = film->units.samples / parts;
    work.done = work.resumed = rt_film_samples_done(film);
    work.began = work.saved = work.shown = rt_clock();
    begin_tests(&work);
    return work;
}

/* The next units from work->at on that the film lacks; those of this part alone. */
static rt_unit_range find(rt_work *work)
{
    const rt_units *units = &work->film->units;
    const uint32_t parts = work->options->parts;
    for (;;) {
        rt_unit_range gap = rt_coverage_gap(&work->film->done, work->at, work->end);
        if (gap.count == 0 || parts <= 1)
            return gap;
        const uint64_t chunk = rt_units_chunk_of(units, gap.first);
        const rt_unit_range whole = rt_units_chunk(units, chunk);
        const uint64_t end = whole.first + whole.count;
        work->at = gap.first;
        if (chunk % parts == work->options->part - 1) {
            gap.count = gap.count < end - gap.first ? gap.count : end - gap.first;
            return gap;
        }
        work->at = end;
    }
}

int rt_work_next(rt_work *work, rt_unit_range *out)
{
    const rt_render_options *o = work->options;
    const rt_units *units = &work->film->units;
    if (work->enough || rt_work_is_out_of_time(work))
        return 0;
    rt_unit_range range = find(work), given = {0, 0};
    rt_units_answer answer = o->next_units ? RT_UNITS_GIVEN : RT_UNITS_NONE;
    while (range.count == 0 && answer == RT_UNITS_GIVEN) {
        answer = o->next_units(o->units_user, &given.first, &given.count);
        if (answer != RT_UNITS_GIVEN)
            break;
        work->at = given.first;
        work->end = given.first + given.count;
        range = find(work);
    }
    *out = range;
    work->must_save = answer == RT_UNITS_SAVE;
    if (range.count == 0)
        return work->must_save;
    const uint64_t block_end = (range.first / units->items + 1) * units->items;
    if (range.count > block_end - range.first)
        range.count = block_end - range.first;
    work->at = range.first + range.count;
    *out = range;
    return 1;
}

int rt_work_extend(rt_work *work, rt_unit_range *range)
{
    const rt_units *units = &work->film->units;
    const uint64_t end = range->first + range->count;
    if (units->replicates > 1 || work->options->parts > 1 || range->count == 0 ||
        range->first % units->items != 0 || range->count % units->items != 0)
        return 0;
    const rt_unit_range gap = rt_coverage_gap(&work->film->done, end, work->end);
    if (gap.first != end || gap.count < units->items)
        return 0;
    range->count += units->items;
    work->at = end + units->items;
    return 1;
}

rt_status rt_work_done(rt_work *work, rt_unit_range units, rt_error *error)
{
    work->done += rt_units_amount(&work->film->units, units);
    return rt_coverage_add(&work->film->done, units, error);
}

/* ---- How far it is ----------------------------------------------------------- */

int rt_work_is_out_of_time(const rt_work *work)
{
    const rt_film *film = work->film;
    const rt_render_options *o = work->options;
    /* Whoever hands out the units ends by time, too. */
    if (o->time <= 0 || o->next_units || rt_clock() - work->began < o->time)
        return 0;
    if (!work->is_whole || film->units.base > 0)
        return 1;
    return film->done.count > 0 && film->done.ranges[0].first == 0 &&
           film->done.ranges[0].count >= film->units.items;
}

static rt_extent extent_of(const rt_work *work)
{
    const rt_render_options *o = work->options;
    return (rt_extent){.before = work->resumed,
                       .done = work->done,
                       .all = work->all,
                       .elapsed = rt_clock() - work->began,
                       .time = o->next_units ? 0 : o->time,
                       .target = o->target_error,
                       .noise = &work->noise,
                       .replicates = work->film->units.replicates};
}

double rt_work_fraction(const rt_work *work)
{
    const rt_extent extent = extent_of(work);
    return rt_extent_fraction(&extent);
}

rt_status rt_work_begin_stage(const rt_work *work, rt_stage_progress *progress, rt_stage stage)
{
    const rt_extent extent = extent_of(work);
    rt_status status = rt_stage_begin(progress, work->options->hooks, stage);
    progress->origin = rt_extent_origin(&extent);
    return status;
}

int rt_work_test_is_due(const rt_work *work)
{
    const rt_film *film = work->film;
    if (film->units.replicates < 2 || !work->is_whole || film->done.count != 1 ||
        film->done.ranges[0].first != 0 ||
        film->done.ranges[0].count % ((uint64_t)film->units.items * film->units.replicates) != 0)
        return 0;
    return rt_noise_is_due(&work->noise, length_done(film));
}

void rt_work_test(rt_work *work)
{
    rt_profile_begin(work->profile, "error");
    work->enough = rt_noise_test(&work->noise, work->film, length_done(work->film),
                                 work->options->target_error);
    rt_profile_end(work->profile);
}

int rt_work_save_is_due(const rt_work *work)
{
    const rt_render_options *o = work->options;
    return o->checkpoint &&
           (work->must_save || rt_clock() - work->saved >=
                                   rt_checkpoint_interval(o->checkpoint_seconds, work->saving));
}

int rt_work_preview_is_due(const rt_work *work)
{
    const rt_render_options *o = work->options;
    return o->preview &&
           rt_clock() - work->shown >= rt_checkpoint_interval(o->preview_seconds, work->showing);
}

void rt_work_preview(rt_work *work, double began)
{
    rt_profile_begin(work->profile, "preview");
    work->options->preview(work->options->preview_user, work->film);
    rt_profile_end(work->profile);
    work->shown = rt_clock();
    work->showing = work->shown - began;
}

void rt_work_time(rt_work *work, double *seconds)
{
    work->seconds = seconds;
    work->before = *seconds - rt_clock();
}

void rt_work_end_time(rt_work *work)
{
    if (work->seconds)
        *work->seconds = work->before + rt_clock();
}

int rt_work_save(rt_work *work)
{
    const double began = rt_clock();
    rt_work_end_time(work);
    rt_profile_begin(work->profile, "checkpoint");
    work->options->checkpoint(work->options->checkpoint_user, work->film);
    rt_profile_end(work->profile);
    if (work->options->hand_over)
        rt_film_clear(work->film);
    if (work->seconds)
        rt_work_time(work, work->seconds);
    work->saved = rt_clock();
    work->saving = work->saved - began;
    return work->options->hand_over;
}
