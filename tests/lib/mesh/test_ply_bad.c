/*
 * PLY files that are damaged or lie: each class of fault is refused, with its place and the value
 * at fault.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "lib/image/scratch.h"
#include "lib/mesh/sample.h"

#define ASCII "ply\nformat ascii 1.0\n"
#define XYZ "property float x\nproperty float y\nproperty float z\n"
#define LIST "property list uchar int vertex_indices\n"
#define TRIANGLE                                                                                   \
    ASCII "element vertex 3\n" XYZ "element face 1\n" LIST "end_header\n" /* nine lines */

static void refuse(const char *text, int line, const char *part)
{
    sample_refuse("a.ply", text, line, part);
}

static void headers_are_read_strictly(void **state)
{
    (void)state;
    refuse("", 1, "empty");
    refuse("pl", 1, "not a PLY file");
    refuse("ply2\nformat ascii 1.0\nend_header\n", 1, "not a PLY file");
    refuse("ply x\nformat ascii 1.0\nend_header\n", 1, "'ply x'");
    refuse("ply", 1, "no end_header");
    refuse("ply\nelement vertex 1\nend_header\n", 2, "'element vertex 1'");
    refuse("ply\nformat ascii 1.1\nend_header\n", 2, "'format ascii 1.1'");
    refuse("ply\nformat binary 1.0\nend_header\n", 2, "'format binary 1.0'");
    refuse("ply\nformat ascii 1.0 x\nend_header\n", 2, "'format ascii 1.0 x'");
    refuse("ply\n\nformat ascii 1.0\nend_header\n", 2, "an empty line");
    refuse(ASCII "element vertex 1\n" XYZ, 7, "no end_header");
    refuse(ASCII "element vertex 1\n" XYZ "end_heade", 7, "'end_heade'");
    refuse(ASCII "hello world\nend_header\n", 3, "'hello world'");
    refuse(ASCII "end_header x\n", 3, "'end_header x'");
}

static void counts_are_whole_numbers_that_fit_the_file(void **state)
{
    (void)state;
    static const char *const words[] = {"-1", "1.5", "1e3", "0x10", "many", "99999999999999999999",
                                        "",   "1 2"};
    static const char *const large[] = {"2", "1000000", "2147483648", "4294967296",
                                        "1000000000000000000"};
    char text[512];
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        snprintf(text, sizeof text, ASCII "element vertex %s\n" XYZ "end_header\n1 2 3\n",
                 words[i]);
        refuse(text, 3, "expected 'element NAME COUNT'");
    }
    for (size_t i = 0; i < sizeof large / sizeof *large; i++) {
        snprintf(text, sizeof text, ASCII "element vertex %s\n" XYZ "end_header\n1 2 3\n",
                 large[i]);
        refuse(text, 3, large[i]);
        snprintf(text, sizeof text,
                 "ply\nformat binary_little_endian 1.0\nelement vertex %s\n" XYZ
                 "end_header\n123456789012",
                 large[i]);
        refuse(text, 3, large[i]);
        snprintf(text, sizeof text,
                 "ply\nformat binary_big_endian 1.0\nelement face %s\n" LIST "end_header\n\1",
                 large[i]);
        refuse(text, 3, large[i]);
        snprintf(text, sizeof text, ASCII "element other %s\nproperty char c\nend_header\n1",
                 large[i]);
        refuse(text, 3, large[i]);
    }
}

static void elements_without_properties_cost_nothing(void **state)
{
    (void)state;
    rt_mesh_destroy(sample_accept(
        "a.ply", ASCII "element void 4000000000000\nelement vertex 1\n" XYZ "end_header\n1 2 3\n"));
}

static void properties_are_read_strictly(void **state)
{
    (void)state;
    refuse(ASCII "property float x\nend_header\n", 3, "an element before its properties");
    refuse(ASCII "element vertex 0\nproperty float\nend_header\n", 4, "'property float'");
    refuse(ASCII "element vertex 0\nproperty float x y\nend_header\n", 4, "'property float x y'");
    refuse(ASCII "element vertex 0\nproperty half x\nend_header\n", 4, "'half' is no type");
    refuse(ASCII "element face 0\nproperty list uchar vertex_indices\nend_header\n", 4,
           "COUNT_TYPE");
    refuse(ASCII "element face 0\nproperty list float int vertex_indices\nend_header\n", 4,
           "an integer type");
    refuse(ASCII "element face 0\nproperty list byte int vertex_indices\nend_header\n", 4,
           "'byte' is no type");
    refuse(ASCII "element vertex 0\nproperty float x\nproperty int x\nend_header\n", 5,
           "'x' is there twice");
    refuse(ASCII "element vertex 0\nelement vertex 0\nend_header\n", 4, "'vertex' is there twice");
}

static void too_many_elements_or_properties_are_refused(void **state)
{
    (void)state;
    sample elements = {0}, properties = {0};
    char line[64];
    rt_mesh *mesh;
    rt_error error;
    sample_text(&elements, ASCII);
    sample_text(&properties, ASCII "element vertex 0\n");
    for (int i = 0; i < 5000; i++) {
        snprintf(line, sizeof line, "element e%d 0\n", i);
        sample_text(&elements, line);
        snprintf(line, sizeof line, "property int p%d\n", i);
        sample_text(&properties, line);
    }
    assert_int_equal(sample_read(&mesh, &elements, "a.ply", &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "more than 64 elements"));
    assert_int_equal(sample_read(&mesh, &properties, "a.ply", &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "more than 4096 properties"));
    sample_free(&elements);
    sample_free(&properties);
}

static void vertices_need_coordinates(void **state)
{
    (void)state;
    refuse(ASCII "element vertex 1\nproperty float x\nproperty float y\nend_header\n1 2\n", 3,
           "x, y and z");
    refuse(ASCII "element vertex 1\nproperty list uchar float x\nproperty float y\nproperty float "
                 "z\nend_header\n1 1 2 3\n",
           3, "x, y and z");
}

static void faces_need_integer_indices(void **state)
{
    (void)state;
    refuse(ASCII "element vertex 3\n" XYZ
                 "element face 1\nproperty list uchar float vertex_indices\nend_header\n"
                 "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
           7, "integer type");
    refuse(ASCII "element vertex 3\n" XYZ
                 "element face 1\nproperty int vertex_indices\nend_header\n"
                 "0 0 0\n1 0 0\n0 1 0\n3\n",
           7, "no list vertex_indices");
    refuse(ASCII "element vertex 3\n" XYZ
                 "element face 1\nproperty list uchar int corners\nend_header\n"
                 "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
           7, "no list vertex_indices");
}

static void coordinates_are_finite_floats(void **state)
{
    (void)state;
    static const char *const words[] = {"nan",         "inf",
                                        "-inf",        "INFINITY",
                                        "1e39",        "-3.5e38",
                                        "1e999999999", "1,5",
                                        "++1",         "1e",
                                        "1e+",         ".",
                                        "-",           "0x1p3",
                                        "1.2.3",       "x1",
                                        "1f",          "e5",
                                        "1e5.",        "nanx",
                                        "infi",        "99999999999999999999999999999999999999999"};
    char text[512];
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        snprintf(text, sizeof text, ASCII "element vertex 2\n" XYZ "end_header\n1 2 3\n4 %s 6\n",
                 words[i]);
        refuse(text, 9, "vertex 1 of 2, y: ");
    }
}

/* A bad one is made from the faces around. */
static void normals_may_be_any_number(void **state)
{
    (void)state;
    static const char header[] =
        ASCII "element vertex 3\n" XYZ "property float nx\nproperty float ny\nproperty float nz\n"
              "element face 1\nproperty list uchar int vertex_index\nend_header\n";
    char text[512];
    snprintf(text, sizeof text, "%s0 0 0 nan 0 1\n1 0 0 0 0 0\n0 1 0 0 3 0\n3 0 1 2\n", header);
    rt_mesh *mesh = sample_accept("a.ply", text);
    static const float normals[] = {0, 0, 1, 0, 0, 1, 0, 1, 0};
    sample_expect_floats(mesh->normals, normals, 9);
    assert_int_equal(mesh->bad_normals, 2);
    rt_mesh_destroy(mesh);
}

static void binary_coordinates_are_finite_floats(void **state)
{
    (void)state;
    static const unsigned long bits[] = {0x7f800000, 0xff800000, 0x7fc00000, 0x7f800001};
    for (int big = 0; big < 2; big++)
        for (size_t i = 0; i < sizeof bits / sizeof *bits; i++) {
            sample s = {0};
            rt_mesh *mesh;
            rt_error error;
            sample_text(&s, big ? "ply\nformat binary_big_endian 1.0\n"
                                : "ply\nformat binary_little_endian 1.0\n");
            sample_text(&s, "element vertex 2\n" XYZ "end_header\n");
            for (int k = 0; k < 6; k++)
                sample_u32(&s, k == 4 ? bits[i] : 0x3f800000, big);
            assert_int_equal(sample_read(&mesh, &s, "a.ply", &error), RT_ERROR_INPUT);
            assert_non_null(strstr(error.message, "vertex 1 of 2, y: "));
            sample_free(&s);
        }
}

static void doubles_beyond_float_are_refused(void **state)
{
    (void)state;
    sample s = {0};
    rt_mesh *mesh;
    rt_error error;
    sample_text(&s, "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float "
                    "x\nproperty double y\n"
                    "property float z\nend_header\n");
    sample_f32(&s, 1, 0);
    sample_f64(&s, 1e39, 0);
    sample_f32(&s, 1, 0);
    assert_int_equal(sample_read(&mesh, &s, "a.ply", &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "1e+39"));
    sample_free(&s);
}

static void indices_are_in_range(void **state)
{
    (void)state;
    static const char *const rows[] = {"3 0 1 3", "3 0 1 2147483647", "3 -1 1 2", "4 0 1 2 7",
                                       "1 5"};
    char text[512];
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        snprintf(text, sizeof text, TRIANGLE "0 0 0\n1 0 0\n0 1 0\n%s\n", rows[i]);
        refuse(text, 13, "out of range; the file has 3 vertices");
    }
    refuse(ASCII "element face 1\n" LIST "end_header\n3 0 1 2\n", 6, "the file has 0 vertices");
    refuse(ASCII "element face 1\n" LIST "element vertex 2\n" XYZ
                 "end_header\n3 0 1 2\n0 0 0\n1 1 1\n",
           10, "the file has 2 vertices");
    refuse(ASCII "element vertex 1\n" XYZ "element tristrips 1\n" LIST
                 "end_header\n0 0 0\n3 0 -2 0\n",
           11, "vertex -2");
}

static void binary_indices_are_in_range(void **state)
{
    (void)state;
    static const unsigned long bad[] = {3, 0xffffffff, 0x80000000, 0x7fffffff};
    for (int big = 0; big < 2; big++)
        for (int k = 0; k < 4; k++) {
            sample s = {0};
            rt_mesh *mesh;
            rt_error error;
            sample_text(&s, big ? "ply\nformat binary_big_endian 1.0\n"
                                : "ply\nformat binary_little_endian 1.0\n");
            sample_text(&s, "element vertex 3\n" XYZ "element face 2\n" LIST "end_header\n");
            for (int i = 0; i < 9; i++)
                sample_f32(&s, (float)i, big);
            for (int face = 0; face < 2; face++) {
                sample_u8(&s, 3);
                for (unsigned i = 0; i < 3; i++)
                    sample_u32(&s, face == 1 && i == 2 ? bad[k] : i, big);
            }
            assert_int_equal(sample_read(&mesh, &s, "a.ply", &error), RT_ERROR_INPUT);
            assert_non_null(strstr(error.message, "face 1 of 2, vertex_indices: vertex "));
            sample_free(&s);
        }
}

static void integers_stay_in_the_range_of_their_type(void **state)
{
    (void)state;
    static const char *const pairs[][2] = {
        {"char", "128"},       {"char", "-129"},
        {"uchar", "256"},      {"uchar", "-1"},
        {"short", "32768"},    {"ushort", "65536"},
        {"int", "2147483648"}, {"uint", "4294967296"},
        {"int", "1.0"},        {"uint", "99999999999999999999999"}};
    char text[512];
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        snprintf(text, sizeof text,
                 ASCII "element vertex 1\n" XYZ "property %s tag\nend_header\n1 2 3 %s\n",
                 pairs[i][0], pairs[i][1]);
        refuse(text, 9, pairs[i][1]);
    }
}

static void lists_end_before_the_file_does(void **state)
{
    (void)state;
    refuse(TRIANGLE "0 0 0\n1 0 0\n0 1 0\n200 0 1 2\n", 13, "a list of 200 values");
    refuse(TRIANGLE "0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n", 13, "'-3'");
    refuse(TRIANGLE "0 0 0\n1 0 0\n0 1 0\n4 0 1 2", 13, "a list of 4 values");
    refuse(TRIANGLE "0 0 0\n1 0 0\n0 1 0\n3 0 1     ", 13, "the file ends here");
    sample s = {0};
    rt_mesh *mesh;
    rt_error error;
    sample_text(&s, "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list uint "
                    "uchar vertex_indices\nend_header\n");
    sample_u32(&s, 0xffffffff, 0);
    assert_int_equal(sample_read(&mesh, &s, "a.ply", &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "a list of 4294967295 values"));
    sample_free(&s);
    sample_text(&s,
                "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list char uchar "
                "vertex_indices\nend_header\n\xff");
    assert_int_equal(sample_read(&mesh, &s, "a.ply", &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "a list of -1 values"));
    sample_free(&s);
}

/* A row with more values than announced would shift all that follows. */
static void rows_hold_no_more_than_the_header_says(void **state)
{
    (void)state;
    refuse(TRIANGLE "0 0 0 9\n1 0 0\n0 1 0\n3 0 1 2\n", 10, "'9' is one value more");
    refuse(TRIANGLE "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 0\n", 13, "'0' is one value more");
    refuse(ASCII "element vertex 3\n" XYZ "element face 2\n" LIST
                 "end_header\n0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 2\n",
           11, "one value more");
}

static void texture_coordinates_by_face_come_in_pairs(void **state)
{
    (void)state;
    refuse(ASCII "element vertex 3\n" XYZ "element face 1\n" LIST
                 "property list uchar float texcoord\nend_header\n"
                 "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 5 0 0 1 0 1\n",
           14, "texcoord has 5 values for 3 corners");
}

/* Each proper prefix lacks something; only the end of the last line may go. */
static void every_truncation_is_refused(void **state)
{
    (void)state;
    static const char text[] = TRIANGLE "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    for (size_t size = 0; size + 2 < sizeof text; size++) {
        sample s = {0};
        rt_mesh *mesh;
        rt_error error;
        sample_bytes(&s, text, size);
        assert_int_equal(sample_read(&mesh, &s, "a.ply", &error), RT_ERROR_INPUT);
        sample_free(&s);
    }
}

static void every_truncation_of_binary_is_refused(void **state)
{
    (void)state;
    sample s = {0};
    rt_mesh *mesh;
    rt_error error;
    sample_text(&s, "ply\nformat binary_big_endian 1.0\nelement vertex 3\n" XYZ
                    "element face 1\n" LIST "end_header\n");
    for (int i = 0; i < 9; i++)
        sample_f32(&s, (float)i, 1);
    sample_u8(&s, 3);
    for (unsigned i = 0; i < 3; i++)
        sample_u32(&s, i, 1);
    assert_int_equal(sample_read(&mesh, &s, "a.ply", &error), RT_OK);
    rt_mesh_destroy(mesh);
    while (s.size--)
        assert_int_equal(sample_read(&mesh, &s, "a.ply", &error), RT_ERROR_INPUT);
    sample_free(&s);
}

static void messages_are_printable(void **state)
{
    (void)state;
    refuse(ASCII "element\033[2J vertex\001 5\nend_header\n", 3, "'element?[2J vertex? 5'");
}

/* In text at its line; in rows of one size, which are read column by column, at its row. */
static void colours_go_from_0_to_1(void **state)
{
    (void)state;
#define RGB "property float red\nproperty float green\nproperty float blue\n"
    sample s = {0};
    rt_mesh *mesh;
    rt_error error;
    refuse(ASCII "element vertex 1\n" XYZ RGB "end_header\n0 0 -1 1 -.5 0\n", 11,
           "vertex 0 of 1, green: the colour -0.5 is negative");
    refuse(ASCII "element vertex 3\n" XYZ "element face 1\n" LIST
                 "property char red\nproperty char green\nproperty char blue\nend_header\n"
                 "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 0 0 -7\n",
           16, "face 0 of 1, blue: the colour -7 is negative");
    refuse(ASCII "element vertex 1\n" XYZ RGB "end_header\n0 0 -1 1 1.0002 0\n", 11,
           "vertex 0 of 1, green: the colour 1.0002 is above 1: colours go from 0 to 1; whole");
    refuse(ASCII "element vertex 1\n" XYZ
                 "property int red\nproperty uint green\nproperty int blue\nend_header\n"
                 "0 0 0 255 256 0\n",
           11, "vertex 0 of 1, green: the colour 256 is above 255: colours of whole numbers go");
    refuse(ASCII "element vertex 1\n" XYZ
                 "property int red\nproperty int green\nproperty int blue\nend_header\n"
                 "0 0 0 255 0 -1\n",
           11, "vertex 0 of 1, blue: the colour -1 is negative");
    sample_text(&s,
                "ply\nformat binary_little_endian 1.0\nelement vertex 1\n" XYZ RGB "end_header\n");
    for (int i = 0; i < 6; i++)
        sample_f32(&s, i == 3 ? -2.0f : 0.0f, 0);
    assert_int_equal(sample_read(&mesh, &s, "a.ply", &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "vertex 0 of 1, red: the colour -2 is negative"));
    sample_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(headers_are_read_strictly),
        cmocka_unit_test(counts_are_whole_numbers_that_fit_the_file),
        cmocka_unit_test(elements_without_properties_cost_nothing),
        cmocka_unit_test(properties_are_read_strictly),
        cmocka_unit_test(too_many_elements_or_properties_are_refused),
        cmocka_unit_test(vertices_need_coordinates),
        cmocka_unit_test(faces_need_integer_indices),
        cmocka_unit_test(coordinates_are_finite_floats),
        cmocka_unit_test(normals_may_be_any_number),
        cmocka_unit_test(binary_coordinates_are_finite_floats),
        cmocka_unit_test(doubles_beyond_float_are_refused),
        cmocka_unit_test(colours_go_from_0_to_1),
        cmocka_unit_test(indices_are_in_range),
        cmocka_unit_test(binary_indices_are_in_range),
        cmocka_unit_test(integers_stay_in_the_range_of_their_type),
        cmocka_unit_test(lists_end_before_the_file_does),
        cmocka_unit_test(rows_hold_no_more_than_the_header_says),
        cmocka_unit_test(texture_coordinates_by_face_come_in_pairs),
        cmocka_unit_test(every_truncation_is_refused),
        cmocka_unit_test(every_truncation_of_binary_is_refused),
        cmocka_unit_test(messages_are_printable),
    };
    return cmocka_run_group_tests_name("mesh/ply_bad", tests, scratch_enter, scratch_leave);
}
