/* extent.h - how far a render is, and what it began with: samples, time and error. */
#ifndef RT_LIB_FILM_EXTENT_H
#define RT_LIB_FILM_EXTENT_H

#include "film/noise.h"

typedef struct rt_extent {
    double before, done, all; /* samples or passes: when it began, now, and at its end */
    double elapsed, time;     /* seconds since it began, and at most; 0: no limit */
    double target;            /* of the relative error; 0: none */
    const rt_noise *noise;    /* of the film */
    double replicates;
} rt_extent;

/*
 * How much there was when it began, as rt_extent_fraction: 0 with a target, of which nothing is
 * known before the error is tested.
 */
double rt_extent_origin(const rt_extent *extent);

/*
 * How much there is now, from rt_extent_origin to 1: of what was left by samples, by time or by the
 * error, whichever is furthest. So rt_time_remaining is right, whichever ends it.
 */
double rt_extent_fraction(const rt_extent *extent);

#endif
