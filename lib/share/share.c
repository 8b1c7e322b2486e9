/* share.c - gives workers their units, and adds up what they hand over. */
#include "share/share.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/condition.h"
#include "base/error.h"
#include "base/progress.h"
#include "film/extent.h"
#include "photon/map_warnings.h"
#include "setting/options.h"

/* Seconds after which films are handed over where there are no checkpoints: they may be lost. */
static const double default_seconds = 60;

/* And the first one, so that what does not fit is found out early. */
static const double first_seconds = 1;

/*
 * Films are asked for so seldom that taking them keeps to this part of the time, however many
 * workers there are; but from each at the latest after so many times the seconds above.
 */
static const double taking_part = 0.1, most_late = 10;

/* What a pixel of a film takes, in seconds, until it is known. */
static const double pixel_taking = 6e-8;

/* ---- The horizon ---------------------------------------------------------------- */

/* The units after which the error is tested next, or all. */
static uint64_t next_horizon(const rt_share *share)
{
    const rt_units *units = &share->film->units;
    const uint64_t round = (uint64_t)units->items * units->replicates;
    if (share->options.target_error <= 0)
        return UINT64_MAX;
    for (uint64_t at = round; at <= units->count; at += round)
        if (rt_noise_is_due(&share->noise, rt_units_length(units, at)))
            return at;
    return UINT64_MAX;
}

/* Tests the error where all units up to the horizon are done, and moves that on. */
static void test(rt_share *share)
{
    const rt_film *film = share->film;
    while (!share->enough && share->horizon <= film->units.count &&
           rt_coverage_prefix(&film->done) >= share->horizon) {
        const uint32_t length = rt_units_length(&film->units, share->horizon);
        if (film->done.count == 1 && film->done.ranges[0].count == share->horizon)
            share->enough = rt_noise_test(&share->noise, film, length, share->options.target_error);
        share->noise.next_test = rt_units_next_test(length);
        share->horizon = next_horizon(share);
    }
}

/* ---- Create and destroy ----------------------------------------------------------- */

static rt_status check(const rt_render_options *o, rt_error *error)
{
    if (o->parts > 1 || o->next_units)
        return rt_fail_field(error, RT_ERROR_USAGE, "part", "a part of a picture is not shared");
    return RT_OK;
}

/* The units whose samples a finished film had are nothing to hand out. */
static rt_status skip_base(rt_film *film, rt_error *error)
{
    const rt_unit_range gap = rt_coverage_gap(&film->done, 0, film->units.count);
    rt_unit_range base = {0, 0};
    if (film->units.base == 0 || gap.first > 0)
        return RT_OK;
    while (base.count < gap.count && rt_units_block(&film->units, base.count).count == 0)
        base.count += film->units.items;
    if (base.count > gap.count)
        base.count = gap.count;
    return base.count > 0 ? rt_coverage_add(&film->done, base, error) : RT_OK;
}

/* Makes the film, and finds what is to be done. */
static rt_status open(rt_share *share, rt_renderer *renderer, rt_error *error)
{
    rt_status status = rt_film_begin(&share->film, renderer, &share->options, error);
    if (status == RT_OK)
        status = skip_base(share->film, error);
    if (status == RT_OK)
        status = rt_coverage_join(&share->given, &share->film->done, error);
    if (status != RT_OK)
        return status;
    share->before = rt_share_rendered(share);
    share->taking = pixel_taking * share->film->units.replicates * rt_film_pixels(share->film);
    /* A film that is raised was tested before. */
    const uint32_t base = share->film->units.base / share->film->units.replicates;
    share->noise = rt_noise_begin(base < RT_NOISE_FEWEST ? RT_NOISE_FEWEST : base + 1);
    share->horizon = next_horizon(share);
    test(share);
    return RT_OK;
}

/*
 * The lock, which a thread may take again: it is held while callbacks look at the film, and these
 * may ask how far it is, or stop. Returns 0, or an error.
 */
static int begin_lock(pthread_mutex_t *lock)
{
    pthread_mutexattr_t how;
    int code = pthread_mutexattr_init(&how);
    if (code)
        return code;
    code = pthread_mutexattr_settype(&how, PTHREAD_MUTEX_RECURSIVE);
    if (!code)
        code = pthread_mutex_init(lock, &how);
    pthread_mutexattr_destroy(&how);
    return code;
}

/* A share with its lock; NULL where there is no memory. */
static rt_share *make(void)
{
    rt_share *share = calloc(1, sizeof *share);
    if (share && begin_lock(&share->lock) != 0) {
        free(share);
        return NULL;
    }
    if (share && rt_condition_begin(&share->changed) != 0) {
        pthread_mutex_destroy(&share->lock);
        free(share);
        return NULL;
    }
    return share;
}

rt_status rt_share_create(rt_share **out, rt_renderer *renderer, const rt_render_options *options,
                          rt_error *error)
{
    if (rt_is_missing(renderer, "renderer", error) || rt_is_missing(options, "options", error))
        return RT_ERROR_USAGE;
    rt_status status = check(options, error);
    if (status != RT_OK)
        return status;
    rt_share *share = make();
    if (!share)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for a picture to be shared");
    share->options = *options;
    share->saved = rt_clock();
    status = open(share, renderer, error);
    if (status == RT_OK)
        *out = share;
    else
        rt_share_destroy(share);
    return status;
}

void rt_share_destroy(rt_share *share)
{
    if (!share)
        return;
    for (uint32_t i = 0; i < share->count; i++)
        rt_coverage_free(&share->workers[i].held);
    free(share->workers);
    rt_coverage_free(&share->given);
    rt_film_destroy(share->film);
    pthread_cond_destroy(&share->changed);
    pthread_mutex_destroy(&share->lock);
    free(share);
}

/* ---- Workers ---------------------------------------------------------------------- */

rt_status rt_share_join(uint32_t *worker, rt_share *share, rt_error *error)
{
    rt_status status = RT_OK;
    if (rt_is_missing(share, "share", error))
        return RT_ERROR_USAGE;
    pthread_mutex_lock(&share->lock);
    rt_share_worker *workers = realloc(share->workers, (share->count + 1) * sizeof *share->workers);
    if (workers) {
        share->workers = workers;
        workers[share->count] = (rt_share_worker){.handed = rt_clock()};
        *worker = share->count++;
    } else {
        status = rt_fail(error, RT_ERROR_MEMORY, "out of memory for a worker");
    }
    pthread_mutex_unlock(&share->lock);
    return status;
}

/* Whether a worker has units and is to hand them over, so that they are not lost. */
static int must_hand_over(rt_share *share, rt_share_worker *worker, double now)
{
    const rt_render_options *o = &share->options;
    const double kept = o->checkpoint ? o->checkpoint_seconds : default_seconds;
    const double asked = o->preview ? fmin(kept, fmax(o->preview_seconds, first_seconds)) : kept;
    const double every = rt_checkpoint_interval(asked, share->saving), age = now - worker->handed;
    if (worker->held.count == 0 || worker->is_told)
        return worker->is_told;
    if (age < (worker->is_proven ? every : fmin(every, first_seconds)) ||
        (now < share->rested && age < most_late * every))
        return 0;
    share->rested = fmax(share->rested, now) + share->taking / taking_part;
    worker->is_told = 1;
    return 1;
}

/* Gives a worker units, or says why there are none. */
static rt_share_task give(rt_share *share, rt_share_worker *worker, rt_unit_range *out, double now)
{
    const int ends = share->stopped || share->enough || rt_share_is_out_of_time(share, now);
    *out = (rt_unit_range){0, 0};
    if (!ends && !must_hand_over(share, worker, now))
        *out = rt_share_choose(share, worker, now);
    if (out->count > 0) {
        if (rt_coverage_add(&worker->held, *out, NULL) == RT_OK &&
            rt_coverage_add(&share->given, *out, NULL) == RT_OK) {
            worker->given = rt_units_amount(&share->film->units, *out);
            return RT_SHARE_RENDER;
        }
        share->stopped = 1; /* no memory for a list */
    }
    if (worker->held.count > 0)
        return RT_SHARE_HAND_OVER;
    if (ends || share->stopped ||
        rt_coverage_prefix(&share->film->done) >= share->film->units.count)
        return RT_SHARE_END;
    return RT_SHARE_WAIT;
}

/* A worker by its number, or NULL. */
static rt_share_worker *find_worker(rt_share *share, uint32_t worker)
{
    return worker < share->count ? share->workers + worker : NULL;
}

rt_share_task rt_share_ask(rt_share *share, uint32_t worker, uint64_t *first, uint64_t *count)
{
    rt_unit_range range = {0, 0};
    const double now = rt_clock();
    pthread_mutex_lock(&share->lock);
    rt_share_worker *w = find_worker(share, worker);
    if (w && share->began == 0)
        share->began = now;
    const rt_share_task task = w && !w->is_gone ? give(share, w, &range, now) : RT_SHARE_END;
    pthread_mutex_unlock(&share->lock);
    *first = range.first;
    *count = range.count;
    return task;
}

void rt_share_note(rt_share *share, uint32_t worker, uint64_t first, uint64_t count, double seconds)
{
    pthread_mutex_lock(&share->lock);
    rt_share_worker *w = find_worker(share, worker);
    const double amount = rt_units_amount(&share->film->units, (rt_unit_range){first, count});
    if (w && seconds > 0 && amount > 0)
        w->rate = amount / seconds;
    if (w)
        w->rendered += amount;
    pthread_mutex_unlock(&share->lock);
}

/* Lets others have what a worker was given and did not hand over. */
static void take_back(rt_share *share, rt_share_worker *worker)
{
    rt_status status = RT_OK;
    for (size_t i = 0; i < worker->held.count && status == RT_OK; i++)
        status = rt_coverage_remove(&share->given, worker->held.ranges[i], NULL);
    if (status != RT_OK)
        share->stopped = 1;
    rt_coverage_free(&worker->held);
    worker->rendered = 0;
    worker->is_told = 0;
}

/* Whether a worker was given all that a film has. */
static int holds(const rt_share_worker *worker, const rt_coverage *done)
{
    for (size_t i = 0; i < done->count; i++) {
        const rt_unit_range r = done->ranges[i];
        size_t j = 0;
        while (j < worker->held.count &&
               !(worker->held.ranges[j].first <= r.first &&
                 worker->held.ranges[j].first + worker->held.ranges[j].count >= r.first + r.count))
            j++;
        if (j == worker->held.count)
            return 0;
    }
    return 1;
}

/* Makes a checkpoint where it is due. */
static void save(rt_share *share)
{
    const rt_render_options *o = &share->options;
    const double now = rt_clock();
    if (!o->checkpoint ||
        now - share->saved < rt_checkpoint_interval(o->checkpoint_seconds, share->saving))
        return;
    o->checkpoint(o->checkpoint_user, share->film);
    share->saved = rt_clock();
    share->saving = share->saved - now;
}

/* Shows a preview where it is due. */
static void show(rt_share *share)
{
    const rt_render_options *o = &share->options;
    const double now = rt_clock();
    if (!o->preview ||
        now - share->shown < rt_checkpoint_interval(o->preview_seconds, share->showing))
        return;
    o->preview(o->preview_user, share->film);
    share->shown = rt_clock();
    share->showing = share->shown - now;
}

/* A worker has nothing left of what it was given. */
static void note_handed(rt_share_worker *worker)
{
    worker->rendered = 0;
    worker->is_proven = 1;
    worker->is_told = 0;
    worker->handed = rt_clock();
}

rt_status rt_share_add(rt_share *share, uint32_t worker, const rt_film *film, double seconds,
                       rt_error *error)
{
    if (rt_is_missing(share, "share", error) || rt_is_missing(film, "film", error))
        return RT_ERROR_USAGE;
    pthread_mutex_lock(&share->lock);
    const double began = rt_clock();
    rt_share_worker *w = find_worker(share, worker);
    rt_status status = !w ? rt_fail_field(error, RT_ERROR_USAGE, "worker", "there is no worker %u",
                                          (unsigned)worker)
                       : holds(w, &film->done)
                           ? rt_film_add(share->film, film, error)
                           : rt_fail(error, RT_ERROR_USAGE, "the film has what was not asked for");
    for (size_t i = 0; i < film->done.count && status == RT_OK; i++)
        status = rt_coverage_remove(&w->held, film->done.ranges[i], error);
    if (status == RT_OK) {
        note_handed(w);
        share->taking += (seconds + w->handed - began - share->taking) / 2;
        test(share);
        show(share);
        save(share);
    } else if (w) {
        take_back(share, w);
    }
    pthread_cond_broadcast(&share->changed);
    pthread_mutex_unlock(&share->lock);
    return status;
}

void rt_share_pass(rt_share *share, uint32_t from, uint32_t to)
{
    pthread_mutex_lock(&share->lock);
    rt_share_worker *a = find_worker(share, from), *b = find_worker(share, to);
    if (a && b && a != b) {
        if (rt_coverage_join(&b->held, &a->held, NULL) != RT_OK)
            share->stopped = 1; /* no memory for a list */
        b->rendered += a->rendered;
        rt_coverage_free(&a->held);
        note_handed(a);
        if (b->is_gone)
            take_back(share, b);
        pthread_cond_broadcast(&share->changed);
    }
    pthread_mutex_unlock(&share->lock);
}

void rt_share_leave(rt_share *share, uint32_t worker)
{
    pthread_mutex_lock(&share->lock);
    rt_share_worker *w = find_worker(share, worker);
    if (w) {
        take_back(share, w);
        w->is_gone = 1;
    }
    pthread_cond_broadcast(&share->changed);
    pthread_mutex_unlock(&share->lock);
}

void rt_share_stop(rt_share *share)
{
    pthread_mutex_lock(&share->lock);
    share->stopped = 1;
    pthread_cond_broadcast(&share->changed);
    pthread_mutex_unlock(&share->lock);
}

uint32_t rt_share_raised_from(const rt_share *share)
{
    return share->film->units.base;
}

/* ---- The picture ------------------------------------------------------------------ */

void rt_share_get_progress(rt_share *share, rt_progress *out)
{
    pthread_mutex_lock(&share->lock);
    const rt_render_options *o = &share->options;
    const rt_extent extent = {.before = share->before,
                              .done = rt_share_rendered(share),
                              .all = rt_share_all(share),
                              .elapsed = share->began > 0 ? rt_clock() - share->began : 0,
                              .time = o->time,
                              .target = o->target_error,
                              .noise = &share->noise,
                              .replicates = share->film->units.replicates};
    const double fraction = rt_extent_fraction(&extent);
    *out = (rt_progress){
        .stage = o->mode == RT_MODE_PHOTON && !share->film->units.in_passes ? RT_STAGE_GATHER
                                                                            : RT_STAGE_RENDER,
        .fraction = fraction,
        .elapsed = extent.elapsed,
        .remaining = rt_time_remaining(extent.elapsed, rt_extent_origin(&extent), fraction),
        .error = rt_noise_last(&share->noise),
    };
    pthread_mutex_unlock(&share->lock);
}

/* Warns of what a render alone warns of at its end, see mode/photon. */
static void warn(const rt_share *share, const rt_hooks *hooks)
{
    const rt_film *film = share->film;
    const rt_render_options *o = &film->options;
    if (o->mode != RT_MODE_PHOTON)
        return;
    if (share->options.photon_map)
        rt_photon_map_warn_starved(share->options.photon_map, &film->ledger, 0, o->k, o->caustic_k,
                                   hooks);
    else
        rt_photon_map_warn_lights(&film->ledger, hooks);
    rt_photon_map_warn_gathers(&film->stats, hooks);
}

rt_status rt_share_finish(rt_film **out, rt_share *share, const rt_hooks *hooks, rt_error *error)
{
    if (rt_is_missing(share, "share", error))
        return RT_ERROR_USAGE;
    const rt_render_options *o = &share->options;
    rt_film *film = share->film;
    const int is_whole = share->enough || rt_share_is_out_of_time(share, rt_clock()) ||
                         rt_coverage_prefix(&film->done) >= film->units.count;
    *out = NULL;
    if (o->checkpoint)
        o->checkpoint(o->checkpoint_user, film);
    if (is_whole)
        warn(share, hooks);
    rt_status status = rt_film_resolve(film, hooks, error);
    if (status != RT_OK)
        return status;
    if (film->stats.spp > 0) {
        *out = film;
        share->film = NULL;
    }
    return is_whole ? RT_OK : rt_fail(error, RT_CANCELLED, "cancelled");
}
