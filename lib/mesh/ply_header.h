/*
 * ply_header.h - the header of a PLY file.
 *
 * Reference: G. Turk, "The PLY Polygon File Format", 1994. Beyond it: the type names int8 ..
 * float64, obj_info lines, and comments before the format line.
 */
#ifndef RT_LIB_MESH_PLY_HEADER_H
#define RT_LIB_MESH_PLY_HEADER_H

#include "mesh/source.h"
#include "mesh/text.h"

/* More than any exporter writes; bounds the search for names given twice. */
#define RT_PLY_ELEMENTS 64
#define RT_PLY_PROPERTIES 4096
#define RT_PLY_TEXTURES 256

typedef enum rt_ply_type {
    RT_PLY_INT8,
    RT_PLY_UINT8,
    RT_PLY_INT16,
    RT_PLY_UINT16,
    RT_PLY_INT32,
    RT_PLY_UINT32,
    RT_PLY_FLOAT32,
    RT_PLY_FLOAT64
} rt_ply_type;

typedef enum rt_ply_format { RT_PLY_ASCII, RT_PLY_LITTLE_ENDIAN, RT_PLY_BIG_ENDIAN } rt_ply_format;

typedef struct rt_ply_property {
    rt_token name;
    rt_ply_type type; /* of the value, or of each in a list */
    int is_list;
    rt_ply_type count_type;
} rt_ply_property;

typedef struct rt_ply_element {
    rt_token name;
    uint64_t count;
    rt_ply_property *properties;
    size_t property_count;
    size_t line;
} rt_ply_element;

/* Names point into the file. */
typedef struct rt_ply_header {
    rt_ply_format format;
    rt_ply_element elements[RT_PLY_ELEMENTS];
    size_t element_count;
    rt_token textures[RT_PLY_TEXTURES]; /* of `comment TextureFile NAME`, in their order */
    size_t texture_count;
    rt_mesh_text body; /* where the data begins */
} rt_ply_header;

/* Reads and checks the header. Free *out with rt_ply_header_free, also after a failure. */
rt_status rt_ply_header_read(rt_ply_header *out, const rt_mesh_source *source);
void rt_ply_header_free(rt_ply_header *header);

/* The element or property of this name, or NULL. */
const rt_ply_element *rt_ply_find_element(const rt_ply_header *header, const char *name);
const rt_ply_property *rt_ply_find_property(const rt_ply_element *element, const char *name);

static inline int rt_ply_is_float(rt_ply_type type)
{
    return type == RT_PLY_FLOAT32 || type == RT_PLY_FLOAT64;
}

/* Bytes of a value in a binary file. */
size_t rt_ply_size(rt_ply_type type);

/* The least and the greatest value of an integer type. */
int64_t rt_ply_least(rt_ply_type type);
int64_t rt_ply_greatest(rt_ply_type type);

#endif
