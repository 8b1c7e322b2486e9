/*
 * replicates.h - the order in which samples are taken where the error is to be estimated: a few
 * sequences of samples, each scrambled on its own (rt_params.replicate), which grow together. Few
 * and long sequences keep most of the advantage that a Sobol sequence has over independent samples;
 * the variance among them estimates the error (see noise.h).
 */
#ifndef RT_LIB_FILM_REPLICATES_H
#define RT_LIB_FILM_REPLICATES_H

#include <stdint.h>

enum { RT_REPLICATES = 8 };

/* The samples that come next: first .. first + count - 1 of a replicate. None end the order. */
typedef struct rt_sample_range {
    uint32_t replicate, first, count;
    uint32_t total, replicates; /* samples of all replicates together, and their number */
    uint32_t from, to;          /* the replicates grow from one length to the other */
} rt_sample_range;

/* The first samples of so many in all, in replicates or in one sequence. */
rt_sample_range rt_sample_range_first(uint32_t total, int replicated);

/*
 * Those of the next replicate; after the last, of the first again. Lengths are 1, 2, 3, 4, 6, 8,
 * 12, 16 and so on.
 */
rt_sample_range rt_sample_range_next(rt_sample_range range);

/* The length that a replicate of `length` samples grows to next. */
uint32_t rt_replicate_grow(uint32_t length);

#endif
