/* support.c - opens the device, and runs kernels of the tests' own. */
#include "support.h"

#include <stdlib.h>
#include <string.h>

#include "types.h"

static rt_device *device;

void expect_ok(rt_status status, const rt_error *error)
{
    if (status != RT_OK)
        fail_msg("status %d: %s", (int)status, error->message);
}

static void close_device(void)
{
    rt_device_close(device);
}

rt_device *test_device_open(uint32_t threads, uint32_t work_group)
{
    const char *width = getenv("RT_TEST_BATCH");
    rt_device_options options = {.select = getenv("RT_TEST_DEVICE"),
                                 .threads = threads,
                                 .work_group = work_group,
                                 .width = width ? (uint32_t)strtoul(width, NULL, 10) : 0};
    rt_device *opened = NULL;
    rt_error error;
    expect_ok(rt_device_open(&opened, &options, &error), &error);
    if (getenv("RT_TEST_KEEP"))
        opened->keeps_photons = 1;
    return opened;
}

rt_device *test_device(void)
{
    if (!device) {
        device = test_device_open(0, 0);
        atexit(close_device);
    }
    return device;
}

rt_renderer *test_renderer(const char *text)
{
    rt_renderer *renderer = NULL;
    rt_scene *scene = NULL;
    rt_error error;
    expect_ok(rt_scene_parse(&scene, text, "test", NULL, &error), &error);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    rt_scene_destroy(scene);
    return renderer;
}

cl_kernel test_kernel(const char *program, const char *kernel)
{
    rt_error error;
    cl_kernel made = NULL;
    expect_ok(rt_device_kernel_from(test_device(), &made, rt_test_kernel_sources, program, kernel,
                                    NULL, &error),
              &error);
    return made;
}

cl_mem test_buffer(size_t bytes, const void *host)
{
    rt_error error;
    cl_mem buffer = NULL;
    expect_ok(rt_buffer_create(test_device(), &buffer, CL_MEM_READ_WRITE, bytes, (void *)host,
                               "test data", &error),
              &error);
    return buffer;
}

cl_mem test_texels(const void *texels, size_t size)
{
    const size_t head = sizeof(rt_scene_header);
    unsigned char *const bytes = calloc(head + size + 1, 1);
    assert_non_null(bytes);
    ((rt_scene_header *)(void *)bytes)->texels = (rt_u32)(head / RT_SCENE_ROW);
    if (size)
        memcpy(bytes + head, texels, size);
    cl_mem buffer = test_buffer(head + size + 1, bytes);
    free(bytes);
    return buffer;
}

cl_mem test_output(size_t bytes, void *host)
{
    /* A float8 is the widest that kernels write. */
    const int in_place = test_device()->info.is_cpu && (uintptr_t)host % 32 == 0;
    const cl_mem_flags flags = CL_MEM_READ_WRITE | (in_place ? CL_MEM_USE_HOST_PTR : 0);
    rt_error error;
    cl_mem buffer = NULL;
    expect_ok(rt_buffer_create(test_device(), &buffer, flags, bytes, in_place ? host : NULL,
                               "test data", &error),
              &error);
    return buffer;
}

void test_run(cl_kernel kernel, const rt_arg *args, cl_uint count, size_t items)
{
    rt_error error;
    expect_ok(rt_kernel_args(kernel, args, count, &error), &error);
    expect_ok(rt_launch(test_device(), kernel, items, &error), &error);
    expect_ok(rt_device_finish(test_device(), &error), &error);
}

void test_read(cl_mem buffer, size_t bytes, void *host)
{
    rt_error error;
    expect_ok(rt_buffer_read(test_device(), buffer, 0, bytes, host, &error), &error);
}
