/* statement.h - one statement of a scene's text, as the parser leaves it. */
#ifndef RT_DSL_STATEMENT_H
#define RT_DSL_STATEMENT_H

#include "dsl/expression.h"
#include "dsl/schema.h"
#include "dsl/source.h"

/* A field as it is written. */
typedef struct rt_entry {
    const rt_field *field;
    rt_place name;
    rt_place word; /* the word given, or the text of a string */
    int value_count;
    int is_broken;                             /* has an error already reported */
    rt_expression values[RT_FIELD_VALUES_MAX]; /* last: only value_count are ever written */
} rt_entry;

typedef enum rt_statement_kind {
    RT_STATEMENT_LET,
    RT_STATEMENT_INCLUDE,
    RT_STATEMENT_BLOCK,
    RT_STATEMENT_REPEAT, /* up to its '{' */
    RT_STATEMENT_END     /* the '}' of a repeat */
} rt_statement_kind;

#define RT_ENTRIES_MAX 64 /* in one block */

typedef struct rt_statement {
    rt_statement_kind kind;
    rt_place place; /* of its first word, or first two: `light point` */
    /* the word that names it or, of a repeat, its constant; length 0 when it is missing */
    rt_place name;
    rt_expression value; /* of a constant; of a repeat the first */
    rt_expression last;  /* of a repeat */
    rt_place path;       /* of an include, without the quotes */
    const rt_block *block;
    int is_broken;     /* has an error already reported: not to be built */
    int is_incomplete; /* fields may be missing because of an error already reported */
    int entry_count;
    /*
     * last: only the first entry_count are ever written, and the one behind them, which is being
     * parsed
     */
    rt_entry entries[RT_ENTRIES_MAX + 1];
} rt_statement;

/* The entry of a field in a block, or NULL. */
const rt_entry *rt_statement_entry(const rt_statement *statement, const rt_field *field);

#endif
