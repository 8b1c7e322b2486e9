/*
 * photon_boxes.h - which points have no photon of theirs among the nearest, known without a search.
 *
 * Photons near each other share a box around their positions and one around their normals. Boxes
 * with enough photons bound from above how far the nearest `reach` photons of any kind lie, those
 * whose normals may fit a point bound from below how far the first that fits lies. Where the second
 * is the greater there is none to find, which a search would learn from all of the `reach`.
 */
#ifndef RT_LIB_PHOTON_PHOTON_BOXES_H
#define RT_LIB_PHOTON_PHOTON_BOXES_H

#include "photon/photon_list.h"

typedef struct rt_photon_boxes rt_photon_boxes;

/*
 * reach >= 1: the nearest photons of any kind that matter. The boxes count in `memory`. The caller
 * owns *out.
 */
rt_status rt_photon_boxes_create(rt_photon_boxes **out, const rt_photon_list *map, size_t reach,
                                 uint32_t threads, rt_memory *memory, rt_error *error);
void rt_photon_boxes_destroy(rt_photon_boxes *boxes);

/*
 * Whether surely none of the nearest `reach` photons is accepted at a point, within the squared
 * limit. Errs on the side of 0.
 */
int rt_photon_boxes_none(const rt_photon_boxes *boxes, const float position[3],
                         const float normal[3], float squared_limit);

#endif
