/*
 * photon_sorter.h - photons on the device in the order of Hilbert's curve, the one that
 * rt_point_order finds on the host.
 */
#ifndef RT_LIB_PHOTON_PHOTON_SORTER_H
#define RT_LIB_PHOTON_PHOTON_SORTER_H

#include "device/device.h"
#include "photon/prefix_sum.h"

/* Kernels and memory that serve any number of lists. All zero is none. */
typedef struct rt_photon_sorter {
    rt_device *device;
    cl_kernel bounds, join_bounds, sample, most, cells, keys, count, move;
    rt_prefix_sum prefix;
    cl_mem curve;             /* rt_point_order_curve */
    cl_mem samples, extremes; /* of coordinates, and where most of these are */
    cl_mem grid, boxes;       /* the cells of the curve, and boxes around photons */
    cl_mem items, spare;      /* rt_u64 [photons] */
    cl_mem places;            /* rt_u32 [16][shares], and room for its sums */
} rt_photon_sorter;

/* rt_photon_sorter_release undoes it. */
rt_status rt_photon_sorter_create(rt_photon_sorter *out, rt_device *device, rt_error *error);
void rt_photon_sorter_release(rt_photon_sorter *sorter);

/*
 * Enqueues the sorting of photons [count], at most 2^28 and at least one. sorter->items then holds
 * the index of each photon in the low RT_INDEX_BITS, in order.
 */
rt_status rt_photon_sorter_run(rt_photon_sorter *sorter, cl_mem photons, size_t count,
                               rt_error *error);

#endif
