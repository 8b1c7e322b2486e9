/*
 * neighbour_search.h - which photons count at a point, and the disc they lie in, by FLANN on the
 * host.
 *
 * A photon is accepted at a point when its normal is within 60 degrees of the point's. Both
 * normals stand on the lit side, so that one test rejects photons on the other side of a thin
 * wall, on walls that meet at a corner, and on surfaces that face away. Rejected photons are
 * left out before the k nearest are ranked. At a point whose surface transmits diffusely those of
 * both of its sides are accepted, with normals within 60 degrees of the point's or its opposite.
 *
 * The disc. With the accepted photons in order of distance, its radius is where the search
 * stops, and the photons strictly nearer count:
 *   - at the k-th, which gives the radius and does not count;
 *   - at the limit on the radius, when fewer than k lie inside it: all of these count;
 *   - at the farthest of all, when the whole map has fewer than k and there is no limit;
 *   - at the (16 k)-th photon, accepted or not, so that a point whose surface has no photons costs
 *     bounded time.
 * Where photons are a Poisson field, the first, the second and the last rule, and any mixture
 * of them, make the sum of K exactly unbiased: each radius is a stopping time of the field, and
 * a photon nearer than it changes it in a way that does not depend on where the photon lies.
 */
#ifndef RT_LIB_PHOTON_NEIGHBOUR_SEARCH_H
#define RT_LIB_PHOTON_NEIGHBOUR_SEARCH_H

#include "photon/photon_list.h"
#include "rt.h"
#include "types.h"

typedef struct rt_neighbour_search rt_neighbour_search;

/* Most candidates of a point, accepted or not, as a multiple of k. */
enum { RT_CANDIDATES_MAX = 16 };

/*
 * Builds the search tree of a map, which is not referred to afterwards. k >= 1 photons a point;
 * max_radius in metres, infinite for no limit; threads on the host. skip_empty: a disc without
 * photons has radius 0, and most of them are told without a search. The search counts in `memory`.
 * The caller owns *out.
 */
rt_status rt_neighbour_search_create(rt_neighbour_search **out, const rt_photon_list *map,
                                     uint32_t k, float max_radius, int skip_empty, uint32_t threads,
                                     rt_memory *memory, rt_error *error);
void rt_neighbour_search_destroy(rt_neighbour_search *search);

/* Entries of a row of neighbour lists: the most photons that can count at a point. */
size_t rt_neighbour_search_stride(const rt_neighbour_search *search);

/*
 * Finds the disc of each point and its photons, nearest first: row i of lists, which has the
 * search's stride, holds discs[i].count indices into the map. A point whose weight is zero is no
 * query and has none. Works on all of the search's threads.
 */
rt_status rt_neighbour_search_find(const rt_neighbour_search *search, const rt_gather_point *points,
                                   size_t count, rt_u32 *lists, rt_gather_disc *discs,
                                   rt_error *error);

#endif
