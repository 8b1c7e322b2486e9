/*
 * flann_index.h - exact nearest neighbours among points, by FLANN's kd-tree.
 *
 * All functions may be called from many threads at once.
 */
#ifndef RT_LIB_PHOTON_FLANN_INDEX_H
#define RT_LIB_PHOTON_FLANN_INDEX_H

#include <stddef.h>

#include "rt.h"

typedef struct rt_flann_index rt_flann_index;

/*
 * Builds the tree over positions [count][3], finite, which are copied; it counts in `memory`. An
 * empty set is allowed. Fails with RT_ERROR_MEMORY, also when count is beyond FLANN's int. The
 * caller owns *out.
 */
rt_status rt_flann_index_create(rt_flann_index **out, const float *positions, size_t count,
                                rt_memory *memory, rt_error *error);
void rt_flann_index_destroy(rt_flann_index *index);

/*
 * The k nearest points of each query, nearest first: indices and squared distances, both
 * [query_count][k]. queries: [query_count][3], finite. k must be between 1 and the number of
 * points. An index beside an infinite distance means nothing: the distance overflowed. Works on the
 * calling thread alone, with 24 bytes of memory for each of k.
 */
rt_status rt_flann_index_nearest(const rt_flann_index *index, const float *queries,
                                 size_t query_count, size_t k, int *indices, float *squared,
                                 rt_error *error);

#endif
