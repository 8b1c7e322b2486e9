/*
 * test_device.c - the list of devices: where it cannot be had, the reason is told, and what drivers
 * are asked is asked by one thread at a time. A closed device lasts as long as its renderers.
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

static int contexts_released;

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

cl_int CL_API_CALL clReleaseContext(cl_context context)
{
    const union {
        void *object;
        cl_int(CL_API_CALL *function)(cl_context);
    } release = {next("clReleaseContext")};
    contexts_released++;
    return release.function(context);
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

static const char scene_text[] = "camera { eye 0 1 -4  look_at 0 1 0 }\n"
                                 "film { width 4  height 3 }\n"
                                 "material white { kd 0.7 }\n"
                                 "sphere { centre 0 1 0  radius 1  material white }\n"
                                 "light point { position 2 4 -3  intensity 20 }\n";

/* Whatever is destroyed before them, renderers work, and with the last of them all ends. */
static void a_closed_device_lasts_until_its_last_renderer_ends(void **state)
{
    rt_profile *profile = NULL;
    rt_memory *memory = NULL;
    rt_scene *scene = NULL;
    rt_device *device = NULL;
    rt_renderer *renderers[2] = {NULL, NULL};
    rt_film *film = NULL;
    rt_error error;
    (void)state;
    expect_ok(rt_profile_create(&profile, 0, &error), &error);
    expect_ok(rt_memory_create(&memory, 0, &error), &error);
    const rt_device_options options = {.memory = memory, .profile = profile};
    expect_ok(rt_device_open(&device, &options, &error), &error);
    expect_ok(rt_scene_parse(&scene, scene_text, "scene", NULL, &error), &error);
    for (int i = 0; i < 2; i++)
        expect_ok(rt_renderer_create(renderers + i, scene, device, NULL, &error), &error);
    contexts_released = 0;
    rt_device_close(device);
    rt_profile_destroy(profile);
    rt_memory_destroy(memory);
    rt_scene_destroy(scene);
    rt_renderer_destroy(renderers[0]);
    assert_int_equal(contexts_released, 0);
    const rt_render_options small = {.width = 4, .height = 3, .spp = 1};
    expect_ok(rt_render(&film, renderers[1], &small, &error), &error);
    rt_renderer_destroy(renderers[1]);
    assert_int_equal(contexts_released, 1);
    assert_true(rt_film_rgb(film)[3 * (4 + 2)] > 0);
    rt_film_destroy(film);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        /* It comes before errors that would leave the drivers' start undone. */
        cmocka_unit_test(a_closed_device_lasts_until_its_last_renderer_ends),
        cmocka_unit_test(a_list_that_cannot_be_had_tells_why),
        cmocka_unit_test(drivers_are_asked_by_one_thread_at_a_time),
    };
    return cmocka_run_group_tests_name("lib/device/device", tests, NULL, NULL);
}
