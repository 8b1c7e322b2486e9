/* statistics.h - statistical tests of samples: Pearson's chi-square, and means. */
#ifndef RT_TESTS_KERNELS_STATISTICS_H
#define RT_TESTS_KERNELS_STATISTICS_H

#include <stddef.h>
#include <stdint.h>

#include "chance.h"

/*
 * Pearson's chi-square test, cells with fewer than 10 expected counts pooled: the probability that
 * samples of the stated density give counts at least as far from it.
 */
double chance_of_counts(const uint32_t *counts, const double *expected, size_t cells);

/*
 * The probability that the mean of n independent values, by their own variance, is at least as far
 * from the exact mean as this; a deviation up to `rounding` is allowed.
 */
double chance_of_mean(const double *values, size_t n, double exact, double rounding);

/*
 * A chi-square value with so many degrees of freedom as a deviate of the standard normal
 * distribution.
 */
double chi_square_deviate(double chi_square, double freedom);

/* Comparisons of a statistical test; see chance.h. */

/* Samples where none can be fail the test at once. */
void expect_counts(const uint32_t *counts, const double *expected, size_t cells, const char *what);

/* By chance_of_mean. */
void expect_mean(const double *values, size_t n, double exact, double rounding, const char *what);

/* A number that should be standard normal, or closer to 0. */
void expect_deviate(double deviate, const char *what);

/*
 * A random number held to a bound of five standard deviations or more, which the caller knows from
 * elsewhere.
 */
void expect_close(double found, double exact, double bound, const char *what);

#endif
