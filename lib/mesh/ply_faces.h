/* ply_faces.h - the elements `face` and `tristrips` of a PLY file. */
#ifndef RT_LIB_MESH_PLY_FACES_H
#define RT_LIB_MESH_PLY_FACES_H

#include "mesh/canonical.h"
#include "mesh/ply_attributes.h"
#include "mesh/ply_reader.h"
#include "mesh/unique.h"

/* Words of the keys of corners. */
enum { RT_PLY_CORNER_UV = 1, RT_PLY_CORNER_COLOUR = 3, RT_PLY_CORNER_WORDS = 6 };

/*
 * Faces while they are read. Set mesh, vertex_count, has_texcoord, has_colour and texture_count;
 * the rest is zero.
 */
typedef struct rt_ply_faces {
    rt_canonical *mesh;
    uint64_t vertex_count; /* of the file */
    /*
     * Whether faces bring texture coordinates for their corners (`property list uchar float
     * texcoord`, two for each corner), or a colour. If so, the corners of the triangles are numbers
     * in `corners`, whose keys are a vertex of the file and the bits of u, v and the colour.
     */
    int has_texcoord, has_colour;
    rt_unique corners;
    float colour[3];      /* of the face that is being read */
    int has_bare_corners; /* faces bring none all the same */

    uint32_t texture_count; /* that the header names, where faces say which: `texnumber` */
    int64_t texture;        /* of the face that is being read */
    uint64_t bad_textures;  /* faces of a texture that is not named */
    uint32_t *texture_of;   /* [texture_room]: of triangles, RT_MESH_BARE for none */
    size_t textured, texture_room;

    rt_ply_attributes attributes; /* of the faces, found by rt_ply_faces_attributes */
    float values[RT_PLY_ATTRIBUTES * RT_ATTRIBUTE_WIDTH]; /* of the face that is being read */
    size_t valued, value_room;                            /* rows of mesh->of_triangles */

    uint32_t *list; /* one list of vertices */
    float *uv;      /* one list of texture coordinates */
    size_t list_room, uv_room;
} rt_ply_faces;

/* The list of vertices of a face or strip element, or NULL. */
const rt_ply_property *rt_ply_faces_list(const rt_ply_element *element);

/* The list of texture coordinates of the corners of a face, or NULL. */
const rt_ply_property *rt_ply_faces_texcoord(const rt_ply_element *element);

/* Which texture a face has, or NULL. */
const rt_ply_property *rt_ply_faces_texnumber(const rt_ply_element *element);

/* Finds the attributes of faces and names them in the mesh, whose triangles will have them. */
rt_status rt_ply_faces_attributes(rt_ply_faces *faces, const rt_ply_element *element,
                                  const rt_mesh_source *source);

/* Reads polygons, each fanned, or strips, which -1 restarts; the reader has entered the element. */
rt_status rt_ply_faces_read(rt_ply_faces *faces, rt_ply_reader *reader, int strips);

/* Frees what faces owns; mesh is not its own. */
void rt_ply_faces_free(rt_ply_faces *faces);

#endif
