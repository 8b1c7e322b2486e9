/* progress.c - estimates how much of a scene's text is left to be read, and reports it. */
#include "dsl/progress.h"

#include <string.h>
#include <time.h>

/* Statements between two looks at the clock, and seconds between two reports. */
enum { STEPS = 256 };
static const double interval = 0.1;

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static int tell(rt_reading *reading, double fraction, double now)
{
    double elapsed = now - reading->began;
    reading->last = now;
    if (fraction > reading->furthest)
        reading->furthest = fraction;
    fraction = reading->furthest;
    const double remaining = fraction > 0 ? elapsed * (1 - fraction) / fraction : -1;
    rt_progress report = {.stage = RT_STAGE_LOAD,
                          .fraction = fraction,
                          .elapsed = elapsed,
                          .remaining = remaining,
                          .error = -1};
    return reading->hooks->progress(reading->hooks->user, &report) == 0;
}

int rt_reading_begin(rt_reading *reading, const rt_hooks *hooks)
{
    memset(reading, 0, sizeof *reading);
    if (!hooks || !hooks->progress)
        return 1;
    reading->hooks = hooks;
    reading->began = seconds();
    return tell(reading, 0, reading->began);
}

int rt_reading_end(rt_reading *reading)
{
    return !reading->hooks || tell(reading, 1, seconds());
}

int rt_reading_step(rt_reading *reading, size_t bytes, size_t left)
{
    reading->done += (double)bytes;
    if (!reading->hooks || ++reading->steps < STEPS)
        return 1;
    double now = seconds(), all = reading->done + reading->left + (double)left;
    reading->steps = 0;
    if (now - reading->last < interval)
        return 1;
    /* All of it is read before the scene is checked. */
    return tell(reading, 0.99 * reading->done / all, now);
}
