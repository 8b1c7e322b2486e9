/* program.c - the programs of a device, built as they are needed, and kernels made of them. */
#include "device/device.h"

#include <string.h>

#include "base/error.h"
#include "base/progress.h"
#include "device/build.h"
#include "device/kernel_cache.h"

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
    rt_status status = rt_program_build(device, &built, source, hooks, error);
    if (status != RT_OK)
        return status;
    rt_log(hooks, "program %s built in %.3f s", source->name, rt_clock() - began);
    device->programs[device->program_count].source = source;
    device->programs[device->program_count].program = built;
    *out = device->program_count++;
    return RT_OK;
}

/* By FNV-1a, as in build.c. */
static uint64_t hash_of_name(const char *name)
{
    uint64_t h = 0xcbf29ce484222325u;
    for (; *name; name++)
        h = (h ^ (unsigned char)*name) * 0x100000001b3u;
    return h;
}

/* Notes that a kernel is made; whether it is the first of its name, or there is no more room. */
static int is_first(rt_device *device, int program, const char *kernel)
{
    const uint64_t name = hash_of_name(kernel);
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
    const rt_kernel_source *source = rt_kernel_source_find(rt_kernel_sources, program);
    for (int i = 0; i < device->program_count; i++)
        if (device->programs[i].source == source)
            return 1;
    return source->name && rt_program_is_stored(device, source);
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
