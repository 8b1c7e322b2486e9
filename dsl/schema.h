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

#define RT_BLACK_WORD "black" /* a part of a material that reflects nothing */

typedef enum rt_block_id {
    RT_BLOCK_CAMERA,
    RT_BLOCK_FILM,
    RT_BLOCK_RENDER,
    RT_BLOCK_TEXTURE,
    RT_BLOCK_GRID,
    RT_BLOCK_MATERIAL,
    RT_BLOCK_POINT_LIGHT,
    RT_BLOCK_SPOT_LIGHT,
    RT_BLOCK_PROJECTOR_LIGHT,
    RT_BLOCK_GONIOMETRIC_LIGHT,
    RT_BLOCK_BEAM_LIGHT,
    RT_BLOCK_DIRECTIONAL_LIGHT,
    RT_BLOCK_ENVIRONMENT_LIGHT,
    RT_BLOCK_PORTAL,
    RT_BLOCK_MEDIUM,
    RT_BLOCK_MESH, /* a mesh under a name; this and the following are in shapes.c */
    RT_BLOCK_INSTANCE,
    RT_BLOCK_SHAPE, /* any other shape */
    RT_BLOCK_COUNT
} rt_block_id;

#define RT_BLOCK_ONCE 1u   /* a scene holds at most one */
#define RT_BLOCK_NAMED 2u  /* a name that the scene chooses follows the word */
#define RT_BLOCK_REFERS 4u /* the name of a mesh follows the word */

#define RT_BLOCK_FIELDS_MAX 96

/* What a block is called by, or refers to. */
typedef struct rt_build_name {
    const char *text; /* the name that the scene gives it, or "" */
    /* receives the index of a material, texture, grid or mesh; of an instance: the mesh */
    uint32_t index;
    /* of a mesh: the texture that its file names; of an instance: the one it has unless it says */
    uint32_t texture;
    uint32_t parts;            /* of a mesh or an instance: the shapes that placing it adds */
    int names_materials;       /* of a mesh or model: its file has materials, which are left out */
    int goes_on;               /* the same: its file has more than its header announces */
    rt_mesh_warnings warnings; /* the same: what else its file says */
} rt_build_name;

typedef struct rt_block {
    rt_block_id id;
    const char *word;
    const char *kind; /* the second word, as in `light point`; NULL for none */
    unsigned flags;
    /* of `film` and `render` NULL: their fields are settings of rt.h, see rt_block_field */
    const rt_field *fields;
    size_t field_count;
    /* of blocks in shapes.c: adds what the struct at `fields` describes to the scene */
    rt_status (*build)(rt_scene *scene, const void *fields, rt_build_name *name, rt_error *error);
} rt_block;

/* Bytes of the greatest struct that the fields of a shape fill. */
#define RT_SHAPE_FIELDS_SIZE 256

/* What the fields of any block fill. */
typedef union rt_block_fields {
    rt_camera camera;
    rt_render_options options; /* of film and render */
    rt_texture texture;
    rt_grid grid;
    rt_material material;
    rt_point_light point_light;
    rt_spot_light spot_light;
    rt_projector_light projector_light;
    rt_goniometric_light goniometric_light;
    rt_beam_light beam_light;
    rt_directional_light directional_light;
    rt_environment environment;
    rt_portal portal;
    rt_medium medium;
    double shape[RT_SHAPE_FIELDS_SIZE / sizeof(double)]; /* a struct of shapes.c */
} rt_block_fields;

/* The blocks up to RT_BLOCK_MESH, by their ids; and those of shapes. */
extern const rt_block rt_blocks[];
extern const rt_block rt_shape_blocks[];
extern const size_t rt_shape_block_count;

/* All blocks, from 0 on; NULL behind the last. */
const rt_block *rt_block_at(size_t index);

/* The block of a word, or of a word and a kind; NULL if there is none. */
const rt_block *rt_schema_find(rt_text word, const rt_text *kind);

/* Whether a word begins a block, whatever its kind. */
int rt_schema_is_block(rt_text word);

/* The index-th setting of `film`, or of `render`, which has all others; or NULL. */
const rt_field *rt_block_setting(const rt_block *block, size_t index);

/* A block's fields, from 0 on; NULL behind the last. */
static inline const rt_field *rt_block_field(const rt_block *block, size_t index)
{
    if (!block->fields)
        return rt_block_setting(block, index);
    return index < block->field_count ? &block->fields[index] : NULL;
}

/* The field of that name, or NULL. */
const rt_field *rt_schema_field(const rt_block *block, rt_text name);

/* Whether a field is a step of a transform. */
int rt_field_is_transform(const rt_field *field);

/* "light point": a block as messages name it. */
#define RT_BLOCK_TITLE_SIZE 48
const char *rt_block_title(char out[RT_BLOCK_TITLE_SIZE], const rt_block *block);

#define RT_PHRASE_SIZE 160 /* room for what a field takes, in words */

#endif
