/*
 * support.h - what many tests need: a device, kernels of the tests' own, and errors that fail the
 * test. Includes cmocka.h and what that needs.
 */
#ifndef RT_TESTS_SUPPORT_H
#define RT_TESTS_SUPPORT_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "device/device.h"
#include "rt.h"

/* Programs of tests/kernels/, embedded as the library's are. */
extern const rt_kernel_source rt_test_kernel_sources[];

/* Fails the running test with error's message unless status is RT_OK. */
void expect_ok(rt_status status, const rt_error *error);

/*
 * The OpenCL device that the environment variable RT_TEST_DEVICE names as rtc's --device does, else
 * the first, with default options; opened once a test program and closed at its end. Where the
 * environment variable RT_TEST_BATCH is set, it is the width of this device and the next: 1 or 8;
 * where RT_TEST_KEEP is, photons of renders stay on both.
 */
rt_device *test_device(void);

/* A renderer of the scene that a text describes, on test_device(). */
rt_renderer *test_renderer(const char *text);

/*
 * The same device once more, with options as in rt_device_options. Close it with rt_device_close.
 */
rt_device *test_device_open(uint32_t threads, uint32_t work_group);

/* A kernel of rt_test_kernel_sources on test_device(). Release it with rt_kernel_release. */
cl_kernel test_kernel(const char *program, const char *kernel);

/*
 * A buffer on test_device(), copied from host when that is not NULL. Release it with
 * rt_buffer_release.
 */
cl_mem test_buffer(size_t bytes, const void *host);

/* A packed scene that has nothing but these texels; size may be 0. */
cl_mem test_texels(const void *texels, size_t size);

/*
 * A buffer for a kernel's output, which test_read then copies to `host`: on a CPU it is that
 * memory, where its alignment allows, which saves the copy and the pages. Release it with
 * rt_buffer_release.
 */
cl_mem test_output(size_t bytes, void *host);

/* Sets the arguments, launches `items` work-items and waits. */
void test_run(cl_kernel kernel, const rt_arg *args, cl_uint count, size_t items);

/* Copies a buffer's first bytes to host memory. */
void test_read(cl_mem buffer, size_t bytes, void *host);

#endif
