/* ply_faces.c - polygons and strips of a PLY file as triangles. */
#include "mesh/ply_faces.h"

#include <stdlib.h>
#include <string.h>

const rt_ply_property *rt_ply_faces_list(const rt_ply_element *element)
{
    const rt_ply_property *list = rt_ply_find_property(element, "vertex_indices");
    return list ? list : rt_ply_find_property(element, "vertex_index");
}

const rt_ply_property *rt_ply_faces_texcoord(const rt_ply_element *element)
{
    const rt_ply_property *list = rt_ply_find_property(element, "texcoord");
    return list && list->is_list && rt_ply_is_float(list->type) ? list : NULL;
}

/* Makes room for a list whose values are known to be in the file. */
static rt_status grow(void **array, size_t *room, uint64_t count, size_t size,
                      const rt_mesh_source *source)
{
    if (count <= *room)
        return RT_OK;
    rt_status status = rt_mesh_resize(source, array, count, size);
    if (status == RT_OK)
        *room = (size_t)count;
    return status;
}

/* Reads a list of vertices; in a strip, -1 stands for UINT32_MAX. */
static rt_status read_vertices(rt_ply_faces *f, rt_ply_reader *reader,
                               const rt_ply_property *property, int strips, uint64_t *count)
{
    rt_status status = rt_ply_list(reader, property, count);
    if (status == RT_OK)
        status = grow((void **)&f->list, &f->list_room, *count, sizeof *f->list, reader->source);
    for (uint64_t i = 0; i < *count && status == RT_OK; i++) {
        double index;
        status = rt_ply_value(reader, property->type, &index);
        if (status != RT_OK)
            return status;
        int restart = strips && index == -1;
        if (!restart && (index < 0 || index >= (double)f->vertex_count))
            return rt_ply_fail(reader, "vertex %.0f is out of range; the file has %llu vertices",
                               index, (unsigned long long)f->vertex_count);
        f->list[i] = restart ? UINT32_MAX : (uint32_t)index;
    }
    return status;
}

static rt_status read_texcoord(rt_ply_faces *f, rt_ply_reader *reader,
                               const rt_ply_property *property, uint64_t *count)
{
    rt_status status = rt_ply_list(reader, property, count);
    if (status == RT_OK)
        status = grow((void **)&f->uv, &f->uv_room, *count, sizeof *f->uv, reader->source);
    for (uint64_t i = 0; i < *count && status == RT_OK; i++)
        status = rt_ply_finite(reader, property->type, &f->uv[i]);
    return status;
}

/* Turns vertices of the file into corners, each with its own texture coordinates. */
static rt_status number_corners(rt_ply_faces *f, rt_ply_reader *reader, uint64_t count,
                                uint64_t uv_count)
{
    static const float none[2] = {0, 0};
    if (uv_count != 0 && uv_count != 2 * count) {
        reader->property = NULL;
        return rt_ply_fail(reader,
                           "texcoord has %llu values for %llu corners; expected two for each",
                           (unsigned long long)uv_count, (unsigned long long)count);
    }
    f->bare_faces += uv_count == 0;
    rt_status status = RT_OK;
    for (uint64_t i = 0; i < count && status == RT_OK; i++) {
        uint32_t key[3] = {f->list[i], 0, 0};
        memcpy(key + 1, uv_count ? f->uv + 2 * i : none, 2 * sizeof *key);
        status = rt_unique_add(&f->corners, reader->source, key, &f->list[i]);
    }
    return status;
}

/* Adds each triangle of the strips: every second one turned, so that all face the same way. */
static rt_status add_strips(rt_ply_faces *f, const rt_mesh_source *source, uint64_t count)
{
    rt_status status = RT_OK;
    uint64_t length = 0; /* of the strip so far */
    f->mesh->file_faces++;
    for (uint64_t i = 0; i < count && status == RT_OK; i++) {
        const uint32_t *v = f->list + i;
        length = *v == UINT32_MAX ? 0 : length + 1;
        if (length >= 3)
            status = length % 2 ? rt_canonical_triangle(f->mesh, source, v[-2], v[-1], v[0])
                                : rt_canonical_triangle(f->mesh, source, v[-1], v[-2], v[0]);
    }
    return status;
}

static rt_status read_row(rt_ply_faces *f, rt_ply_reader *reader, const rt_ply_property *list,
                          const rt_ply_property *texcoord, int strips)
{
    const rt_ply_element *element = reader->element;
    uint64_t count = 0, uv_count = 0;
    rt_status status = RT_OK;
    for (size_t i = 0; i < element->property_count && status == RT_OK; i++) {
        const rt_ply_property *property = &element->properties[i];
        if (property == list)
            status = read_vertices(f, reader, property, strips, &count);
        else if (property == texcoord)
            status = read_texcoord(f, reader, property, &uv_count);
        else
            status = rt_ply_skip(reader, property);
    }
    if (status == RT_OK && f->by_corner && !strips)
        status = number_corners(f, reader, count, uv_count);
    if (status == RT_OK)
        status = strips ? add_strips(f, reader->source, count)
                        : rt_canonical_polygon(f->mesh, reader->source, f->list, count);
    return status == RT_OK ? rt_ply_end_row(reader) : status;
}

/* Whether the rows of triangles are those of the canonical form. */
static int is_canonical(const rt_ply_faces *f, const rt_ply_reader *reader,
                        const rt_ply_property *list, int strips)
{
    return !strips && !f->by_corner && reader->element->property_count == 1 &&
           rt_ply_is_native(reader->format) && rt_ply_size(list->count_type) == 1 &&
           (list->type == RT_PLY_INT32 || list->type == RT_PLY_UINT32);
}

/* Copies triangles as they stand in the file, up to the first row that is anything else. */
static void copy_triangles(rt_ply_faces *f, rt_ply_reader *reader)
{
    rt_canonical *mesh = f->mesh;
    while (reader->row < reader->element->count && mesh->triangle_count < mesh->triangle_room &&
           reader->end - reader->at >= RT_CANONICAL_FACE && reader->at[0] == 3) {
        uint32_t v[3];
        memcpy(v, reader->at + 1, sizeof v);
        /* A negative index is far too large as an unsigned one. */
        if (v[0] >= f->vertex_count || v[1] >= f->vertex_count || v[2] >= f->vertex_count)
            return;
        memcpy(mesh->faces + (size_t)mesh->triangle_count++ * RT_CANONICAL_FACE, reader->at,
               RT_CANONICAL_FACE);
        mesh->file_faces++;
        reader->at += RT_CANONICAL_FACE;
        reader->row++;
    }
}

rt_status rt_ply_faces_read(rt_ply_faces *f, rt_ply_reader *reader, int strips)
{
    const rt_ply_element *element = reader->element;
    const rt_ply_property *list = rt_ply_faces_list(element);
    const rt_ply_property *texcoord = f->by_corner ? rt_ply_faces_texcoord(element) : NULL;
    if (element->count == 0)
        return RT_OK;
    if (!list || !list->is_list || rt_ply_is_float(list->type))
        return rt_mesh_fail(reader->source, element->line,
                            "element %s has no list vertex_indices of an integer type",
                            strips ? "tristrips" : "face");
    int direct = is_canonical(f, reader, list, strips);
    rt_status status = strips ? RT_OK
                              : rt_canonical_reserve(f->mesh, reader->source,
                                                     f->mesh->triangle_count + element->count);
    while (reader->row < element->count && status == RT_OK) {
        if (direct)
            copy_triangles(f, reader);
        if (reader->row < element->count)
            status = read_row(f, reader, list, texcoord, strips);
    }
    return status;
}

void rt_ply_faces_free(rt_ply_faces *f)
{
    rt_unique_free(&f->corners);
    rt_memory_free(f->list);
    rt_memory_free(f->uv);
}
