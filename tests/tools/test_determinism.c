/*
 * test_determinism.c - the same seed gives the same bytes of EXR, run after run, however the work
 * is shared out.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "expect.h"
#include "lib/image/scratch.h"
#include "spawn.h"

/*
 * Diffuse, mirror and glass, a point and an area light, a thin lens: all that draws samples.
 */
static const char scene[] =
    "camera { eye 0 1.5 -5  look_at 0 0.8 0  fov 45  aperture 0.05 }\n"
    "film { width 37  height 29 }\n"
    "material white { kd 0.7 }\n"
    "material mirror { ks 0.9 }\n"
    "material glass { kt 1  ior 1.5  fresnel dielectric }\n"
    "plane { point 0 0 0  normal 0 1 0  material white }\n"
    "sphere { centre -1.2 1 0  radius 1  material mirror }\n"
    "sphere { centre 1 1 0  radius 0.9  material glass }\n"
    "triangle { a -4 0 3  b 0 6 3  c 4 0 3  material white }\n"
    "quad { corner -1 4 -1  edge1 2 0 0  edge2 0 0 2  material white  radiance 8 }\n"
    "light point { position 2 4 -3  intensity 20 }\n";

enum { RUNS = 5 };

static void render(const char *mode, const char *how, const char *out)
{
    run run =
        run_rtc("a.rts --quiet --spp 5 --photons 20000 --final-gather 1 --seed 3 %s %s --out %s",
                mode, how, out);
    expect_status(&run, 0);
    run_free(&run);
}

/* Each size of work-group compiles the mode's kernels once more. */
static void check_mode(const char *mode, const char *const groups[], int group_count)
{
    static const char *const threads[] = {"1", "2"};
    scratch_write("a.rts", scene);
    render(mode, "", "first.exr");
    for (int i = 1; i < RUNS; i++) {
        render(mode, "", "again.exr");
        expect_same_files("first.exr", "again.exr");
    }
    for (int t = 0; t < 2; t++)
        for (int g = 0; g < group_count; g++) {
            char how[64];
            snprintf(how, sizeof how, "--threads %s --work-group %s", threads[t], groups[g]);
            render(mode, how, "shared.exr");
            expect_same_files("first.exr", "shared.exr");
        }
}

static void path_mode_gives_the_same_bytes(void **state)
{
    static const char *const groups[] = {"1", "16", "64"};
    (void)state;
    check_mode("--mode path", groups, 3);
}

/* PoCL is told to offer two devices. A runtime that ignores that has one, which all names too. */
static void several_devices_give_the_same_bytes(void **state)
{
    static const char *const modes[] = {"--mode path --target-error 0.6 --spp 64",
                                        "--mode photon --caustic-photons 5000 --spp 3",
                                        "--mode photon --passes 5 --photons 4000"};
    (void)state;
    scratch_write("a.rts", scene);
    for (size_t i = 0; i < sizeof modes / sizeof *modes; i++) {
        run run = run_rtc("a.rts --quiet --seed 3 %s --out one.exr", modes[i]);
        expect_status(&run, 0);
        run_free(&run);
        assert_int_equal(setenv("POCL_DEVICES", "pthread basic", 1), 0);
        run = run_rtc("a.rts --quiet --seed 3 %s --device all --out all.exr", modes[i]);
        assert_int_equal(unsetenv("POCL_DEVICES"), 0);
        expect_status(&run, 0);
        run_free(&run);
        expect_same_files("one.exr", "all.exr");
    }
    run run = run_rtc("a.rts --device 0,0");
    expect_status(&run, 2);
    expect_err(&run, "--device 0,0 names device 0 twice");
    run_free(&run);
    run = run_rtc("a.rts --device 0,,1");
    expect_status(&run, 2);
    run_free(&run);
}

/* PoCL is told to take one work-item a work-group, less than are usual here. */
static void a_device_of_small_work_groups_gives_the_same_bytes(void **state)
{
    (void)state;
    scratch_write("a.rts", scene);
    render("--mode path", "", "first.exr");
    run run = run_rtc("POCL_MAX_WORK_GROUP_SIZE=1 rtc a.rts --quiet --spp 5 --photons 20000 "
                      "--final-gather 1 --seed 3 "
                      "--mode path --out small.exr");
    expect_status(&run, 0);
    run_free(&run);
    expect_same_files("first.exr", "small.exr");
}

static void photon_mode_gives_the_same_bytes(void **state)
{
    static const char *const groups[] = {"1", "16"};
    (void)state;
    check_mode("--mode photon", groups, 2);
}

/* The variance is in the file, and where the render ends depends on it. */
static void what_is_said_of_the_error_is_the_same_bytes(void **state)
{
    static const char *const modes[] = {
        "--mode path --spp 1000 --target-error 0.3",
        "--mode photon --spp 1 --photons 1000 --passes 50 --target-error 0.5"};
    (void)state;
    scratch_write("a.rts", scene);
    for (int i = 0; i < 2; i++) {
        render(modes[i], "", "first.exr");
        render(modes[i], "--threads 1 --work-group 16", "again.exr");
        expect_same_files("first.exr", "again.exr");
    }
}

/* Else the tests above could not fail. */
static void another_seed_gives_other_bytes(void **state)
{
    (void)state;
    static const char *const modes[] = {"--mode path", "--mode photon"};
    scratch_write("a.rts", scene);
    for (int i = 0; i < 2; i++) {
        render(modes[i], "--seed 3", "a.pfm");
        render(modes[i], "--seed 4", "b.pfm");
        expect_different_files("a.pfm", "b.pfm");
    }
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_enter, scratch_leave)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(path_mode_gives_the_same_bytes),
        TEST(several_devices_give_the_same_bytes),
        TEST(a_device_of_small_work_groups_gives_the_same_bytes),
        TEST(photon_mode_gives_the_same_bytes),
        TEST(what_is_said_of_the_error_is_the_same_bytes),
        TEST(another_seed_gives_other_bytes),
    };
    return spawn_find_rtc() == 0 ? cmocka_run_group_tests(tests, NULL, NULL) : 1;
}
