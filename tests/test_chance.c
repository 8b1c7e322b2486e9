/*
 * test_chance.c - statistical tests have the false-alarm rate that they state, and detect errors.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include "kernels/rays.h"
#include "kernels/statistics.h"
#include "support.h"

/* ---- Verdicts ------------------------------------------------------------------------ */

enum { many = 100 };

static int runs; /* of the test below */

/* Each comparison is unlikely, but not among so many. */
static void one_of_many(void **state)
{
    (void)state;
    for (int i = 0; i < many; i++)
        chance_compare(i == 7 ? 1.1 * CHANCE_SUSPECT / many : 1, "comparison %d", i);
    runs++;
}

static void far_among_many(void **state)
{
    (void)state;
    for (int i = 0; i < many; i++)
        chance_compare(i == 7 ? 0.9 * CHANCE_SUSPECT / many : 1, "comparison %d", i);
}

static void far_with_the_first_seed(void **state)
{
    (void)state;
    chance_compare(test_seed(5) == 5 ? 0 : 1, "seed");
    runs++;
}

static void not_a_number(void **state)
{
    (void)state;
    chance_compare(NAN, "nothing");
}

static void without_comparisons(void **state)
{
    (void)state;
}

/* The number of tests that fail in a process with that test alone, which is to run so often. */
static int failures(struct CMUnitTest test, int expected_runs)
{
    int status;
    fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        const struct CMUnitTest tests[] = {test};
        if (!freopen("/dev/null", "w", stdout) || !freopen("/dev/null", "w", stderr))
            _exit(90);
        const int failed = cmocka_run_group_tests(tests, NULL, NULL);
        _exit(expected_runs && runs != expected_runs ? 91 : failed);
    }
    assert_true(child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status));
    return WEXITSTATUS(status);
}

static void what_is_far_with_two_seeds_fails(void **state)
{
    (void)state;
    assert_int_equal(unsetenv("RT_TEST_SEED"), 0);
    assert_int_equal(failures((struct CMUnitTest)statistical_test(one_of_many), 1), 0);
    assert_int_equal(failures((struct CMUnitTest)statistical_test(far_with_the_first_seed), 2), 0);
    assert_int_equal(failures((struct CMUnitTest)statistical_test(far_among_many), 0), 1);
    assert_int_equal(failures((struct CMUnitTest)statistical_test(not_a_number), 0), 1);
}

static void what_compares_nothing_fails(void **state)
{
    (void)state;
    assert_int_equal(failures((struct CMUnitTest)statistical_test(without_comparisons), 0), 1);
    assert_int_equal(failures((struct CMUnitTest)cmocka_unit_test(one_of_many), 0), 1);
}

static void seeds_are_as_given_unless_others_are_asked_for(void **state)
{
    (void)state;
    assert_int_equal(unsetenv("RT_TEST_SEED"), 0);
    assert_int_equal(test_seed(5), 5);
    assert_int_equal(setenv("RT_TEST_SEED", "1", 1), 0);
    const uint32_t other = test_seed(5);
    assert_int_equal(setenv("RT_TEST_SEED", "2", 1), 0);
    assert_true(other != 5 && test_seed(5) != 5 && test_seed(5) != other);
    assert_int_equal(unsetenv("RT_TEST_SEED"), 0);
}

/* ---- Chances ------------------------------------------------------------------------- */

/*
 * Values of mean 1: of two even numbers, exponential, and mostly none, so that few carry the sum.
 */
static double draw(int kind, rays_stream *stream)
{
    const double u = rays_uniform(stream);
    switch (kind) {
    case 0:
        return u + rays_uniform(stream);
    case 1:
        return -log(1 - u);
    default:
        return u < 0.05 ? 20 : 0;
    }
}

/*
 * Of correct means at most a fraction p has a p-value below p: 20 000 means each, to 5.5 standard
 * deviations.
 */
static void chances_of_means_are_chances(void **state)
{
    enum { n = 500, trials = 20000, kinds = 3 };
    static const double levels[] = {0.1, 0.01, 0.001};
    (void)state;
    for (int kind = 0; kind < kinds; kind++) {
        rays_stream stream = {7};
        int below[3] = {0};
        for (int i = 0; i < trials; i++) {
            double values[n];
            for (int k = 0; k < n; k++)
                values[k] = draw(kind, &stream);
            const double chance = chance_of_mean(values, n, 1, 0);
            for (int l = 0; l < 3; l++)
                below[l] += chance < levels[l];
        }
        for (int l = 0; l < 3; l++) {
            const double expected = trials * levels[l];
            print_message("kind %d: %d means have a chance below %g\n", kind, below[l], levels[l]);
            assert_true(below[l] < 1.5 * expected + 5 * sqrt(expected) &&
                        below[l] > 0.5 * expected - 5 * sqrt(expected));
        }
    }
}

static void means_that_are_off_have_none(void **state)
{
    double values[100];
    (void)state;
    for (int i = 0; i < 100; i++)
        values[i] = i % 2;
    assert_float_equal(chance_of_mean(values, 100, 0.5, 0), 1, 1e-12);
    assert_float_equal(chance_of_mean(values, 100, 0.4, 0.1 + 1e-9), 1, 1e-12);
    assert_true(chance_of_mean(values, 100, 0.2, 0) < 1e-7);
    assert_true(chance_of_mean(values, 100, 0.2, 0.2) > 1e-2);
    for (int i = 0; i < 100; i++)
        values[i] = 1;
    assert_true(chance_of_mean(values, 100, 1, 0) == 1);
    assert_true(chance_of_mean(values, 100, 0.99, 0) == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_far_with_two_seeds_fails),
        cmocka_unit_test(what_compares_nothing_fails),
        cmocka_unit_test(seeds_are_as_given_unless_others_are_asked_for),
        cmocka_unit_test(chances_of_means_are_chances),
        cmocka_unit_test(means_that_are_off_have_none),
    };
    return cmocka_run_group_tests_name("chance", tests, NULL, NULL);
}
