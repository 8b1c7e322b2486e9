/* Loading: formats told apart, files that are none, progress and cancelling, normals. */
#define _XOPEN_SOURCE 700 /* mkfifo */

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "lib/image/scratch.h"
#include "lib/mesh/sample.h"
#include "mesh/normals.h"

#define PLY                                                                                        \
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float " \
    "z\n"
#define FACE "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
#define TRIANGLE PLY FACE "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"

static void formats_go_by_content_then_by_name(void **state)
{
    (void)state;
    static const char *const names[] = {"a.ply", "a.PLY", "a", "a.obj", "a.b.stl"};
    for (int i = 0; i < 5; i++)
        rt_mesh_destroy(sample_accept(names[i], TRIANGLE));
    rt_mesh_destroy(sample_accept("A.OBJ", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
    rt_mesh_destroy(sample_accept("A.Off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"));
    sample_refuse("a.ply", "v 0 0 0\n", 1, "not a PLY file");
    sample_refuse("a.txt", "v 0 0 0\n", 0, "unknown mesh format");
    sample_refuse("plain", "v 0 0 0\n", 0, "unknown mesh format");
    sample_refuse("a.", "", 0, "unknown mesh format");
}

static void fails(const char *path, const char *part)
{
    rt_mesh *mesh = NULL;
    rt_error error = {0};
    assert_int_equal(rt_mesh_load(&mesh, path, NULL, &error), RT_ERROR_INPUT);
    assert_null(mesh);
    assert_string_equal(error.file, path);
    if (!strstr(error.message, part))
        fail_msg("'%s' does not contain '%s'", error.message, part);
    assert_int_equal(rt_mesh_load(&mesh, path, NULL, NULL), RT_ERROR_INPUT);
}

static void what_is_no_file_is_refused(void **state)
{
    (void)state;
    assert_int_equal(mkdir("directory.ply", 0755), 0);
    assert_int_equal(mkfifo("pipe.ply", 0644), 0);
    fails("missing.ply", "missing.ply");
    fails("directory.ply", "not a regular file");
    fails("pipe.ply", "not a regular file");
    fails("/dev/zero", "not a regular file");
    assert_int_equal(unlink("pipe.ply"), 0);
    assert_int_equal(rmdir("directory.ply"), 0);
}

/* What the hooks were told. */
typedef struct heard {
    int reports, cancel_at, lines;
    double last;
    char text[1024];
} heard;

static int on_progress(void *user, const rt_progress *progress)
{
    heard *h = user;
    assert_int_equal(progress->stage, RT_STAGE_LOAD);
    assert_true(progress->fraction >= h->last && progress->fraction <= 1);
    h->last = progress->fraction;
    return ++h->reports == h->cancel_at;
}

static void on_log(void *user, const char *line)
{
    heard *h = user;
    h->lines++;
    size_t used = strlen(h->text);
    snprintf(h->text + used, sizeof h->text - used, "%s\n", line);
}

static void progress_is_reported_and_cancels(void **state)
{
    (void)state;
    heard h = {0};
    rt_hooks hooks = {.progress = on_progress, .log = on_log, .user = &h};
    rt_mesh *mesh = NULL;
    rt_error error = {0};
    scratch_write("a.ply", TRIANGLE);
    assert_int_equal(rt_mesh_load(&mesh, "a.ply", &hooks, &error), RT_OK);
    assert_true(h.reports >= 2);
    assert_true(h.last == 1);
    rt_mesh_destroy(mesh);
    mesh = NULL;

    for (int at = 1; at <= 2; at++) {
        heard c = {.cancel_at = at};
        hooks.user = &c;
        assert_int_equal(rt_mesh_load(&mesh, "a.ply", &hooks, &error), RT_CANCELLED);
        assert_int_equal(error.status, RT_CANCELLED);
        assert_null(mesh);
    }
}

static void the_log_tells_what_was_left_out(void **state)
{
    (void)state;
    static const char *const parts[] = {
        "a.ply: 1 of 3 faces have fewer than three corners, thus no area, and are left out; the "
        "first is face 1",
        "a.ply: 1 of 2 triangles have no area",
        "a.ply: 1 normals have no length",
        "what follows the last element, from line 20 on, is ignored",
        "4 vertices and 3 faces in the file, 4 vertices and 2 triangles in the mesh",
    };
    heard h = {0};
    rt_hooks hooks = {.log = on_log, .user = &h};
    rt_mesh *mesh = NULL;
    scratch_write(
        "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
        "float z\n"
        "property float nx\nproperty float ny\nproperty float nz\nelement face 3\n"
        "property list uchar int vertex_indices\nend_header\n"
        "0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 0\n9 9 9 0 0 1\n3 0 1 2\n2 0 1\n3 0 0 1\nmore\n");
    assert_int_equal(rt_mesh_load(&mesh, "a.ply", &hooks, NULL), RT_OK);
    rt_mesh_destroy(mesh);
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        if (!strstr(h.text, parts[i]))
            fail_msg("the log lacks '%s':\n%s", parts[i], h.text);
}

static void normals_come_out_at_length_one(void **state)
{
    (void)state;
    /*
     * Lengths from the least float to the greatest; the last vertex has none and belongs to no
     * face.
     */
    static const float expected[] = {0.6f, 0, 0.8f, 0, 1, 0, -1, 0, 0, 0, 1, 0};
    rt_mesh *mesh = sample_accept(
        "a.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                 "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n" FACE
                 "0 0 0 3 0 4\n1 0 0 0 3e38 0\n0 1 0 -1e-45 0 0\n5 5 5 0 0 0\n3 0 1 2\n");
    for (int i = 0; i < 12; i++)
        assert_true(fabsf(mesh->normals[i] - expected[i]) < 1e-6f);
    rt_mesh_destroy(mesh);
}

/*
 * A roof: at the ridge the normal is the mean, weighted by angle, 90 degrees of both faces at one
 * end, atan 3 and 45 degrees at the other; far from the ridge it is the face's own.
 */
static void smooth_normals_weigh_faces_by_angle(void **state)
{
    (void)state;
    rt_mesh *mesh = sample_accept(
        "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
        "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0\n0 1 0\n-3 0 0\n0 0 -1\n7 7 7\n3 0 1 2\n3 1 0 3\n");
    rt_error error;
    assert_null(mesh->normals);
    assert_int_equal(rt_mesh_smooth(mesh, &error), RT_OK);
    const float even = sqrtf(0.5f), a = atanf(1), b = atanf(3), length = hypotf(a, b);
    const float expected[] = {even, 0, even, a / length, 0, b / length, 0, 0, 1, 1, 0, 0, 0, 1, 0};
    for (int i = 0; i < 15; i++)
        assert_true(fabsf(mesh->normals[i] - expected[i]) < 1e-6f);
    rt_mesh_destroy(mesh);
}

/* The ridge of two faces at a right angle, whose corners have what is theirs alone. */
static void smooth_normals_cross_seams(void **state)
{
    static const char *const files[][2] = {
        {"a.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                  "property float z\nelement face 2\nproperty list uchar int vertex_indices\n"
                  "property float red\nproperty float green\nproperty float blue\nend_header\n"
                  "0 0 0\n0 1 0\n-1 0 0\n0 0 -1\n3 0 1 2 1 0 0\n3 1 0 3 0 1 0\n"},
        {"a.obj", "v 0 0 0\nv 0 1 0\nv -1 0 0\nv 0 0 -1\nvt 0 0\nvt 1 1\nvt 0 1\n"
                  "f 1/1 2/2 3/3\nf 2/1 1/3 4/2\n"}};
    (void)state;
    for (int i = 0; i < 2; i++) {
        rt_mesh *mesh = sample_accept(files[i][0], files[i][1]);
        rt_error error;
        assert_int_equal(mesh->vertex_count, 6);
        assert_int_equal(rt_mesh_smooth(mesh, &error), RT_OK);
        for (size_t v = 0; v < 6; v++) {
            const float *p = mesh->positions + 3 * v, *n = mesh->normals + 3 * v;
            const int is_of_ridge = p[0] == 0 && p[2] == 0;
            assert_true(!is_of_ridge || (fabsf(n[0] - n[2]) < 0.6f && n[0] > 0.4f && n[2] > 0.4f));
        }
        rt_mesh_destroy(mesh);
    }
}

static void destroying_nothing_is_fine(void **state)
{
    (void)state;
    rt_mesh_destroy(NULL);
}

/* Every text format may begin with the mark; a binary STL has any bytes there. */
static void a_byte_order_mark_is_passed_over(void **state)
{
    (void)state;
#define MARK "\xef\xbb\xbf"
    static const char *const files[][2] = {
        {"a.obj", MARK "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
        {"a.off", MARK "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
        {"a.ply",
         MARK "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
              "property float z\nelement face 1\nproperty list uchar int vertex_index\n"
              "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
        {"a.stl", MARK "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                       "vertex 0 1 0\nendloop\nendfacet\nendsolid a\n"}};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        rt_mesh *mesh = sample_accept(files[i][0], files[i][1]);
        assert_int_equal(mesh->triangle_count, 1);
        rt_mesh_destroy(mesh);
    }
    sample_refuse("a.obj", MARK "v 0 0 x\n", 1, "'x' is not a number");
    sample s = {0};
    rt_mesh *mesh;
    rt_error error;
    sample_text(&s, MARK);
    for (int i = 0; i < 77; i++)
        sample_u8(&s, 0);
    sample_u32(&s, 1, 0);
    for (int i = 0; i < 12; i++)
        sample_f32(&s, i == 6 || i == 10, 0);
    sample_u16(&s, 0, 0);
    assert_int_equal(sample_read(&mesh, &s, "a.stl", &error), RT_OK);
    assert_int_equal(mesh->triangle_count, 1);
    rt_mesh_destroy(mesh);
    sample_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(formats_go_by_content_then_by_name),
        cmocka_unit_test(what_is_no_file_is_refused),
        cmocka_unit_test(progress_is_reported_and_cancels),
        cmocka_unit_test(the_log_tells_what_was_left_out),
        cmocka_unit_test(normals_come_out_at_length_one),
        cmocka_unit_test(smooth_normals_weigh_faces_by_angle),
        cmocka_unit_test(smooth_normals_cross_seams),
        cmocka_unit_test(destroying_nothing_is_fine),
        cmocka_unit_test(a_byte_order_mark_is_passed_over),
    };
    return cmocka_run_group_tests_name("mesh/mesh", tests, scratch_enter, scratch_leave);
}
