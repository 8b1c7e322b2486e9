/*
 * bvh.h - the bounding volume hierarchy, built on the host.
 *
 * A binary tree is built by the binned surface area heuristic, then collapsed to nodes of eight
 * children whose expected cost is least. Build, ask for the counts, give memory, write:
 *
 *     rt_bvh *bvh;
 *     rt_bvh_build(&bvh, &input, threads, progress, error);
 *     rt_bvh_get_counts(bvh, &counts);
 *     ... allocate counts.nodes rt_bvh_node, counts.blocks rt_tri_block, counts.analytic u32 ...
 *     rt_bvh_write(bvh, nodes, blocks, analytic, 0, 0);
 *     rt_bvh_destroy(bvh);
 *
 * The result does not depend on the number of threads, to the bit.
 */
#ifndef RT_LIB_ACCEL_BVH_H
#define RT_LIB_ACCEL_BVH_H

#include <stdint.h>

#include "accel/input.h"
#include "base/progress.h"
#include "rt.h"
#include "types.h"

typedef struct rt_bvh_counts {
    uint32_t nodes; /* at least 1: the root is there even when the scene is empty */
    uint32_t blocks;
    uint32_t analytic; /* equals the input's analytic_count */
} rt_bvh_counts;

typedef struct rt_bvh rt_bvh;

/*
 * Builds the tree with at least one thread. progress may be NULL; it is told of the fraction done
 * and can cancel. Fails with RT_ERROR_MEMORY, RT_CANCELLED, or RT_ERROR_INPUT when there are too
 * many primitives.
 */
rt_status rt_bvh_build(rt_bvh **out, const rt_bvh_input *input, uint32_t threads,
                       rt_stage_progress *progress, rt_error *error);

void rt_bvh_get_counts(const rt_bvh *bvh, rt_bvh_counts *out);

/* The box around everything in the tree; lo = hi = 0 when it is empty. */
void rt_bvh_get_bounds(const rt_bvh *bvh, float lo[3], float hi[3]);

/*
 * Writes the tree into arrays as long as the counts say. Pointers of empty arrays may be NULL.
 * Where the arrays are parts of tables that hold more trees, child references count from the start
 * of the tables: first_node and first_block say where in them nodes and blocks begin.
 */
void rt_bvh_write(const rt_bvh *bvh, rt_bvh_node *nodes, rt_tri_block *blocks, uint32_t *analytic,
                  uint32_t first_node, uint32_t first_block);

void rt_bvh_destroy(rt_bvh *bvh);

#endif
