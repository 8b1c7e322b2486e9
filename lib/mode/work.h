/*
 * work.h - which units of work come next in a render, what is done and how far it is: a whole
 * picture, what a film to be continued lacks, one of several parts, or ranges that the caller hands
 * out.
 */
#ifndef RT_LIB_MODE_WORK_H
#define RT_LIB_MODE_WORK_H

#include "base/progress.h"
#include "film/film.h"
#include "film/noise.h"

typedef struct rt_work {
    const rt_render_options *options;
    rt_film *film;
    uint64_t at, end; /* the next unit to look at, and the end of the range */
    double done, all; /* samples or passes of this work, in pixels */
    double resumed;   /* those that the film had when it began */
    double began;     /* rt_clock() */
    double saved;     /* rt_clock() after the last checkpoint */
    double saving;    /* seconds that it took */
    double shown;     /* as saved, of previews, */
    double showing;   /* and saving */
    double *seconds;  /* of the film's stats, that the time since `began` belongs to, or NULL */
    double before;    /* what they were, less rt_clock() */
    int is_whole;     /* neither a part nor handed out: the error can be tested on the way */
    int enough;       /* the error asked for is reached */
    int must_save;    /* next_units wants a checkpoint */
    rt_noise noise;
    rt_profile *profile; /* of tests and checkpoints; set by the caller, or NULL */
} rt_work;

/* Begins with the units that the film lacks; its sums must be in host memory. */
rt_work rt_work_begin(rt_film *film, const rt_render_options *options);

/*
 * The next units of one block; 0: there are none, or time is up, or the error small enough. None at
 * all where a checkpoint is to be made first, see rt_work_save_is_due.
 */
int rt_work_next(rt_work *work, rt_unit_range *out);

/*
 * Adds the next block to a range of whole blocks, where all of it is to be done too and its samples
 * follow theirs; returns whether it did.
 */
int rt_work_extend(rt_work *work, rt_unit_range *range);

/* Notes units whose samples the sums of the film, here or on the device, have. */
rt_status rt_work_done(rt_work *work, rt_unit_range units, rt_error *error);

/* Whether options->time is up and every pixel has a sample. */
int rt_work_is_out_of_time(const rt_work *work);

/* How much is done, see rt_extent_fraction; and a stage whose updates are fractions of that. */
rt_status rt_work_begin_stage(const rt_work *work, rt_stage_progress *progress, rt_stage stage);
double rt_work_fraction(const rt_work *work);

/*
 * Whether the error is to be tested now, which needs the film's sums: rt_work_test. All units
 * before the next one must be done for that.
 */
int rt_work_test_is_due(const rt_work *work);
void rt_work_test(rt_work *work);

/*
 * Whether a checkpoint is due, which needs the film's sums: rt_work_save. Returns whether the film
 * was handed over and is empty now, which the device has to know.
 */
int rt_work_save_is_due(const rt_work *work);
int rt_work_save(rt_work *work);

/*
 * The same for a preview, which leaves the film as it is. began: rt_clock() before the film was
 * read from the device for it.
 */
int rt_work_preview_is_due(const rt_work *work);
void rt_work_preview(rt_work *work, double began);

/* Books the time since this work began on these seconds of the film's stats, from now on. */
void rt_work_time(rt_work *work, double *seconds);
void rt_work_end_time(rt_work *work);

#endif
