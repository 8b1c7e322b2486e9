/* map_check.h - whether the photons of a loaded map can be used in a render. */
#ifndef RT_LIB_PHOTON_MAP_CHECK_H
#define RT_LIB_PHOTON_MAP_CHECK_H

#include "photon/photon_map.h"
#include "render/renderer.h"

/*
 * Fails where a map is not of the renderer's scene, has photons on shapes that the scene lacks, or
 * does not fit the options' direct light. Warns of another max_depth, and of Sobol photons for the
 * hull.
 */
rt_status rt_photon_map_check(const rt_photon_map *map, const rt_renderer *renderer,
                              const rt_render_options *options, rt_error *error);

/* Whether a map is what a render by complete options would emit itself, in the same scene. */
rt_status rt_photon_map_is_emitted(int *out, const rt_photon_map *map, const rt_renderer *renderer,
                                   const rt_render_options *options, rt_error *error);

#endif
