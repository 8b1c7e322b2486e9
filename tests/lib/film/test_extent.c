/* test_extent.c - the time that remains is right by samples, by time and by the error. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/progress.h"
#include "film/extent.h"

static const rt_noise untested = {.next_test = 8, .error = -1};

/* What a caller makes of it. */
static double remaining(const rt_extent *e)
{
    return rt_time_remaining(e->elapsed, rt_extent_origin(e), rt_extent_fraction(e));
}

static void expect_near(double found, double right)
{
    if (!(fabs(found - right) <= 1e-9 * fabs(right)))
        fail_msg("found %.12g, expected %.12g", found, right);
}

/* 50 of 100 samples were there; 10 more took 10 s. */
static void what_was_there_before_took_no_time(void **state)
{
    rt_extent e = {
        .before = 50, .done = 60, .all = 100, .elapsed = 10, .noise = &untested, .replicates = 1};
    (void)state;
    expect_near(rt_extent_fraction(&e), 0.6);
    expect_near(rt_extent_origin(&e), 0.5);
    expect_near(remaining(&e), 40);
    e.before = 0;
    expect_near(remaining(&e), 10 * 40.0 / 60);
    e.before = e.done = 100;
    assert_true(rt_extent_fraction(&e) == 1);
}

/* A limit of time ends it first, whatever was there before. */
static void a_limit_of_time_is_what_is_left_of_it(void **state)
{
    rt_extent e = {.before = 90,
                   .done = 91,
                   .all = 100,
                   .elapsed = 4,
                   .time = 10,
                   .noise = &untested,
                   .replicates = 1};
    (void)state;
    expect_near(remaining(&e), 6);
    e.time = 100; /* samples end it first */
    expect_near(remaining(&e), 36);
}

/* Twice the error asked for at 40 samples: 160 are wanted, of which 20 were there. */
static void an_error_is_reached_by_four_times_the_samples(void **state)
{
    const rt_noise noise = {.next_test = 80, .error = 0.015, .bound = 0.02, .tested_at = 40};
    rt_extent e = {.before = 20,
                   .done = 60,
                   .all = 1e9,
                   .elapsed = 10,
                   .target = 0.01,
                   .noise = &noise,
                   .replicates = 1};
    (void)state;
    expect_near(remaining(&e), 25);
    e.noise = &untested;
    assert_true(remaining(&e) < 0 && rt_extent_fraction(&e) == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_was_there_before_took_no_time),
        cmocka_unit_test(a_limit_of_time_is_what_is_left_of_it),
        cmocka_unit_test(an_error_is_reached_by_four_times_the_samples),
    };
    return cmocka_run_group_tests_name("film/extent", tests, NULL, NULL);
}
