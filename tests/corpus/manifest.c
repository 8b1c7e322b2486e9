/* manifest.c - reads MANIFEST.tsv line by line. */
#include "corpus/manifest.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#define TEXT_MAX (1 << 20)
#define RESULT_MAX 99

static void *allocate(size_t size)
{
    void *block = calloc(1, size);
    assert_non_null(block);
    return block;
}

/* FOLDER/NAME, on the heap. */
static char *join(const char *folder, const char *name)
{
    size_t size = strlen(folder) + strlen(name) + 2;
    char *path = allocate(size);
    snprintf(path, size, "%s/%s", folder, name);
    return path;
}

static char *read_text(const char *path)
{
    char *text = allocate(TEXT_MAX);
    FILE *file = fopen(path, "rb");
    if (!file)
        fail_msg("cannot read %s", path);
    size_t size = fread(text, 1, TEXT_MAX - 1, file);
    assert_true(feof(file) && size > 0);
    fclose(file);
    return text;
}

/* Splits a line at its tabs into at most `most` fields. */
static size_t split(char *line, const char **fields, size_t most)
{
    size_t count = 0;
    for (char *next = line; next && count < most; count++) {
        fields[count] = next;
        next = strchr(next, '\t');
        if (next)
            *next++ = '\0';
    }
    return count;
}

/* Ends the line at *text by a zero, moves *text behind it and returns it; NULL at the end. */
static char *next_line(char **text)
{
    char *line = *text;
    if (!*line)
        return NULL;
    size_t length = strcspn(line, "\n");
    *text = line + length + (line[length] ? 1 : 0);
    line[length] = '\0';
    if (length > 0 && line[length - 1] == '\r')
        line[length - 1] = '\0';
    return line;
}

manifest *manifest_open(const char *folder)
{
    const char *corpus = getenv("RT_CORPUS");
    if (!corpus)
        fail_msg("RT_CORPUS does not name the directory of the corpus");
    manifest *m = allocate(sizeof *m);
    m->folder = join(corpus, folder);
    char *path = join(m->folder, "MANIFEST.tsv");
    char *text = m->text = read_text(path);
    free(path);

    size_t lines = 0;
    for (const char *c = text; *c; c++)
        lines += *c == '\n';
    m->column_count = split(next_line(&text), m->columns, MANIFEST_COLUMNS_MAX);
    m->fields = allocate((lines + 1) * m->column_count * sizeof *m->fields);
    for (char *line; (line = next_line(&text));) {
        const char **fields = m->fields + m->row_count * m->column_count;
        if (!*line)
            continue;
        for (size_t i = split(line, fields, m->column_count); i < m->column_count; i++)
            fields[i] = "";
        m->row_count++;
    }
    assert_true(m->row_count > 0);
    return m;
}

void manifest_close(manifest *m)
{
    free(m->folder);
    free(m->text);
    free(m->fields);
    free(m);
}

const char *manifest_field(const manifest *m, size_t row, const char *column)
{
    size_t i = 0;
    while (i < m->column_count && strcmp(m->columns[i], column) != 0)
        i++;
    if (i == m->column_count)
        fail_msg("the manifest has no column %s", column);
    return m->fields[row * m->column_count + i];
}

char *manifest_path(const manifest *m, size_t row)
{
    return join(m->folder, manifest_field(m, row, "file"));
}

int manifest_attempt(int (*attempt)(const char *path, void *user), const char *path, void *user,
                     unsigned seconds)
{
    int status = 0;
    fflush(NULL);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        alarm(seconds);
        _exit(attempt(path, user));
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    if (WIFEXITED(status) && WEXITSTATUS(status) <= RESULT_MAX)
        return WEXITSTATUS(status);
    if (WIFEXITED(status))
        fprintf(stderr, "%s: ended with status %d\n", path, WEXITSTATUS(status));
    else
        fprintf(stderr, "%s: killed by signal %d\n", path, WTERMSIG(status));
    return -1;
}
