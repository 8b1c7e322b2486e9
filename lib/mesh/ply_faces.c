/* ply_faces.c - polygons and strips of a PLY file as triangles. */
#include "mesh/ply_faces.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesh/colour.h"
#include "mesh/ply_vertices.h"

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

const rt_ply_property *rt_ply_faces_texnumber(const rt_ply_element *element)
{
    const rt_ply_property *number = rt_ply_find_property(element, "texnumber");
    return number && !number->is_list && !rt_ply_is_float(number->type) ? number : NULL;
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
    if (uv_count != 0 && uv_count != 2 * count) {
        reader->property = NULL;
        return rt_ply_fail(reader,
                           "texcoord has %llu values for %llu corners; expected two for each",
                           (unsigned long long)uv_count, (unsigned long long)count);
    }
    f->has_bare_corners |= f->has_texcoord && uv_count == 0;
    rt_status status = RT_OK;
    for (uint64_t i = 0; i < count && status == RT_OK; i++) {
        uint32_t key[RT_PLY_CORNER_WORDS] = {f->list[i], 0};
        if (uv_count)
            memcpy(key + RT_PLY_CORNER_UV, f->uv + 2 * i, 2 * sizeof *key);
        memcpy(key + RT_PLY_CORNER_COLOUR, f->colour, sizeof f->colour);
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

/* What the rows of an element are made of. */
typedef struct columns {
    const rt_ply_property *list, *texcoord, *texnumber, *colour[3];
    int strips;
} columns;

static columns find_columns(const rt_ply_faces *f, const rt_ply_element *element, int strips)
{
    columns found = {.list = rt_ply_faces_list(element), .strips = strips};
    if (f->has_texcoord)
        found.texcoord = rt_ply_faces_texcoord(element);
    if (f->texture_count && !strips)
        found.texnumber = rt_ply_faces_texnumber(element);
    if (f->has_colour && !strips)
        rt_ply_find_colour(element, found.colour);
    return found;
}

static int is_taken(const void *user, const rt_ply_property *property)
{
    const columns *c = user;
    return property == c->list || property == c->texcoord || property == c->texnumber ||
           property == c->colour[0] || property == c->colour[1] || property == c->colour[2];
}

rt_status rt_ply_faces_attributes(rt_ply_faces *f, const rt_ply_element *element,
                                  const rt_mesh_source *source)
{
    columns known = {.list = rt_ply_faces_list(element),
                     .texcoord = rt_ply_faces_texcoord(element),
                     .texnumber = rt_ply_faces_texnumber(element)};
    rt_ply_find_colour(element, known.colour);
    rt_ply_attributes_find(&f->attributes, element, is_taken, &known);
    return rt_ply_attributes_add(&f->mesh->of_triangles, &f->attributes, source->memory,
                                 source->error);
}

/* Reads a number of an attribute of the face. */
static rt_status read_attribute(rt_ply_faces *f, rt_ply_reader *reader,
                                const rt_ply_property *property, int place)
{
    double value;
    reader->property = property;
    const rt_status status = rt_ply_value(reader, property->type, &value);
    if (status == RT_OK)
        f->values[place] = rt_mesh_single(value * rt_ply_attribute_scale(property));
    return status;
}

/* Gives the triangles that a face has become its attributes. */
static rt_status note_attributes(rt_ply_faces *f, const rt_mesh_source *source)
{
    rt_attributes *const to = &f->mesh->of_triangles;
    const size_t count = f->mesh->triangle_count, row = to->width * sizeof *to->values;
    if (count > f->value_room) {
        const size_t room = count + count / 2;
        rt_status status = rt_mesh_resize(source, (void **)&to->values, room, row);
        if (status != RT_OK)
            return status;
        f->value_room = room;
    }
    while (f->valued < count)
        memcpy(to->values + f->valued++ * to->width, f->values, row);
    return RT_OK;
}

/* A colour or texture number of the face, or what is of no use. */
static rt_status read_scalar(rt_ply_faces *f, rt_ply_reader *reader, const columns *columns,
                             const rt_ply_property *property)
{
    double value;
    int channel = 0;
    while (channel < 3 && property != columns->colour[channel])
        channel++;
    if (channel == 3 && property != columns->texnumber)
        return rt_ply_skip(reader, property);
    reader->property = property;
    rt_status status = rt_ply_value(reader, property->type, &value);
    const double largest = rt_ply_colour_scale(property->type);
    if (status == RT_OK &&
        (!(fabs(value) <= FLT_MAX) || (channel < 3 && rt_mesh_colour_is_bad(value, largest))))
        return rt_ply_refuse(reader, value, largest);
    if (status == RT_OK && channel < 3)
        f->colour[channel] = (float)rt_mesh_colour(value, largest);
    else if (status == RT_OK)
        f->texture = (int64_t)value;
    return status;
}

/* Notes the texture of the triangles that a face has become. */
static rt_status note_texture(rt_ply_faces *f, const rt_mesh_source *source)
{
    const int is_known = f->texture >= 0 && f->texture < f->texture_count;
    const size_t count = f->mesh->triangle_count;
    if (count > f->texture_room) {
        size_t room = count + count / 2;
        rt_status status =
            rt_mesh_resize(source, (void **)&f->texture_of, room, sizeof *f->texture_of);
        if (status != RT_OK)
            return status;
        f->texture_room = room;
    }
    f->bad_textures += f->texture >= f->texture_count;
    while (f->textured < count)
        f->texture_of[f->textured++] = is_known ? (uint32_t)f->texture : RT_MESH_BARE;
    return RT_OK;
}

static rt_status read_row(rt_ply_faces *f, rt_ply_reader *reader, const columns *columns)
{
    const rt_ply_element *element = reader->element;
    uint64_t count = 0, uv_count = 0;
    int place;
    rt_status status = RT_OK;
    for (size_t i = 0; i < element->property_count && status == RT_OK; i++) {
        const rt_ply_property *property = &element->properties[i];
        if (property == columns->list)
            status = read_vertices(f, reader, property, columns->strips, &count);
        else if (property == columns->texcoord)
            status = read_texcoord(f, reader, property, &uv_count);
        else if (!columns->strips && (place = rt_ply_attributes_place(&f->attributes, i)) >= 0)
            status = read_attribute(f, reader, property, place);
        else
            status = read_scalar(f, reader, columns, property);
    }
    if (status == RT_OK && (f->has_texcoord || f->has_colour) && !columns->strips)
        status = number_corners(f, reader, count, uv_count);
    if (status == RT_OK)
        status = columns->strips ? add_strips(f, reader->source, count)
                                 : rt_canonical_polygon(f->mesh, reader->source, f->list, count);
    if (status == RT_OK && columns->texnumber)
        status = note_texture(f, reader->source);
    if (status == RT_OK && f->attributes.count && !columns->strips)
        status = note_attributes(f, reader->source);
    return status == RT_OK ? rt_ply_end_row(reader) : status;
}

/* Whether the rows of triangles are those of the canonical form. */
static int is_canonical(const rt_ply_reader *reader, const rt_ply_property *list, int strips)
{
    return !strips && reader->element->property_count == 1 && rt_ply_is_native(reader->format) &&
           rt_ply_size(list->count_type) == 1 &&
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
    const columns columns = find_columns(f, element, strips);
    const rt_ply_property *list = columns.list;
    if (element->count == 0)
        return RT_OK;
    if (!list || !list->is_list || rt_ply_is_float(list->type))
        return rt_mesh_fail(reader->source, element->line,
                            "element %s has no list vertex_indices of an integer type",
                            strips ? "tristrips" : "face");
    int direct = is_canonical(reader, list, strips);
    rt_status status = strips ? RT_OK
                              : rt_canonical_reserve(f->mesh, reader->source,
                                                     f->mesh->triangle_count + element->count);
    while (reader->row < element->count && status == RT_OK) {
        if (direct)
            copy_triangles(f, reader);
        if (reader->row < element->count)
            status = read_row(f, reader, &columns);
    }
    return status;
}

void rt_ply_faces_free(rt_ply_faces *f)
{
    rt_unique_free(&f->corners);
    rt_memory_free(f->list);
    rt_memory_free(f->uv);
    rt_memory_free(f->texture_of);
}
