/*
 * dump.h - blocks written back as they were understood: constants, repeats and includes resolved,
 * defaults filled in where they have an effect.
 */
#ifndef RT_DSL_DUMP_H
#define RT_DSL_DUMP_H

#include "dsl/schema.h"

/* The names of what was written so far, by what rt.h calls it by. All zero is none. */
typedef struct rt_dump_names {
    char **items;
    size_t count;
} rt_dump_names;

typedef struct rt_dump {
    rt_dump_names materials, textures, grids, meshes;
    char *line; /* that of the latest block */
    size_t size, capacity;
    int out_of_memory;
} rt_dump;

/*
 * Writes a block that has been built to the callback of options. is_local: its name is one of an
 * iteration, so that others may have it too.
 */
void rt_dump_block(rt_dump *dump, const rt_load_options *options, const rt_block *block,
                   const rt_block_fields *fields, const rt_build_name *name, int is_local);

/* Writes the settings of the whole scene, as `film` and `render`. */
void rt_dump_settings(rt_dump *dump, const rt_load_options *options, const rt_scene *scene);

void rt_dump_free(rt_dump *dump);

/* Bytes of a number that is written, with the end of the text. */
enum { RT_DUMP_NUMBER = 32 };

/* The shortest decimal that reads back to the same number in single precision. */
void rt_dump_number(char out[RT_DUMP_NUMBER], float value);

#endif
