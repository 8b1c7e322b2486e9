/*
 * Meshes that others wrote: every file of a corpus does as its manifest says.
 *
 * RT_CORPUS names a directory with ply/MANIFEST.tsv: lines of file, source, licence, what it exercises, what
 * a reader must do, and the counts of vertices and triangles. Each file is read by a process of its own, so
 * that one that crashes or hangs is told by name.
 */
#include <math.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "mesh/mesh.h"

enum { SECONDS = 2, COLUMNS = 8, LINE_MAX_SIZE = 4096, PATH_SIZE = 1024 };

/* What came of reading a file, as the exit status of the process that read it. */
enum { ACCEPTED = 10, REJECTED = 11, UNSOUND = 12, WRONG_COUNTS = 13 };

typedef struct entry {
    const char *file, *expected;
    long vertices, triangles; /* -1: not given */
} entry;

/* Splits a line at its tabs. */
static entry parse(char *line)
{
    char *columns[COLUMNS] = {0};
    line[strcspn(line, "\r\n")] = '\0';
    for (int i = 0; i < COLUMNS && line; i++) {
        columns[i] = line;
        line = strchr(line, '\t');
        if (line)
            *line++ = '\0';
    }
    entry e = {columns[0], columns[4] ? columns[4] : "", -1, -1};
    if (columns[5] && columns[5][0] && columns[6] && columns[6][0]) {
        e.vertices = strtol(columns[5], NULL, 10);
        e.triangles = strtol(columns[6], NULL, 10);
    }
    return e;
}

static int all_finite(const float *values, size_t count)
{
    for (size_t i = 0; values && i < count; i++)
        if (!isfinite(values[i]))
            return 0;
    return 1;
}

static int is_sound(const rt_mesh *mesh)
{
    for (size_t i = 0; i < 3 * (size_t)mesh->triangle_count; i++)
        if (mesh->indices[i] >= mesh->vertex_count)
            return 0;
    return all_finite(mesh->positions, 3 * (size_t)mesh->vertex_count) &&
           all_finite(mesh->normals, 3 * (size_t)mesh->vertex_count) &&
           all_finite(mesh->uv, 2 * (size_t)mesh->vertex_count) &&
           all_finite(mesh->colours, 3 * (size_t)mesh->vertex_count);
}

static int load(const char *path, const entry *e)
{
    rt_mesh *mesh = NULL;
    rt_error error = {0};
    if (rt_mesh_load(&mesh, path, NULL, &error) != RT_OK) {
        printf("    %s:%d: %s\n", e->file, error.line, error.message);
        return error.status == RT_ERROR_INPUT && error.message[0] && error.file[0] ? REJECTED : UNSOUND;
    }
    int result = ACCEPTED;
    if (!is_sound(mesh)) {
        result = UNSOUND;
    } else if (e->vertices >= 0 &&
               (mesh->file_vertices != (uint64_t)e->vertices || mesh->triangle_count != (uint32_t)e->triangles)) {
        printf("    %s: %llu vertices and %u triangles\n", e->file, (unsigned long long)mesh->file_vertices,
               mesh->triangle_count);
        result = WRONG_COUNTS;
    }
    rt_mesh_destroy(mesh);
    return result;
}

/* Reads a file in a process of its own, which may take two seconds. Returns the result, or 0 for a crash or a hang. */
static int try_file(const char *directory, const entry *e)
{
    char path[PATH_SIZE];
    snprintf(path, sizeof path, "%s/ply/%s", directory, e->file);
    fflush(stdout);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        alarm(SECONDS);
        int result = load(path, e);
        fflush(stdout);
        _exit(result);
    }
    int status;
    assert_true(waitpid(child, &status, 0) == child);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 0;
}

static int starts_with(const char *text, const char *start)
{
    return strncmp(text, start, strlen(start)) == 0;
}

static int is_as_expected(const entry *e, int result)
{
    if (starts_with(e->expected, "accept"))
        return result == ACCEPTED;
    if (starts_with(e->expected, "reject"))
        return result == REJECTED;
    assert_true(starts_with(e->expected, "either"));
    return result == ACCEPTED || result == REJECTED;
}

static void every_file_does_as_the_manifest_says(void **state)
{
    (void)state;
    const char *directory = getenv("RT_CORPUS");
    char path[PATH_SIZE], line[LINE_MAX_SIZE];
    int files = 0, wrong = 0;
    assert_non_null(directory);
    snprintf(path, sizeof path, "%s/ply/MANIFEST.tsv", directory);
    FILE *manifest = fopen(path, "r");
    assert_non_null(manifest);
    assert_non_null(fgets(line, sizeof line, manifest)); /* the heading */
    while (fgets(line, sizeof line, manifest)) {
        entry e = parse(line);
        int result = try_file(directory, &e);
        files++;
        if (!is_as_expected(&e, result)) {
            wrong++;
            printf("WRONG %s: expected %s, got %s\n", e.file, e.expected,
                   result == ACCEPTED       ? "acceptance"
                   : result == REJECTED     ? "rejection"
                   : result == UNSOUND      ? "an unsound mesh or error"
                   : result == WRONG_COUNTS ? "wrong counts"
                                            : "a crash or a hang");
        }
    }
    fclose(manifest);
    printf("%d files, %d not as expected\n", files, wrong);
    assert_true(files > 0);
    assert_int_equal(wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_file_does_as_the_manifest_says),
    };
    return cmocka_run_group_tests_name("corpus/ply", tests, NULL, NULL);
}
