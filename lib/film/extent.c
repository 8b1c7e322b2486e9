/* extent.c - how far a render is, of what was left when it began. */
#include "film/extent.h"

#include <math.h>

/* Where `now` is between `before` and `all`, 0 to 1. */
static double part(double before, double now, double all)
{
    return all > before ? fmin(fmax((now - before) / (all - before), 0), 1) : 1;
}

double rt_extent_origin(const rt_extent *e)
{
    return e->target > 0 || !(e->all > 0) ? 0 : fmin(e->before / e->all, 1);
}

double rt_extent_fraction(const rt_extent *e)
{
    const double origin = rt_extent_origin(e);
    double run = part(e->before, e->done, e->all);
    if (e->target > 0) {
        /* Until the error is first tested nothing is known: samples may be without limit. */
        const double by_error = rt_noise_progress(e->noise, e->done / e->replicates, e->target);
        const double began = rt_noise_progress(e->noise, e->before / e->replicates, e->target);
        run = by_error > 0 ? fmax(run, part(began, by_error, 1)) : 0;
    }
    if (e->time > 0)
        run = fmax(run, fmin(e->elapsed / e->time, 1));
    return origin + (1 - origin) * run;
}
