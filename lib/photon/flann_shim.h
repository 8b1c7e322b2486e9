/*
 * flann_shim.h - calls FLANN, which is C++, by its templates.
 *
 * FLANN's C functions let std::bad_alloc escape through C, lose what they had allocated by then,
 * and depend on a type of distance and a log that belong to the process; nothing of that is here.
 */
#ifndef RT_LIB_PHOTON_FLANN_SHIM_H
#define RT_LIB_PHOTON_FLANN_SHIM_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rt_flann_tree rt_flann_tree;

/*
 * A kd-tree over positions [count][3], finite and at least one, to which it keeps pointers. Returns
 * 0 and *out, or -1 and the reason in why.
 */
int rt_flann_build(rt_flann_tree **out, const float *positions, int count, char *why,
                   size_t why_size);
void rt_flann_free(rt_flann_tree *tree);

/* The bytes that the tree has allocated. */
uint64_t rt_flann_bytes(const rt_flann_tree *tree);

/*
 * The k points nearest to each of the queries [count][3], nearest first, and their squared
 * distances, both [count][k]. Fewer are written where there are fewer points or where distances
 * overflow. From many threads at once. Returns 0, or -1 and the reason in why.
 */
int rt_flann_search(const rt_flann_tree *tree, const float *queries, size_t count, size_t k,
                    int *indices, float *squared, char *why, size_t why_size);

#ifdef __cplusplus
}
#endif

#endif
