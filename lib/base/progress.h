/* progress.h - reporting a stage of a long call through the caller's hooks. */
#ifndef RT_LIB_BASE_PROGRESS_H
#define RT_LIB_BASE_PROGRESS_H

#include "rt.h"

/* One stage under way. Plain data; needs no destruction. */
typedef struct rt_stage_progress {
    const rt_hooks *hooks; /* may be NULL */
    rt_stage stage;
    double began, last;   /* seconds, rt_clock() */
    double from, to;      /* the part of the stage that fractions are of, 0 to 1 */
    double error;         /* relative error of the picture so far, negative while unknown */
    double origin;        /* the fraction that was done before; 0 unless set after the begin */
    double furthest;      /* fraction reported so far; none is below it */
    uint32_t step, steps; /* see rt_progress; set between reports */
    int cancelled;
} rt_stage_progress;

/* Seconds on a monotonic clock. */
double rt_clock(void);

/*
 * The time from one checkpoint, or preview, to the next: as asked for, but 100 times what the last
 * one took.
 */
double rt_checkpoint_interval(double seconds, double last_took);

/*
 * The seconds that the rest takes, where a stage went from fraction `origin` to `fraction` in
 * `elapsed`; -1 while that is too little to tell.
 */
double rt_time_remaining(double elapsed, double origin, double fraction);

/*
 * Each reports to the progress callback and returns RT_OK, or RT_CANCELLED once the callback asked
 * for it.
 */
rt_status rt_stage_begin(rt_stage_progress *progress, const rt_hooks *hooks, rt_stage stage);
/* at most ten reports a second */
rt_status rt_stage_update(rt_stage_progress *progress, double fraction);
/* what the next updates are fractions of */
void rt_stage_part(rt_stage_progress *progress, double from, double to);
/* seconds: the stage's length, or NULL; a stage that was cancelled reports no end */
rt_status rt_stage_end(rt_stage_progress *progress, double *seconds);

/*
 * Runs work(data) on a thread of its own while this one keeps the progress callback informed, for
 * calls into other libraries that cannot report by themselves. A cancel is noted and takes effect
 * when work is done. Returns what work returned, else RT_CANCELLED.
 */
rt_status rt_stage_run(rt_stage_progress *progress, rt_status (*work)(void *data), void *data);

/* One line to the log callback, if there is one; or to that for warnings. */
void rt_log(const rt_hooks *hooks, const char *format, ...)
#if defined(__GNUC__)
    __attribute__((format(printf, 2, 3)))
#endif
    ;
void rt_warn(const rt_hooks *hooks, const char *format, ...)
#if defined(__GNUC__)
    __attribute__((format(printf, 2, 3)))
#endif
    ;

#endif
