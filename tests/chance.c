/* chance.c - adds up the rate of false alarms, and repeats suspect tests. */
#include "chance.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "support.h"

static const double pi = 3.14159265358979323846;

/* ---- What is spent ---------------------------------------------------------------- */

static double spent;

/* The line that tests/run.sh reads. */
static void tell_spent(void)
{
    printf("[  CHANCE  ] %.3g\n", spent);
}

void chance_spend(double chance)
{
    if (spent == 0)
        atexit(tell_spent);
    spent += chance;
}

/* ---- Tests -------------------------------------------------------------------------- */

/* A run of a statistical test. */
static struct {
    int is_running;
    uint32_t round; /* 1: again */
    int comparisons;
    double least;   /* chance of them */
    char what[400]; /* of the least */
} trial;

uint32_t test_seed(uint32_t seed)
{
    const char *wanted = getenv("RT_TEST_SEED");
    const uint32_t drawn = wanted ? (uint32_t)strtoul(wanted, NULL, 10) : 0;
    return seed + (2 * drawn + trial.round) * 0x85ebca6bu;
}

void chance_compare(double chance, const char *format, ...)
{
    if (!trial.is_running)
        fail_msg("%s: compared outside of a statistical test", format);
    trial.comparisons++;
    if (chance >= trial.least)
        return;
    trial.least = isnan(chance) ? 0 : chance;
    va_list args;
    va_start(args, format);
    vsnprintf(trial.what, sizeof trial.what, format, args);
    va_end(args);
}

static int is_suspect(const chance_test *test, uint32_t round)
{
    void *state = test->state;
    trial.is_running = 1;
    trial.round = round;
    trial.comparisons = 0;
    trial.least = 2;
    test->test(&state);
    trial.is_running = 0;
    trial.round = 0;
    assert_true(trial.comparisons > 0);
    if (trial.least * trial.comparisons >= CHANCE_SUSPECT)
        return 0;
    print_message("suspect: %s; a chance of %.2g in one of %d comparisons\n", trial.what,
                  trial.least, trial.comparisons);
    return 1;
}

void chance_run(void **state)
{
    const chance_test *test = *state;
    chance_spend(CHANCE_TEST);
    if (is_suspect(test, 0) && is_suspect(test, 1))
        fail_msg("%s; a chance of %.2g, and suspect with other seeds as well", trial.what,
                 trial.least);
}

/* ---- Student's t ---------------------------------------------------------------------- */

/*
 * Abramowitz and Stegun, "Handbook of Mathematical Functions", 26.7.3 and 26.7.4; in the limit it
 * is normal.
 */
double chance_of_student(double t, double freedom)
{
    if (freedom > 10000)
        return erfc(fabs(t) / sqrt(2));
    const double angle = atan(fabs(t) / sqrt(freedom)), c = cos(angle), s = sin(angle);
    const int is_odd = (int)freedom % 2;
    double term = is_odd ? c : 1, sum = 0;
    for (int i = is_odd; i <= (int)freedom - 2; i += 2) {
        sum += term;
        term *= c * c * (i + 1) / (i + 2);
    }
    return fmax(0, 1 - (is_odd ? 2 / pi * (angle + s * sum) : s * sum));
}
