/* Polygons of files: cut by every reader so that what is inside is covered once, or told. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "lib/image/scratch.h"
#include "lib/mesh/sample.h"

enum { TEXT = 4096, CORNERS_MAX = 16 };

typedef double corner[2];

/* Area 7, 8 with a hole that a bridge joins, 0.75. */
static const corner horseshoe[] = {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
static const corner keyhole[] = {{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0},
                                 {1, 1}, {1, 2}, {2, 2}, {2, 1}, {1, 1}};
static const corner dart[] = {{0, 0}, {2, 0.5}, {0.5, 0.5}, {0.5, 2}};

typedef enum format { OBJ, PLY, PLY_FACES_FIRST, OFF, FORMATS } format;
static const char *const names[FORMATS] = {"a.obj", "a.ply", "b.ply", "a.off"};

static void add(char *text, const char *format, ...)
{
    va_list args;
    const size_t used = strlen(text);
    va_start(args, format);
    vsnprintf(text + used, TEXT - used, format, args);
    va_end(args);
}

static void add_face(char *text, size_t count, size_t first, int from)
{
    add(text, from ? "f" : "%d", (int)count);
    for (size_t i = 0; i < count; i++)
        add(text, " %d", (int)((first + i) % count) + from);
    add(text, "\n");
}

static void add_vertices(char *text, const corner *p, size_t count, const char *before)
{
    for (size_t i = 0; i < count; i++) /* on a slope */
        add(text, "%s%.9g %.9g %.9g\n", before, p[i][0], 0.6 * p[i][1], 0.8 * p[i][1]);
}

/* A file with one polygon. */
static void write(char *text, format format, const corner *p, size_t count, size_t first)
{
    static const char vertex[] = "element vertex %d\nproperty float x\nproperty float y\n"
                                 "property float z\n";
    static const char face[] = "element face 1\nproperty list uchar int vertex_indices\n";
    text[0] = '\0';
    switch (format) {
    case OBJ:
        add_vertices(text, p, count, "v ");
        add_face(text, count, first, 1);
        break;
    case PLY:
        add(text, "ply\nformat ascii 1.0\n");
        add(text, vertex, (int)count);
        add(text, "%send_header\n", face);
        add_vertices(text, p, count, "");
        add_face(text, count, first, 0);
        break;
    case PLY_FACES_FIRST:
        add(text, "ply\nformat ascii 1.0\n%s", face);
        add(text, vertex, (int)count);
        add(text, "end_header\n");
        add_face(text, count, first, 0);
        add_vertices(text, p, count, "");
        break;
    case OFF:
        add(text, "OFF\n%d 1 0\n", (int)count);
        add_vertices(text, p, count, "");
        add_face(text, count, first, 0);
        break;
    case FORMATS:
        break;
    }
}

/* The sum of the areas of the triangles. */
static double area_of(const rt_mesh *mesh)
{
    double area = 0;
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        double e[2][3], n[3];
        for (int k = 0; k < 2; k++)
            for (int c = 0; c < 3; c++)
                e[k][c] =
                    (double)
                        mesh->positions[3 * mesh->indices[3 * i + 1 + (uint32_t)k] + (uint32_t)c] -
                    mesh->positions[3 * mesh->indices[3 * i] + (uint32_t)c];
        for (int c = 0; c < 3; c++)
            n[c] = e[0][(c + 1) % 3] * e[1][(c + 2) % 3] - e[0][(c + 2) % 3] * e[1][(c + 1) % 3];
        area += 0.5 * sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    }
    return area;
}

static void expect_area(const corner *p, size_t count, double area)
{
    char text[TEXT];
    for (format format = OBJ; format < FORMATS; format++)
        for (size_t first = 0; first < count; first++) {
            write(text, format, p, count, first);
            rt_mesh *mesh = sample_accept(names[format], text);
            assert_int_equal(mesh->triangle_count, count - 2);
            assert_int_equal(mesh->file_faces, 1);
            assert_int_equal(mesh->warnings.count, 0);
            assert_true(fabs(area_of(mesh) - area) < 1e-5);
            rt_mesh_destroy(mesh);
        }
}

#define EXPECT_AREA(p, area) expect_area(p, sizeof(p) / sizeof *(p), area)

static void every_reader_covers_a_polygon_once(void **state)
{
    (void)state;
    EXPECT_AREA(horseshoe, 7);
    EXPECT_AREA(keyhole, 8);
    EXPECT_AREA(dart, 0.75);
}

/* Each corner keeps its texture coordinates and its normal: they are functions of its place. */
static void what_corners_have_goes_with_them(void **state)
{
    (void)state;
    char text[TEXT] = "";
    const int count = sizeof horseshoe / sizeof *horseshoe;
    add_vertices(text, horseshoe, (size_t)count, "v ");
    for (int i = 0; i < count; i++)
        add(text, "vt %g %g\nvn %g 1 0\n", horseshoe[i][0] / 4, horseshoe[i][1] / 4,
            horseshoe[i][0]);
    add(text, "f");
    for (int i = 0; i < count; i++)
        add(text, " %d/%d/%d", (i + 3) % count + 1, (i + 3) % count + 1, (i + 3) % count + 1);
    rt_mesh *mesh = sample_accept("a.obj", text);
    assert_true(fabs(area_of(mesh) - 7) < 1e-5);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const float *p = mesh->positions + 3 * i, *n = mesh->normals + 3 * i;
        assert_true(fabsf(mesh->uv[2 * i] - p[0] / 4) < 1e-6f);
        assert_true(fabsf(mesh->uv[2 * i + 1] - p[2] / 3.2f) < 1e-6f);
        assert_true(fabsf(n[0] - p[0] * n[1]) < 1e-5f);
    }
    rt_mesh_destroy(mesh);
}

/* Each face is cut by itself, between others. */
static void polygons_stand_among_triangles(void **state)
{
    (void)state;
    rt_mesh *mesh =
        sample_accept("a.obj", "v 0 0 0\nv 2 .5 0\nv .5 .5 0\nv .5 2 0\nv 9 0 0\nv 9 1 0\nv 8 1 0\n"
                               "f 5 6 7\nf 2 3 4 1\nf 5 6\nf 5 6 7\nf 4 1 2 3\nf 5 6 7\n");
    assert_int_equal(mesh->triangle_count, 7);
    assert_true(fabs(area_of(mesh) - (3 * 0.5 + 2 * 0.75)) < 1e-6);
    rt_mesh_destroy(mesh);
}

static void expect_warning(const char *name, const char *text, const char *warning)
{
    rt_mesh *mesh = sample_accept(name, text);
    assert_int_equal(mesh->warnings.count, 1);
    assert_string_equal(mesh->warnings.text[0], warning);
    rt_mesh_destroy(mesh);
}

static void what_is_not_simple_is_told(void **state)
{
    (void)state;
#define BOW "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nv 2 2 0\nv 3 3 0\n"
    expect_warning("a.obj", BOW "f 1 2\nf 1 2 3\nf 1 2 \\\n 3 4\n",
                   "a.obj:10: this face of 4 corners crosses itself: parts of it may be covered "
                   "twice or not at all");
    expect_warning("a.obj", BOW "f 1 2 5 6\nf 1 2 3\nf 6 5 2 1\n",
                   "a.obj:7: this face of 4 corners has all its corners on one line: it is not "
                   "seen (and 1 more faces)");
    expect_warning("a.off", "OFF\n4 2 0\n0 0 0\n1 1 0\n1 0 0\n0 1 0\n3 0 1 2\n4 0 1 2 3\n",
                   "a.off: face 1, counted from 0, of 4 corners crosses itself: parts of it may be "
                   "covered twice or not at all");
    /* a quad that is a triangle has its area */
    rt_mesh *mesh = sample_accept("a.obj", BOW "f 1 3 2 2\n");
    assert_int_equal(mesh->warnings.count, 0);
    rt_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_reader_covers_a_polygon_once),
        cmocka_unit_test(what_corners_have_goes_with_them),
        cmocka_unit_test(polygons_stand_among_triangles),
        cmocka_unit_test(what_is_not_simple_is_told),
    };
    return cmocka_run_group_tests_name("mesh/cut", tests, scratch_enter, scratch_leave);
}
