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
#ifndef RT_ACCEL_BVH_H
#define RT_ACCEL_BVH_H

#include <stdint.h>

#include "base/progress.h"
#include "rt.h"
#include "types.h"

/* Triangles that share vertices. Triangle i is primitive first_prim + i of the scene. */
typedef struct rt_bvh_mesh {
    const float *positions;  /* [vertex][3], metres, finite */
    const uint32_t *indices; /* [triangle_count][3] */
    uint32_t triangle_count;
    uint32_t first_prim;
} rt_bvh_mesh;

/* The parallelogram corner + u edge1 + v edge2. */
typedef struct rt_bvh_quad {
    float corner[3], edge1[3], edge2[3];
    uint32_t prim; /* primitive of the scene */
} rt_bvh_quad;

/* A shape with an intersection function of its own; infinite ones stay outside the tree. */
typedef struct rt_bvh_analytic {
    float lo[3], hi[3]; /* its bounds, finite */
    uint32_t shape;     /* what rt_bvh_write puts in the table of analytic entries */
} rt_bvh_analytic;

/*
 * What the tree holds; any count may be 0. Their sum stays below 2^30. Kept until rt_bvh_write
 * returns.
 */
typedef struct rt_bvh_input {
    const rt_bvh_mesh *meshes;
    uint32_t mesh_count;
    const rt_bvh_quad *quads;
    uint32_t quad_count;
    const rt_bvh_analytic *analytic;
    uint32_t analytic_count;
} rt_bvh_input;

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
