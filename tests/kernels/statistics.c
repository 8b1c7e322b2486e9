/* statistics.c - p-values of means and counts. */
#include "statistics.h"

#include <math.h>

#include "support.h"

enum { smallest_cell = 10 };

/* Wilson and Hilferty, PNAS 17(12), 1931. */
double chi_square_deviate(double chi_square, double freedom)
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
    return 0.5 * erfc(chi_square_deviate(sum, (double)used) / sqrt(2));
}

void expect_counts(const uint32_t *counts, const double *expected, size_t cells, const char *what)
{
    for (size_t i = 0; i < cells; i++)
        if (expected[i] <= 0 && counts[i] > 0)
            fail_msg("%s: %u samples in cell %zu, where none can be", what, counts[i], i);
    chance_compare(chance_of_counts(counts, expected, cells), "%s: counts", what);
}

/* The mean of n values, its standard error and its skewness. */
static void measure(const double *values, size_t n, double *mean, double *error, double *skewness)
{
    double sum = 0, squares = 0, cubes = 0;
    for (size_t i = 0; i < n; i++)
        sum += values[i];
    *mean = sum / (double)n;
    for (size_t i = 0; i < n; i++) {
        const double off = values[i] - *mean;
        squares += off * off;
        cubes += off * off * off;
    }
    *error = sqrt(squares / ((double)n * (double)(n - 1)));
    *skewness = squares > 0 ? cubes / pow(squares, 1.5) : 0;
}

/*
 * Where few of the values carry most of the sum, t is skewed: where too few of them were sampled,
 * mean and standard error are both too small. Hall's transformation corrects that: "On the Removal
 * of Skewness by Transformation", J. R. Statist. Soc. B 54(1), 1992.
 */
static double without_skewness(double t, double skewness)
{
    return t + skewness * t * t / 3 + skewness * skewness * t * t * t / 27 + skewness / 6;
}

double chance_of_mean(const double *values, size_t n, double exact, double rounding)
{
    double mean, error, skewness;
    measure(values, n, &mean, &error, &skewness);
    if (fabs(mean - exact) <= rounding)
        return 1;
    const double t = copysign(fabs(mean - exact) - rounding, mean - exact) / error;
    return chance_of_student(without_skewness(t, skewness), (double)(n - 1));
}

void expect_mean(const double *values, size_t n, double exact, double rounding, const char *what)
{
    double mean, error, skewness;
    measure(values, n, &mean, &error, &skewness);
    chance_compare(chance_of_mean(values, n, exact, rounding),
                   "%s: mean %.9g, should be %.9g, standard error %.3g", what, mean, exact, error);
}

void expect_deviate(double deviate, const char *what)
{
    chance_compare(chance_of_student(deviate, INFINITY), "%s: %+.2f standard errors off", what,
                   deviate);
}

void expect_close(double found, double exact, double bound, const char *what)
{
    chance_compare(fabs(found - exact) <= bound, "%s: %.9g, should be %.9g to %.3g", what, found,
                   exact, bound);
}
