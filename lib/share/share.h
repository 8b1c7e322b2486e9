/* share.h - a picture that several workers make together: what each was given, and what is done. */
#ifndef RT_LIB_SHARE_SHARE_H
#define RT_LIB_SHARE_SHARE_H

#include <pthread.h>

#include "film/film.h"
#include "film/noise.h"

typedef struct rt_share_worker {
    int is_gone;
    int is_proven;    /* a film of it fitted */
    int is_told;      /* to hand over, as films are due, and has not done so yet */
    rt_coverage held; /* the units that it was given and has not handed over */
    double rendered;  /* samples or passes of these that are rendered, as rt_units_amount */
    double given;     /* what it was given last, likewise */
    double rate;      /* likewise, a second; 0: not known yet */
    double handed;    /* rt_clock() when it last handed over, or began */
} rt_share_worker;

struct rt_share {
    pthread_mutex_t lock;
    pthread_cond_t changed; /* what was to be waited for may be over */
    rt_render_options options;
    rt_film *film;     /* what was handed over */
    rt_coverage given; /* the units that are done or held by a worker */
    rt_share_worker *workers;
    uint32_t count;
    uint64_t horizon; /* units from here on wait for a test of the error */
    rt_noise noise;
    int enough;     /* the error asked for is reached */
    int stopped;    /* by rt_share_stop */
    double before;  /* samples or passes that a resumed film had */
    double began;   /* rt_clock() at the first question; 0: before */
    double saved;   /* rt_clock() after the last checkpoint */
    double saving;  /* seconds that it took */
    double shown;   /* as saved, of previews, */
    double showing; /* and saving */
    double taking;  /* seconds that it takes to receive a film and to add it */
    double rested;  /* rt_clock() from when on another film may be asked for */
};

/* The units that a worker is to render next, at the given time; none, its count is 0. */
rt_unit_range rt_share_choose(const rt_share *share, const rt_share_worker *worker, double now);

/* Whether time is up and each pixel has, or is getting, a sample. */
int rt_share_is_out_of_time(const rt_share *share, double now);

/* How much of the picture is rendered, in samples or passes. */
double rt_share_rendered(const rt_share *share);

/* How much the picture is to have; where the error or time ends it, at most. */
double rt_share_all(const rt_share *share);

#endif
