/* mesh_parts.c - the parts of a mesh that have textures of their own, as meshes. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "scene/scene.h"

static const char what[] = "a part of a mesh";

/* The part of one texture, and where its vertices come from. */
typedef struct part {
    const rt_scene *scene;
    const rt_scene_mesh *whole;
    uint32_t *triangles; /* [whole->triangle_count], by texture, those without one last */
    uint32_t *ends;      /* [texture_count + 2]: behind those of each texture */
    uint32_t *numbers;   /* [whole->vertex_count]: in the part, or UINT32_MAX */
    uint32_t *sources;   /* [whole->vertex_count]: of each of the part's vertices */
    rt_scene_mesh made;
} part;

static void *allocate(const part *p, size_t count, size_t size, rt_error *error)
{
    return rt_memory_alloc(p->scene->memory, count, size, what, error);
}

/* Makes the arrays, and sorts the triangles. */
static rt_status begin(part *p, const uint32_t *texture_of, uint32_t texture_count, rt_error *error)
{
    const size_t count = p->whole->triangle_count;
    p->triangles = allocate(p, count, sizeof *p->triangles, error);
    p->ends = p->triangles ? allocate(p, texture_count + 2, sizeof *p->ends, error) : NULL;
    p->numbers = p->ends ? allocate(p, p->whole->vertex_count, sizeof *p->numbers, error) : NULL;
    p->sources = p->numbers ? allocate(p, p->whole->vertex_count, sizeof *p->sources, error) : NULL;
    if (!p->sources)
        return RT_ERROR_MEMORY;
    memset(p->numbers, 0xff, p->whole->vertex_count * sizeof *p->numbers);
    memset(p->ends, 0, (texture_count + 2) * sizeof *p->ends);
    for (size_t i = 0; i < count; i++)
        p->ends[1 + (texture_of[i] < texture_count ? texture_of[i] : texture_count)]++;
    for (uint32_t i = 0; i < texture_count; i++)
        p->ends[i + 1] += p->ends[i];
    for (uint32_t i = 0; i < count; i++)
        p->triangles[p->ends[texture_of[i] < texture_count ? texture_of[i] : texture_count]++] = i;
    return RT_OK;
}

/* These rows of an array, or nothing where there is none or *status is a failure. */
static float *take_rows(const part *p, const float *from, size_t width, const uint32_t *sources,
                        size_t count, rt_status *status, rt_error *error)
{
    float *rows = from && *status == RT_OK ? allocate(p, count, width * sizeof *rows, error) : NULL;
    for (size_t i = 0; rows && i < count; i++)
        memcpy(rows + width * i, from + width * sources[i], width * sizeof *rows);
    if (from && !rows)
        *status = RT_ERROR_MEMORY;
    return rows;
}

static rt_status take_attributes(const part *p, rt_attributes *to, const rt_attributes *from,
                                 const uint32_t *sources, size_t count, rt_error *error)
{
    rt_status status = RT_OK;
    for (uint32_t i = 0; i < from->count && status == RT_OK; i++)
        status = rt_attributes_add(to, from->list[i].name, strlen(from->list[i].name),
                                   from->list[i].width, p->scene->memory, error);
    to->values = take_rows(p, from->values, from->width, sources, count, &status, error);
    return status;
}

/* The indices of the triangles of one texture; numbers its vertices. */
static rt_status take_triangles(part *p, uint32_t texture, rt_error *error)
{
    const uint32_t *const triangles = p->triangles + (texture ? p->ends[texture - 1] : 0);
    const size_t count = (size_t)(p->triangles + p->ends[texture] - triangles);
    p->made = (rt_scene_mesh){.next = RT_NONE};
    memcpy(p->made.origin, p->whole->origin, sizeof p->made.origin);
    if (count == 0)
        return RT_OK;
    p->made.indices = allocate(p, count, 3 * sizeof *p->made.indices, error);
    if (!p->made.indices)
        return RT_ERROR_MEMORY;
    for (size_t i = 0; i < 3 * count; i++) {
        const uint32_t vertex = p->whole->indices[3 * (size_t)triangles[i / 3] + i % 3];
        if (p->numbers[vertex] == UINT32_MAX) {
            p->sources[p->made.vertex_count] = vertex;
            p->numbers[vertex] = (uint32_t)p->made.vertex_count++;
        }
        p->made.indices[i] = p->numbers[vertex];
    }
    p->made.triangle_count = count;
    rt_status status =
        take_attributes(p, &p->made.of_triangles, &p->whole->of_triangles, triangles, count, error);
    for (size_t i = 0; i < p->made.vertex_count; i++)
        p->numbers[p->sources[i]] = UINT32_MAX;
    return status;
}

/* Makes the part of a texture; without triangles that have an area there is none. */
static rt_status make_part(part *p, uint32_t texture, rt_error *error)
{
    const rt_scene_mesh *whole = p->whole;
    rt_status status = take_triangles(p, texture, error);
    const uint32_t *const from = p->sources;
    const size_t count = p->made.vertex_count;
    if (p->made.triangle_count == 0)
        return status;
    p->made.positions = take_rows(p, whole->positions, 3, from, count, &status, error);
    p->made.normals = take_rows(p, whole->normals, 3, from, count, &status, error);
    p->made.uv = take_rows(p, whole->uv, 2, from, count, &status, error);
    p->made.colours = take_rows(p, whole->colours, 3, from, count, &status, error);
    if (status == RT_OK)
        status = take_attributes(p, &p->made.of_vertices, &whole->of_vertices, from, count, error);
    if (status == RT_OK)
        rt_scene_mesh_measure(&p->made);
    return status;
}

/* Takes a part to the scene, behind the one before. */
static rt_status take_part(rt_scene *scene, part *p, uint32_t *first, uint32_t *last,
                           rt_error *error)
{
    uint32_t index;
    if (!(p->made.area > 0)) {
        rt_scene_mesh_free(&p->made);
        return RT_OK;
    }
    rt_status status = rt_scene_take_mesh(scene, &index, &p->made, error);
    if (status != RT_OK)
        return status;
    memset(&p->made, 0, sizeof p->made);
    if (*first == RT_NONE)
        *first = index;
    else
        scene->meshes[*last].next = index;
    *last = index;
    return RT_OK;
}

rt_status rt_scene_add_parts(rt_scene *scene, uint32_t *out, const rt_scene_mesh *whole,
                             const uint32_t *texture_of, const uint32_t *textures,
                             uint32_t texture_count, rt_error *error)
{
    part p = {.scene = scene, .whole = whole};
    const size_t before = scene->mesh_count;
    uint32_t first = RT_NONE, last = RT_NONE;
    rt_status status = begin(&p, texture_of, texture_count, error);
    for (uint32_t i = 0; i <= texture_count && status == RT_OK; i++) {
        status = make_part(&p, i, error);
        p.made.texture = i < texture_count ? textures[i] : 0;
        if (status == RT_OK)
            status = take_part(scene, &p, &first, &last, error);
    }
    rt_scene_mesh_free(&p.made);
    rt_memory_free(p.triangles);
    rt_memory_free(p.ends);
    rt_memory_free(p.numbers);
    rt_memory_free(p.sources);
    while (status != RT_OK && scene->mesh_count > before)
        rt_scene_mesh_free(scene->meshes + --scene->mesh_count);
    if (status == RT_OK)
        *out = first;
    return status;
}
