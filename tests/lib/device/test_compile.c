/* test_compile.c - kernels that are compiled before there is anything to compute. */
#define _GNU_SOURCE

#include <malloc.h>
#include <string.h>

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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_program_is_launched_for_no_items),
        cmocka_unit_test(a_program_that_is_none_is_refused),
    };
    return cmocka_run_group_tests_name("device/compile", tests, NULL, NULL);
}
