/* progress.h - how far the reading of a scene has come, for the caller's hooks. */
#ifndef RT_DSL_PROGRESS_H
#define RT_DSL_PROGRESS_H

#include "rt.h"

/* Plain data; needs no destruction. Work is counted in bytes of text, read again by each repeat. */
typedef struct rt_reading {
    const rt_hooks *hooks; /* NULL: none */
    double began, last;    /* seconds */
    double done;           /* bytes so far */
    double left;           /* bytes behind the text or repeat that is being read, as far as known */
    double furthest;       /* fraction reported so far; none is below it */
    unsigned steps;        /* since the clock was read */
} rt_reading;

/* Each returns whether to go on: 0 when the callback asks to stop. */
int rt_reading_begin(rt_reading *reading, const rt_hooks *hooks);
int rt_reading_end(rt_reading *reading);

/* So many bytes were read, and so many are left in the text. At most ten reports a second. */
int rt_reading_step(rt_reading *reading, size_t bytes, size_t left);

#endif
