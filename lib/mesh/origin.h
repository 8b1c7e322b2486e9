/*
 * origin.h - points near meshes that are far from the origin, which their coordinates are taken
 * relative to; and how much rounding moves.
 */
#ifndef RT_LIB_MESH_ORIGIN_H
#define RT_LIB_MESH_ORIGIN_H

#include <stdint.h>

/* The part of a triangle by which rounding may move its vertices without a word. */
#define RT_ROUNDING_MAX 1e-4

/*
 * The point for a mesh within these bounds: where they are farther away than four times its size,
 * their middle, in steps as large as the mesh, so that subtracting it is exact in double precision,
 * and of floats in single; else 0. Returns whether it is not 0.
 */
int rt_mesh_origin(double origin[3], const double lo[3], const double hi[3]);

/* The largest moves of vertices. All zero is none so far. */
typedef struct rt_rounding {
    uint64_t triangles;  /* of which it is more than RT_ROUNDING_MAX */
    double part, length; /* the largest of their longest edge, and of all */
} rt_rounding;

/* Adds a triangle, from exact vertices to rounded ones. One without edges counts as none. */
void rt_rounding_add(rt_rounding *rounding, const double exact[3][3], const double rounded[3][3]);

#endif
