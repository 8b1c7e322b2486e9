/* map_warnings.h - warnings of light that a photon map lacks. */
#ifndef RT_LIB_PHOTON_MAP_WARNINGS_H
#define RT_LIB_PHOTON_MAP_WARNINGS_H

#include "photon/photon_map.h"

/*
 * Warns of lights with power that fewer than 100 paths came from, by the ledger of all paths, and
 * of lists of the map with fewer photons than an estimate needs: k of them, or caustic_k in the
 * caustic list; but not of lists that are empty because there is no light. pass: the one that the
 * map is of, from 1; 0: there are none.
 */
void rt_photon_map_warn_starved(const rt_photon_map *map, const rt_ledger *ledger, uint32_t pass,
                                uint32_t k, uint32_t caustic_k, const rt_hooks *hooks);

/* Warns where the hull is used with Sobol photons, which are too evenly distributed for it. */
void rt_photon_map_warn_even(const rt_photon_map *map, rt_area area, const rt_hooks *hooks);

/* Of the lights alone. */
void rt_photon_map_warn_lights(const rt_ledger *ledger, const rt_hooks *hooks);

/* Warns where most queries at the ends of eye paths found no photon. */
void rt_photon_map_warn_gathers(const rt_film_stats *stats, const rt_hooks *hooks);

#endif
