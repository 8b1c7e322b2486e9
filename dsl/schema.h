/*
 * schema.h - the blocks of the language and their fields, as tables.
 *
 * One table drives checking, the "expected" part of messages, suggestions and the
 * tests of the reference page. A block's fields are stored into its plain struct
 * at the offsets that the table gives.
 */
#ifndef RT_DSL_SCHEMA_H
#define RT_DSL_SCHEMA_H

#include "dsl/source.h"

/* What a field's value is, and how it is stored. */
typedef enum rt_field_type {
    RT_FIELD_NUMBER,   /* float, or double by the member's size */
    RT_FIELD_INTEGER,  /* uint32_t, or uint64_t by the member's size */
    RT_FIELD_VECTOR,   /* float[3] */
    RT_FIELD_COLOUR,   /* float[3]; one number is a grey */
    RT_FIELD_BOOLEAN,  /* int */
    RT_FIELD_CHOICE,   /* int: position among the choices */
    RT_FIELD_MATERIAL  /* uint32_t: index of the material of that name */
} rt_field_type;

/* Which fields a block must give. Those of one block marked with a group need form that group. */
typedef enum rt_field_need {
    RT_NEED_OPTIONAL,
    RT_NEED_REQUIRED,
    RT_NEED_ONE_OF,      /* group: exactly one */
    RT_NEED_AT_MOST_ONE, /* group: one or none */
    RT_NEED_ALL_OR_NONE  /* group: all or none */
} rt_field_need;

/* Which numbers a field takes; of a vector or colour, each component. */
typedef enum rt_range_kind {
    RT_RANGE_ANY,
    RT_RANGE_ABOVE,    /* greater than low, at most high */
    RT_RANGE_CLOSED,   /* low to high, both included */
    RT_RANGE_BETWEEN,  /* low to high, both excluded */
    RT_RANGE_DIRECTION /* any vector but zero */
} rt_range_kind;

typedef struct rt_range {
    rt_range_kind kind;
    double low, high;
} rt_range;

typedef struct rt_field {
    const char *name;
    rt_field_type type;
    rt_field_need need;
    rt_range range;
    const char *unit;           /* as the reference prints it; "" for none */
    const char *fallback;       /* the value when the field is left out, as the reference prints it; "" for none */
    const char *const *choices; /* of RT_FIELD_CHOICE, ended by NULL */
    size_t offset, size;        /* of the member in the block's struct */
} rt_field;

typedef enum rt_block_id {
    RT_BLOCK_CAMERA,
    RT_BLOCK_FILM,
    RT_BLOCK_RENDER,
    RT_BLOCK_MATERIAL,
    RT_BLOCK_POINT_LIGHT,
    RT_BLOCK_PLANE,
    RT_BLOCK_SPHERE,
    RT_BLOCK_TRIANGLE,
    RT_BLOCK_QUAD,
    RT_BLOCK_COUNT
} rt_block_id;

#define RT_BLOCK_ONCE 1u  /* a scene holds at most one */
#define RT_BLOCK_NAMED 2u /* a name that the scene chooses follows the word */

#define RT_BLOCK_FIELDS_MAX 32

typedef struct rt_block {
    rt_block_id id;
    const char *word;
    const char *kind; /* the second word, as in `light point`; NULL for none */
    unsigned flags;
    const rt_field *fields;
    size_t field_count;
} rt_block;

/* What the fields of the shapes fill. */
typedef struct rt_plane_fields {
    float point[3], normal[3];
    rt_surface surface;
} rt_plane_fields;

typedef struct rt_sphere_fields {
    float centre[3], radius;
    rt_surface surface;
} rt_sphere_fields;

typedef struct rt_triangle_fields {
    float corners[3][3], normals[3][3];
    rt_surface surface;
} rt_triangle_fields;

typedef struct rt_quad_fields {
    float corner[3], edge1[3], edge2[3];
    rt_surface surface;
} rt_quad_fields;

/* What the fields of any block fill. */
typedef union rt_block_fields {
    rt_camera camera;
    rt_render_options options; /* of film and render */
    rt_material material;
    rt_point_light point_light;
    rt_plane_fields plane;
    rt_sphere_fields sphere;
    rt_triangle_fields triangle;
    rt_quad_fields quad;
} rt_block_fields;

/* All blocks, RT_BLOCK_COUNT of them, by their ids. */
extern const rt_block rt_blocks[];

/* The block of a word, or of a word and a kind; NULL if there is none. */
const rt_block *rt_schema_find(rt_text word, const rt_text *kind);

/* Whether a word begins a block, whatever its kind; and whether that block has kinds. */
int rt_schema_is_block(rt_text word);
int rt_schema_has_kinds(rt_text word);

/* The field of a block, or NULL. */
const rt_field *rt_schema_field(const rt_block *block, rt_text name);

/* "light point": a block as messages name it. */
#define RT_BLOCK_TITLE_SIZE 48
const char *rt_block_title(char out[RT_BLOCK_TITLE_SIZE], const rt_block *block);

/* "one or three numbers", "true or false", ...: what a field takes. */
#define RT_PHRASE_SIZE 160
const char *rt_field_phrase(char out[RT_PHRASE_SIZE], const rt_field *field);

/* "from 0 to 1", ...; "" for any. Whether a number lies in a range. */
const char *rt_range_phrase(char out[RT_PHRASE_SIZE], rt_range range);
int rt_range_holds(rt_range range, double value);

#endif
