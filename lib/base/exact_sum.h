/*
 * exact_sum.h - sums of doubles that have the same bits in whatever order and in how many parts
 * they are taken. camera/film_sum.h, which does the same for the floats of a film on the device,
 * explains how.
 */
#ifndef RT_LIB_BASE_EXACT_SUM_H
#define RT_LIB_BASE_EXACT_SUM_H

#include <stdint.h>

enum { RT_EXACT_SUM_BIN_LAST = 66 }; /* the highest that is a lower bin */

/* All zero is a sum of nothing. */
typedef struct rt_exact_sum {
    int64_t high, low; /* of two neighbouring bins of 31 bits */
    int64_t bin;       /* the lower one: units of 2^(31 bin - 1074) */
} rt_exact_sum;

/* Adds a finite number, of up to 2^32; what is below 2^-31 of the largest is left out. */
void rt_exact_sum_add(rt_exact_sum *sum, double value);

/* Adds all numbers of another sum. */
void rt_exact_sum_join(rt_exact_sum *sum, const rt_exact_sum *other);

double rt_exact_sum_value(const rt_exact_sum *sum);

#endif
