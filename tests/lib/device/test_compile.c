/* test_compile.c - kernels that are compiled before there is anything to compute. */
#define _GNU_SOURCE

#include <malloc.h>
#include <signal.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include "../image/scratch.h"
#include "device/compiler.h"
#include "device/kernel_source.h"
#include "rt/device.h"
#include "support.h"

/*
 * A kernel is launched once for no items: every count that it sees is zero, whatever lay in the
 * memory that the driver keeps arguments in.
 */
static void each_program_is_launched_for_no_items(void **state)
{
    (void)state;
    int count = 0;
    rt_device *device = test_device();
    mallopt(M_PERTURB, 0x5a); /* a sanitizer's allocator has none, and fills memory by itself */
    for (const rt_kernel_source *source = rt_kernel_sources; source->name; source++) {
        rt_error error;
        count++;
        expect_ok(rt_device_compile(device, source->name, NULL, &error), &error);
    }
    mallopt(M_PERTURB, 0);
    assert_true(count > 10);
}

static void a_program_that_is_none_is_refused(void **state)
{
    (void)state;
    rt_error error;
    assert_int_equal(rt_device_compile(test_device(), "nothing", NULL, &error), RT_ERROR_USAGE);
    assert_string_equal(error.message, "there is no kernel program 'nothing'");
}

/* A program that waits for signals in one thread, as rtc does, blocks them in all. */
static void a_compiler_hears_signals_that_its_parent_blocks(void **state)
{
    (void)state;
    char compiler[] = "./compiler";
    const rt_device device = {.compiler = compiler, .work_group = 1};
    const char *const programs[] = {"path"};
    sigset_t terminate, before;
    int status;
    scratch_write(compiler, "#!/bin/sh\nexec sleep 3\n");
    assert_int_equal(chmod(compiler, 0700), 0);
    sigemptyset(&terminate);
    sigaddset(&terminate, SIGTERM);
    assert_int_equal(pthread_sigmask(SIG_BLOCK, &terminate, &before), 0);
    const pid_t process = rt_compiler_begin(&device, programs, 1);
    assert_int_equal(pthread_sigmask(SIG_SETMASK, &before, NULL), 0);
    assert_true(process > 0);
    assert_int_equal(kill(process, SIGTERM), 0);
    assert_int_equal(waitpid(process, &status, 0), process);
    assert_true(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_program_is_launched_for_no_items),
        cmocka_unit_test(a_program_that_is_none_is_refused),
        cmocka_unit_test_setup_teardown(a_compiler_hears_signals_that_its_parent_blocks,
                                        scratch_enter, scratch_leave),
    };
    return cmocka_run_group_tests_name("device/compile", tests, NULL, NULL);
}
