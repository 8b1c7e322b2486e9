#include "statistics.h"

#include <math.h>

#include "support.h"

enum { smallest_cell = 10 };

static const double limit = 4.5, limit_of_many = 5.5; /* standard deviations */

/* The chi-square value as a standard normal deviate: Wilson and Hilferty, PNAS 17(12), 1931. */
static double deviate(double chi_square, double freedom)
{
    double variance = 2 / (9 * freedom);
    return (cbrt(chi_square / freedom) - (1 - variance)) / sqrt(variance);
}

double chance_of_counts(const uint32_t *counts, const double *expected, size_t cells)
{
    double sum = 0, pooled = 0, pooled_expected = 0, least = INFINITY, least_count = 0;
    size_t used = 0;

    for (size_t i = 0; i < cells; i++) {
        if (expected[i] < smallest_cell) {
            pooled += counts[i];
            pooled_expected += expected[i];
            continue;
        }
        if (expected[i] < least) {
            least = expected[i];
            least_count = counts[i];
        }
        sum += (counts[i] - expected[i]) * (counts[i] - expected[i]) / expected[i];
        used++;
    }
    /* A pool that is too small itself goes to the smallest of the other cells. */
    if (used > 0 && pooled_expected < smallest_cell) {
        sum -= (least_count - least) * (least_count - least) / least;
        pooled += least_count;
        pooled_expected += least;
        used--;
    }
    sum += (pooled - pooled_expected) * (pooled - pooled_expected) / pooled_expected;
    assert_true(used >= 1);
    return 0.5 * erfc(deviate(sum, (double)used) / sqrt(2));
}

void expect_counts(const uint32_t *counts, const double *expected, size_t cells, const char *what)
{
    for (size_t i = 0; i < cells; i++)
        if (expected[i] <= 0 && counts[i] > 0)
            fail_msg("%s: %u samples in cell %zu, where none can be", what, counts[i], i);
    const double chance = chance_of_counts(counts, expected, cells);
    if (chance < 0.5 * erfc(limit / sqrt(2)))
        fail_msg("%s: such counts have a chance of %g", what, chance);
}

/* Mean and standard error of n values. */
static void measure(const double *values, size_t n, double *mean, double *error)
{
    double sum = 0, squares = 0;
    for (size_t i = 0; i < n; i++)
        sum += values[i];
    *mean = sum / (double)n;
    for (size_t i = 0; i < n; i++)
        squares += (values[i] - *mean) * (values[i] - *mean);
    *error = sqrt(squares / ((double)n * (double)(n - 1)));
}

static void expect_within(const double *values, size_t n, double truth, double deviates, double rounding,
                          const char *what)
{
    double mean, error;
    measure(values, n, &mean, &error);
    if (!(fabs(mean - truth) <= deviates * error + rounding))
        fail_msg("%s: mean %.9g, should be %.9g, standard error %.3g", what, mean, truth, error);
}

void expect_mean(const double *values, size_t n, double truth, double rounding, const char *what)
{
    expect_within(values, n, truth, limit, rounding, what);
}

void expect_mean_of_many(const double *values, size_t n, double truth, double rounding, const char *what)
{
    expect_within(values, n, truth, limit_of_many, rounding, what);
}
