/*
 * manifest.h - a corpus of files that others wrote: a folder with MANIFEST.tsv, whose first line
 * names its columns and each further line says of one file what a reader must do with it.
 *
 * The environment variable RT_CORPUS names the directory that holds the folders.
 */
#ifndef RT_TESTS_CORPUS_MANIFEST_H
#define RT_TESTS_CORPUS_MANIFEST_H

#include <stddef.h>

#define MANIFEST_COLUMNS_MAX 16

typedef struct manifest {
    char *folder;
    char *text; /* of the file, each field ended by a zero */
    const char *columns[MANIFEST_COLUMNS_MAX];
    size_t column_count;
    const char **fields; /* [row_count][column_count], empty where a line is too short */
    size_t row_count;
} manifest;

/*
 * Reads $RT_CORPUS/FOLDER/MANIFEST.tsv; fails the running test when it is missing or lists nothing.
 */
manifest *manifest_open(const char *folder);
void manifest_close(manifest *m);

/* A row's field by the name of its column; fails the running test when there is no such column. */
const char *manifest_field(const manifest *m, size_t row, const char *column);

/* The path of a row's file. The caller frees it. */
char *manifest_path(const manifest *m, size_t row);

/*
 * Runs attempt(path, user) in a process of its own, which may crash, for at most `seconds`. Returns
 * what it returned, 0 to 99, or -1 after telling on stderr how the process ended otherwise.
 */
int manifest_attempt(int (*attempt)(const char *path, void *user), const char *path, void *user,
                     unsigned seconds);

#endif
