/*
 * replicates.h - the order in which samples are taken where the error is to be known: a few
 * sequences of samples, each scrambled on its own (rt_params.replicate), which grow together. Few
 * and long ones keep most of what a Sobol sequence is better at than chance; the spread among them
 * tells the error (see noise.h).
 */
#ifndef RT_LIB_RENDER_REPLICATES_H
#define RT_LIB_RENDER_REPLICATES_H

#include <stdint.h>

enum { RT_REPLICATES = 8 };

/* The samples that come next: first .. first + count - 1 of a replicate. None end the order. */
typedef struct rt_stretch {
    uint32_t replicate, first, count;
    uint32_t all, replicates; /* samples in all, and what they are shared by */
    uint32_t from, to;        /* the replicates grow from one length to the other */
} rt_stretch;

/* The first samples of so many in all, in replicates or in one sequence. */
rt_stretch rt_stretch_first(uint32_t all, int replicated);

/*
 * Those of the next replicate; after the last, of the first again. Lengths are 1, 2, 3, 4, 6, 8,
 * 12, 16 and so on.
 */
rt_stretch rt_stretch_next(rt_stretch stretch);

/* What a replicate has after it has `length`. */
uint32_t rt_replicate_grow(uint32_t length);

#endif
