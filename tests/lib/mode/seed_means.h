/*
 * seed_means.h - means of pictures whose pixels share photons: their standard error is by the
 * scatter of renders of other seeds.
 */
#ifndef RT_TESTS_LIB_MODE_SEED_MEANS_H
#define RT_TESTS_LIB_MODE_SEED_MEANS_H

#include "rt.h"

enum { SEEDS = 14 }; /* by chance.h, a bound of 5 standard errors is enough */

/* A mean over SEEDS renders, and its standard error. */
typedef struct seed_mean {
    double value[3], error[3];
} seed_mean;

/* The mean of the pictures, in which no sample may be rejected. */
seed_mean seed_mean_of(rt_renderer *renderer, rt_render_options options);

/* part: by which the blur over discs may be off. */
void expect_mean_near(const seed_mean *m, const double exact[3], double part);

/* Two means are the same, but for a part by blur. */
void expect_same_mean(const seed_mean *a, const seed_mean *b, double part);

#endif
