/* test_launch.c - the items of a launch: each once, in order, and evenly among its work-groups. */
#include <stdlib.h>

#include "device/device.h"
#include "support.h"

/* Launches `count` items and reads what the kernel saw of each; the caller frees *groups. */
static void launch(uint32_t count, uint32_t **seen, uint32_t **groups)
{
    const size_t seen_bytes = count * sizeof **seen, bytes = seen_bytes + sizeof **groups;
    *seen = calloc(count, sizeof **seen);
    *groups = calloc(count + 1, sizeof **groups);
    assert_true(*seen && *groups);
    cl_kernel kernel = test_kernel("launch", "places");
    cl_mem seen_buffer = test_buffer(seen_bytes, *seen), buffer = test_buffer(bytes, *groups);
    rt_arg args[] = {RT_ARG(count), RT_ARG(seen_buffer), RT_ARG(buffer)};
    test_run(kernel, args, 3, count);
    test_read(seen_buffer, seen_bytes, *seen);
    test_read(buffer, bytes, *groups);
    rt_buffer_release(test_device(), seen_buffer);
    rt_buffer_release(test_device(), buffer);
    rt_kernel_release(kernel);
}

/*
 * Drivers hand their threads runs of work-groups: any part of these, from the first on, has that
 * part of the items, to within a work-group.
 */
static void check(uint32_t count)
{
    uint32_t *seen, *groups;
    launch(count, &seen, &groups);
    const double group = test_device()->work_group, items_a_group = (double)count / groups[count];
    for (uint32_t i = 0; i < count; i++) {
        assert_int_equal(seen[i], 1);
        assert_true(i == 0 || groups[i - 1] <= groups[i]);
        const double before = items_a_group * groups[i];
        if (i + 1.0 < before - group || i > before + 2 * group)
            fail_msg("%u items: %u is in group %u of %u", count, i, groups[i], groups[count]);
    }
    free(seen);
    free(groups);
}

static void items_lie_evenly_among_work_groups(void **state)
{
    /* Rows have 1024 items; the last is more than a layer of them. */
    static const uint32_t counts[] = {1,    15,   16,   17,    100,    256,    500,    1023,
                                      1024, 1025, 1407, 10000, 100000, 123456, 1500000};
    (void)state;
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
        check(counts[i]);
}

static void groups_may_have_any_size(void **state)
{
    static const uint32_t sizes[] = {1, 7, 48, 64};
    const uint32_t kept = test_device()->work_group;
    (void)state;
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        test_device()->work_group = sizes[i];
        check(1);
        check(1025);
        check(5000);
    }
    test_device()->work_group = kept;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(items_lie_evenly_among_work_groups),
        cmocka_unit_test(groups_may_have_any_size),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
