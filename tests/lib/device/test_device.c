/*
 * test_device.c - the list of devices: where it cannot be had, the reason is told, and what drivers
 * are asked is asked by one thread at a time.
 */
#define _GNU_SOURCE /* RTLD_NEXT */
#include "support.h"

#include <CL/cl_ext.h>
#include <dlfcn.h>
#include <pthread.h>
#include <string.h>
#include <time.h>

#include "device/kernel_cache.h"

/* What the functions below return in place of what those of OpenCL do; CL_SUCCESS: the latter. */
static cl_int platforms_fail, devices_fail;

/* Another thread that takes the lock of the drivers while this one asks them. */
static int others_try, has_begun, has_entered, entered_meanwhile;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static pthread_t other;

/* A function of OpenCL that this program has one of its own for. */
static void *next(const char *name)
{
    void *found = dlsym(RTLD_NEXT, name);
    assert_non_null(found);
    return found;
}

cl_int CL_API_CALL clGetPlatformIDs(cl_uint room, cl_platform_id *out, cl_uint *count)
{
    const union {
        void *object;
        cl_int(CL_API_CALL *function)(cl_uint, cl_platform_id *, cl_uint *);
    } get = {next("clGetPlatformIDs")};
    return platforms_fail ? platforms_fail : get.function(room, out, count);
}

cl_int CL_API_CALL clGetDeviceIDs(cl_platform_id platform, cl_device_type type, cl_uint room,
                                  cl_device_id *out, cl_uint *count)
{
    const union {
        void *object;
        cl_int(CL_API_CALL *function)(cl_platform_id, cl_device_type, cl_uint, cl_device_id *,
                                      cl_uint *);
    } get = {next("clGetDeviceIDs")};
    return devices_fail ? devices_fail : get.function(platform, type, room, out, count);
}

static void *enter(void *unused)
{
    (void)unused;
    rt_driver_lock();
    rt_driver_unlock();
    pthread_mutex_lock(&lock);
    has_entered = 1;
    pthread_mutex_unlock(&lock);
    return NULL;
}

cl_int CL_API_CALL clGetDeviceInfo(cl_device_id device, cl_device_info what, size_t size, void *out,
                                   size_t *needed)
{
    const union {
        void *object;
        cl_int(CL_API_CALL *function)(cl_device_id, cl_device_info, size_t, void *, size_t *);
    } get = {next("clGetDeviceInfo")};
    const struct timespec nap = {0, 10000000};
    if (others_try && !has_begun)
        has_begun = pthread_create(&other, NULL, enter, NULL) == 0;
    if (others_try) {
        nanosleep(&nap, NULL);
        pthread_mutex_lock(&lock);
        entered_meanwhile |= has_entered;
        pthread_mutex_unlock(&lock);
    }
    return get.function(device, what, size, out, needed);
}

static void expect_no_list(cl_int of_platforms, cl_int of_devices, const char *why)
{
    rt_device_info *devices = NULL;
    rt_error error = {0};
    size_t count = 0;
    platforms_fail = of_platforms;
    devices_fail = of_devices;
    const rt_status status = rt_devices_list(&devices, &count, &error);
    platforms_fail = devices_fail = CL_SUCCESS;
    assert_int_equal(status, RT_ERROR_DEVICE);
    assert_null(devices);
    if (!strstr(error.message, why))
        fail_msg("'%s' does not say '%s'", error.message, why);
}

static void a_list_that_cannot_be_had_tells_why(void **state)
{
    (void)state;
    expect_no_list(CL_PLATFORM_NOT_FOUND_KHR, CL_SUCCESS,
                   "no OpenCL platform is installed (on Debian");
    expect_no_list(CL_OUT_OF_RESOURCES, CL_SUCCESS,
                   "asking for the OpenCL platforms: CL_OUT_OF_RESOURCES (-5)");
    expect_no_list(CL_SUCCESS, CL_OUT_OF_HOST_MEMORY, ": CL_OUT_OF_HOST_MEMORY (-6)");
    expect_no_list(CL_SUCCESS, CL_DEVICE_NOT_FOUND, "no OpenCL device on ");
}

static void drivers_are_asked_by_one_thread_at_a_time(void **state)
{
    rt_device_info *devices = NULL;
    rt_error error;
    size_t count = 0;
    (void)state;
    others_try = 1;
    expect_ok(rt_devices_list(&devices, &count, &error), &error);
    others_try = 0;
    assert_true(has_begun);
    assert_int_equal(pthread_join(other, NULL), 0);
    assert_false(entered_meanwhile);
    rt_devices_free(devices);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_list_that_cannot_be_had_tells_why),
        cmocka_unit_test(drivers_are_asked_by_one_thread_at_a_time),
    };
    return cmocka_run_group_tests_name("lib/device/device", tests, NULL, NULL);
}
