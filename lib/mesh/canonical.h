/*
 * canonical.h - a mesh in canonical form, the only one that OpenMesh is given to read.
 *
 * OpenMesh's own readers hang, overflow or lose faces on files that are damaged or merely unusual.
 * So a reader of ours goes through each file first, trusts nothing in it, and writes what it found
 * as a binary PLY of one fixed layout: float vertices, then triangles of `list uchar uint`, in the
 * byte order of the host.
 */
#ifndef RT_LIB_MESH_CANONICAL_H
#define RT_LIB_MESH_CANONICAL_H

#include <stdint.h>

#include "mesh/mesh.h"
#include "mesh/source.h"

/* Bytes of one triangle: the corner count 3, then three uint32. */
#define RT_CANONICAL_FACE 13
/*
 * The first byte of a triangle: the count 3, which until rt_canonical_cut says that a face of the
 * file begins; or that it goes on.
 */
enum { RT_CANONICAL_FIRST = 3, RT_CANONICAL_GOES_ON = 0 };
/* OpenMesh's handles are ints. */
#define RT_CANONICAL_MAX INT32_MAX

/* All zero is empty. */
typedef struct rt_canonical {
    uint32_t vertex_count, triangle_count, triangle_room;
    int has_normals, has_uv;
    uint32_t row;     /* floats a vertex: position, then normal, then texture coordinates */
    float *vertices;  /* [vertex_count][row] */
    double *exact;    /* [vertex_count][3]: positions until rt_canonical_settle; NULL: no float
                        rounds them */
    double origin[3]; /* that positions are relative to */
    int has_origin;   /* the reader has chosen it */
    uint8_t *faces;   /* [triangle_count][RT_CANONICAL_FACE] */
    /* [vertex_count][3] or NULL; kept aside, because OpenMesh rounds them to bytes */
    float *colours;
    rt_attributes of_vertices, of_triangles; /* kept aside likewise */
    uint32_t *shared;                        /* as that of rt_mesh */
    char *textures; /* their names, one behind the other, each terminated; or NULL */
    uint32_t texture_count;
    uint32_t *texture_of; /* [triangle_count]: which texture, or RT_MESH_BARE; NULL: the first */

    rt_memory *memory; /* that the arrays count in; NULL: none */

    int names_materials; /* which are left out */
    rt_mesh_warnings warnings;
    int goes_on; /* a PLY, after what its header announces */
    uint64_t file_vertices, file_faces, skipped_faces;
    uint64_t first_skipped; /* number of the first face left out, from 0 */
    int zero_is_bare;       /* a normal that is zero is one that the file does not give */
    int has_bare_corners;   /* some have no texture coordinates, and 0 0 for them */
} rt_canonical;

/* Makes room for all vertices; they are zero until filled in. */
rt_status rt_canonical_vertices(rt_canonical *mesh, const rt_mesh_source *source, uint64_t count,
                                int normals, int uv, int colours);

/* Where the parts of a vertex stand. Only those that the mesh has. */
float *rt_canonical_position(const rt_canonical *mesh, uint32_t vertex);
float *rt_canonical_normal(const rt_canonical *mesh, uint32_t vertex);
float *rt_canonical_uv(const rt_canonical *mesh, uint32_t vertex);

/* Makes room for positions in double precision, zero until filled in, which take the place. */
rt_status rt_canonical_exact(rt_canonical *mesh, const rt_mesh_source *source);

/*
 * Chooses the origin and rounds the positions; warns where that moves one by too much. Once all are
 * there and polygons are cut.
 */
void rt_canonical_settle(rt_canonical *mesh, const rt_mesh_source *source);

/* The position as the file has it. */
void rt_canonical_point(double out[3], const rt_canonical *mesh, uint32_t vertex);

struct rt_unique;

/*
 * Remembers which vertices are corners of one of `count` of the file, whose number, and `first`
 * more, begins the key of each.
 */
rt_status rt_canonical_share(rt_canonical *mesh, const rt_mesh_source *source,
                             const struct rt_unique *corners, uint32_t first, uint64_t count);

/*
 * Replaces the vertices by corners, whose keys begin with the number of a vertex: each is a copy of
 * it, with the texture coordinates and the colour that stand at these words of the key, or with its
 * own where that is 0.
 */
rt_status rt_canonical_split(rt_canonical *mesh, const rt_mesh_source *source,
                             const struct rt_unique *corners, int uv, int colour);

/*
 * Gives the triangles, before they are cut, colours, [triangle_count][3]: vertices become several
 * where those of their triangles differ, and ones without a triangle are left out.
 */
rt_status rt_canonical_face_colours(rt_canonical *mesh, const rt_mesh_source *source,
                                    const float *colours);

/* Makes room for so many triangles in all, ahead of adding them. */
rt_status rt_canonical_reserve(rt_canonical *mesh, const rt_mesh_source *source,
                               uint64_t triangles);

/* Adds a triangle. The corners must be below vertex_count by the time OpenMesh reads. */
rt_status rt_canonical_triangle(rt_canonical *mesh, const rt_mesh_source *source, uint32_t a,
                                uint32_t b, uint32_t c);

/*
 * Counts one face of the file and adds it as a fan around its first corner, for rt_canonical_cut to
 * cut; one of fewer than three corners counts as skipped.
 */
rt_status rt_canonical_polygon(rt_canonical *mesh, const rt_mesh_source *source,
                               const uint32_t *corners, uint64_t count);

/*
 * Cuts the polygons anew whose fan is not right, once all positions are there, and warns of those
 * that are not simple. line_of gives the line of a face, counted from 0 among those with three
 * corners or more; NULL: none.
 */
typedef size_t rt_line_of_face(const rt_mesh_source *source, uint64_t face);
rt_status rt_canonical_cut(rt_canonical *mesh, const rt_mesh_source *source,
                           rt_line_of_face *line_of);

void rt_canonical_free(rt_canonical *mesh);

#endif
