/* mesh.h - a triangle mesh as it was read from a file. */
#ifndef RT_LIB_MESH_MESH_H
#define RT_LIB_MESH_MESH_H

#include <stdint.h>

#include "mesh/attributes.h"
#include "rt.h"

/* A triangle without a texture beside others that have one. */
#define RT_MESH_BARE UINT32_MAX

/*
 * Owns its arrays, which rt_memory_free frees. Every number in them is finite and every index below
 * vertex_count.
 */
typedef struct rt_mesh {
    uint32_t vertex_count, triangle_count; /* both may be 0: a file may hold points only */
    float *positions;                      /* [vertex_count][3], relative to origin */
    double origin[3];                      /* all 0 unless the mesh is far away */
    /* [vertex_count][3], of length 1, or NULL when the file has none */
    float *normals;
    float *uv; /* [vertex_count][2], as in the file, or NULL */
    /*
     * [vertex_count][3], linear: integers of the file are decoded as sRGB, floats are as they are;
     * or NULL
     */
    float *colours;
    rt_attributes of_vertices, of_triangles; /* as in the file */
    uint32_t *indices;                       /* [triangle_count][3] */
    /*
     * [vertex_count]: the first of the vertices that are one in the file, where corners of its
     * faces have texture coordinates or colours of their own; NULL: each is one
     */
    uint32_t *shared;
    /*
     * the files that `comment TextureFile NAME` of a PLY name, as written, one behind the other,
     * each terminated; or NULL
     */
    char *textures;
    uint32_t texture_count;
    uint32_t *texture_of; /* [triangle_count]: which of them, or RT_MESH_BARE; NULL: the first */
    int names_materials;  /* an OBJ that names materials (mtllib, usemtl), which are left out */
    int goes_on;          /* a PLY that goes on after the elements that its header announces */
    rt_mesh_warnings warnings;

    /*
     * What the file holds. Its vertices become more where one has several normals or texture
     * coordinates (OBJ, texture coordinates by face) and fewer where an STL repeats them. A polygon
     * of n corners becomes n - 2 triangles, and so does a strip.
     */
    uint64_t file_vertices, file_faces;
    /* of fewer than three corners, thus without area; the log names the first */
    uint64_t skipped_faces;
    uint64_t zero_area;   /* triangles without area; they are kept in indices */
    int zero_is_bare;     /* a normal that is zero is one that the file does not give */
    int has_bare_corners; /* some have no texture coordinates, and 0 0 for them */
    /* vertices of faces whose normal is zero or not finite; it was made from the faces around */
    uint64_t bad_normals;

    rt_memory *memory; /* that the arrays count in; NULL: none */
} rt_mesh;

/* Frees the mesh with its arrays; NULL is none. */
void rt_mesh_destroy(rt_mesh *mesh);

#endif
