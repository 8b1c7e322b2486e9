/*
 * gather_neighbours.h - gathering by neighbour lists: FLANN finds the photons of each point on the
 * host, and the kernel on the device sums them.
 */
#ifndef RT_LIB_PHOTON_GATHER_NEIGHBOURS_H
#define RT_LIB_PHOTON_GATHER_NEIGHBOURS_H

#include "device/device.h"
#include "photon/neighbour_search.h"

typedef struct rt_neighbour_gather {
    rt_neighbour_search *search;
    rt_density_params estimate;
    size_t capacity;              /* points a batch */
    cl_mem photons;               /* rt_photon, the list */
    cl_mem discs;                 /* rt_gather_disc [capacity] */
    cl_mem lists;                 /* u32 [capacity][estimate.stride] */
    cl_mem scene;                 /* as rt_tree_gather has it */
    rt_gather_point *host_points; /* the same on the host */
    rt_gather_disc *host_discs;
    rt_u32 *host_lists;
} rt_neighbour_gather;

/*
 * Makes a list ready for gathers of up to `capacity` points, or fewer; estimate: density, cone_k,
 * k, squared_limit and scale. rt_neighbour_gather_release undoes it, also after a failure.
 */
rt_status rt_neighbour_gather_prepare(rt_neighbour_gather *out, rt_device *device,
                                      const rt_photon_list *list, const rt_density_params *estimate,
                                      float max_radius, int skip_empty, size_t capacity,
                                      rt_error *error);
void rt_neighbour_gather_release(rt_neighbour_gather *gather, rt_device *device);

/*
 * Finds the photons of points first .. first + count - 1 and enqueues the kernel gather_neighbours,
 * or one of the same arguments, for them. discs [count], if not NULL, is what was found.
 */
rt_status rt_neighbour_gather_launch(rt_neighbour_gather *gather, rt_device *device,
                                     cl_kernel kernel, cl_mem points, size_t first, size_t count,
                                     rt_gather_disc *discs, rt_error *error);

/* Enqueues the kernel alone, for copies of the points of the last launch: what was found stays. */
rt_status rt_neighbour_gather_sum(const rt_neighbour_gather *gather, rt_device *device,
                                  cl_kernel kernel, cl_mem points, size_t first, size_t count,
                                  rt_error *error);

#endif
