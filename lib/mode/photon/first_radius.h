/*
 * first_radius.h - the radii that progressive passes begin with where none is given: distances of
 * the k-th photon, found by one sample of the film.
 */
#ifndef RT_LIB_MODE_PHOTON_FIRST_RADIUS_H
#define RT_LIB_MODE_PHOTON_FIRST_RADIUS_H

#include "mode/photon/photon_render.h"

/*
 * Sets first_radius and first_radii of a query by the eye paths of this sample; first_radius stays
 * 0 where no point queries, or there are no photons.
 */
/*
 * Whether the query points lie on the surface seen in the pixel, so that its samples are close
 * together and the pixel can have a radius of its own.
 */
int rt_photon_render_seen_by_pixels(const rt_photon_render *render, rt_query query);

rt_status rt_photon_render_choose_radius(rt_photon_render *r, rt_query query, uint32_t sample,
                                         rt_stage_progress *progress, rt_error *error);

#endif
