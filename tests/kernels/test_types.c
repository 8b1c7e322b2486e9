/* test_types.c - host and device lay the shared structs out alike. */
#include "support.h"

#include "types.h"

typedef struct expectation {
    const char *name;
    uint32_t value;
} expectation;

static const expectation expected[] = {
#define TYPE(type) {"size of " #type, sizeof(type)},
#define MEMBER(type, member) {#type "." #member, offsetof(type, member)},
#include "kernels/type_members.h"
};

enum { count = sizeof expected / sizeof *expected };

static void structs_have_the_same_layout_on_host_and_device(void **state)
{
    static uint32_t device[count];
    (void)state;
    cl_kernel kernel = test_kernel("types", "layout");
    cl_mem out = test_buffer(sizeof device, NULL);
    rt_arg args[] = {RT_ARG(out)};

    test_run(kernel, args, 1, 1);
    test_read(out, sizeof device, device);
    for (int i = 0; i < count; i++)
        if (device[i] != expected[i].value)
            fail_msg("%s: %u on the host, %u on the device", expected[i].name, expected[i].value,
                     device[i]);
    rt_buffer_release(test_device(), out);
    rt_kernel_release(kernel);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(structs_have_the_same_layout_on_host_and_device)};
    return cmocka_run_group_tests_name("kernels/types", tests, NULL, NULL);
}
