/* statistics.h - tests of samples against what they should be. */
#ifndef RT_TESTS_KERNELS_STATISTICS_H
#define RT_TESTS_KERNELS_STATISTICS_H

#include <stddef.h>
#include <stdint.h>

/*
 * Pearson's chi-square test, cells with few expected counts pooled: fails the running test when
 * samples of the stated density would give such counts in fewer than 4 of a million runs.
 */
void expect_counts(const uint32_t *counts, const double *expected, size_t cells, const char *what);

/* Fails when the mean of n values is more than 4.5 standard errors, and `rounding`, from the truth: 7 in a million. */
void expect_mean(const double *values, size_t n, double truth, double rounding, const char *what);

#endif
