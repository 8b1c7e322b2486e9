/* map_continue.h - a photon map of some paths, to which an emission adds others. */
#ifndef RT_LIB_PHOTON_MAP_CONTINUE_H
#define RT_LIB_PHOTON_MAP_CONTINUE_H

#include "photon/photon_map.h"

/*
 * Fills an empty map, whose settings and ledger are those of an emission by complete options, with
 * a copy of another. Fails with RT_ERROR_USAGE, saying what differs, where that is of another scene
 * or other settings, or has paths that the emission has not.
 */
rt_status rt_photon_map_continue(rt_photon_map *map, const rt_photon_map *from,
                                 const rt_render_options *options, rt_error *error);

/*
 * The first run of paths from `first` on and before `end` that ranges of one seed, which are in
 * order, lack; its count is 0 when there is none.
 */
rt_path_range rt_path_ranges_gap(const rt_path_ranges *ranges, uint64_t first, uint64_t end);

#endif
