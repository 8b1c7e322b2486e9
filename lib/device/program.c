/* program.c - building OpenCL programs and making kernels of them. */
#include "device/device.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/progress.h"
#include "device/kernel_cache.h"

enum { OPTIONS_SIZE = 256 };

/* Copies the first line of a build log that speaks of an error. */
static void first_error(char *line, size_t size, const char *log)
{
    const char *at = strstr(log, "error:");
    if (!at)
        at = log;
    while (at > log && at[-1] != '\n')
        at--;
    size_t length = strcspn(at, "\n");
    if (length >= size)
        length = size - 1;
    memcpy(line, at, length);
    line[length] = '\0';
}

/* Reports why a program did not build: the whole log to the hooks, the first error to *error. */
static rt_status report_build(rt_device *device, cl_program program, const char *name, cl_int code,
                              const rt_hooks *hooks, rt_error *error)
{
    char line[384] = "";
    size_t size = 0;
    clGetProgramBuildInfo(program, device->id, CL_PROGRAM_BUILD_LOG, 0, NULL, &size);
    char *log = calloc(size + 1, 1);
    if (log) {
        clGetProgramBuildInfo(program, device->id, CL_PROGRAM_BUILD_LOG, size, log, NULL);
        first_error(line, sizeof line, log);
        char *rest;
        for (char *at = strtok_r(log, "\n", &rest); at; at = strtok_r(NULL, "\n", &rest))
            rt_log(hooks, "%s", at);
        free(log);
    }
    return rt_fail(error, RT_ERROR_DEVICE, "kernel program '%s' does not build on %s (%s): %s",
                   name, device->info.name, rt_cl_error_name(code), line);
}

/* Whether the device has an extension; where it does not answer, it has none. */
static int has_extension(const rt_device *device, const char *name)
{
    size_t size = 0;
    if (clGetDeviceInfo(device->id, CL_DEVICE_EXTENSIONS, 0, NULL, &size) != CL_SUCCESS)
        return 0;
    char *all = calloc(size + 1, 1);
    int found = all &&
                clGetDeviceInfo(device->id, CL_DEVICE_EXTENSIONS, size, all, NULL) == CL_SUCCESS &&
                strstr(all, name) != NULL;
    free(all);
    return found;
}

/*
 * The paths that a work-item follows at a time, and exact division: bounds on rounding in the
 * kernels take quotients and roots to be correctly rounded, which OpenCL 1.2 promises on demand
 * alone, where a device can do it.
 *
 * NVIDIA's compiler would give a work-item up to 255 registers, so that few run at once. With 128
 * paths are followed a tenth faster; with fewer it depends on the scene (measured on an H100).
 */
static rt_status build_options(char *options, size_t size, const rt_device *device, rt_error *error)
{
    cl_device_fp_config can = 0;
    rt_status status =
        rt_cl_check(clGetDeviceInfo(device->id, CL_DEVICE_SINGLE_FP_CONFIG, sizeof can, &can, NULL),
                    "asking the device how it rounds", error);
    if (status != RT_OK)
        return status;
    snprintf(options, size, "-cl-std=CL1.2 -cl-kernel-arg-info -D RT_WIDTH=%u%s%s%s", device->width,
             device->count_rays ? " -D RT_COUNT_RAYS" : "",
             can & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT ? " -cl-fp32-correctly-rounded-divide-sqrt"
                                                       : "",
             has_extension(device, "cl_nv_compiler_options") ? " -cl-nv-maxrregcount=128" : "");
    return RT_OK;
}

static const uint64_t hash_basis = 0xcbf29ce484222325u;

static uint64_t hash(uint64_t h, const void *data, size_t size)
{
    const unsigned char *at = data;
    for (size_t i = 0; i < size; i++)
        h = (h ^ at[i]) * 0x100000001b3u;
    return h;
}

static uint64_t hash_text(uint64_t h, const char *text)
{
    return hash(h, text, strlen(text) + 1);
}

/*
 * What identifies a compiled program: its source, the options, the device and the driver. By
 * FNV-1a (Fowler, Noll, Vo, Eastlake: "The FNV Non-Cryptographic Hash Algorithm", IETF draft).
 */
static uint64_t cache_key(const rt_device *device, const rt_kernel_source *source,
                          const char *options)
{
    uint64_t h = hash(hash_basis, source->text, source->length);
    h = hash_text(hash_text(h, source->name), options);
    h = hash_text(hash_text(h, device->info.platform), device->info.name);
    return hash_text(hash_text(h, device->info.version), device->info.driver);
}

/* Builds for the device, out of the cache where the program is there. */
static cl_int build_cached(rt_device *device, cl_program program, const rt_kernel_source *source,
                           const char *options)
{
    uint64_t key = cache_key(device, source, options);
    rt_driver_lock();
    rt_kernel_cache_fetch(key, source->name);
    cl_int code = clBuildProgram(program, 1, &device->id, options, NULL, NULL);
    rt_kernel_cache_built(key);
    rt_driver_unlock();
    return code;
}

int rt_device_stores(const rt_device *device)
{
    rt_driver_lock();
    const int is_kept = rt_kernel_cache_store()[0] != 0;
    rt_driver_unlock();
    return is_kept && strcmp(device->info.platform, "Portable Computing Language") == 0;
}

static rt_status build(rt_device *device, cl_program *out, const rt_kernel_source *source,
                       const rt_hooks *hooks, rt_error *error)
{
    cl_int code;
    char options[OPTIONS_SIZE];
    const char *text = (const char *)source->text;
    rt_status status = build_options(options, sizeof options, device, error);
    if (status != RT_OK)
        return status;
    cl_program program =
        clCreateProgramWithSource(device->context, 1, &text, &source->length, &code);
    if ((status = rt_cl_check(code, "creating an OpenCL program", error)) != RT_OK)
        return status;
    code = build_cached(device, program, source, options);
    if (code != CL_SUCCESS) {
        status = report_build(device, program, source->name, code, hooks, error);
        clReleaseProgram(program);
        return status;
    }
    *out = program;
    return RT_OK;
}

const rt_kernel_source *rt_kernel_source_find(const rt_kernel_source *sources, const char *name)
{
    while (sources->name && strcmp(sources->name, name) != 0)
        sources++;
    return sources;
}

/* Finds the number of a program among those already built, or builds it. */
static rt_status find_program(rt_device *device, int *out, const rt_kernel_source *source,
                              const rt_hooks *hooks, rt_error *error)
{
    cl_program built = NULL;
    for (int i = 0; i < device->program_count; i++)
        if (device->programs[i].source == source) {
            *out = i;
            return RT_OK;
        }
    if (device->program_count == RT_PROGRAMS_MAX)
        return rt_fail(error, RT_ERROR_DEVICE, "more than %d OpenCL programs on one device",
                       RT_PROGRAMS_MAX);
    double began = rt_clock();
    rt_status status = build(device, &built, source, hooks, error);
    if (status != RT_OK)
        return status;
    rt_log(hooks, "program %s built in %.3f s", source->name, rt_clock() - began);
    device->programs[device->program_count].source = source;
    device->programs[device->program_count].program = built;
    *out = device->program_count++;
    return RT_OK;
}

/* Notes that a kernel is made; whether it is the first of its name, or there is no more room. */
static int is_first(rt_device *device, int program, const char *kernel)
{
    const uint64_t name = hash_text(hash_basis, kernel);
    uint64_t *made = device->programs[program].kernels;
    for (int i = 0; i < RT_KERNELS_MAX; i++) {
        if (made[i] == name)
            return 0;
        if (made[i] == 0) {
            made[i] = name;
            break;
        }
    }
    return 1;
}

int rt_device_has_program(const rt_device *device, const char *program)
{
    char options[OPTIONS_SIZE];
    const rt_kernel_source *source = rt_kernel_source_find(rt_kernel_sources, program);
    if (!source->name || build_options(options, sizeof options, device, NULL) != RT_OK)
        return 0;
    for (int i = 0; i < device->program_count; i++)
        if (device->programs[i].source == source)
            return 1;
    rt_driver_lock();
    const int is_stored = rt_kernel_cache_has(cache_key(device, source, options), program);
    rt_driver_unlock();
    return is_stored;
}

/* The number of a program, built now if it is not yet. */
static rt_status program_of(rt_device *device, int *out, const rt_kernel_source *sources,
                            const char *program, const rt_hooks *hooks, rt_error *error)
{
    const rt_kernel_source *source = rt_kernel_source_find(sources, program);
    if (!source->name)
        return rt_fail(error, RT_ERROR_DEVICE, "there is no kernel program '%s'", program);
    return find_program(device, out, source, hooks, error);
}

rt_status rt_device_program(rt_device *device, cl_program *out, const char *program,
                            const rt_hooks *hooks, rt_error *error)
{
    int number = 0;
    rt_status status = program_of(device, &number, rt_kernel_sources, program, hooks, error);
    if (status == RT_OK)
        *out = device->programs[number].program;
    return status;
}

rt_status rt_device_kernel_from(rt_device *device, cl_kernel *out, const rt_kernel_source *sources,
                                const char *program, const char *kernel, const rt_hooks *hooks,
                                rt_error *error)
{
    int number = 0;
    cl_int code;

    rt_status status = program_of(device, &number, sources, program, hooks, error);
    if (status != RT_OK)
        return status;
    cl_kernel made = clCreateKernel(device->programs[number].program, kernel, &code);
    if ((status = rt_cl_check(code, kernel, error)) == RT_OK)
        *out = made;
    device->has_new_kernels |= is_first(device, number, kernel);
    rt_kernel_cache_tell(hooks);
    return status;
}

rt_status rt_device_kernel(rt_device *device, cl_kernel *out, const char *program,
                           const char *kernel, const rt_hooks *hooks, rt_error *error)
{
    return rt_device_kernel_from(device, out, rt_kernel_sources, program, kernel, hooks, error);
}
