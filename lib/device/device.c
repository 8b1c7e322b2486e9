/* device.c - finding, opening and closing OpenCL devices. */
#include "device/device.h"

#include <CL/cl_ext.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "base/error.h"
#include "base/memory.h"
#include "base/profile.h"
#include "device/kernel_cache.h"

enum {
    platforms_max = 16,
    devices_max = 64,
    default_work_group_cpu = 16,
    default_work_group_gpu = 64
};

/*
 * A work-item that follows eight paths takes enough pixels to keep all of them under way; one that
 * follows a single path takes one pixel, so that the device has as many work-items as can be.
 */
enum { width_cpu = 8, width_gpu = 1, path_pixels_batch = 64, path_pixels_single = 1 };

typedef struct device_list {
    cl_platform_id platform[devices_max];
    cl_device_id id[devices_max];
    cl_uint count;
} device_list;

/* Fails where the platforms, of which there are so many, cannot be had or there are none. */
static rt_status check_platforms(cl_int code, cl_uint count, rt_error *error)
{
    if (code != CL_SUCCESS && code != CL_PLATFORM_NOT_FOUND_KHR)
        return rt_cl_check(code, "asking for the OpenCL platforms", error);
    if (code != CL_SUCCESS || count == 0)
        return rt_fail(
            error, RT_ERROR_DEVICE,
            "no OpenCL platform is installed (on Debian: pocl-opencl-icd gives one for the CPU)");
    return RT_OK;
}

/* Collects the devices of all platforms, up to devices_max. */
static rt_status ask_platforms(device_list *list, rt_error *error)
{
    cl_platform_id platforms[platforms_max];
    cl_uint platform_count = 0;

    list->count = 0;
    cl_int code = clGetPlatformIDs(platforms_max, platforms, &platform_count), failed = CL_SUCCESS;
    rt_status status = check_platforms(code, platform_count, error);
    if (status != RT_OK)
        return status;
    if (platform_count > platforms_max)
        platform_count = platforms_max;
    for (cl_uint p = 0; p < platform_count && list->count < devices_max; p++) {
        cl_uint found = 0, room = devices_max - list->count;
        code =
            clGetDeviceIDs(platforms[p], CL_DEVICE_TYPE_ALL, room, list->id + list->count, &found);
        /* One without devices, or that fails, does not matter beside others. */
        if (code != CL_SUCCESS && code != CL_DEVICE_NOT_FOUND)
            failed = code;
        if (code != CL_SUCCESS)
            continue;
        if (found > room)
            found = room;
        for (cl_uint d = 0; d < found; d++)
            list->platform[list->count++] = platforms[p];
    }
    if (list->count > 0)
        return RT_OK;
    if (failed != CL_SUCCESS)
        return rt_fail(error, RT_ERROR_DEVICE, "no OpenCL device on %u platform%s: %s (%d)",
                       platform_count, platform_count == 1 ? "" : "s", rt_cl_error_name(failed),
                       (int)failed);
    return rt_fail(error, RT_ERROR_DEVICE, "no OpenCL device on %u platform%s", platform_count,
                   platform_count == 1 ? "" : "s");
}

/*
 * The same, starting the drivers when it is the first time; under rt_driver_lock, as a driver that
 * several threads start at once may crash.
 */
static rt_status list_devices(device_list *list, rt_error *error)
{
    rt_status status = rt_kernel_cache_open(error);
    if (status != RT_OK)
        return status;
    status = ask_platforms(list, error);
    rt_kernel_cache_opened();
    return status;
}

/* Fills *info; where the driver does not answer, its name says so. Returns what it answered. */
static cl_int describe(rt_device_info *info, cl_platform_id platform, cl_device_id id)
{
    cl_ulong memory = 0, largest = 0;
    cl_device_type type = 0;
    cl_uint units = 0;

    memset(info, 0, sizeof *info);
    const struct {
        cl_device_info what;
        size_t size;
        void *out;
    } questions[] = {
        {CL_DEVICE_NAME, sizeof info->name - 1, info->name},
        {CL_DEVICE_VERSION, sizeof info->version - 1, info->version},
        {CL_DRIVER_VERSION, sizeof info->driver - 1, info->driver},
        {CL_DEVICE_GLOBAL_MEM_SIZE, sizeof memory, &memory},
        {CL_DEVICE_MAX_MEM_ALLOC_SIZE, sizeof largest, &largest},
        {CL_DEVICE_MAX_COMPUTE_UNITS, sizeof units, &units},
        {CL_DEVICE_TYPE, sizeof type, &type},
    };
    cl_int code = clGetPlatformInfo(platform, CL_PLATFORM_NAME, sizeof info->platform - 1,
                                    info->platform, NULL);
    for (size_t i = 0; i < sizeof questions / sizeof *questions && code == CL_SUCCESS; i++)
        code = clGetDeviceInfo(id, questions[i].what, questions[i].size, questions[i].out, NULL);
    if (code != CL_SUCCESS)
        snprintf(info->name, sizeof info->name, "a device that does not answer: %s (%d)",
                 rt_cl_error_name(code), (int)code);
    info->memory = memory;
    info->largest_buffer = largest;
    info->compute_units = units;
    info->is_cpu = (type & CL_DEVICE_TYPE_CPU) != 0;
    snprintf(info->kernel_cache, sizeof info->kernel_cache, "%.255s", rt_kernel_cache_store());
    return code;
}

/* The devices as the caller sees them; under rt_driver_lock, too. */
static rt_status describe_all(rt_device_info **out, size_t *count, rt_error *error)
{
    device_list list;
    rt_status status = list_devices(&list, error);
    if (status != RT_OK)
        return status;
    rt_device_info *infos = malloc(list.count * sizeof *infos);
    if (!infos)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for %u devices", list.count);
    for (cl_uint i = 0; i < list.count; i++)
        describe(infos + i, list.platform[i], list.id[i]);
    *out = infos;
    *count = list.count;
    return RT_OK;
}

rt_status rt_devices_list(rt_device_info **out, size_t *count, rt_error *error)
{
    rt_driver_lock();
    const rt_status status = describe_all(out, count, error);
    rt_driver_unlock();
    return status;
}

void rt_devices_free(rt_device_info *devices)
{
    free(devices);
}

/* Whether text holds part, letters of either case alike. */
static int contains(const char *text, const char *part)
{
    for (size_t length = strlen(part); *text; text++)
        if (strncasecmp(text, part, length) == 0)
            return 1;
    return 0;
}

/* Picks a device by its number or by part of its name. */
static rt_status select_device(rt_device *device, const char *select, rt_error *error)
{
    device_list list;
    rt_status status = list_devices(&list, error);
    if (status != RT_OK)
        return status;

    char *end;
    unsigned long number = select && *select ? strtoul(select, &end, 10) : 0;
    int by_number = !select || !*select || (*end == '\0' && select[0] >= '0' && select[0] <= '9');
    for (cl_uint i = 0; i < list.count; i++) {
        cl_int code = describe(&device->info, list.platform[i], list.id[i]);
        if (by_number
                ? i == number
                : contains(device->info.name, select) || contains(device->info.platform, select)) {
            device->number = i;
            device->platform = list.platform[i];
            device->id = list.id[i];
            return rt_cl_check(code, "asking the device what it is", error);
        }
    }
    return rt_fail_field(error, RT_ERROR_DEVICE, "device",
                         "no OpenCL device '%s' among the %u of this machine", select, list.count);
}

/*
 * Limits a CPU device to so many of its compute units. The sub-device is kept until the process
 * ends: PoCL's threads may still read it after the last command is done, and clReleaseDevice would
 * free it under them.
 */
static rt_status limit_units(rt_device *device, uint32_t units, rt_error *error)
{
    if (!device->info.is_cpu || units >= device->info.compute_units)
        return RT_OK;
    cl_device_partition_property how[] = {CL_DEVICE_PARTITION_BY_COUNTS,
                                          (cl_device_partition_property)units,
                                          CL_DEVICE_PARTITION_BY_COUNTS_LIST_END, 0};
    cl_device_id part;
    rt_status status = rt_cl_check(clCreateSubDevices(device->id, how, 1, &part, NULL),
                                   "limiting the device to some of its compute units", error);
    if (status != RT_OK)
        return status;
    device->id = part;
    return rt_cl_check(describe(&device->info, device->platform, part),
                       "asking the device what it is", error);
}

static rt_status choose_work_group(rt_device *device, uint32_t asked, rt_error *error)
{
    uint32_t usual = device->info.is_cpu ? default_work_group_cpu : default_work_group_gpu;
    size_t largest = 1;
    rt_status status = rt_cl_check(
        clGetDeviceInfo(device->id, CL_DEVICE_MAX_WORK_GROUP_SIZE, sizeof largest, &largest, NULL),
        "asking the device for its largest work-group", error);
    if (status != RT_OK)
        return status;
    if (asked > largest)
        return rt_fail_field(error, RT_ERROR_USAGE, "work_group",
                             "a work-group of %u work-items is more than the device's %zu", asked,
                             largest);
    device->work_group = asked ? asked : usual < largest ? usual : (uint32_t)largest;
    return RT_OK;
}

static rt_status choose_width(rt_device *device, uint32_t asked, rt_error *error)
{
    if (asked != 0 && asked != 1 && asked != 8)
        return rt_fail_field(error, RT_ERROR_USAGE, "width",
                             "a work-item follows 1 or 8 paths at a time, not %u", asked);
    device->width = asked ? asked : device->info.is_cpu ? width_cpu : width_gpu;
    device->path_pixels = device->width > 1 ? path_pixels_batch : path_pixels_single;
    return RT_OK;
}

static void choose_memory(rt_device *device)
{
    cl_device_fp_config doubles = 0;
    if (clGetDeviceInfo(device->id, CL_DEVICE_DOUBLE_FP_CONFIG, sizeof doubles, &doubles, NULL) !=
        CL_SUCCESS)
        doubles = 0;
    device->keeps_photons = !device->info.is_cpu && doubles != 0;
}

static char *copy_text(const char *text)
{
    char *copy = malloc(strlen(text) + 1);
    return copy ? strcpy(copy, text) : NULL;
}

rt_status rt_device_open(rt_device **out, const rt_device_options *options, rt_error *error)
{
    static const rt_device_options defaults;
    rt_status status;
    cl_int code;

    if (!options)
        options = &defaults;
    rt_device *device = calloc(1, sizeof *device);
    if (!device)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for a device");
    device->holders = 1;
    device->memory = rt_memory_hold(options->memory);
    device->count_rays = options->count_rays;
    if (options->compiler && !(device->compiler = copy_text(options->compiler))) {
        rt_device_close(device);
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for a device");
    }
    rt_driver_lock();
    if ((status = select_device(device, options->select, error)) != RT_OK)
        goto out;

    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    device->threads = options->threads ? options->threads : cores > 0 ? (uint32_t)cores : 1;
    if ((options->threads && (status = limit_units(device, options->threads, error)) != RT_OK) ||
        (status = choose_work_group(device, options->work_group, error)) != RT_OK ||
        (status = choose_width(device, options->width, error)) != RT_OK)
        goto out;
    choose_memory(device);
    device->context = clCreateContext(NULL, 1, &device->id, NULL, NULL, &code);
    if ((status = rt_cl_check(code, "creating an OpenCL context", error)) != RT_OK)
        goto out;
    device->queue = clCreateCommandQueue(device->context, device->id,
                                         options->profile ? CL_QUEUE_PROFILING_ENABLE : 0, &code);
    status = rt_cl_check(code, "creating an OpenCL command queue", error);
    if (status == RT_OK && options->profile) {
        device->profile = rt_profile_hold(options->profile);
        device->track = rt_profile_add_device(options->profile, device->info.name);
    }
out:
    rt_driver_unlock();
    if (status == RT_OK)
        *out = device;
    else
        rt_device_close(device);
    return status;
}

rt_device *rt_device_hold(rt_device *device)
{
    __atomic_add_fetch(&device->holders, 1, __ATOMIC_RELAXED);
    return device;
}

void rt_device_close(rt_device *device)
{
    if (!device || __atomic_sub_fetch(&device->holders, 1, __ATOMIC_ACQ_REL) > 0)
        return;
    rt_events_book(device);
    rt_driver_lock();
    rt_kernel_cache_keep();
    for (int i = 0; i < device->program_count; i++)
        clReleaseProgram(device->programs[i].program);
    if (device->queue)
        clReleaseCommandQueue(device->queue);
    if (device->context)
        clReleaseContext(device->context);
    rt_driver_unlock();
    rt_memory_free(device->counted);
    rt_memory_drop(device->memory);
    rt_profile_destroy(device->profile);
    free(device->compiler);
    free(device);
}

void rt_device_get_info(const rt_device *device, rt_device_info *out)
{
    *out = device->info;
}
