/*
 * volume_gather.h - volume photons on a device, ready to be gathered along camera rays; see
 * kernels/photon/beam.h.
 */
#ifndef RT_LIB_PHOTON_VOLUME_GATHER_H
#define RT_LIB_PHOTON_VOLUME_GATHER_H

#include "device/device.h"
#include "photon/volume_tree.h"
#include "rt.h"

/* All zero is no photons. */
typedef struct rt_volume_gather {
    rt_volume_params params;
    rt_photon_tree_data tree; /* on the host: where the device works on its memory */
    cl_mem nodes, blocks;
} rt_volume_gather;

/* How to gather. */
typedef struct rt_volume_options {
    uint32_t k;       /* as rt_volume_radii */
    float max_radius; /* likewise */
    double factor;    /* likewise */
    rt_density density;
    float cone_k;
    rt_volume_estimate estimate;
} rt_volume_options;

/*
 * Builds the tree of a list on the host, which is not referred to afterwards, and uploads it.
 * Release with rt_volume_gather_release.
 */
rt_status rt_volume_gather_create(rt_volume_gather *out, rt_device *device,
                                  const rt_photon_list *list, const rt_volume_options *options,
                                  rt_error *error);
void rt_volume_gather_release(rt_volume_gather *gather, rt_device *device);

#endif
