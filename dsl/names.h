/* names.h - the names that a scene defines: a table from word to what it stands for. */
#ifndef RT_DSL_NAMES_H
#define RT_DSL_NAMES_H

#include "dsl/source.h"

/* A number, or a vector of three. A number has all three components equal. */
typedef struct rt_value {
    double v[3];
    int is_vector;
} rt_value;

#define RT_NAME_INSIDE 3 /* a texture has at most so many inside */

/* One name. */
typedef struct rt_name {
    rt_text text;
    rt_place place; /* where it is defined */
    int is_used;
    int is_broken;    /* its definition is wrong; already reported, so its uses are not */
    int is_awaited;   /* of a constant: the caller has set it, and its `let` is still to come */
    int has_kd;       /* of a material: it reflects diffusely */
    int emits;        /* of a material */
    rt_value value;   /* of a constant */
    uint32_t index;   /* of a material, texture, grid or mesh: what rt.h calls it by */
    uint32_t texture; /* of a mesh: the texture that its file names, or 0 */
    uint32_t parts;   /* of a mesh: the shapes that an instance adds */
    rt_text inside[RT_NAME_INSIDE]; /* of a texture: the textures that it names, where it does */
} rt_name;

#define RT_NAME_NONE ((size_t)-1)

/* A hash table; the names themselves stay in order of definition. All zero is the empty table. */
typedef struct rt_names {
    rt_name *items;
    size_t count, capacity;
    size_t *slots; /* open addressing: position in items plus 1, or 0 */
    size_t slot_count;
    rt_budget *budget; /* that they count in; NULL: none */
} rt_names;

/* The position of a name in items, or RT_NAME_NONE. */
size_t rt_names_find(const rt_names *names, rt_text text);

/*
 * Adds a name that is not there yet, with zero content; NULL when memory is exhausted. Moves items.
 */
rt_name *rt_names_add(rt_names *names, rt_place place);

/* Takes the latest names away until `count` are left. */
void rt_names_truncate(rt_names *names, size_t count);

void rt_names_free(rt_names *names);

#endif
