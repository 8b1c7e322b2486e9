/* ply_vertices.h - the element `vertex` of a PLY file. */
#ifndef RT_LIB_MESH_PLY_VERTICES_H
#define RT_LIB_MESH_PLY_VERTICES_H

#include "mesh/canonical.h"
#include "mesh/ply_reader.h"

/*
 * Makes room in mesh for the vertices and what the header gives them: position, normal (nx ny nz),
 * texture coordinates (u v, s t, texture_u texture_v, texture_s texture_t) and colour (red green
 * blue, diffuse_red ..., r g b). with_uv asks for texture coordinates also where the vertices have
 * none.
 */
rt_status rt_ply_vertices_prepare(rt_canonical *mesh, rt_ply_reader *reader,
                                  const rt_ply_element *element, int with_uv);

/*
 * Reads the vertices, which the reader has entered. Integer texture coordinates are scaled by the
 * greatest value of their type.
 */
rt_status rt_ply_vertices_read(rt_canonical *mesh, rt_ply_reader *reader);

/*
 * The `largest` colour of a type, as in colour.h: the greatest value of an integer type, but of 32
 * bits 255, which is what programs put there.
 */
double rt_ply_colour_scale(rt_ply_type type);

/* The properties that give the rows of an element a colour; returns 0 where there are none. */
int rt_ply_find_colour(const rt_ply_element *element, const rt_ply_property *parts[3]);

#endif
