/* Wavefront OBJ: indices of every kind, split vertices, and files that are wrong. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "lib/image/scratch.h"
#include "lib/mesh/sample.h"

#define SQUARE "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"

static void refuse(const char *text, int line, const char *part)
{
    sample_refuse("a.obj", text, line, part);
}

static void polygons_become_fans(void **state)
{
    (void)state;
    static const float square[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    static const unsigned two[] = {0, 1, 2, 0, 2, 3};
    rt_mesh *mesh = sample_accept("a.obj", "# a square\n" SQUARE "f 1 2 3 4 # and no more\n");
    sample_expect_floats(mesh->positions, square, 12);
    sample_expect_triangles(mesh, two, 2);
    assert_int_equal(mesh->file_vertices, 4);
    assert_int_equal(mesh->file_faces, 1);
    assert_null(mesh->normals);
    assert_null(mesh->uv);
    rt_mesh_destroy(mesh);
}

static void negative_indices_count_back_from_their_line(void **state)
{
    (void)state;
    static const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 0, 0, 6, 0, 0, 5, 1, 0};
    static const unsigned two[] = {0, 1, 2, 3, 4, 5};
    rt_mesh *mesh = sample_accept(
        "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf -3 -2 -1\n");
    sample_expect_floats(mesh->positions, positions, 18);
    sample_expect_triangles(mesh, two, 2);
    rt_mesh_destroy(mesh);
}

static void vertices_split_where_corners_differ(void **state)
{
    (void)state;
    static const unsigned two[] = {0, 1, 2, 3, 2, 4};
    static const float uv[] = {0, 0, 1, 0, 1, 1, 0.5f, 0.5f, 0, 1};
    rt_mesh *mesh =
        sample_accept("a.obj", SQUARE "vt 0 0\nvt 1 0 0\nvt 1 1\nvt 0 1\nvt .5 .5\nvn 0 0 2\n"
                                      "f 1/1/1 2/2/1 3/3/1\nf 1/5/1 3/3/-1 4/-2/1\n");
    sample_expect_triangles(mesh, two, 2);
    sample_expect_floats(mesh->uv, uv, 10);
    for (int i = 0; i < 5; i++)
        assert_true(mesh->normals[3 * i] == 0 && mesh->normals[3 * i + 1] == 0 &&
                    mesh->normals[3 * i + 2] == 1);
    rt_mesh_destroy(mesh);
}

static void a_normal_may_stand_without_texture_coordinates(void **state)
{
    (void)state;
    static const float normals[] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    rt_mesh *mesh =
        sample_accept("a.obj", SQUARE "vn 1 0 0\nvn 0 1 0\nvn 0 0 1\nf 1//1 2//2 3//3\n");
    sample_expect_floats(mesh->normals, normals, 9);
    assert_null(mesh->uv);
    rt_mesh_destroy(mesh);
}

static void corners_without_normals_get_those_of_their_faces(void **state)
{
    (void)state;
    rt_mesh *mesh = sample_accept("a.obj", SQUARE "vn 1 0 0\nf 1//1 2//1 3//1\nf 1 3 4\n");
    assert_int_equal(mesh->vertex_count, 6);
    assert_true(mesh->normals[0] == 1);
    for (int i = 3; i < 6; i++)
        assert_true(mesh->normals[3 * i] == 0 && mesh->normals[3 * i + 1] == 0 &&
                    mesh->normals[3 * i + 2] == 1);
    rt_mesh_destroy(mesh);
}

static void colours_may_follow_the_coordinates(void **state)
{
    (void)state;
    static const float colours[] = {1, 0.5f, 0, 0, 1, 0, 0, 0, 0.25f};
    rt_mesh *mesh =
        sample_accept("a.obj", "v 0 0 0 1 .5 0\nv 1 0 0 -0 1.00009 0\nv 0 1 0 0 0 .25\nf 1 2 3\n");
    sample_expect_floats(mesh->colours, colours, 9);
    rt_mesh_destroy(mesh);
}

static void vertices_without_a_colour_are_white_beside_others(void **state)
{
    (void)state;
    static const float colours[] = {1, 1, 1, 1, 1, 1, 0.5f, 0.25f, 1, 1, 1, 1, 0, 0, 0.25f};
    rt_mesh *mesh = sample_accept("a.obj", "v 0 0 0\nv 1 0 0 1\nv 0 1 0 .5 .25 1\nv 1 1 0\n"
                                           "v 2 1 0 0 0 .25\nf 1 2 3\nf 4 5 1\n");
    sample_expect_floats(mesh->colours, colours, 15);
    rt_mesh_destroy(mesh);
    mesh = sample_accept("a.obj", SQUARE "f 1 2 3\n");
    assert_null(mesh->colours);
    rt_mesh_destroy(mesh);
}

/* They are made from the faces around, and counted where a corner has them. */
static void bad_normals_are_no_errors(void **state)
{
    (void)state;
    rt_mesh *mesh =
        sample_accept("a.obj", SQUARE "vn 0 0 0\nvn nan 0 1\nvn inf 0 0\nvn 0 0 5\nvn nan nan nan\n"
                                      "f 1//1 2//2 3//3\nf 1//4 3//4 4//4\n");
    assert_int_equal(mesh->bad_normals, 3);
    for (int i = 0; i < 6; i++)
        assert_true(mesh->normals[3 * i] == 0 && mesh->normals[3 * i + 1] == 0 &&
                    mesh->normals[3 * i + 2] == 1);
    rt_mesh_destroy(mesh);
    refuse("vn 0 x 1\n", 1, "vn: 'x' is not a number");
}

static void lines_may_be_continued(void **state)
{
    (void)state;
    static const unsigned two[] = {0, 1, 2, 0, 2, 3};
    rt_mesh *mesh = sample_accept(
        "a.obj", "v 0 0 0\r\nv 1 \\\r\n0 0\r\nv 1 1 0\r\nv 0 1 0\r\nf 1 2\\\r\n 3 4\r\n");
    sample_expect_triangles(mesh, two, 2);
    rt_mesh_destroy(mesh);
    mesh = sample_accept("a.obj", "# made in C:\\here\\\nv 0 0 0\n");
    assert_int_equal(mesh->file_vertices, 1);
    rt_mesh_destroy(mesh);
    refuse("v 0 0 \\\n 0\nf 1 1 2\n", 3, "vertex 2 is out of range");
}

static void what_is_no_mesh_is_passed_over(void **state)
{
    (void)state;
    rt_mesh *mesh = sample_accept("a.obj", "mtllib a.mtl\no one\ng x y\ns off\nusemtl red\n" SQUARE
                                           "vp 1 2\nl 1 2\np 1\nf 1 2 3\nf 1 2\n");
    assert_int_equal(mesh->triangle_count, 1);
    assert_int_equal(mesh->file_faces, 2);
    assert_int_equal(mesh->skipped_faces, 1);
    assert_true(mesh->names_materials);
    rt_mesh_destroy(mesh);
    mesh = sample_accept("a.obj", SQUARE "f 1 2 3\n");
    assert_false(mesh->names_materials);
    rt_mesh_destroy(mesh);
}

static void wrong_files_are_refused_at_the_line(void **state)
{
    (void)state;
    refuse(SQUARE "f 1 2 5\n", 5, "vertex 5 is out of range; there are 4");
    refuse(SQUARE "f 1 2 0\n", 5, "vertex 0 is out of range");
    refuse(SQUARE "f 1 2 -5\n", 5, "vertex -5 is out of range");
    refuse(SQUARE "f 1 2 99999999999999999999\n", 5, "is not an index");
    refuse(SQUARE "f 1 2 9223372036854775807\n", 5, "out of range");
    refuse(SQUARE "f 1 2 -9223372036854775807\n", 5, "out of range");
    refuse(SQUARE "f 1/1 2/1 3/1\n", 5, "texture coordinate 1 is out of range; there are 0");
    refuse(SQUARE "vt 0 0\nf 1/1 2/ 3/1\n", 6, "'' is not an index");
    refuse(SQUARE "f 1//1 2//1 3//1\n", 5, "normal 1 is out of range; there are 0");
    refuse(SQUARE "f 1/// 2 3\n", 5, "");
    refuse(SQUARE "f 1/1/1/1 2 3\n", 5, "");
    refuse(SQUARE "f / 2 3\n", 5, "is not an index");
    refuse(SQUARE "f 1.0 2 3\n", 5, "'1.0' is not an index");
    refuse("v 0 0\n", 1, "2 values; at least 3");
    refuse("v 0 0 nan\n", 1, "'nan' is not a finite float");
    refuse("v 0 0 1e39\n", 1, "'1e39' is not a finite float");
    refuse("v 0 0 x\n", 1, "'x' is not a number");
    refuse("v 1 2 3 4 5 6 7 8\n", 1, "more than 7 values");
    refuse("v 1 2 3 .4 -5 .6\n", 1, "v: the colour -5 is negative");
    refuse("v 1 2 3 255 128 0\n", 1, "v: the colour 255 is above 1: colours go from 0 to 1; whole");
    refuse("\nv 1 2 3 .5 1 1.0002\n", 2, "v: the colour 1.0002 is above 1");
    refuse("\nvn 0 1\n", 2, "2 values; at least 3");
    refuse("vt\n", 1, "0 values; at least 1");
    refuse("hello\n", 1, "'hello' is no statement");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(polygons_become_fans),
        cmocka_unit_test(negative_indices_count_back_from_their_line),
        cmocka_unit_test(vertices_split_where_corners_differ),
        cmocka_unit_test(a_normal_may_stand_without_texture_coordinates),
        cmocka_unit_test(corners_without_normals_get_those_of_their_faces),
        cmocka_unit_test(colours_may_follow_the_coordinates),
        cmocka_unit_test(vertices_without_a_colour_are_white_beside_others),
        cmocka_unit_test(bad_normals_are_no_errors),
        cmocka_unit_test(lines_may_be_continued),
        cmocka_unit_test(what_is_no_mesh_is_passed_over),
        cmocka_unit_test(wrong_files_are_refused_at_the_line),
    };
    return cmocka_run_group_tests_name("mesh/obj", tests, scratch_enter, scratch_leave);
}
