/*
 * events.c - books the commands of a device. Device and host have clocks of their own: each command
 * tells by the device's when it was enqueued, which the host knows by its own.
 */
#include "device/device.h"

#include <stdio.h>
#include <string.h>

#include "base/profile.h"
#include "base/progress.h"

cl_event *rt_event_of(rt_device *device, cl_event *event)
{
    *event = NULL;
    device->asked = rt_clock();
    return device->profile ? event : NULL;
}

static double seconds_of(cl_event event, cl_profiling_info what)
{
    cl_ulong time = 0;
    clGetEventProfilingInfo(event, what, sizeof time, &time, NULL);
    return 1e-9 * (double)time;
}

/* The queue is in order: what the clocks would let overlap begins where the last one ended. */
static void book(rt_device *device, const rt_pending *pending)
{
    const double offset = pending->asked - seconds_of(pending->event, CL_PROFILING_COMMAND_QUEUED);
    rt_profile_done done = {pending->name,
                            pending->is_transfer,
                            pending->amount,
                            pending->asked,
                            offset + seconds_of(pending->event, CL_PROFILING_COMMAND_START),
                            offset + seconds_of(pending->event, CL_PROFILING_COMMAND_END)};
    if (done.started < device->last_end)
        done.started = device->last_end;
    if (done.ended < done.started)
        done.ended = done.started;
    device->last_end = done.ended;
    rt_profile_add(device->profile, device->track, &done);
    clReleaseEvent(pending->event);
}

void rt_events_book(rt_device *device)
{
    for (uint32_t i = 0; i < device->pending_count; i++)
        if (clWaitForEvents(1, &device->pending[i].event) == CL_SUCCESS)
            book(device, device->pending + i);
        else
            clReleaseEvent(device->pending[i].event);
    device->pending_count = 0;
}

/* A command that was enqueued by the call that rt_event_of came before. */
static rt_pending *add(rt_device *device, cl_event event, uint64_t amount)
{
    const double asked = device->asked;
    if (device->pending_count == RT_PENDING_MAX)
        rt_events_book(device);
    rt_pending *pending = device->pending + device->pending_count++;
    *pending = (rt_pending){.event = event, .amount = amount, .asked = asked};
    return pending;
}

void rt_event_launched(rt_device *device, cl_event event, cl_kernel kernel, size_t items)
{
    if (!event)
        return;
    rt_pending *pending = add(device, event, items);
    clGetKernelInfo(kernel, CL_KERNEL_FUNCTION_NAME, sizeof pending->name - 1, pending->name, NULL);
}

void rt_event_transferred(rt_device *device, cl_event event, const char *name, size_t bytes)
{
    if (!event)
        return;
    rt_pending *pending = add(device, event, bytes);
    snprintf(pending->name, sizeof pending->name, "%s", name);
    pending->is_transfer = 1;
}
