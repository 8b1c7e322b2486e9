/* prefix_sum.h - on the device, each number of a table becomes the sum of those before it. */
#ifndef RT_LIB_PHOTON_PREFIX_SUM_H
#define RT_LIB_PHOTON_PREFIX_SUM_H

#include "device/device.h"
#include "types.h"

/* All zero is none. */
typedef struct rt_prefix_sum {
    rt_device *device;
    cl_kernel sum, place;
} rt_prefix_sum;

/* rt_prefix_sum_release undoes it. */
rt_status rt_prefix_sum_create(rt_prefix_sum *out, rt_device *device, rt_error *error);
void rt_prefix_sum_release(rt_prefix_sum *prefix);

/* How many numbers a table of `count` must have room for: its own, and sums behind them. */
size_t rt_prefix_sum_room(size_t count);

/* Enqueues the sums of a table of rt_u32, whose sum is below 2^32. */
rt_status rt_prefix_sum_run(const rt_prefix_sum *prefix, cl_mem table, size_t count,
                            rt_error *error);

#endif
