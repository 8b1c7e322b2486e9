/* buffer.c - creates and copies buffers, sets kernel arguments, and launches kernels. */
#include <stdio.h>

#include "base/memory.h"
#include "device/device.h"
#include "device/kernel_cache.h"

const char *rt_cl_error_name(cl_int code)
{
    static const struct {
        cl_int code;
        const char *name;
    } names[] = {
        {CL_SUCCESS, "CL_SUCCESS"},
        {CL_DEVICE_NOT_FOUND, "CL_DEVICE_NOT_FOUND"},
        {CL_DEVICE_NOT_AVAILABLE, "CL_DEVICE_NOT_AVAILABLE"},
        {CL_COMPILER_NOT_AVAILABLE, "CL_COMPILER_NOT_AVAILABLE"},
        {CL_MEM_OBJECT_ALLOCATION_FAILURE, "CL_MEM_OBJECT_ALLOCATION_FAILURE"},
        {CL_OUT_OF_RESOURCES, "CL_OUT_OF_RESOURCES"},
        {CL_OUT_OF_HOST_MEMORY, "CL_OUT_OF_HOST_MEMORY"},
        {CL_BUILD_PROGRAM_FAILURE, "CL_BUILD_PROGRAM_FAILURE"},
        {CL_INVALID_VALUE, "CL_INVALID_VALUE"},
        {CL_INVALID_DEVICE, "CL_INVALID_DEVICE"},
        {CL_INVALID_CONTEXT, "CL_INVALID_CONTEXT"},
        {CL_INVALID_MEM_OBJECT, "CL_INVALID_MEM_OBJECT"},
        {CL_INVALID_BINARY, "CL_INVALID_BINARY"},
        {CL_INVALID_BUILD_OPTIONS, "CL_INVALID_BUILD_OPTIONS"},
        {CL_INVALID_PROGRAM, "CL_INVALID_PROGRAM"},
        {CL_INVALID_PROGRAM_EXECUTABLE, "CL_INVALID_PROGRAM_EXECUTABLE"},
        {CL_INVALID_KERNEL_NAME, "CL_INVALID_KERNEL_NAME"},
        {CL_INVALID_KERNEL, "CL_INVALID_KERNEL"},
        {CL_INVALID_ARG_INDEX, "CL_INVALID_ARG_INDEX"},
        {CL_INVALID_ARG_VALUE, "CL_INVALID_ARG_VALUE"},
        {CL_INVALID_ARG_SIZE, "CL_INVALID_ARG_SIZE"},
        {CL_INVALID_KERNEL_ARGS, "CL_INVALID_KERNEL_ARGS"},
        {CL_INVALID_WORK_GROUP_SIZE, "CL_INVALID_WORK_GROUP_SIZE"},
        {CL_INVALID_WORK_ITEM_SIZE, "CL_INVALID_WORK_ITEM_SIZE"},
        {CL_INVALID_BUFFER_SIZE, "CL_INVALID_BUFFER_SIZE"},
        {CL_INVALID_DEVICE_PARTITION_COUNT, "CL_INVALID_DEVICE_PARTITION_COUNT"},
        {CL_DEVICE_PARTITION_FAILED, "CL_DEVICE_PARTITION_FAILED"},
    };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (names[i].code == code)
            return names[i].name;
    return "unnamed OpenCL error";
}

rt_status rt_cl_check(cl_int code, const char *what, rt_error *error)
{
    if (code == CL_SUCCESS)
        return RT_OK;
    int memory = code == CL_MEM_OBJECT_ALLOCATION_FAILURE || code == CL_OUT_OF_HOST_MEMORY;
    return rt_fail(error, memory ? RT_ERROR_MEMORY : RT_ERROR_DEVICE, "%s: %s (%d)", what,
                   rt_cl_error_name(code), (int)code);
}

/* Whether a buffer takes memory of its own. */
static int has_memory(cl_mem_flags flags)
{
    return !(flags & CL_MEM_USE_HOST_PTR);
}

/* Takes the memory of a buffer, and makes room to note it. */
static rt_status begin_count(rt_device *device, size_t bytes, const char *what, rt_error *error)
{
    if (!device->memory || bytes == 0)
        return RT_OK;
    rt_status status = rt_memory_grow(NULL, (void **)&device->counted, &device->counted_room,
                                      device->counted_count + 1, sizeof *device->counted,
                                      "the list of buffers", error);
    return status == RT_OK ? rt_memory_take(device->memory, bytes, what, error) : status;
}

static void note_count(rt_device *device, cl_mem buffer, size_t bytes, const char *what)
{
    rt_counted_buffer *counted = device->counted + device->counted_count++;
    counted->buffer = buffer;
    counted->bytes = bytes;
    snprintf(counted->what, sizeof counted->what, "%s", what);
}

static void end_count(rt_device *device, cl_mem buffer)
{
    for (size_t i = device->counted_count; i-- > 0;)
        if (device->counted[i].buffer == buffer) {
            rt_memory_give(device->memory, device->counted[i].bytes, device->counted[i].what);
            device->counted[i] = device->counted[--device->counted_count];
            return;
        }
}

rt_status rt_buffer_create(rt_device *device, cl_mem *out, cl_mem_flags flags, size_t bytes,
                           void *host, const char *what, rt_error *error)
{
    cl_int code;
    /* Asked here, because some drivers abort instead of refusing. */
    if (bytes > device->info.largest_buffer)
        return rt_fail(error, RT_ERROR_MEMORY,
                       "%s takes %zu bytes, more than the %llu of a buffer on %s", what, bytes,
                       (unsigned long long)device->info.largest_buffer, device->info.name);
    const size_t size = bytes ? bytes : 1, counted = has_memory(flags) ? size : 0;
    rt_status status = begin_count(device, counted, what, error);
    if (status != RT_OK)
        return status;
    if (host && has_memory(flags))
        flags |= CL_MEM_COPY_HOST_PTR;
    cl_mem buffer = clCreateBuffer(device->context, flags, size, bytes ? host : NULL, &code);
    status = rt_cl_check(code, what, error);
    if (status != RT_OK) {
        rt_memory_give(device->memory, counted, what);
        return status;
    }
    if (device->memory && counted > 0)
        note_count(device, buffer, counted, what);
    *out = buffer;
    return RT_OK;
}

rt_status rt_buffer_reserve(rt_device *device, cl_mem *buffer, size_t bytes, const char *what,
                            rt_error *error)
{
    size_t size = 0;
    if (*buffer) {
        rt_status status =
            rt_cl_check(clGetMemObjectInfo(*buffer, CL_MEM_SIZE, sizeof size, &size, NULL),
                        "asking for the size of a buffer", error);
        if (status != RT_OK || size >= bytes)
            return status;
    }
    rt_buffer_release(device, *buffer);
    *buffer = NULL;
    rt_status status =
        rt_buffer_create(device, buffer, CL_MEM_READ_WRITE, bytes + bytes / 8, NULL, what, error);
    return status == RT_ERROR_MEMORY
               ? rt_buffer_create(device, buffer, CL_MEM_READ_WRITE, bytes, NULL, what, error)
               : status;
}

rt_status rt_buffer_read(rt_device *device, cl_mem buffer, size_t offset, size_t bytes, void *host,
                         rt_error *error)
{
    if (bytes == 0)
        return RT_OK;
    cl_event event, *const wanted = rt_event_of(device, &event);
    rt_status status = rt_cl_check(
        clEnqueueReadBuffer(device->queue, buffer, CL_TRUE, offset, bytes, host, 0, NULL, wanted),
        "reading from the device", error);
    rt_event_transferred(device, event, "read", bytes);
    return status;
}

rt_status rt_buffer_write(rt_device *device, cl_mem buffer, size_t offset, size_t bytes,
                          const void *host, rt_error *error)
{
    if (bytes == 0)
        return RT_OK;
    cl_event event, *const wanted = rt_event_of(device, &event);
    rt_status status = rt_cl_check(
        clEnqueueWriteBuffer(device->queue, buffer, CL_TRUE, offset, bytes, host, 0, NULL, wanted),
        "writing to the device", error);
    rt_event_transferred(device, event, "write", bytes);
    return status;
}

rt_status rt_buffer_clear(rt_device *device, cl_mem buffer, size_t bytes, rt_error *error)
{
    static const unsigned char zeros[16];
    const size_t pattern = bytes % sizeof zeros == 0 ? sizeof zeros : 4; /* it divides the bytes */
    if (bytes == 0)
        return RT_OK;
    cl_event event, *const wanted = rt_event_of(device, &event);
    rt_status status = rt_cl_check(
        clEnqueueFillBuffer(device->queue, buffer, zeros, pattern, 0, bytes, 0, NULL, wanted),
        "clearing memory of the device", error);
    rt_event_transferred(device, event, "clear", bytes);
    return status;
}

rt_status rt_buffer_copy(rt_device *device, cl_mem from, cl_mem to, size_t offset, size_t bytes,
                         rt_error *error)
{
    if (bytes == 0)
        return RT_OK;
    cl_event event, *const wanted = rt_event_of(device, &event);
    rt_status status =
        rt_cl_check(clEnqueueCopyBuffer(device->queue, from, to, 0, offset, bytes, 0, NULL, wanted),
                    "copying on the device", error);
    rt_event_transferred(device, event, "copy", bytes);
    return status;
}

/* What rt_buffer_map and rt_buffer_map_begin fail with. */
static rt_status check_map(cl_int code, const char *what, rt_error *error)
{
    char text[128];
    if (code == CL_SUCCESS)
        return RT_OK;
    snprintf(text, sizeof text, "reading %s from the device", what);
    return rt_cl_check(code, text, error);
}

rt_status rt_buffer_map_begin(rt_device *device, cl_mem buffer, size_t bytes, const void **out,
                              cl_event *ready, const char *what, rt_error *error)
{
    cl_int code = CL_SUCCESS;
    void *mapped = clEnqueueMapBuffer(device->queue, buffer, CL_FALSE, CL_MAP_READ, 0, bytes, 0,
                                      NULL, ready, &code);
    rt_status status = check_map(code, what, error);
    if (status == RT_OK)
        *out = mapped;
    return status;
}

rt_status rt_buffer_map_wait(cl_event ready, const char *what, rt_error *error)
{
    rt_status status = check_map(clWaitForEvents(1, &ready), what, error);
    clReleaseEvent(ready);
    return status;
}

rt_status rt_buffer_map(rt_device *device, cl_mem buffer, size_t bytes, const void **out,
                        const char *what, rt_error *error)
{
    void *mapped = NULL;
    cl_int code =
        bytes ? CL_SUCCESS : clGetMemObjectInfo(buffer, CL_MEM_SIZE, sizeof bytes, &bytes, NULL);
    if (code == CL_SUCCESS)
        mapped = clEnqueueMapBuffer(device->queue, buffer, CL_TRUE, CL_MAP_READ, 0, bytes, 0, NULL,
                                    NULL, &code);
    rt_status status = check_map(code, what, error);
    if (status == RT_OK)
        *out = mapped;
    return status;
}

rt_status rt_buffer_unmap(rt_device *device, cl_mem buffer, const void *mapped, rt_error *error)
{
    if (!mapped)
        return RT_OK;
    return rt_cl_check(
        clEnqueueUnmapMemObject(device->queue, buffer, (void *)mapped, 0, NULL, NULL),
        "returning memory to the device", error);
}

rt_status rt_mirror_create(rt_device *device, cl_mem *out, size_t bytes, void *host,
                           const char *what, rt_error *error)
{
    const cl_mem_flags flags = CL_MEM_READ_WRITE;
    return rt_buffer_create(device, out, device->info.is_cpu ? flags | CL_MEM_USE_HOST_PTR : flags,
                            bytes, host, what, error);
}

/* Tells the driver that the host reads or writes the memory that a buffer works on. */
static rt_status touch(rt_device *device, cl_mem buffer, cl_map_flags flags, size_t bytes,
                       rt_error *error)
{
    cl_int code = CL_SUCCESS;
    void *mapped =
        clEnqueueMapBuffer(device->queue, buffer, CL_TRUE, flags, 0, bytes, 0, NULL, NULL, &code);
    rt_status status = rt_cl_check(code, "sharing memory with the device", error);
    return status == RT_OK ? rt_buffer_unmap(device, buffer, mapped, error) : status;
}

rt_status rt_mirror_read(rt_device *device, cl_mem buffer, size_t bytes, void *host,
                         rt_error *error)
{
    return device->info.is_cpu ? touch(device, buffer, CL_MAP_READ, bytes, error)
                               : rt_buffer_read(device, buffer, 0, bytes, host, error);
}

rt_status rt_mirror_write(rt_device *device, cl_mem buffer, size_t bytes, const void *host,
                          rt_error *error)
{
    return device->info.is_cpu ? touch(device, buffer, CL_MAP_WRITE, bytes, error)
                               : rt_buffer_write(device, buffer, 0, bytes, host, error);
}

void rt_buffer_release(rt_device *device, cl_mem buffer)
{
    if (!buffer)
        return;
    end_count(device, buffer);
    clReleaseMemObject(buffer);
}

void rt_kernel_release(cl_kernel kernel)
{
    if (kernel)
        clReleaseKernel(kernel);
}

rt_status rt_kernel_args(cl_kernel kernel, const rt_arg *args, cl_uint count, rt_error *error)
{
    for (cl_uint i = 0; i < count; i++) {
        cl_int code = clSetKernelArg(kernel, i, args[i].size, args[i].value);
        if (code != CL_SUCCESS)
            return rt_fail(error, RT_ERROR_DEVICE, "kernel argument %u: %s", i,
                           rt_cl_error_name(code));
    }
    return RT_OK;
}

/*
 * Items of a row of a launch, rounded up to whole work-groups; as many rows or fewer make a layer.
 * So no launch of up to ROW_ITEMS^3 items is wider than another. Where one is, PoCL 3.1 loads the
 * kernel once more and counts its uses with those of the first: a process ends in an assertion of
 * pocl_release_dlhandle_cache where another queue runs that kernel meanwhile.
 *
 * The rows have room for more work-groups than the items need, and PoCL hands its threads runs of
 * up to half of all. The offset of the second dimension tells item_number (kernels/entry.h) how
 * many are needed; it spreads them evenly, so that each run has its share of the work.
 */
enum { ROW_ITEMS = 1024 };

rt_status rt_launch(rt_device *device, cl_kernel kernel, size_t items, rt_error *error)
{
    size_t local = device->work_group, largest = 0;
    if (items == 0)
        return RT_OK;
    /*
     * A kernel that needs many registers may allow fewer work-items per group than the device does.
     */
    if (clGetKernelWorkGroupInfo(kernel, device->id, CL_KERNEL_WORK_GROUP_SIZE, sizeof largest,
                                 &largest, NULL) == CL_SUCCESS &&
        largest > 0 && largest < local)
        local = largest;
    const size_t row = (ROW_ITEMS + local - 1) / local * local, rows = (items + row - 1) / row;
    const size_t layers = (rows + row - 1) / row, needed = (items + local - 1) / local;
    const size_t global[3] = {row, (rows + layers - 1) / layers, layers}, group[3] = {local, 1, 1};
    const size_t offset[3] = {0, needed, 0};
    cl_event event, *const wanted = rt_event_of(device, &event);
    rt_status status = rt_cl_check(
        clEnqueueNDRangeKernel(device->queue, kernel, 3, offset, global, group, 0, NULL, wanted),
        "launching a kernel", error);
    rt_event_launched(device, event, kernel, items);
    if (status == RT_OK)
        status = rt_cl_check(clFlush(device->queue), "launching a kernel", error);
    return status;
}

rt_status rt_run(rt_device *device, cl_kernel kernel, const rt_arg *args, cl_uint count,
                 size_t items, rt_error *error)
{
    rt_status status = rt_kernel_args(kernel, args, count, error);
    return status == RT_OK ? rt_launch(device, kernel, items, error) : status;
}

rt_status rt_device_finish(rt_device *device, rt_error *error)
{
    rt_status status = rt_cl_check(clFinish(device->queue), "waiting for the device", error);
    rt_events_book(device);
    if (device->has_new_kernels) {
        rt_driver_lock();
        rt_kernel_cache_keep();
        rt_driver_unlock();
        device->has_new_kernels = 0;
    }
    return status;
}

void rt_device_settle(rt_device *device)
{
    clFinish(device->queue); /* where that fails, the device is lost and reads nothing any more */
    rt_events_book(device);
}
