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
    RT_FIELD_COUNT,    /* uint32_t, or RT_K_ALL for the word `all` */
    RT_FIELD_PAIR,     /* float[2] */
    RT_FIELD_VECTOR,   /* float[3] */
    RT_FIELD_COLOUR,   /* float[3]; one number is a grey */
    RT_FIELD_BOOLEAN,  /* int */
    RT_FIELD_CHOICE,   /* int: position among the choices */
    RT_FIELD_MATERIAL, /* uint32_t: index of the material of that name */
    RT_FIELD_TEXTURE,  /* uint32_t: handle of the texture of that name */
    RT_FIELD_FILE,     /* const char *: path; at most one a block */
    /*
     * Steps of a transform, all into one rt_transform, in the order in which they stand; each may
     * stand often.
     */
    RT_FIELD_TRANSLATE, /* three numbers */
    RT_FIELD_ROTATE,    /* axis and degrees */
    RT_FIELD_SCALE,     /* one or three numbers */
    RT_FIELD_MATRIX     /* twelve numbers, row by row */
} rt_field_type;

#define RT_FIELD_VALUES_MAX 12 /* numbers that a field takes */

/* Which fields a block must give. Those of one block marked with a group need form that group. */
typedef enum rt_field_need {
    RT_NEED_OPTIONAL,
    RT_NEED_REQUIRED,
    RT_NEED_ONE_OF,         /* group: exactly one */
    RT_NEED_AT_MOST_ONE,    /* group: one or none */
    RT_NEED_ALL_OR_NONE,    /* group: all or none */
    RT_NEED_ALL_OR_NONE_TOO /* a second such group */
} rt_field_need;

/* Which numbers a field takes; of a vector or colour, each component. */
typedef enum rt_range_kind {
    RT_RANGE_ANY,
    RT_RANGE_ABOVE,     /* greater than low, at most high */
    RT_RANGE_CLOSED,    /* low to high, both included */
    RT_RANGE_BETWEEN,   /* low to high, both excluded */
    RT_RANGE_DIRECTION, /* any vector but zero; of a rotation, the axis */
    RT_RANGE_NOT_ZERO   /* each number */
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
    const char *unit; /* as the reference prints it; "" for none */
    /* the value when the field is left out, as the reference prints it; "" for none */
    const char *fallback;
    const char *const *choices; /* of RT_FIELD_CHOICE, ended by NULL */
    size_t offset, size;        /* of the member in the block's struct */
} rt_field;

typedef enum rt_block_id {
    RT_BLOCK_CAMERA,
    RT_BLOCK_FILM,
    RT_BLOCK_RENDER,
    RT_BLOCK_TEXTURE,
    RT_BLOCK_MATERIAL,
    RT_BLOCK_POINT_LIGHT,
    RT_BLOCK_SPOT_LIGHT,
    RT_BLOCK_DIRECTIONAL_LIGHT,
    RT_BLOCK_ENVIRONMENT_LIGHT,
    RT_BLOCK_PLANE,
    RT_BLOCK_SPHERE,
    RT_BLOCK_TRIANGLE,
    RT_BLOCK_QUAD,
    RT_BLOCK_DISC,
    RT_BLOCK_CYLINDER,
    RT_BLOCK_CONE,
    RT_BLOCK_ELLIPSOID,
    RT_BLOCK_TORUS,
    RT_BLOCK_MESH,
    RT_BLOCK_INSTANCE,
    RT_BLOCK_MODEL,
    RT_BLOCK_COUNT
} rt_block_id;

#define RT_BLOCK_ONCE 1u   /* a scene holds at most one */
#define RT_BLOCK_NAMED 2u  /* a name that the scene chooses follows the word */
#define RT_BLOCK_REFERS 4u /* the name of a mesh follows the word */

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
    float corners[3][3], normals[3][3], uv[3][2];
    rt_surface surface;
} rt_triangle_fields;

typedef struct rt_quad_fields {
    float corner[3], edge1[3], edge2[3];
    rt_surface surface;
} rt_quad_fields;

typedef struct rt_disc_fields {
    float centre[3], normal[3], radius, inner_radius;
    rt_surface surface;
} rt_disc_fields;

typedef struct rt_cylinder_fields {
    float a[3], b[3], radius;
    int caps;
    rt_surface surface;
} rt_cylinder_fields;

typedef struct rt_cone_fields {
    float base[3], apex[3], radius, apex_radius;
    int caps;
    rt_surface surface;
} rt_cone_fields;

typedef struct rt_ellipsoid_fields {
    float centre[3], radii[3];
    rt_surface surface;
} rt_ellipsoid_fields;

typedef struct rt_torus_fields {
    float centre[3], axis[3], major_radius, minor_radius;
    rt_surface surface;
} rt_torus_fields;

/* Of a mesh, an instance and a model, which has all of it. */
typedef struct rt_mesh_fields {
    const char *path;
    int shading; /* rt_shading */
    rt_surface surface;
} rt_mesh_fields;

/* What the fields of any block fill. */
typedef union rt_block_fields {
    rt_camera camera;
    rt_render_options options; /* of film and render */
    rt_texture texture;
    rt_material material;
    rt_point_light point_light;
    rt_spot_light spot_light;
    rt_directional_light directional_light;
    rt_environment environment;
    rt_plane_fields plane;
    rt_sphere_fields sphere;
    rt_triangle_fields triangle;
    rt_quad_fields quad;
    rt_disc_fields disc;
    rt_cylinder_fields cylinder;
    rt_cone_fields cone;
    rt_ellipsoid_fields ellipsoid;
    rt_torus_fields torus;
    rt_mesh_fields mesh;
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

/* Whether a field is a step of a transform. */
int rt_field_is_transform(const rt_field *field);

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
