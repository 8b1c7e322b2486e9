/*
 * Meshes that others wrote: each is read with the counts that the corpus's manifest gives, or
 * refused; none crashes the reader, keeps it for more than two seconds or brings in an index or a
 * number out of range.
 *
 * RT_CORPUS names the directory that holds ply/MANIFEST.tsv. Without it the program fails: it is
 * run by a target of its own.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "corpus/manifest.h"
#include "mesh/load.h"

#define SECONDS 2

/* What came of a file. A memory checker that finds an error exits with another status. */
enum { is_accepted = 10, is_refused, is_unsound, is_miscounted };

/* The counts of a file, as the manifest writes them; empty where it gives none. */
typedef struct counts {
    const char *vertices, *triangles;
} counts;

static int all_finite(const float *values, size_t count)
{
    for (size_t i = 0; values && i < count; i++)
        if (!isfinite(values[i]))
            return 0;
    return 1;
}

static int is_sound(const rt_mesh *mesh)
{
    size_t vertices = mesh->vertex_count;
    for (size_t i = 0; i < 3 * (size_t)mesh->triangle_count; i++)
        if (mesh->indices[i] >= vertices)
            return 0;
    return all_finite(mesh->positions, 3 * vertices) && all_finite(mesh->normals, 3 * vertices) &&
           all_finite(mesh->uv, 2 * vertices) && all_finite(mesh->colours, 3 * vertices);
}

static int has_counts(const rt_mesh *mesh, const counts *expected)
{
    return !expected->vertices[0] ||
           (mesh->file_vertices == strtoull(expected->vertices, NULL, 10) &&
            mesh->triangle_count == strtoull(expected->triangles, NULL, 10));
}

static int try_mesh(const char *path, void *user)
{
    rt_mesh *mesh = NULL;
    rt_error error = {0};
    rt_status status = rt_mesh_load(&mesh, path, NULL, &error);
    if (status != RT_OK)
        return status == RT_ERROR_INPUT && error.message[0] && strcmp(error.file, path) == 0
                   ? is_refused
                   : is_unsound;
    int result = !is_sound(mesh)          ? is_unsound
                 : has_counts(mesh, user) ? is_accepted
                                          : is_miscounted;
    rt_mesh_destroy(mesh);
    return result;
}

/* Whether a result is what the manifest asks for: "accept ...", "reject ..." or "either ...". */
static int is_as_expected(const char *expected, int result)
{
    if (strncmp(expected, "accept", 6) == 0)
        return result == is_accepted;
    if (strncmp(expected, "reject", 6) == 0)
        return result == is_refused;
    return result == is_accepted || result == is_refused;
}

static void meshes_do_as_the_manifest_says(void **state)
{
    (void)state;
    manifest *m = manifest_open("ply");
    size_t wrong = 0;
    for (size_t row = 0; row < m->row_count; row++) {
        const char *expected = manifest_field(m, row, "expected");
        counts given = {manifest_field(m, row, "V"), manifest_field(m, row, "triangles")};
        char *path = manifest_path(m, row);
        int result = manifest_attempt(try_mesh, path, &given, SECONDS);
        if (!is_as_expected(expected, result)) {
            fprintf(stderr, "%s: result %d, expected %s\n", path, result, expected);
            wrong++;
        }
        free(path);
    }
    if (wrong)
        fail_msg("%zu of %zu files went wrong", wrong, m->row_count);
    manifest_close(m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(meshes_do_as_the_manifest_says)};
    return cmocka_run_group_tests_name("corpus/ply", tests, NULL, NULL);
}
