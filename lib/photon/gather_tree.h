/* gather_tree.h - gathering by a tree of photons: the device traverses it and sums the photons. */
#ifndef RT_LIB_PHOTON_GATHER_TREE_H
#define RT_LIB_PHOTON_GATHER_TREE_H

#include "device/device.h"
#include "photon/photon_tree.h"
#include "photon/tree_builder.h"

typedef struct rt_tree_gather {
    rt_photon_tree_data tree; /* on the host; freed when the device has its copy */
    cl_mem nodes, blocks;
    cl_mem scratch;       /* float [items][stride] */
    cl_mem discs;         /* rt_gather_disc [capacity] */
    rt_tree_place *place; /* that keeps these buffers; NULL: they are the gather's own */
    cl_mem own_limits;    /* the caller's, see estimate.own_limits; NULL without */
    cl_mem scene;         /* the caller's, for points of rough lobes; NULL: there are none */
    rt_density_params estimate;
} rt_tree_gather;

/*
 * Builds the tree of a list where the list lies, and uploads it where that is the host, for gathers
 * of up to *capacity points, fewer where there is not enough memory; estimate: density, cone_k, k,
 * squared_limit and scale; place: as rt_gatherer_create has it. Where the device has no room to
 * build a tree, the host does, and hooks (may be NULL) are told. rt_tree_gather_release undoes it,
 * also after a failure.
 */
rt_status rt_tree_gather_prepare(rt_tree_gather *out, rt_device *device, const rt_photon_list *list,
                                 const rt_density_params *estimate, rt_tree_place *place,
                                 size_t *capacity, const rt_hooks *hooks, rt_error *error);
void rt_tree_gather_release(rt_tree_gather *gather, rt_device *device);

/*
 * Enqueues the kernel gather_tree, or one of the same arguments, for points first .. first + count
 * - 1.
 */
rt_status rt_tree_gather_launch(const rt_tree_gather *gather, rt_device *device, cl_kernel kernel,
                                cl_mem points, size_t first, size_t count, rt_error *error);

/*
 * Enqueues the kernel count_sectors for the points 0 .. count - 1, for a gather with radii of
 * pixels; tests: rt_radius_test of each.
 */
rt_status rt_tree_gather_sectors(const rt_tree_gather *gather, rt_device *device, cl_kernel kernel,
                                 cl_mem points, size_t count, cl_mem tests, rt_error *error);

#endif
