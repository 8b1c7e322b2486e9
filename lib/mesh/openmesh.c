/*
 * openmesh.c - writes the header of the canonical form and takes over what OpenMesh reads from it.
 */
#include "mesh/openmesh.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesh/openmesh_shim.h"
#include "mesh/ply_reader.h"

#define HEADER_MAX 512

/* The header that describes the canonical form. */
static size_t write_header(const rt_canonical *mesh, char header[HEADER_MAX])
{
    int length = snprintf(
        header, HEADER_MAX,
        "ply\nformat %s 1.0\n"
        "element vertex %u\nproperty float x\nproperty float y\nproperty float z\n%s%s"
        "element face %u\nproperty list uchar uint vertex_index\nend_header\n",
        rt_ply_is_native(RT_PLY_LITTLE_ENDIAN) ? "binary_little_endian" : "binary_big_endian",
        mesh->vertex_count,
        mesh->has_normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "",
        mesh->has_uv ? "property float u\nproperty float v\n" : "", mesh->triangle_count);
    return (size_t)length;
}

/* Room for `count` rows of `width` values of 4 bytes. */
static void *allocate(const rt_canonical *canonical, uint32_t count, size_t width, rt_error *error)
{
    return rt_memory_zeroed(canonical->memory, count, width * 4, "a mesh", error);
}

static rt_mesh *create(const rt_canonical *canonical, rt_error *error)
{
    const uint32_t vertices = canonical->vertex_count;
    rt_mesh *mesh = calloc(1, sizeof *mesh);
    if (!mesh) {
        rt_fail(error, RT_ERROR_MEMORY, "out of memory for a mesh");
        return NULL;
    }
    mesh->memory = canonical->memory;
    mesh->positions = allocate(canonical, vertices, 3, error);
    if (mesh->positions && canonical->has_normals)
        mesh->normals = allocate(canonical, vertices, 3, error);
    if (mesh->positions && canonical->has_uv)
        mesh->uv = allocate(canonical, vertices, 2, error);
    if (mesh->positions)
        mesh->indices = allocate(canonical, canonical->triangle_count, 3, error);
    if (mesh->positions && mesh->indices && (mesh->normals || !canonical->has_normals) &&
        (mesh->uv || !canonical->has_uv))
        return mesh;
    rt_mesh_destroy(mesh);
    return NULL;
}

/* How far OpenMesh is. */
typedef struct stage {
    rt_stage_progress *progress;
    uint64_t all;
} stage;

static int step(void *user, uint64_t done)
{
    stage *s = user;
    return rt_stage_update(s->progress, 0.5 + 0.5 * (double)done / (double)s->all) != RT_OK;
}

static rt_status read_through(rt_mesh *mesh, const rt_canonical *canonical, const char *path,
                              rt_stage_progress *progress, rt_error *error)
{
    char header[HEADER_MAX], why[128];
    stage s = {progress, (uint64_t)canonical->vertex_count + canonical->triangle_count};
    rt_openmesh_file file = {
        {header, canonical->vertices, canonical->faces},
        {write_header(canonical, header),
         (size_t)canonical->vertex_count * canonical->row * sizeof(float),
         (size_t)canonical->triangle_count * RT_CANONICAL_FACE},
    };
    rt_openmesh_sink sink = {
        .positions = mesh->positions,
        .normals = mesh->normals,
        .uv = mesh->uv,
        .indices = mesh->indices,
        .vertex_room = canonical->vertex_count,
        .triangle_room = canonical->triangle_count,
        .step = step,
        .user = &s,
    };
    switch (rt_openmesh_read(&sink, &file, why, sizeof why)) {
    case RT_OPENMESH_STOPPED:
        return RT_CANCELLED;
    case RT_OPENMESH_MEMORY:
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory while reading %.350s", path);
    case RT_OPENMESH_FAILED:
        return rt_fail(error, RT_ERROR_INPUT, "OpenMesh cannot read %.300s: %s", path, why);
    case RT_OPENMESH_OK:
        break;
    }
    /* Nothing may be lost on the way. */
    if (sink.vertex_count != canonical->vertex_count ||
        sink.triangle_count != canonical->triangle_count)
        return rt_fail(error, RT_ERROR_INPUT,
                       "OpenMesh read %u of %u vertices and %u of %u triangles of %.300s",
                       sink.vertex_count, canonical->vertex_count, sink.triangle_count,
                       canonical->triangle_count, path);
    mesh->vertex_count = sink.vertex_count;
    mesh->triangle_count = sink.triangle_count;
    return RT_OK;
}

rt_status rt_mesh_from_canonical(rt_mesh **out, rt_canonical *canonical, const char *path,
                                 rt_stage_progress *progress, rt_error *error)
{
    rt_mesh *mesh = create(canonical, error);
    if (!mesh)
        return RT_ERROR_MEMORY;
    rt_status status = read_through(mesh, canonical, path, progress, error);
    if (status != RT_OK) {
        rt_mesh_destroy(mesh);
        return status;
    }
    mesh->colours = canonical->colours;
    mesh->of_vertices = canonical->of_vertices;
    mesh->of_triangles = canonical->of_triangles;
    mesh->shared = canonical->shared;
    mesh->textures = canonical->textures;
    mesh->texture_count = canonical->texture_count;
    mesh->texture_of = canonical->texture_of;
    canonical->colours = NULL;
    memset(&canonical->of_vertices, 0, sizeof canonical->of_vertices);
    memset(&canonical->of_triangles, 0, sizeof canonical->of_triangles);
    canonical->shared = NULL;
    canonical->textures = NULL;
    canonical->texture_of = NULL;
    mesh->names_materials = canonical->names_materials;
    mesh->goes_on = canonical->goes_on;
    mesh->warnings = canonical->warnings;
    memcpy(mesh->origin, canonical->origin, sizeof mesh->origin);
    mesh->file_vertices = canonical->file_vertices;
    mesh->file_faces = canonical->file_faces;
    mesh->skipped_faces = canonical->skipped_faces;
    mesh->zero_is_bare = canonical->zero_is_bare;
    mesh->has_bare_corners = canonical->has_bare_corners;
    *out = mesh;
    return RT_OK;
}
