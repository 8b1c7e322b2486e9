/*
 * volume_tree.h - the tree of volume photons that camera rays traverse: each photon is a sphere of
 * a radius of its own, and as seen along a ray a disc.
 *
 * Jarosz, Zwicker, Jensen: "The Beam Radiance Estimate for Volumetric Photon Mapping", Eurographics
 * 2008, section 5: the radius is that of the k-th nearest photon. It is found once for the eight
 * photons of a block, from the middle of them.
 */
#ifndef RT_LIB_PHOTON_VOLUME_TREE_H
#define RT_LIB_PHOTON_VOLUME_TREE_H

#include "photon/photon_tree.h"

/* The radii of volume photons. */
typedef struct rt_volume_radii {
    uint32_t k;       /* of the k-th nearest; 0: max_radius for all */
    float max_radius; /* m; 0: no limit, which k = 0 must have */
    double factor;    /* of all radii */
} rt_volume_radii;

/*
 * Builds the tree of a list on the host, which is not referred to afterwards, on so many threads.
 * It depends on the list and the radii alone. Free with rt_photon_tree_free.
 */
rt_status rt_volume_tree_build(rt_photon_tree_data *out, const rt_photon_list *list,
                               const rt_volume_radii *radii, uint32_t threads, rt_memory *memory,
                               rt_error *error);

#endif
