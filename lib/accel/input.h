/* input.h - what a bounding volume hierarchy is built over. */
#ifndef RT_LIB_ACCEL_INPUT_H
#define RT_LIB_ACCEL_INPUT_H

#include <stdint.h>

#include "rt.h"

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
    rt_memory *memory; /* that the hierarchy counts in; NULL: none */
    int has_pairs;     /* two-wide nodes are to be made of it, see pairs.h */
} rt_bvh_input;

#endif
