/* STL, ascii and binary: shared corners, and files that are wrong. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "lib/image/scratch.h"
#include "lib/mesh/sample.h"

#define FACET(a, b, c)                                                                             \
    "facet normal 0 0 1\nouter loop\nvertex " a "\nvertex " b "\nvertex " c "\nendloop\nendfacet"  \
    "\n"
#define TWO FACET("0 0 0", "1 0 0", "1 1 0") FACET("-0 0 0", "1 1 0", "0 1 0")

static const float square[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
static const unsigned two[6] = {0, 1, 2, 0, 2, 3};

static void refuse(const char *text, int line, const char *part)
{
    sample_refuse("a.stl", text, line, part);
}

static void ascii_corners_in_one_place_are_one_vertex(void **state)
{
    (void)state;
    rt_mesh *mesh = sample_accept("a.stl", "solid a square, so called\n" TWO "endsolid a square\n");
    sample_expect_floats(mesh->positions, square, 12);
    sample_expect_triangles(mesh, two, 2);
    assert_int_equal(mesh->vertex_count, 4);
    assert_int_equal(mesh->file_vertices, 6);
    assert_int_equal(mesh->file_faces, 2);
    assert_null(mesh->normals);
    rt_mesh_destroy(mesh);
}

static void solids_may_follow_each_other(void **state)
{
    (void)state;
    rt_mesh *mesh = sample_accept(
        "a.stl", "SOLID\nFACET NORMAL nan nan nan OUTER LOOP VERTEX 0 0 0 VERTEX 1 0 0 "
                 "VERTEX 0 1 0 ENDLOOP ENDFACET ENDSOLID\nsolid b\n" FACET("0 0 1", "1 0 1",
                                                                           "1 1 1") "endsolid b\n");
    assert_int_equal(mesh->triangle_count, 2);
    assert_int_equal(mesh->vertex_count, 6);
    rt_mesh_destroy(mesh);
}

/* A binary file: a header, the announced count, and as many facets as given. */
static void make_binary(sample *s, const char *header, unsigned long announced, int facets)
{
    static const int corners[] = {0, 1, 2, 0, 2, 3};
    char start[80] = {0};
    memcpy(start, header, strlen(header));
    sample_bytes(s, start, sizeof start);
    sample_u32(s, announced, 0);
    for (int facet = 0; facet < facets; facet++) {
        for (int i = 0; i < 3; i++)
            sample_f32(s, i == 2, 0);
        for (int corner = 0; corner < 3; corner++)
            for (int axis = 0; axis < 3; axis++)
                sample_f32(s, square[3 * corners[3 * (facet % 2) + corner] + axis], 0);
        sample_u16(s, 0xabcd, 0);
    }
}

static void binary_is_told_from_ascii_by_its_length(void **state)
{
    (void)state;
    static const char *const headers[] = {"exported", "solid but binary"};
    for (int i = 0; i < 2; i++) {
        sample s = {0};
        rt_mesh *mesh;
        rt_error error;
        make_binary(&s, headers[i], 2, 2);
        assert_int_equal(sample_read(&mesh, &s, "a.stl", &error), RT_OK);
        sample_expect_floats(mesh->positions, square, 12);
        sample_expect_triangles(mesh, two, 2);
        rt_mesh_destroy(mesh);
        sample_free(&s);
    }
}

static void binary_counts_fit_the_file(void **state)
{
    (void)state;
    static const unsigned long counts[] = {3, 1000000000, 0xffffffff};
    for (int i = 0; i < 3; i++) {
        sample s = {0};
        rt_mesh *mesh;
        rt_error error;
        make_binary(&s, "x", counts[i], 2);
        assert_int_equal(sample_read(&mesh, &s, "a.stl", &error), RT_ERROR_INPUT);
        assert_non_null(strstr(error.message, "has room for only 2"));
        sample_free(&s);
    }
    /* Fewer than there are: the rest is ignored, and told. */
    sample s = {0};
    rt_mesh *mesh;
    rt_error error;
    make_binary(&s, "x", 1, 2);
    assert_int_equal(sample_read(&mesh, &s, "a.stl", &error), RT_OK);
    assert_int_equal(mesh->triangle_count, 1);
    assert_non_null(strstr(mesh->warnings.text[0], "50 bytes behind the last of 1 facets"));
    rt_mesh_destroy(mesh);
    /* A byte too few. */
    s.data[80] = 2;
    s.size--;
    assert_int_equal(sample_read(&mesh, &s, "a.stl", &error), RT_ERROR_INPUT);
    sample_free(&s);
}

static void binary_coordinates_are_finite(void **state)
{
    (void)state;
    sample s = {0};
    rt_mesh *mesh;
    rt_error error;
    make_binary(&s, "x", 2, 2);
    s.data[84 + 50 + 12 + 3] = 0x7f;
    s.data[84 + 50 + 12 + 2] = 0x80;
    assert_int_equal(sample_read(&mesh, &s, "a.stl", &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "facet 1 of 2"));
    sample_free(&s);
}

static void wrong_files_are_refused_at_the_line(void **state)
{
    (void)state;
    refuse("", 0, "not an STL file");
    refuse("hello", 0, "not an STL file");
    refuse("solid a\n", 2, "the file ends where");
    refuse("solid a\n" TWO, 16, "the file ends where");
    refuse("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", 5,
           "ends where 'vertex' is expected");
    refuse("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0", 4, "ends in a vertex");
    refuse("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 inf\n", 4,
           "'inf' is not a finite float");
    refuse("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 x\n", 4, "'x' is not a number");
    refuse("solid a\nfacet normal 0 x 1\n", 2, "'x' is not a number");
    refuse("solid a\nfacet normal 0", 2, "");
    refuse("solid a\nfacet outer loop\n", 2, "'outer'; expected 'normal'");
    refuse("solid a\nvertex 0 0 0\n", 2, "'vertex'; expected 'facet' or 'endsolid'");
    refuse("solid a\n" TWO "endsolid a\nmore\n", 17, "'more'; expected 'solid'");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ascii_corners_in_one_place_are_one_vertex),
        cmocka_unit_test(solids_may_follow_each_other),
        cmocka_unit_test(binary_is_told_from_ascii_by_its_length),
        cmocka_unit_test(binary_counts_fit_the_file),
        cmocka_unit_test(binary_coordinates_are_finite),
        cmocka_unit_test(wrong_files_are_refused_at_the_line),
    };
    return cmocka_run_group_tests_name("mesh/stl", tests, scratch_enter, scratch_leave);
}
