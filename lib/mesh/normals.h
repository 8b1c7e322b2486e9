/* normals.h - the normals of a mesh. */
#ifndef RT_LIB_MESH_NORMALS_H
#define RT_LIB_MESH_NORMALS_H

#include "mesh/mesh.h"
#include "rt.h"

/*
 * Brings normals to length 1. One of length 0, or not finite, becomes the mean of the faces around
 * its vertex, weighted by angle, or (0, 1, 0) where that has no direction either. Sets *replaced to
 * how many those are, and mesh->bad_normals. Fails with RT_ERROR_MEMORY.
 */
rt_status rt_normals_repair(rt_mesh *mesh, uint64_t *replaced, rt_error *error);

/* How many triangles have no area: two corners in one place, or all on a line. */
uint64_t rt_normals_zero_area(const rt_mesh *mesh);

/*
 * Gives a mesh smooth normals: at each vertex the mean of the faces around it, weighted by angle.
 * Replaces those it has. Fails with RT_ERROR_MEMORY.
 */
rt_status rt_mesh_smooth(rt_mesh *mesh, rt_error *error);

#endif
