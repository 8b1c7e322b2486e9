/*
 * formats.h - the readers of the mesh formats.
 *
 * Each goes through the whole file, checks all that a mesh is made of (counts against the size of
 * the file, types, indices, finite numbers) and leaves the result in canonical form. Each fails
 * with RT_ERROR_INPUT (and the line, in text files), RT_ERROR_MEMORY or RT_CANCELLED. Free *mesh,
 * which begins all zero, also after a failure.
 */
#ifndef RT_LIB_MESH_FORMATS_H
#define RT_LIB_MESH_FORMATS_H

#include "mesh/canonical.h"

/*
 * PLY, ascii and binary of either byte order: elements in any order, properties of any type,
 * polygons and strips; elements and properties of no use to a mesh are passed over.
 */
rt_status rt_ply_read(rt_canonical *mesh, const rt_mesh_source *source);

/* Whether data begins like a PLY file. */
int rt_ply_is(const uint8_t *data, size_t size);

/*
 * Wavefront OBJ: v, vt, vn and f; indices from 1, or negative ones from the end; a vertex with
 * several normals or texture coordinates is split. Materials, groups, lines and free-form surfaces
 * are passed over, which the log says.
 */
rt_status rt_obj_read(rt_canonical *mesh, const rt_mesh_source *source);

/* Geomview OFF with the prefixes ST, C and N, ascii. The colours of faces are passed over. */
rt_status rt_off_read(rt_canonical *mesh, const rt_mesh_source *source);

/*
 * STL, ascii and binary. Corners in the same place become one vertex; the normals of facets are
 * passed over.
 */
rt_status rt_stl_read(rt_canonical *mesh, const rt_mesh_source *source);

/* Whether the size of the data is that of a binary STL with as many facets as it announces. */
int rt_stl_is_binary(const rt_mesh_source *source);

#endif
