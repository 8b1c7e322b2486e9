/*
 * face_colours.c - splits vertices whose triangles differ in what they give them, such as colours.
 */
#include <string.h>

#include "mesh/canonical.h"
#include "mesh/unique.h"

enum { KEY_VERTEX, KEY_COLOUR, KEY_WORDS = 4 };

/* Numbers the corners by vertex and colour; the triangles get the numbers. */
static rt_status number_corners(rt_unique *corners, rt_canonical *mesh,
                                const rt_mesh_source *source, const float *colours)
{
    rt_status status = RT_OK;
    for (size_t i = 0; i < 3 * (size_t)mesh->triangle_count && status == RT_OK; i++) {
        uint8_t *const at = mesh->faces + i / 3 * RT_CANONICAL_FACE + 1 + 4 * (i % 3);
        uint32_t key[KEY_WORDS], number;
        memcpy(key + KEY_VERTEX, at, sizeof *key);
        memcpy(key + KEY_COLOUR, colours + 3 * (i / 3), 3 * sizeof *key);
        status = rt_unique_add(corners, source, key, &number);
        if (status == RT_OK)
            memcpy(at, &number, sizeof number);
    }
    return status;
}

static void copy_vertex(const rt_canonical *to, uint32_t corner, const rt_canonical *mesh,
                        const uint32_t *key, int uv, int colour)
{
    const size_t vertex = *key;
    memcpy(rt_canonical_position(to, corner), rt_canonical_position(mesh, *key),
           mesh->row * sizeof(float));
    if (mesh->exact)
        memcpy(to->exact + 3 * (size_t)corner, mesh->exact + 3 * vertex, 3 * sizeof(double));
    if (uv)
        memcpy(rt_canonical_uv(to, corner), key + uv, 2 * sizeof(float));
    if (to->colours)
        memcpy(to->colours + 3 * (size_t)corner,
               colour ? (const void *)(key + colour) : mesh->colours + 3 * vertex,
               3 * sizeof(float));
    const size_t width = mesh->of_vertices.width;
    if (width)
        memcpy(to->of_vertices.values + width * corner, mesh->of_vertices.values + width * vertex,
               width * sizeof(float));
}

rt_status rt_canonical_share(rt_canonical *mesh, const rt_mesh_source *source,
                             const rt_unique *corners, uint32_t first, uint64_t count)
{
    uint32_t *corner_of = NULL, *shared = NULL;
    rt_status status = rt_mesh_zeroed(source, (void **)&corner_of, count, sizeof *corner_of);
    if (status == RT_OK)
        status = rt_mesh_zeroed(source, (void **)&shared, corners->count, sizeof *shared);
    int is_any = 0;
    for (uint32_t i = 0; i < corners->count && status == RT_OK; i++) {
        const uint32_t vertex = *rt_unique_key(corners, i) - first,
                       whole = mesh->shared ? mesh->shared[vertex] : vertex;
        if (corner_of[whole] == 0)
            corner_of[whole] = i + 1;
        shared[i] = corner_of[whole] - 1;
        is_any |= shared[i] != i;
    }
    rt_memory_free(corner_of);
    rt_memory_free(status == RT_OK && is_any ? mesh->shared : shared);
    if (status == RT_OK && is_any)
        mesh->shared = shared;
    return status;
}

/* Takes the vertices of another in place of its own. */
static void replace(rt_canonical *mesh, const rt_canonical *split)
{
    rt_memory_free(mesh->vertices);
    rt_memory_free(mesh->colours);
    rt_memory_free(mesh->exact);
    rt_memory_free(mesh->of_vertices.values);
    mesh->of_vertices.values = split->of_vertices.values;
    mesh->vertices = split->vertices;
    mesh->colours = split->colours;
    mesh->exact = split->exact;
    mesh->vertex_count = split->vertex_count;
}

rt_status rt_canonical_split(rt_canonical *mesh, const rt_mesh_source *source,
                             const rt_unique *corners, int uv, int colour)
{
    rt_canonical split = {.memory = mesh->memory};
    rt_status status = rt_canonical_vertices(&split, source, corners->count, mesh->has_normals,
                                             mesh->has_uv, mesh->colours || colour);
    if (status == RT_OK && mesh->exact)
        status = rt_canonical_exact(&split, source);
    if (status == RT_OK && mesh->of_vertices.width)
        status = rt_mesh_zeroed(source, (void **)&split.of_vertices.values, corners->count,
                                mesh->of_vertices.width * sizeof(float));
    if (status == RT_OK)
        status = rt_canonical_share(mesh, source, corners, 0, mesh->vertex_count);
    for (uint32_t i = 0; i < corners->count && status == RT_OK; i++)
        copy_vertex(&split, i, mesh, rt_unique_key(corners, i), uv, colour);
    if (status == RT_OK)
        replace(mesh, &split);
    else
        rt_canonical_free(&split);
    return status;
}

rt_status rt_canonical_face_colours(rt_canonical *mesh, const rt_mesh_source *source,
                                    const float *colours)
{
    rt_unique corners = {.words = KEY_WORDS};
    rt_status status = number_corners(&corners, mesh, source, colours);
    if (status == RT_OK)
        status = rt_canonical_split(mesh, source, &corners, 0, KEY_COLOUR);
    rt_unique_free(&corners);
    return status;
}
