/* scene_text.h - scene texts made from the tables of the language. */
#ifndef RT_TESTS_FUZZ_SCENE_TEXT_H
#define RT_TESTS_FUZZ_SCENE_TEXT_H

#include "dsl/schema.h"
#include "fuzz/fuzz.h"

/* Which fields a block gets. */
typedef enum fuzz_fields {
    FUZZ_FIELDS_NEEDED, /* only those that it must have, with values that it takes */
    FUZZ_FIELDS_ALL,    /* those that may stand together, likewise */
    FUZZ_FIELDS_ANY     /* a random choice, half of the time with values that may be wrong */
} fuzz_fields;

/*
 * Appends a block in one line. What it names is defined by fuzz_scene_names, and its files are
 * those that the target makes.
 */
void fuzz_scene_block(rt_bytes *out, const rt_block *block, fuzz_fields fields,
                      fuzz_random *random);

/* A random block. */
void fuzz_scene_any_block(rt_bytes *out, fuzz_random *random);

/* A random value of any field, such as "0.5", "[n 0 1]" or "mirror". */
void fuzz_scene_any_value(rt_bytes *out, fuzz_random *random);

/* The text that defines the names which blocks use. */
extern const char fuzz_scene_names[];

#endif
