/* collect.h - parses a scene text in a test and keeps all that is said about it. */
#ifndef RT_TESTS_DSL_COLLECT_H
#define RT_TESTS_DSL_COLLECT_H

#include "rt.h"

#define COLLECTED_MAX 64

typedef struct collected_diagnostic {
    rt_severity severity;
    rt_finding_kind finding;
    int line, column, length;
    char file[256], message[512], hint[512], source_line[256];
} collected_diagnostic;

/* The result of reading one scene. */
typedef struct collected {
    rt_status status;
    rt_error error;
    rt_scene *scene;   /* to be destroyed by collected_free */
    int count, errors; /* diagnostics, of them errors; only the first COLLECTED_MAX are kept */
    collected_diagnostic items[COLLECTED_MAX];
} collected;

/* Each writes all of *out. check_text: with what rt_scene_check finds. */
void collect_text(collected *out, const char *text);
void check_text(collected *out, const char *text);
void collect_file(collected *out, const char *path);
void collected_free(collected *c);

/* Fails the test unless text was accepted without a diagnostic; shows the first one. */
void expect_clean(const collected *c, const char *text);

/* Reads a whole file into a NUL-terminated string, to be freed; fails the test if it cannot. */
char *read_text(const char *path);

#endif
