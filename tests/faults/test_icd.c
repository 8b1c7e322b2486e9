/*
 * test_icd.c - rtc on platforms and devices that fail, played by icd.c: it says what is wrong, ends
 * with the right status, and goes on where it can.
 */
#define _XOPEN_SOURCE 700

#include <limits.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "lib/image/scratch.h"
#include "tools/expect.h"
#include "tools/small_scene.h"
#include "tools/spawn.h"

static char icd_path[PATH_MAX];

static int enter(void **state)
{
    char text[PATH_MAX + 2];
    if (scratch_enter(state) != 0)
        return -1;
    snprintf(text, sizeof text, "%s\n", icd_path);
    scratch_write("faulty.icd", text);
    scratch_write("a.rts", small_scene);
    return 0;
}

/* The environment of a run on the platform of faulty.icd. */
#define PLAY(name) "OCL_ICD_VENDORS=./faulty.icd RT_ICD_PLAY=" name " "

static void without_a_fault_it_renders(void **state)
{
    (void)state;
    run run = run_rtc(PLAY("well") "rtc a.rts --spp 1 --out a.pfm");
    expect_status(&run, 0);
    run_free(&run);
    expect_file("a.pfm");
}

static void no_platform_is_told(void **state)
{
    (void)state;
    run run = run_rtc(PLAY("none") "rtc a.rts --spp 1 --out a.pfm");
    expect_status(&run, 3);
    expect_err(&run, "no OpenCL platform is installed");
    run_free(&run);
    expect_no_file("a.pfm");
    run = run_rtc(PLAY("none") "rtc doctor");
    expect_status(&run, 3);
    expect_out(&run, "apt-get install pocl-opencl-icd");
    run_free(&run);
}

static void a_broken_platform_alone_is_told(void **state)
{
    (void)state;
    run run = run_rtc(PLAY("broken") "rtc a.rts --spp 1 --out a.pfm");
    expect_status(&run, 3);
    expect_err(&run, "no OpenCL device on 1 platform: CL_OUT_OF_HOST_MEMORY (-6)");
    run_free(&run);
}

static void a_broken_platform_beside_a_good_one_does_not_matter(void **state)
{
    char *folder = realpath(".", NULL);
    (void)state;
    assert_non_null(folder);
    scratch_write("good.icd", "libpocl.so.2\n");
    run run =
        run_rtc("OCL_ICD_VENDORS=%s RT_ICD_PLAY=broken rtc a.rts --spp 1 --out a.pfm", folder);
    expect_status(&run, 0);
    run_free(&run);
    free(folder);
    expect_file("a.pfm");
}

static void a_lost_device_is_told_and_the_old_picture_stays(void **state)
{
    static const char *const modes[] = {"path --spp 64", "photon --photons 1000", "direct"};
    (void)state;
    for (size_t i = 0; i < sizeof modes / sizeof *modes; i++)
        for (int after = 0; after < 3; after++) {
            scratch_write("a.pfm", "old");
            run run = run_rtc("OCL_ICD_VENDORS=./faulty.icd RT_ICD_PLAY=lost%d "
                              "rtc a.rts --mode %s --out a.pfm",
                              after, modes[i]);
            expect_status(&run, 3);
            expect_err(&run, "CL_OUT_OF_RESOURCES");
            run_free(&run);
            scratch_expect("a.pfm", "old");
        }
}

/* Photons, points to gather at and neighbour lists go in shorter batches. */
static void with_little_memory_it_goes_on_in_shorter_batches(void **state)
{
    static const char *const gathers[] = {"flann", "device", "device --passes 2",
                                          "flann --final-gather 1"};
    (void)state;
    for (size_t i = 0; i < sizeof gathers / sizeof *gathers; i++) {
        run run = run_rtc("a.rts --mode photon --photons 3000 --k 20 --spp 1 --gather %s "
                          "--out much.pfm",
                          gathers[i]);
        expect_status(&run, 0);
        run_free(&run);
        run = run_rtc(PLAY("memory300000") "rtc a.rts --mode photon --photons 3000 --k 20 --spp 1 "
                                           "--gather %s --out little.pfm",
                      gathers[i]);
        expect_status(&run, 0);
        run_free(&run);
        expect_same_files("much.pfm", "little.pfm");
    }
    run run = run_rtc(PLAY("memory100") "rtc a.rts --spp 1 --out a.pfm");
    expect_status(&run, 3);
    expect_err(&run, "CL_MEM_OBJECT_ALLOCATION_FAILURE");
    run_free(&run);
}

static void a_compiler_that_fails_is_quoted(void **state)
{
    (void)state;
    run run = run_rtc(PLAY("compiler") "rtc a.rts --spp 1 --verbose --out a.pfm");
    expect_status(&run, 3);
    expect_err(&run, "does not build on");
    expect_err(&run, "error: this compiler is out of order");
    expect_err(&run, "a note of the compiler");
    run_free(&run);
    run = run_rtc(PLAY("compiler") "rtc doctor");
    expect_status(&run, 3);
    expect_out(&run, "FAIL  kernel program");
    expect_out(&run, "--verbose shows the compiler's log");
    run_free(&run);
}

static void doctor_sees_a_device_that_computes_wrongly(void **state)
{
    (void)state;
    run run = run_rtc(PLAY("wrong") "rtc doctor");
    expect_status(&run, 3);
    expect_out(&run, "wrong intersection on this device");
    expect_out(&run, "the driver computes wrongly");
    run_free(&run);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, enter, scratch_leave)
    const struct CMUnitTest tests[] = {
        TEST(without_a_fault_it_renders),
        TEST(no_platform_is_told),
        TEST(a_broken_platform_alone_is_told),
        TEST(a_broken_platform_beside_a_good_one_does_not_matter),
        TEST(a_lost_device_is_told_and_the_old_picture_stays),
        TEST(with_little_memory_it_goes_on_in_shorter_batches),
        TEST(a_compiler_that_fails_is_quoted),
        TEST(doctor_sees_a_device_that_computes_wrongly),
    };
    if (!realpath("build/tests/faults/icd.so", icd_path)) {
        perror("build/tests/faults/icd.so");
        return 1;
    }
    return spawn_find_rtc() == 0 ? cmocka_run_group_tests(tests, NULL, NULL) : 1;
}
