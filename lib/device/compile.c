/*
 * compile.c - compiles kernels before there is anything to compute: drivers do so at the first
 * launch, for a size of the work-group.
 */
#include "device/device.h"

#include <stdlib.h>

#include "base/error.h"
#include "device/kernel_cache.h"
#include "device/kernel_source.h"

/* The largest structure that a kernel takes by value, and the content of any argument. */
enum { ARGUMENT_MAX = 256, BUFFER_SIZE = 4096 };

/*
 * Sets an argument that is a value to zero. How large it is, no call of OpenCL tells: drivers
 * refuse another size than the right one, or take a larger one and use its beginning.
 */
static cl_int set_zero(cl_kernel kernel, cl_uint index)
{
    static const unsigned char zero[ARGUMENT_MAX];
    cl_int code = CL_INVALID_ARG_SIZE;
    for (size_t size = ARGUMENT_MAX; size > 0 && code == CL_INVALID_ARG_SIZE; size -= 4)
        code = clSetKernelArg(kernel, index, size, zero);
    return code;
}

/* Sets an argument to zero, or to the buffer where it points to one. */
static rt_status set_argument(cl_kernel kernel, cl_uint index, cl_mem buffer, rt_error *error)
{
    cl_kernel_arg_address_qualifier where;
    cl_int code = clGetKernelArgInfo(kernel, index, CL_KERNEL_ARG_ADDRESS_QUALIFIER, sizeof where,
                                     &where, NULL);
    if (code == CL_SUCCESS)
        code = where == CL_KERNEL_ARG_ADDRESS_PRIVATE
                   ? set_zero(kernel, index)
                   : clSetKernelArg(kernel, index, sizeof buffer, &buffer);
    return rt_cl_check(code, "setting a kernel's argument", error);
}

/* Launches a kernel for no items: all of its counts are zero. */
static rt_status launch_for_nothing(rt_device *device, cl_kernel kernel, cl_mem buffer,
                                    rt_error *error)
{
    cl_uint count = 0;
    rt_status status =
        rt_cl_check(clGetKernelInfo(kernel, CL_KERNEL_NUM_ARGS, sizeof count, &count, NULL),
                    "asking a kernel for its arguments", error);
    for (cl_uint i = 0; i < count && status == RT_OK; i++)
        status = set_argument(kernel, i, buffer, error);
    if (status == RT_OK)
        status = rt_launch(device, kernel, 1, error);
    return status == RT_OK ? rt_device_finish(device, error) : status;
}

static rt_status compile(rt_device *device, const char *program, cl_mem buffer,
                         const rt_hooks *hooks, rt_error *error)
{
    cl_kernel kernels[RT_KERNELS_MAX];
    cl_uint count = 0;
    cl_program built;
    rt_status status = rt_device_program(device, &built, program, hooks, error);
    if (status == RT_OK)
        status = rt_cl_check(clCreateKernelsInProgram(built, RT_KERNELS_MAX, kernels, &count),
                             "making the kernels of a program", error);
    if (status != RT_OK)
        return status;
    for (cl_uint i = 0; i < count; i++) {
        device->has_new_kernels = 1; /* each is stored as soon as it is compiled */
        if (status == RT_OK)
            status = launch_for_nothing(device, kernels[i], buffer, error);
        rt_kernel_release(kernels[i]);
    }
    return status;
}

rt_status rt_device_compile(rt_device *device, const char *program, const rt_hooks *hooks,
                            rt_error *error)
{
    cl_mem buffer = NULL;
    if (rt_is_missing(device, "device", error))
        return RT_ERROR_USAGE;
    const rt_kernel_source *source =
        program ? rt_kernel_source_find(rt_kernel_sources, program) : rt_kernel_sources;
    if (!source->name)
        return rt_fail(error, RT_ERROR_USAGE, "there is no kernel program '%s'", program);
    void *zero = calloc(1, BUFFER_SIZE);
    if (!zero)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for a kernel's argument");
    rt_status status = rt_buffer_create(device, &buffer, CL_MEM_READ_WRITE, BUFFER_SIZE, zero,
                                        "a kernel's argument", error);
    for (; source->name && status == RT_OK; source++) {
        status = compile(device, source->name, buffer, hooks, error);
        if (program)
            break;
    }
    rt_buffer_release(device, buffer);
    rt_kernel_cache_tell(hooks);
    free(zero);
    return status;
}
