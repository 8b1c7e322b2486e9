/*
 * check.h - from a block as written to its fields' values: types, ranges, names and completeness.
 */
#ifndef RT_DSL_CHECK_H
#define RT_DSL_CHECK_H

#include "dsl/scope.h"
#include "dsl/statement.h"

/* What checking looks things up in. */
typedef struct rt_checker {
    rt_reports *reports;
    const rt_operations *operations;
    const rt_scope *scope;
    char **path;      /* receives the path of the block's file, to be freed */
    char **string;    /* receives its other text, to be freed */
    const char *root; /* files lie in this folder; NULL: anywhere */
    rt_place texture; /* the name of the texture that is checked; length 0: another block */
} rt_checker;

/*
 * The name of this kind that a word means, marked as used; NULL when there is none, which is
 * reported.
 */
const rt_name *rt_check_known(const rt_checker *checker, const rt_names *names, rt_place place,
                              const char *kind);

/*
 * Stores the value of every entry of a block into *fields, which holds the defaults, and reports
 * what is wrong. Returns whether the block can be built.
 */
int rt_check_block(const rt_checker *checker, const rt_statement *statement,
                   rt_block_fields *fields);

#endif
