/*
 * chance.h - the false-alarm rate of statistical tests: all of `make check` together fails in fewer
 * than one of 10^4 runs of correct code, were seeds drawn anew for each. As seeds are fixed, the
 * verdict on one machine never changes.
 *
 * A statistical test makes T comparisons, each with a p-value: the probability that correct code
 * deviates at least as much. The test is suspect when one of these is below CHANCE_SUSPECT / T,
 * which by Bonferroni's inequality happens in fewer than CHANCE_SUSPECT of all runs, whatever T is
 * and however the comparisons are correlated. Then the whole test runs again with other seeds, and
 * fails only if it is suspect again: CHANCE_TEST of all runs. Wrong code is wrong with any seed, so
 * limits of 3.5 standard errors for one comparison, and of 4.9 for 500, are enough.
 *
 * Where the standard error is known only from other seeds, a bound is stated, of 5 standard
 * deviations over 14 seeds or 7 over 8: Student's t of as many degrees of freedom less one is
 * beyond that in fewer than CHANCE_SUSPECT of all runs.
 *
 *   what                                         how many       a false alarm of each     together
 *   statistical tests: kernels/, lib/,
 *     statistics/test_scattering                 about 90       (5e-4)^2 = 2.5e-7         2.3e-5
 *   checks of proof/, Student's t                about 350      7e-8                      2.5e-5
 *   families of statistics/chi_square.h,
 *     T' tests, each suspect and again so        2              T' (0.01 / T')^2          1.2e-6
 *                                                                                           4.9e-5
 *
 * This table need not be kept up to date: each program adds up its own part as it runs, and
 * tests/run.sh adds up all of them and fails above 1e-4.
 */
#ifndef RT_TESTS_CHANCE_H
#define RT_TESTS_CHANCE_H

#include <stdint.h>

#define CHANCE_SUSPECT 5e-4
#define CHANCE_TEST (CHANCE_SUSPECT * CHANCE_SUSPECT)

/*
 * The seed of random numbers: as given, another one when a suspect runs again, and other ones for
 * each value of the environment variable RT_TEST_SEED, with which false alarms can be counted.
 */
uint32_t test_seed(uint32_t seed);

/*
 * A test that compares by chance_compare, or by the functions of kernels/statistics.h, as an entry
 * of a cmocka group. The group must have no state of its own, which would replace the entry's.
 */
typedef struct chance_test {
    void (*test)(void **state);
    void *state;
} chance_test;
#define statistical_test(f) statistical_test_of(#f, f, NULL)
#define statistical_test_of(name, f, state)                                                        \
    {                                                                                              \
        name, chance_run, NULL, NULL, &(chance_test)                                               \
        {                                                                                          \
            f, state                                                                               \
        }                                                                                          \
    }
void chance_run(void **state);

/* One comparison of a statistical test: its p-value and what it compared. */
void chance_compare(double chance, const char *format, ...) __attribute__((format(printf, 2, 3)));

/*
 * The chance that Student's t with that many degrees of freedom, a whole number, is as far from 0
 * as t or farther.
 */
double chance_of_student(double t, double freedom);

/* Adds to the false-alarm rate of this program; statistical tests do so themselves. */
void chance_spend(double chance);

#endif
