/* progress.c - stages, the clock, and the messages of the log. */
#include "base/progress.h"

#include <errno.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <time.h>

#include "base/condition.h"
#include "base/error.h"

double rt_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double rt_checkpoint_interval(double seconds, double last_took)
{
    const double rarity = 100;
    return seconds > rarity * last_took ? seconds : rarity * last_took;
}

const char *rt_stage_name(rt_stage stage)
{
    static const char *const names[] = {"load", "build", "compile", "emit", "gather", "render"};
    return (size_t)stage < sizeof names / sizeof *names ? names[stage] : "unknown";
}

double rt_time_remaining(double elapsed, double origin, double fraction)
{
    const double made = fraction - origin, least = 1e-3;
    return fraction >= 1 ? 0 : made >= least ? elapsed * (1 - fraction) / made : -1;
}

static rt_status report(rt_stage_progress *progress, double fraction, double now)
{
    const rt_hooks *hooks = progress->hooks;
    progress->last = now;
    fraction = progress->furthest = fraction > progress->furthest ? fraction : progress->furthest;
    if (hooks && hooks->progress) {
        const double elapsed = now - progress->began;
        const rt_progress info = {
            .stage = progress->stage,
            .fraction = fraction,
            .elapsed = elapsed,
            .remaining = rt_time_remaining(elapsed, progress->origin, fraction),
            .error = progress->error,
            .step = progress->step,
            .steps = progress->steps,
        };
        if (hooks->progress(hooks->user, &info))
            progress->cancelled = 1;
    }
    return progress->cancelled ? RT_CANCELLED : RT_OK;
}

rt_status rt_stage_begin(rt_stage_progress *progress, const rt_hooks *hooks, rt_stage stage)
{
    progress->hooks = hooks;
    progress->stage = stage;
    progress->began = rt_clock();
    progress->cancelled = 0;
    progress->error = -1;
    progress->furthest = progress->origin = 0;
    progress->step = progress->steps = 0;
    rt_stage_part(progress, 0, 1);
    return report(progress, 0, progress->began);
}

rt_status rt_stage_update(rt_stage_progress *progress, double fraction)
{
    double now = rt_clock();
    if (now - progress->last < 0.1)
        return progress->cancelled ? RT_CANCELLED : RT_OK;
    return report(progress, progress->from + fraction * (progress->to - progress->from), now);
}

void rt_stage_part(rt_stage_progress *progress, double from, double to)
{
    progress->from = from;
    progress->to = to;
}

rt_status rt_stage_end(rt_stage_progress *progress, double *seconds)
{
    double now = rt_clock();
    if (seconds)
        *seconds = now - progress->began;
    return progress->cancelled ? RT_CANCELLED : report(progress, 1, now);
}

/* Work on its own thread, and how the waiting thread learns of its end. */
typedef struct job {
    rt_status (*work)(void *data);
    void *data;
    rt_status status;
    int done;
    pthread_mutex_t lock;
    pthread_cond_t ended;
} job;

static void *run_job(void *argument)
{
    job *j = argument;
    rt_status status = j->work(j->data);
    pthread_mutex_lock(&j->lock);
    j->status = status;
    j->done = 1;
    pthread_cond_signal(&j->ended);
    pthread_mutex_unlock(&j->lock);
    return NULL;
}

/* Waits for the end of the job, and reports four times a second. */
static void wait_for(job *j, rt_stage_progress *progress)
{
    pthread_mutex_lock(&j->lock);
    while (!j->done)
        if (rt_condition_wait(&j->ended, &j->lock, 0.25) == ETIMEDOUT && !j->done) {
            pthread_mutex_unlock(&j->lock);
            report(progress, progress->from, rt_clock());
            pthread_mutex_lock(&j->lock);
        }
    pthread_mutex_unlock(&j->lock);
}

rt_status rt_stage_run(rt_stage_progress *progress, rt_status (*work)(void *data), void *data)
{
    job j = {.work = work, .data = data, .lock = PTHREAD_MUTEX_INITIALIZER};
    pthread_t thread;

    if (!progress->hooks || !progress->hooks->progress || rt_condition_begin(&j.ended) != 0)
        return work(data);
    int is_begun = pthread_create(&thread, NULL, run_job, &j) == 0;
    if (is_begun) {
        wait_for(&j, progress);
        pthread_join(thread, NULL);
    }
    pthread_cond_destroy(&j.ended);
    if (!is_begun)
        return work(data);
    if (j.status != RT_OK)
        return j.status;
    return progress->cancelled ? RT_CANCELLED : RT_OK;
}

void rt_log(const rt_hooks *hooks, const char *format, ...)
{
    char line[512];
    va_list args;
    if (!hooks || !hooks->log)
        return;
    va_start(args, format);
    rt_write_line(line, sizeof line, format, args);
    va_end(args);
    hooks->log(hooks->user, line);
}

void rt_warn(const rt_hooks *hooks, const char *format, ...)
{
    char line[512];
    va_list args;
    if (!hooks || !hooks->warning)
        return;
    va_start(args, format);
    rt_write_line(line, sizeof line, format, args);
    va_end(args);
    hooks->warning(hooks->user, line);
}
