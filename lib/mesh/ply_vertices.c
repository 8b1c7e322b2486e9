/* ply_vertices.c - finds the properties that a mesh needs and reads them, by row or by column. */
#include "mesh/ply_vertices.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "mesh/colour.h"
#include "mesh/ply_attributes.h"

/* Names of properties that belong together; the first group that is there in full counts. */
#define PARTS_MAX 3
static const char *const position_names[][PARTS_MAX] = {{"x", "y", "z"}};
static const char *const normal_names[][PARTS_MAX] = {{"nx", "ny", "nz"}};
static const char *const uv_names[][PARTS_MAX] = {
    {"u", "v"}, {"s", "t"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}};
static const char *const colour_names[][PARTS_MAX] = {
    {"red", "green", "blue"}, {"diffuse_red", "diffuse_green", "diffuse_blue"}, {"r", "g", "b"}};

/* The parts of one attribute: the properties that give them. */
typedef struct attribute {
    const rt_ply_property *parts[PARTS_MAX];
    int count; /* 0: the vertices do not have it */
} attribute;

typedef struct attributes {
    attribute position, normal, uv, colour;
} attributes;

static attribute find(const rt_ply_element *element, const char *const (*groups)[PARTS_MAX],
                      size_t group_count, int parts)
{
    attribute found = {{NULL, NULL, NULL}, 0};
    for (size_t g = 0; g < group_count; g++) {
        int i = 0;
        for (; i < parts; i++) {
            found.parts[i] = rt_ply_find_property(element, groups[g][i]);
            if (!found.parts[i] || found.parts[i]->is_list)
                break;
        }
        if (i == parts) {
            found.count = parts;
            return found;
        }
    }
    return found;
}

#define FIND(element, names, parts) find(element, names, sizeof(names) / sizeof *(names), parts)

static attributes find_all(const rt_ply_element *element)
{
    attributes found = {
        .position = FIND(element, position_names, 3),
        .normal = FIND(element, normal_names, 3),
        .uv = FIND(element, uv_names, 2),
        .colour = FIND(element, colour_names, 3),
    };
    return found;
}

static int part_of(const attribute *attribute, const rt_ply_property *property)
{
    for (int i = 0; i < attribute->count; i++)
        if (attribute->parts[i] == property)
            return i;
    return -1;
}

/* Whether a property is what every mesh may have. */
static int is_taken(const void *user, const rt_ply_property *property)
{
    const attributes *found = user;
    return part_of(&found->position, property) >= 0 || part_of(&found->normal, property) >= 0 ||
           part_of(&found->uv, property) >= 0 || part_of(&found->colour, property) >= 0;
}

/* Names the other attributes of the vertices, and makes room for their numbers. */
static rt_status prepare_others(rt_canonical *mesh, const rt_mesh_source *source,
                                const rt_ply_element *element, const attributes *found)
{
    rt_ply_attributes others;
    rt_ply_attributes_find(&others, element, is_taken, found);
    if (!others.count)
        return RT_OK;
    const rt_status status =
        rt_ply_attributes_add(&mesh->of_vertices, &others, source->memory, source->error);
    return status == RT_OK ? rt_mesh_zeroed(source, (void **)&mesh->of_vertices.values,
                                            element->count, others.width * sizeof(float))
                           : status;
}

/* Whether floats may not hold the positions: text may have more digits than its type says. */
static int is_rounded(const attribute *position, rt_ply_format format)
{
    for (int i = 0; i < position->count; i++)
        switch (position->parts[i]->type) {
        case RT_PLY_INT8:
        case RT_PLY_UINT8:
        case RT_PLY_INT16:
        case RT_PLY_UINT16:
            break;
        case RT_PLY_FLOAT32:
            if (format == RT_PLY_ASCII)
                return 1;
            break;
        case RT_PLY_INT32:
        case RT_PLY_UINT32:
        case RT_PLY_FLOAT64:
            return 1;
        }
    return 0;
}

rt_status rt_ply_vertices_prepare(rt_canonical *mesh, rt_ply_reader *reader,
                                  const rt_ply_element *element, int with_uv)
{
    attributes found = find_all(element);
    if (element->count && !found.position.count)
        return rt_mesh_fail(reader->source, element->line,
                            "element vertex has not all of the properties x, y and z");
    mesh->file_vertices = element->count;
    rt_status status =
        rt_canonical_vertices(mesh, reader->source, element->count, found.normal.count != 0,
                              found.uv.count != 0 || with_uv, found.colour.count != 0);
    if (status == RT_OK && is_rounded(&found.position, reader->format))
        status = rt_canonical_exact(mesh, reader->source);
    return status == RT_OK ? prepare_others(mesh, reader->source, element, &found) : status;
}

double rt_ply_colour_scale(rt_ply_type type)
{
    const int64_t greatest = rt_ply_is_float(type) ? 0 : rt_ply_greatest(type);
    return greatest > UINT16_MAX ? UINT8_MAX : (double)greatest;
}

int rt_ply_find_colour(const rt_ply_element *element, const rt_ply_property *parts[3])
{
    const attribute found = FIND(element, colour_names, 3);
    memcpy(parts, found.parts, sizeof found.parts);
    return found.count != 0;
}

/* Where one property of a vertex goes. */
typedef struct target {
    float *first;  /* of vertex 0; NULL: nowhere */
    double *exact; /* the same of positions that floats cannot hold */
    size_t stride; /* numbers from vertex to vertex */
    float scale;
    double largest; /* of an integer that encodes a colour as images do; else 0 */
    int is_colour;
    int may_be_bad; /* finite or not */
} target;

static float unit_scale(rt_ply_type type)
{
    return rt_ply_is_float(type) ? 1.0f : 1.0f / (float)rt_ply_greatest(type);
}

static target find_target(const rt_canonical *mesh, const attributes *found,
                          const rt_ply_property *property)
{
    target to = {.stride = mesh->row, .scale = 1};
    int part;
    if ((part = part_of(&found->position, property)) >= 0 && mesh->exact) {
        to.exact = mesh->exact + part;
        to.stride = 3;
    } else if (part >= 0) {
        to.first = rt_canonical_position(mesh, 0) + part;
    } else if ((part = part_of(&found->normal, property)) >= 0) {
        to.first = rt_canonical_normal(mesh, 0) + part;
        to.may_be_bad = 1;
    } else if ((part = part_of(&found->uv, property)) >= 0) {
        to.first = rt_canonical_uv(mesh, 0) + part;
        to.scale = unit_scale(property->type);
    } else if ((part = part_of(&found->colour, property)) >= 0) {
        to.first = mesh->colours + part;
        to.stride = 3;
        to.is_colour = 1;
        to.largest = rt_ply_colour_scale(property->type);
    }
    return to;
}

/* That of a number of another attribute, by its place among them. */
static target other_target(const rt_canonical *mesh, int place, const rt_ply_property *property)
{
    const rt_attributes *of = &mesh->of_vertices;
    return (target){.first = of->values + place,
                    .stride = of->width,
                    .scale = (float)rt_ply_attribute_scale(property),
                    .may_be_bad = 1};
}

/* Puts a value in its place; returns 0 where it is none of those that may stand there. */
static int put(const target *to, uint64_t row, double value)
{
    if ((!(fabs(value) <= FLT_MAX) && !to->may_be_bad) ||
        (to->is_colour && rt_mesh_colour_is_bad(value, to->largest)))
        return 0;
    if (to->exact) {
        to->exact[(size_t)row * to->stride] = value;
        return 1;
    }
    to->first[(size_t)row * to->stride] = to->is_colour ? (float)rt_mesh_colour(value, to->largest)
                                                        : rt_mesh_single(value) * to->scale;
    return 1;
}

/* Row by row, whatever the format. */
static rt_status read_rows(rt_ply_reader *reader, const target *targets)
{
    const rt_ply_element *element = reader->element;
    rt_status status = RT_OK;
    while (reader->row < element->count && status == RT_OK) {
        for (size_t i = 0; i < element->property_count && status == RT_OK; i++) {
            const rt_ply_property *property = &element->properties[i];
            double value;
            if (!targets[i].first && !targets[i].exact) {
                status = rt_ply_skip(reader, property);
                continue;
            }
            reader->property = property;
            status = rt_ply_value(reader, property->type, &value);
            if (status == RT_OK && !put(targets + i, reader->row, value))
                status = rt_ply_refuse(reader, value, targets[i].largest);
        }
        if (status == RT_OK)
            status = rt_ply_end_row(reader);
    }
    return status;
}

/* The bytes of a row of scalars, or 0 when a list is among them. */
static size_t fixed_size(const rt_ply_element *element)
{
    size_t size = 0;
    for (size_t i = 0; i < element->property_count; i++) {
        if (element->properties[i].is_list)
            return 0;
        size += rt_ply_size(element->properties[i].type);
    }
    return size;
}

static float native_single(const uint8_t *at)
{
    float value;
    memcpy(&value, at, sizeof value);
    return value;
}

/* Column by column: binary rows of one size, which rt_ply_enter found to fit in the file. */
static rt_status read_columns(rt_ply_reader *reader, const target *targets, size_t size)
{
    const rt_ply_element *element = reader->element;
    int native = rt_ply_is_native(reader->format);
    const uint8_t *from = reader->at;
    for (size_t i = 0; i < element->property_count; i++) {
        rt_ply_type type = element->properties[i].type;
        const int is_wanted = targets[i].first || targets[i].exact;
        for (uint64_t row = 0; row < element->count && is_wanted; row++) {
            const uint8_t *at = from + (size_t)row * size;
            const double value = type == RT_PLY_FLOAT32 && native ? native_single(at)
                                                                  : rt_ply_decode(at, type, native);
            if (!put(targets + i, row, value)) {
                reader->row = row;
                reader->property = &element->properties[i];
                return rt_ply_refuse(reader, value, targets[i].largest);
            }
        }
        from += rt_ply_size(type);
    }
    reader->at += (size_t)element->count * size;
    return rt_mesh_step(reader->source, (uint64_t)(reader->at - reader->source->data),
                        reader->source->size);
}

rt_status rt_ply_vertices_read(rt_canonical *mesh, rt_ply_reader *reader)
{
    const rt_ply_element *element = reader->element;
    attributes found = find_all(element);
    rt_ply_attributes others;
    target targets[RT_PLY_PROPERTIES];
    rt_ply_attributes_find(&others, element, is_taken, &found);
    for (size_t i = 0; i < element->property_count; i++) {
        const int place = rt_ply_attributes_place(&others, i);
        targets[i] = place < 0 ? find_target(mesh, &found, &element->properties[i])
                               : other_target(mesh, place, &element->properties[i]);
    }
    size_t size = fixed_size(element);
    return reader->format != RT_PLY_ASCII && size ? read_columns(reader, targets, size)
                                                  : read_rows(reader, targets);
}
