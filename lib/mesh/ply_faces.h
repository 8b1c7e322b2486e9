/* ply_faces.h - the elements `face` and `tristrips` of a PLY file. */
#ifndef RT_LIB_MESH_PLY_FACES_H
#define RT_LIB_MESH_PLY_FACES_H

#include "mesh/canonical.h"
#include "mesh/ply_reader.h"
#include "mesh/unique.h"

/* Faces while they are read. Set mesh, vertex_count and by_corner; the rest is zero. */
typedef struct rt_ply_faces {
    rt_canonical *mesh;
    uint64_t vertex_count; /* of the file */
    /*
     * Whether faces bring texture coordinates for their corners (`property list uchar float
     * texcoord`, two for each corner). If so, the corners of the triangles are numbers in
     * `corners`, whose keys are a vertex of the file and the bits of its u and v.
     */
    int by_corner;
    rt_unique corners;
    uint64_t bare_faces; /* that bring none all the same */

    uint32_t *list; /* one list of vertices */
    float *uv;      /* one list of texture coordinates */
    size_t list_room, uv_room;
} rt_ply_faces;

/* The list of vertices of a face or strip element, or NULL. */
const rt_ply_property *rt_ply_faces_list(const rt_ply_element *element);

/* The list of texture coordinates of the corners of a face, or NULL. */
const rt_ply_property *rt_ply_faces_texcoord(const rt_ply_element *element);

/* Reads polygons, each fanned, or strips, which -1 restarts; the reader has entered the element. */
rt_status rt_ply_faces_read(rt_ply_faces *faces, rt_ply_reader *reader, int strips);

/* Frees what faces owns; mesh is not its own. */
void rt_ply_faces_free(rt_ply_faces *faces);

#endif
