/* Geomview OFF: its variants, and files that are wrong. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "lib/image/scratch.h"
#include "lib/mesh/sample.h"

#define SQUARE "0 0 0\n1 0 0\n1 1 0\n0 1 0\n"

static void refuse(const char *text, int line, const char *part)
{
    sample_refuse("a.off", text, line, part);
}

static void polygons_become_fans(void **state)
{
    (void)state;
    static const float square[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    static const unsigned three[] = {0, 1, 2, 0, 2, 3, 3, 2, 1};
    static const char *const heads[] = {"OFF\n4 2 0\n", "OFF 4 2 5\n",
                                        "# a square\nOFF\n\n# counts\n4 2\n", "4 2 0\n"};
    for (int i = 0; i < 4; i++) {
        char text[256];
        strcpy(text, heads[i]);
        strcat(text, SQUARE "\n4 0 1 2 3\n# red\n3 3 2 1\n");
        rt_mesh *mesh = sample_accept("a.off", text);
        sample_expect_floats(mesh->positions, square, 12);
        sample_expect_triangles(mesh, three, 3);
        assert_int_equal(mesh->file_vertices, 4);
        assert_int_equal(mesh->file_faces, 2);
        rt_mesh_destroy(mesh);
    }
}

static void prefixes_announce_attributes(void **state)
{
    (void)state;
    static const float normals[] = {0, 0, 1}, uv[] = {0.25f, 0.75f};
    rt_mesh *mesh = sample_accept("a.off", "STCNOFF\n1 0 0\n1 2 3 0 0 2 255 51 0 128 .25 .75\n");
    sample_expect_floats(mesh->normals, normals, 3);
    sample_expect_floats(mesh->uv, uv, 2);
    /* whole numbers are sRGB */
    assert_true(mesh->colours[0] == 1 && fabsf(mesh->colours[1] - 0.033104767f) < 1e-7f &&
                mesh->colours[2] == 0);
    rt_mesh_destroy(mesh);
    static const char *const fractions[] = {"0.5 1 0", "0.5 1.0 0.0"};
    for (int i = 0; i < 2; i++) {
        char text[64];
        strcat(strcpy(text, "COFF\n1 0 0\n1 2 3 "), fractions[i]);
        mesh = sample_accept("a.off", strcat(text, "\n"));
        assert_true(mesh->colours[0] == 0.5f && mesh->colours[1] == 1 && mesh->colours[2] == 0);
        assert_null(mesh->normals);
        assert_null(mesh->uv);
        rt_mesh_destroy(mesh);
    }
}

/* Writers of floats leave out the point of 0 and 1. */
static void colours_of_0_and_1_are_as_those_before(void **state)
{
    (void)state;
    rt_mesh *mesh = sample_accept("a.off", "COFF\n2 0 0\n1 2 3 0.5 0 0\n1 2 3 1 0 0\n");
    assert_true(mesh->colours[0] == 0.5f && mesh->colours[3] == 1 && mesh->colours[4] == 0);
    rt_mesh_destroy(mesh);
    mesh = sample_accept("a.off", "COFF\n2 0 0\n1 2 3 1 0 0\n1 2 3 0.5 0 0\n");
    assert_true(mesh->colours[0] < 0.001f && mesh->colours[3] == 0.5f);
    rt_mesh_destroy(mesh);
    mesh = sample_accept("a.off", "COFF\n2 0 0\n1 2 3 0.5 0 0\n1 2 3 2 0 0\n");
    assert_true(mesh->colours[3] < 0.001f && mesh->colours[3] > 0);
    rt_mesh_destroy(mesh);
}

static void colours_of_faces_split_vertices(void **state)
{
    (void)state;
    static const float whole[] = {1, 1, 1, 1, 0, 0, 0, 0.21586051f, 0, 0.5f, 0.25f, 1};
    static const unsigned five[] = {0, 1, 2, 3, 4, 5, 3, 5, 6, 7, 8, 9, 10, 11, 12};
    static const unsigned of_vertex[] = {0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 3, 3, 3};
    rt_mesh *mesh = sample_accept("a.off", "OFF\n4 5 0\n" SQUARE "3 0 1 2\n4 0 1 2 3 255 0 0\n"
                                           "2 0 1 0 0 255\n3 0 1 2 0 128 0 255 # green\n"
                                           "3 0 2 3 .5 .25 1 1\n");
    sample_expect_triangles(mesh, five, 5);
    assert_int_equal(mesh->vertex_count, 13);
    for (int i = 0; i < 39; i++)
        assert_true(fabsf(mesh->colours[i] - whole[3 * of_vertex[i / 3] + i % 3]) < 1e-6f);
    assert_true(mesh->positions[3 * 9] == 1 && mesh->positions[3 * 9 + 1] == 1);
    assert_int_equal(mesh->file_vertices, 4);
    assert_int_equal(mesh->warnings.count, 0);
    rt_mesh_destroy(mesh);
}

static void colours_of_faces_that_are_left_out_are_told(void **state)
{
    (void)state;
    rt_mesh *mesh = sample_accept("a.off", "OFF\n4 2 0\n" SQUARE "3 0 1 2 7\n3 0 2 3\n");
    assert_null(mesh->colours);
    assert_int_equal(mesh->warnings.count, 1);
    assert_non_null(strstr(mesh->warnings.text[0], "of 1 faces is no colour of 3 or 4 values"));
    rt_mesh_destroy(mesh);
    mesh = sample_accept("a.off", "COFF\n3 1 0\n0 0 0 0 0 255\n1 0 0 0 0 255\n0 1 0 0 0 255\n"
                                  "3 0 1 2 255 0 0\n");
    assert_true(mesh->vertex_count == 3 && mesh->colours[0] == 0 && mesh->colours[2] == 1);
    assert_int_equal(mesh->warnings.count, 1);
    assert_non_null(strstr(mesh->warnings.text[0], "vertices and faces have colours"));
    rt_mesh_destroy(mesh);
}

static void short_faces_are_counted(void **state)
{
    (void)state;
    rt_mesh *mesh = sample_accept("a.off", "OFF\n4 3 0\n" SQUARE "2 0 1\n3 0 1 2\n0\n");
    assert_int_equal(mesh->triangle_count, 1);
    assert_int_equal(mesh->skipped_faces, 2);
    rt_mesh_destroy(mesh);
}

static void faces_beyond_the_count_are_told(void **state)
{
    (void)state;
    rt_mesh *mesh = sample_accept("a.off", "OFF\n4 1 0\n" SQUARE "3 0 1 2\n3 0 2 3\n");
    assert_int_equal(mesh->triangle_count, 1);
    assert_int_equal(mesh->warnings.count, 1);
    assert_non_null(strstr(mesh->warnings.text[0], "follows the last of 1 faces is ignored"));
    rt_mesh_destroy(mesh);
}

static void wrong_files_are_refused_at_the_line(void **state)
{
    (void)state;
    refuse("", 1, "empty");
    refuse("OFF\n", 2, "ends before its counts");
    refuse("OFG\n1 0 0\n", 1, "'OFG'");
    refuse("4OFF\n1 0 0\n", 1, "'4OFF'");
    refuse("nOFF\n3\n1 0 0\n", 1, "'nOFF'");
    refuse("OFF BINARY\n\1\2\3", 1, "binary OFF");
    refuse("OFF\n-1 0 0\n", 2, "count of vertices: '-1'");
    refuse("OFF\n1000000000 0 0\n0 0 0\n", 2, "count of vertices: '1000000000'");
    refuse("OFF\n1 99999999999999999999 0\n0 0 0\n", 2, "count of faces");
    refuse("OFF\n1\n0 0 0\n", 2, "count of faces: ''");
    refuse("OFF\n1 0 0 0\n0 0 0\n", 2, "more than three counts");
    refuse("OFF\n2 0 0\n0 0 0\n        \n", 5, "the file ends after 1 of 2 vertices");
    refuse("OFF\n1 1 0\n0 0 0\n        \n", 5, "0 of 1 faces");
    refuse("OFF\n1 0 0\n0 0        \n", 3, "vertex 0 has 2 values; expected 3");
    refuse("OFF\n1 0 0\n0 0 0 1\n", 3, "vertex 0 has 4 values; expected 3");
    refuse("COFF\n1 0 0\n0 0 0 0.5 -.5 1\n", 3, "vertex: the colour -0.5 is negative");
    refuse("COFF\n1 0 0\n0 0 0 0 1 -1\n", 3, "the colour -1 is negative");
    refuse("COFF\n1 0 0\n0 0 0 0 256 0\n", 3, "vertex: the colour 256 is above 255: colours of");
    refuse("COFF\n1 0 0\n0 0 0 2 1 .5\n", 3, "the colour 2 is above 1: colours go from 0 to 1;");
    refuse("COFF\n1 0 0\n0 0 0 1 1\n", 3, "vertex 0 has 5 values; expected 3 and 3 or 4 of colour");
    refuse("STCNOFF\n1 0 0\n1 2 3 4 5 6 7 8 9 10 11 12 13 14\n", 3,
           "vertex 0 has at least 13 values");
    refuse("OFF\n1 0 0\n0 nan 0\n", 3, "'nan'");
    refuse("OFF\n1 0 0\n0 zero 0\n", 3, "'zero'");
    refuse("OFF\n4 1 0\n" SQUARE "3 0 1 4\n", 7, "'4' is not a whole number from 0 to 3");
    refuse("OFF\n4 1 0\n" SQUARE "3 0 1 2 0 0 256\n", 7, "face: the colour 256 is above 255");
    refuse("OFF\n4 1 0\n" SQUARE "3 0 1 2 0 .5 -1\n", 7, "face: the colour -1 is negative");
    refuse("OFF\n4 1 0\n" SQUARE "3 0 1 -1\n", 7, "'-1'");
    refuse("OFF\n4 1 0\n" SQUARE "-3 0 1 2\n", 7, "'-3'");
    refuse("OFF\n4 1 0\n" SQUARE "1000000 0 1 2\n", 7, "'1000000'");
    refuse("OFF\n4 1 0\n" SQUARE "3 0 1         \n", 8, "the file ends in face 0 of 1");
    refuse("OFF\n0 1 0\n3 0 0 0\n", 3, "no vertices");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(polygons_become_fans),
        cmocka_unit_test(prefixes_announce_attributes),
        cmocka_unit_test(colours_of_0_and_1_are_as_those_before),
        cmocka_unit_test(colours_of_faces_split_vertices),
        cmocka_unit_test(colours_of_faces_that_are_left_out_are_told),
        cmocka_unit_test(short_faces_are_counted),
        cmocka_unit_test(faces_beyond_the_count_are_told),
        cmocka_unit_test(wrong_files_are_refused_at_the_line),
    };
    return cmocka_run_group_tests_name("mesh/off", tests, scratch_enter, scratch_leave);
}
