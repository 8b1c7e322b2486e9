/* render.c - a worker of this process: rt_render with the units of a share. */
#include <math.h>

#include "base/condition.h"
#include "base/error.h"
#include "base/progress.h"
#include "share/share.h"

/* Seconds between two reports of a worker that waits. */
static const double interval = 0.1;

/* A worker of this process. */
typedef struct local {
    rt_share *share;
    uint32_t number;
    rt_unit_range range; /* that it renders */
    double began;        /* rt_clock() when it was given that */
    const rt_hooks *hooks;
    rt_status status; /* of what it handed over */
    rt_error *error;
} local;

/* Reports on the whole picture; returns whether to cancel. */
static int report(local *l)
{
    rt_progress progress;
    if (!l->hooks || !l->hooks->progress)
        return 0;
    rt_share_get_progress(l->share, &progress);
    return l->hooks->progress(l->hooks->user, &progress);
}

/* Waits until something has changed, for a while. */
static void wait(rt_share *share)
{
    pthread_mutex_lock(&share->lock);
    rt_condition_wait(&share->changed, &share->lock, interval);
    pthread_mutex_unlock(&share->lock);
}

static rt_units_answer next_units(void *user, uint64_t *first, uint64_t *count)
{
    local *l = user;
    if (l->range.count > 0)
        rt_share_note(l->share, l->number, l->range.first, l->range.count, rt_clock() - l->began);
    l->range.count = 0;
    for (;;) {
        switch (rt_share_ask(l->share, l->number, first, count)) {
        case RT_SHARE_END:
            return RT_UNITS_NONE;
        case RT_SHARE_RENDER:
            l->range = (rt_unit_range){*first, *count};
            l->began = rt_clock();
            return RT_UNITS_GIVEN;
        case RT_SHARE_HAND_OVER:
            return RT_UNITS_SAVE;
        case RT_SHARE_WAIT:
            break;
        }
        wait(l->share);
        if (report(l))
            rt_share_stop(l->share);
    }
}

/* Hands the film over. */
static void hand_over(void *user, const rt_film *film)
{
    local *l = user;
    if (l->status != RT_OK)
        return;
    l->status = rt_share_add(l->share, l->number, film, 0, l->error);
    if (l->status != RT_OK)
        rt_share_stop(l->share);
}

/* The progress of the whole picture in place of the worker's own, once it renders. */
static int on_progress(void *user, const rt_progress *progress)
{
    local *l = user;
    switch (progress->stage) {
    case RT_STAGE_GATHER:
    case RT_STAGE_RENDER:
        return report(l);
    case RT_STAGE_LOAD:
    case RT_STAGE_BUILD:
    case RT_STAGE_COMPILE:
    case RT_STAGE_EMIT:
        break;
    }
    return l->hooks->progress ? l->hooks->progress(l->hooks->user, progress) : 0;
}

static void on_log(void *user, const char *line)
{
    local *l = user;
    if (l->hooks->log)
        l->hooks->log(l->hooks->user, line);
}

/* What a worker can warn of at its end is for the whole picture to tell. */
static void on_warning(void *user, const char *line)
{
    local *l = user;
    if (l->hooks->warning && l->began == 0)
        l->hooks->warning(l->hooks->user, line);
}

rt_status rt_share_render(rt_share *share, rt_renderer *renderer, const rt_hooks *hooks,
                          rt_error *error)
{
    static const rt_hooks none;
    if (rt_is_missing(share, "share", error) || rt_is_missing(renderer, "renderer", error))
        return RT_ERROR_USAGE;
    local l = {.share = share, .hooks = hooks ? hooks : &none, .error = error};
    const rt_hooks own = {on_progress, on_log, &l, on_warning};
    rt_render_options o = share->options;
    rt_film *film = NULL;
    rt_status status = rt_share_join(&l.number, share, error);
    if (status != RT_OK)
        return status;
    o.resume = NULL;
    o.raised_from = rt_share_raised_from(share);
    o.hooks = &own;
    o.next_units = next_units;
    o.units_user = o.checkpoint_user = &l;
    o.checkpoint = hand_over;
    o.checkpoint_seconds = INFINITY;
    o.hand_over = 1;
    o.preview = NULL; /* which is of the whole picture */
    status = rt_render(&film, renderer, &o, error);
    rt_film_destroy(film);
    if (status != RT_OK)
        rt_share_stop(share);
    rt_share_leave(share, l.number);
    return l.status == RT_OK ? status : l.status;
}
