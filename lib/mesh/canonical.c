/* canonical.c - fills the canonical form: vertices by number, faces as triangle fans. */
#include "mesh/canonical.h"

#include <stdlib.h>
#include <string.h>

rt_status rt_canonical_vertices(rt_canonical *mesh, const rt_mesh_source *source, uint64_t count,
                                int normals, int uv, int colours)
{
    if (count > RT_CANONICAL_MAX)
        return rt_mesh_fail(source, 0, "%llu vertices are more than the %d that a mesh can have",
                            (unsigned long long)count, RT_CANONICAL_MAX);
    mesh->vertex_count = (uint32_t)count;
    mesh->has_normals = normals;
    mesh->has_uv = uv;
    mesh->row = 3u + (normals ? 3u : 0u) + (uv ? 2u : 0u);
    rt_status status =
        rt_mesh_zeroed(source, (void **)&mesh->vertices, count, mesh->row * sizeof *mesh->vertices);
    if (status == RT_OK && colours)
        status = rt_mesh_zeroed(source, (void **)&mesh->colours, count, 3 * sizeof *mesh->colours);
    return status;
}

float *rt_canonical_position(const rt_canonical *mesh, uint32_t vertex)
{
    return mesh->vertices + (size_t)vertex * mesh->row;
}

float *rt_canonical_normal(const rt_canonical *mesh, uint32_t vertex)
{
    return mesh->vertices + (size_t)vertex * mesh->row + 3;
}

float *rt_canonical_uv(const rt_canonical *mesh, uint32_t vertex)
{
    return mesh->vertices + (size_t)vertex * mesh->row + (mesh->has_normals ? 6 : 3);
}

void rt_canonical_point(double out[3], const rt_canonical *mesh, uint32_t vertex)
{
    const float *position = rt_canonical_position(mesh, vertex);
    for (int i = 0; i < 3; i++)
        out[i] = mesh->exact ? mesh->exact[3 * (size_t)vertex + (size_t)i] : position[i];
}

rt_status rt_canonical_exact(rt_canonical *mesh, const rt_mesh_source *source)
{
    return rt_mesh_zeroed(source, (void **)&mesh->exact, mesh->vertex_count,
                          3 * sizeof *mesh->exact);
}

rt_status rt_canonical_reserve(rt_canonical *mesh, const rt_mesh_source *source, uint64_t triangles)
{
    if (triangles <= mesh->triangle_room)
        return RT_OK;
    if (triangles > RT_CANONICAL_MAX)
        return rt_mesh_fail(source, 0, "%llu triangles are more than the %d that a mesh can have",
                            (unsigned long long)triangles, RT_CANONICAL_MAX);
    rt_status status = rt_mesh_resize(source, (void **)&mesh->faces, triangles, RT_CANONICAL_FACE);
    if (status == RT_OK)
        mesh->triangle_room = (uint32_t)triangles;
    return status;
}

/*
 * Makes room for `more` triangles, growing by at least a half so that adding stays linear in time.
 */
static rt_status grow(rt_canonical *mesh, const rt_mesh_source *source, uint64_t more)
{
    uint64_t needed = mesh->triangle_count + more,
             roomy = mesh->triangle_room + (uint64_t)mesh->triangle_room / 2;
    if (needed <= mesh->triangle_room)
        return RT_OK;
    if (roomy > RT_CANONICAL_MAX)
        roomy = RT_CANONICAL_MAX;
    return rt_canonical_reserve(mesh, source, needed > roomy ? needed : roomy);
}

static void put(rt_canonical *mesh, uint8_t first, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t corners[3] = {a, b, c};
    uint8_t *face = mesh->faces + (size_t)mesh->triangle_count++ * RT_CANONICAL_FACE;
    face[0] = first;
    memcpy(face + 1, corners, sizeof corners);
}

rt_status rt_canonical_triangle(rt_canonical *mesh, const rt_mesh_source *source, uint32_t a,
                                uint32_t b, uint32_t c)
{
    rt_status status = grow(mesh, source, 1);
    if (status == RT_OK)
        put(mesh, RT_CANONICAL_FIRST, a, b, c);
    return status;
}

rt_status rt_canonical_polygon(rt_canonical *mesh, const rt_mesh_source *source,
                               const uint32_t *corners, uint64_t count)
{
    uint64_t face = mesh->file_faces++;
    if (count < 3) {
        if (mesh->skipped_faces++ == 0)
            mesh->first_skipped = face;
        return RT_OK;
    }
    rt_status status = grow(mesh, source, count - 2);
    for (uint64_t i = 2; i < count && status == RT_OK; i++)
        put(mesh, i == 2 ? RT_CANONICAL_FIRST : RT_CANONICAL_GOES_ON, corners[0], corners[i - 1],
            corners[i]);
    return status;
}

void rt_canonical_free(rt_canonical *mesh)
{
    rt_memory_free(mesh->vertices);
    rt_memory_free(mesh->exact);
    rt_memory_free(mesh->faces);
    rt_memory_free(mesh->colours);
    rt_attributes_free(&mesh->of_vertices);
    rt_attributes_free(&mesh->of_triangles);
    rt_memory_free(mesh->shared);
    rt_memory_free(mesh->texture_of);
    free(mesh->textures);
    memset(mesh, 0, sizeof *mesh);
}
