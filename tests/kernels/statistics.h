/* statistics.h - tests of samples against what they should be. */
#ifndef RT_TESTS_KERNELS_STATISTICS_H
#define RT_TESTS_KERNELS_STATISTICS_H

#include <stddef.h>
#include <stdint.h>

/*
 * Pearson's chi-square test, cells with fewer than 10 expected counts pooled: the chance that samples of the stated
 * density give counts as far from it as these, or farther.
 */
double chance_of_counts(const uint32_t *counts, const double *expected, size_t cells);

/* Fails the running test when that chance is below 4 in a million, or samples lie where none can be. */
void expect_counts(const uint32_t *counts, const double *expected, size_t cells, const char *what);

/* Fails when the mean of n values is more than 4.5 standard errors, and `rounding`, from the truth: 7 in a million. */
void expect_mean(const double *values, size_t n, double truth, double rounding, const char *what);

/* The same for one mean of hundreds: more than 5.5 standard errors, 4 in a hundred million. */
void expect_mean_of_many(const double *values, size_t n, double truth, double rounding, const char *what);

#endif
