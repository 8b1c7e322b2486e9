/*
 * pairs.h - makes a tree of two-wide nodes of one of eight-wide nodes, for devices of width 1,
 * where a work-item follows one ray.
 *
 * Two boxes a visit take few registers, and a ray goes to the nearer without sorting. Nodes stand
 * for the children of a wide node, and for the triangles of a block, of which a leaf has two at
 * most; each splits them at the least surface area (Goldsmith and Salmon 1987), or by halves where
 * the tree would be deeper than RT_PAIR_STACK.
 *
 * References:
 *   Goldsmith, Salmon: "Automatic Creation of Object Hierarchies for Ray Tracing", IEEE Computer
 *     Graphics and Applications 7(5), 1987.
 */
#ifndef RT_LIB_ACCEL_PAIRS_H
#define RT_LIB_ACCEL_PAIRS_H

#include <stdint.h>

#include "accel/bvh.h"
#include "types.h"

/* The most two-wide nodes that stand for a tree of these counts. */
uint64_t rt_pairs_most(const rt_bvh_counts *counts);

/*
 * Writes those of the tree at nodes[root] from nodes[first] of *out on, the root first; returns
 * their number. References of the tree count from the start of these arrays. The tree was built
 * with input.has_pairs.
 */
uint32_t rt_pairs_write(rt_pair_node *out, uint32_t first, const rt_bvh_node *nodes, uint32_t root,
                        const rt_tri_block *blocks);

#endif
