/* photon_map.h - the photons of a scene, in host memory. */
#ifndef RT_LIB_PHOTON_PHOTON_MAP_H
#define RT_LIB_PHOTON_PHOTON_MAP_H

#include <stddef.h>

#include "rt.h"
#include "types.h"

/*
 * Photons in the order of their paths, and along each path in the order of its bounces, so
 * that order and content do not depend on how the work was shared out. All zero is empty.
 */
typedef struct rt_photon_map {
    rt_photon *photons; /* [count] */
    size_t count, capacity;
    uint64_t emitted;  /* photon paths */
    uint64_t rejected; /* photons left out because they were not finite */
} rt_photon_map;

/*
 * Appends the photons of path_count more paths: path i stored counts[i] of them, which lie at
 * slots + i * slots_per_path. Photons whose numbers are not all finite are left out.
 */
rt_status rt_photon_map_append(rt_photon_map *map, const rt_photon *slots, const rt_u32 *counts, size_t path_count,
                               size_t slots_per_path, rt_error *error);

/* Frees what the map holds and empties it. */
void rt_photon_map_clear(rt_photon_map *map);

#endif
