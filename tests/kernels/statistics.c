#include "statistics.h"

#include <math.h>

#include "support.h"

enum { smallest_cell = 10 };

static const double limit = 4.5; /* standard deviations */

/* The chi-square value as a standard normal deviate: Wilson and Hilferty, PNAS 17(12), 1931. */
static double deviate(double chi_square, double freedom)
{
    double variance = 2 / (9 * freedom);
    return (cbrt(chi_square / freedom) - (1 - variance)) / sqrt(variance);
}

void expect_counts(const uint32_t *counts, const double *expected, size_t cells, const char *what)
{
    double sum = 0, pooled = 0, pooled_expected = 0;
    size_t used = 0;

    for (size_t i = 0; i < cells; i++) {
        if (expected[i] < smallest_cell) {
            pooled += counts[i];
            pooled_expected += expected[i];
            if (expected[i] <= 0 && counts[i] > 0)
                fail_msg("%s: %u samples in cell %zu, where none can be", what, counts[i], i);
        } else {
            sum += (counts[i] - expected[i]) * (counts[i] - expected[i]) / expected[i];
            used++;
        }
    }
    if (pooled_expected >= smallest_cell) {
        sum += (pooled - pooled_expected) * (pooled - pooled_expected) / pooled_expected;
        used++;
    }
    assert_true(used >= 2);
    if (deviate(sum, (double)used - 1) > limit)
        fail_msg("%s: chi-square %g with %zu cells", what, sum, used);
}

void expect_mean(const double *values, size_t n, double truth, double rounding, const char *what)
{
    double sum = 0, squares = 0;
    for (size_t i = 0; i < n; i++)
        sum += values[i];
    double mean = sum / (double)n;
    for (size_t i = 0; i < n; i++)
        squares += (values[i] - mean) * (values[i] - mean);
    double error = sqrt(squares / ((double)n * (double)(n - 1)));
    if (!(fabs(mean - truth) <= limit * error + rounding))
        fail_msg("%s: mean %.9g, should be %.9g, standard error %.3g", what, mean, truth, error);
}
