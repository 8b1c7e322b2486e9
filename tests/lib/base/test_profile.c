/* test_profile.c - where the time goes: stages, commands, and the trace. */
#include "base/profile.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/progress.h"
#include "support.h"

static rt_profile *new_profile(int has_trace)
{
    rt_profile *profile = NULL;
    rt_error error;
    expect_ok(rt_profile_create(&profile, has_trace, &error), &error);
    return profile;
}

static void pause_ms(long ms)
{
    const struct timespec pause = {0, ms * 1000000};
    nanosleep(&pause, NULL);
}

/* The seconds of a stage are its own: what is within it counts there. */
static void stages_add_up_to_the_time_spent_in_them(void **state)
{
    rt_profile *p = new_profile(0);
    rt_profile_stage stages[4];
    (void)state;
    const double began = rt_clock();
    rt_profile_begin(p, "outer");
    pause_ms(20);
    rt_profile_begin(p, "inner");
    pause_ms(40);
    rt_profile_end(p);
    rt_profile_begin(p, "inner");
    rt_profile_end(p);
    rt_profile_end(p);
    const double took = rt_clock() - began;
    rt_profile_end(p); /* of nothing */
    assert_int_equal(rt_profile_get_stages(p, stages, 4), 2);
    assert_string_equal(stages[0].name, "outer");
    assert_string_equal(stages[1].name, "inner");
    assert_int_equal(stages[1].count, 2);
    assert_true(stages[0].seconds >= 0.02 && stages[1].seconds >= 0.04);
    assert_float_equal(stages[0].seconds + stages[1].seconds, took, 0.01);
    assert_true(stages[0].beside == 0 && stages[1].beside == 0);
    rt_profile_destroy(p);
}

static void nesting_too_deep_counts_as_the_stage_around(void **state)
{
    rt_profile *p = new_profile(0);
    rt_profile_stage stages[2];
    (void)state;
    for (int i = 0; i < 100; i++)
        rt_profile_begin(p, "deep");
    for (int i = 0; i < 100; i++)
        rt_profile_end(p);
    assert_int_equal(rt_profile_get_stages(p, stages, 2), 1);
    assert_true(stages[0].count < 100);
    rt_profile_destroy(p);
}

static void *spend(void *data)
{
    rt_profile_begin(data, "work");
    pause_ms(20);
    rt_profile_end(data);
    return NULL;
}

/* What another thread spends is no time of the one that made the profile. */
static void other_threads_are_told_apart(void **state)
{
    rt_profile *p = new_profile(0);
    rt_profile_stage stage;
    pthread_t thread;
    (void)state;
    assert_int_equal(pthread_create(&thread, NULL, spend, p), 0);
    pthread_join(thread, NULL);
    assert_int_equal(rt_profile_get_stages(p, &stage, 1), 1);
    assert_true(stage.seconds == 0 && stage.beside >= 0.02);
    rt_profile_destroy(p);
}

static void commands_are_summed_by_name(void **state)
{
    rt_profile *p = new_profile(0);
    rt_profile_command c[3];
    (void)state;
    const uint32_t device = rt_profile_add_device(p, "a device");
    rt_profile_add(p, device, &(rt_profile_done){"path", 0, 100, 1, 2, 4});
    rt_profile_add(p, device, &(rt_profile_done){"read", 1, 64, 4, 4, 5});
    rt_profile_add(p, device, &(rt_profile_done){"path", 0, 10, 5, 5.5, 6});
    assert_int_equal(rt_profile_get_commands(p, c, 3), 2);
    assert_string_equal(c[0].name, "path");
    assert_true(c[0].count == 2 && c[0].amount == 110 && !c[0].is_transfer);
    assert_float_equal(c[0].seconds, 2.5, 1e-9);
    assert_float_equal(c[0].waited, 1.5, 1e-9);
    assert_true(c[1].is_transfer && c[1].amount == 64);
    rt_profile_destroy(p);
}

/* A file as a string, which the caller frees. */
static char *read_text(const char *path)
{
    char *text = calloc(1, 65536);
    FILE *file = fopen(path, "r");
    assert_non_null(text);
    assert_non_null(file);
    assert_true(fread(text, 1, 65535, file) > 0);
    fclose(file);
    return text;
}

/* Every piece of metadata has a name that viewers know, and all that they expect of an event. */
static void expect_known_metadata(const char *text)
{
    static const char *const names[] = {"process_name", "thread_name", "process_sort_index"};
    for (const char *at = text; (at = strstr(at, "{\"name\":\"")) != NULL; at++) {
        if (at[-1] != '\n')
            continue; /* an argument */
        const char *end = strchr(at, '\n'), *name = at + strlen("{\"name\":\"");
        int is_known = 0;
        for (size_t i = 0; i < sizeof names / sizeof *names; i++)
            is_known |= strncmp(name, names[i], strlen(names[i])) == 0;
        assert_true(is_known);
        assert_true(strstr(at, "\"pid\":") < end && strstr(at, "\"tid\":") < end);
    }
}

static void a_trace_has_stages_and_commands_by_themselves(void **state)
{
    rt_profile *p = new_profile(1), *sums = new_profile(0);
    rt_error error;
    (void)state;
    assert_int_equal(rt_profile_write(sums, "profile.json", &error), RT_ERROR_USAGE);
    const uint32_t device = rt_profile_add_device(p, "a \"fast\" \\ device");
    spend(p);
    rt_profile_add(p, device, &(rt_profile_done){"path", 0, 100, 1, 2, 4});
    assert_int_equal(rt_profile_write(p, "no/such/folder.json", &error), RT_ERROR_OUTPUT);
    expect_ok(rt_profile_write(p, "profile.json", &error), &error);
    char *text = read_text("profile.json");
    assert_non_null(strstr(text, "\"name\":\"a ?fast? ? device\""));
    assert_non_null(strstr(text, "\"name\":\"work\",\"cat\":\"stage\",\"ph\":\"X\""));
    assert_non_null(strstr(text, "\"dur\":2000000.000,\"pid\":2"));
    assert_non_null(strstr(text, "\"args\":{\"work-items\":100}"));
    expect_known_metadata(text);
    free(text);
    remove("profile.json");
    rt_profile_destroy(p);
    rt_profile_destroy(sums);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stages_add_up_to_the_time_spent_in_them),
        cmocka_unit_test(nesting_too_deep_counts_as_the_stage_around),
        cmocka_unit_test(other_threads_are_told_apart),
        cmocka_unit_test(commands_are_summed_by_name),
        cmocka_unit_test(a_trace_has_stages_and_commands_by_themselves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
