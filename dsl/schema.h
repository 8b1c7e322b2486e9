/*
 * schema.h - the blocks of the language and their fields, as tables.
 *
 * One table drives checking, the "expected" part of messages, suggestions and the
 * reference page. A block's fields are stored into its plain struct at the offsets
 * that the table gives.
 */
#ifndef RT_DSL_SCHEMA_H
#define RT_DSL_SCHEMA_H

#include "dsl/source.h"

#define RT_FIELD_VALUES_MAX 12 /* numbers that a field takes */

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
    /* of `film` and `render` NULL: their fields are settings of rt.h, see rt_block_field */
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

/* A block's fields, from 0 on; NULL behind the last. */
const rt_field *rt_block_field(const rt_block *block, size_t index);

/* The field of that name, or NULL. */
const rt_field *rt_schema_field(const rt_block *block, rt_text name);

/* Whether a field is a step of a transform. */
int rt_field_is_transform(const rt_field *field);

/* "light point": a block as messages name it. */
#define RT_BLOCK_TITLE_SIZE 48
const char *rt_block_title(char out[RT_BLOCK_TITLE_SIZE], const rt_block *block);

#define RT_PHRASE_SIZE 160 /* room for what a field takes, in words */

#endif
