/* openmesh_shim.h - calls OpenMesh, which is C++. */
#ifndef RT_LIB_MESH_OPENMESH_SHIM_H
#define RT_LIB_MESH_OPENMESH_SHIM_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Consecutive pieces of one PLY file in memory. */
#define RT_OPENMESH_PIECES 3
typedef struct rt_openmesh_file {
    const void *piece[RT_OPENMESH_PIECES];
    size_t size[RT_OPENMESH_PIECES];
} rt_openmesh_file;

/*
 * Where OpenMesh puts what it reads. The caller gives the arrays, with room for vertex_room
 * vertices and triangle_room triangles; normals and uv may be NULL when the file has none.
 */
typedef struct rt_openmesh_sink {
    float *positions, *normals, *uv; /* [vertex_room][3], [vertex_room][3], [vertex_room][2] */
    uint32_t *indices;               /* [triangle_room][3] */
    uint32_t vertex_room, triangle_room;
    uint32_t vertex_count, triangle_count; /* how many OpenMesh handed over */
    /* now and then, after so many vertices and triangles; non-zero stops */
    int (*step)(void *user, uint64_t done);
    void *user;
} rt_openmesh_sink;

typedef enum rt_openmesh_result {
    RT_OPENMESH_OK,
    RT_OPENMESH_FAILED, /* OpenMesh refuses the file, or hands over what does not fit the sink */
    RT_OPENMESH_MEMORY, /* out of memory */
    RT_OPENMESH_STOPPED /* step asked for it */
} rt_openmesh_result;

/*
 * Reads a PLY file through OpenMesh's reader, face by face as they stand in the file: no half-edge
 * mesh is built, so edges shared by three faces lose none. OpenMesh's readers are global and
 * mutable; one call at a time gets through. No exception leaves it. `why` gets the cause of a
 * failure, at most why_size - 1 characters.
 */
rt_openmesh_result rt_openmesh_read(rt_openmesh_sink *sink, const rt_openmesh_file *file, char *why,
                                    size_t why_size);

#ifdef __cplusplus
}
#endif

#endif
