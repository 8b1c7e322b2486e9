/*
 * reader.h - reads scene texts statement by statement: each is parsed, checked and built
 * before the next, so that names are defined before they are used and memory is bounded by
 * the largest statement.
 */
#ifndef RT_DSL_READER_H
#define RT_DSL_READER_H

#include "dsl/dump.h"
#include "dsl/expression.h"
#include "dsl/origin.h"
#include "dsl/progress.h"
#include "dsl/schema.h"
#include "dsl/scope.h"

typedef struct rt_reader {
    rt_scene *scene;  /* owned until taken */
    rt_budget budget; /* of all below; failures of its are failures of the reading */
    rt_sources sources;
    rt_reports reports;
    rt_scope scope;
    /* the first block of each kind that may stand only once; length 0: none yet */
    rt_place once[RT_BLOCK_COUNT];
    rt_origins origins;             /* of what is in the scene, when it is to be checked */
    const rt_load_options *options; /* never NULL */
    rt_reading progress;
    rt_dump dump;      /* where the options ask for the blocks */
    uint64_t order;    /* tokens so far */
    size_t blocks;     /* blocks so far */
    size_t iterations; /* of all repeats so far */
    double repeated;   /* bytes that these read */
    int repeats;       /* inside each other */
    int is_defining;   /* the text is a definition of the caller's */
    /* the text was read before, in an earlier iteration of a repeat around it */
    int is_further_iteration;
    /* a failure that is no fault of the text; status RT_OK while there is none */
    rt_error fatal;
} rt_reader;

/*
 * Starts with an empty scene; options, not NULL, must outlive the reader. Whatever it returns, free
 * the reader.
 */
rt_status rt_reader_begin(rt_reader *reader, const rt_load_options *options, rt_error *error);
void rt_reader_free(rt_reader *reader);

/* Reads one text and all that it includes. Errors are collected. */
void rt_reader_read(rt_reader *reader, const rt_source *source);

/* Reads the caller's definitions, before the text; and reports those that it had no `let` for. */
void rt_reader_read_definitions(rt_reader *reader);
void rt_reader_report_unmet(rt_reader *reader);

/* Hands the errors and warnings on, and the scene when there are no errors. */
rt_status rt_reader_finish(rt_reader *reader, rt_scene **out, rt_error *error);

/* Tells the caller of a file that is read. */
void rt_reader_tell_file(const rt_reader *reader, const char *path);

#endif
