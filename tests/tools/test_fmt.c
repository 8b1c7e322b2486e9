/* test_fmt.c - `rtc fmt` in place, to stdout and as a check; and `--dump`. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "expect.h"
#include "lib/image/scratch.h"
#include "spawn.h"

#define ROUGH "film{width 4 height 5} # small\n"
#define NEAT "film { width 4  height 5 }  # small\n"

static void a_file_is_laid_out_in_place(void **state)
{
    (void)state;
    scratch_write("a.rts", ROUGH);
    run run = run_rtc("fmt a.rts");
    expect_status(&run, 0);
    run_free(&run);
    scratch_expect("a.rts", NEAT);
}

static void stdin_goes_to_stdout(void **state)
{
    (void)state;
    run run = run_rtc_input(ROUGH, strlen(ROUGH), "fmt -");
    expect_status(&run, 0);
    assert_string_equal(run.out, NEAT);
    run_free(&run);
}

static void a_check_writes_nothing_and_tells_what_would_change(void **state)
{
    (void)state;
    scratch_write("a.rts", ROUGH);
    scratch_write("b.rts", NEAT);
    run run = run_rtc("fmt --check a.rts b.rts");
    expect_status(&run, 1);
    assert_string_equal(run.out, "a.rts\n");
    run_free(&run);
    scratch_expect("a.rts", ROUGH);
    run = run_rtc("fmt --check b.rts");
    expect_status(&run, 0);
    run_free(&run);
}

static void what_is_no_scene_stays_as_it_is(void **state)
{
    (void)state;
    scratch_write("a.rts", "film { width 4\n");
    run run = run_rtc("fmt a.rts");
    expect_status(&run, 1);
    expect_err(&run, "a.rts:1:1: error: film is not closed: expected '}'");
    run_free(&run);
    scratch_expect("a.rts", "film { width 4\n");
    run = run_rtc("fmt nowhere.rts");
    expect_status(&run, 1);
    expect_err(&run, "nowhere.rts");
    run_free(&run);
    run = run_rtc("fmt");
    expect_status(&run, 2);
    run_free(&run);
}

static void a_dump_has_the_constants_of_set_and_no_settings(void **state)
{
    (void)state;
    scratch_write("a.rts",
                  "let n = 2\nmaterial m { kd 0.5 }\n"
                  "repeat i from 1 to n { sphere { centre i 0 0  radius 1  material m } }\n");
    run run = run_rtc("a.rts --dump --set n=3");
    expect_status(&run, 0);
    expect_out(&run, "centre 3 0 0");
    char *text = run.out;
    run.out = NULL;
    run_free(&run);
    run = run_rtc_input(text, strlen(text), "- --dump");
    expect_status(&run, 0);
    assert_string_equal(run.out, text);
    run_free(&run);
    free(text);
    run = run_rtc("a.rts --dump --spp 4");
    expect_status(&run, 2);
    expect_err(&run, "--spp");
    run_free(&run);
    run = run_rtc("a.rts --dump --stats --json");
    expect_status(&run, 2);
    expect_err(&run, "--json has no effect: leave it out");
    run_free(&run);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_enter, scratch_leave)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(a_file_is_laid_out_in_place),
        TEST(stdin_goes_to_stdout),
        TEST(a_check_writes_nothing_and_tells_what_would_change),
        TEST(what_is_no_scene_stays_as_it_is),
        TEST(a_dump_has_the_constants_of_set_and_no_settings),
    };
    return spawn_find_rtc() == 0 ? cmocka_run_group_tests(tests, NULL, NULL) : 1;
}
