/* PLY files that are sound, in all their variety. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "lib/image/scratch.h"
#include "lib/mesh/sample.h"

#define XYZ "property float x\nproperty float y\nproperty float z\n"
#define LIST "property list uchar int vertex_indices\n"
#define SQUARE "0 0 0\n1 0 0\n1 1 0\n0 1 0\n"

static const float square[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

static void polygons_become_fans(void **state)
{
    (void)state;
    static const unsigned fans[] = {0, 1, 2, 0, 1, 2, 0, 2, 3, 4, 0, 1, 4, 1, 2, 4, 2, 3};
    rt_mesh *mesh = sample_accept("a.ply", "ply\nformat ascii 1.0\nelement vertex 5\n" XYZ
                                           "element face 3\n" LIST "end_header\n" SQUARE
                                           "0.5 0.5 1\n3 0 1 2\n4 0 1 2 3\n5 4 0 1 2 3\n");
    sample_expect_floats(mesh->positions, square, 12);
    sample_expect_triangles(mesh, fans, 6);
    assert_int_equal(mesh->file_vertices, 5);
    assert_int_equal(mesh->file_faces, 3);
    assert_null(mesh->normals);
    assert_null(mesh->uv);
    assert_null(mesh->colours);
    assert_null(mesh->textures);
    rt_mesh_destroy(mesh);
}

static void every_attribute_has_its_place(void **state)
{
    (void)state;
    static const float normals[] = {0, 0, 1, 0, 1, 0, 1, 0, 0},
                       uv[] = {0.25f, 0.5f, 0.75f, 1, 0, 0.125f};
    /* sRGB: of 51, 102, 153 and 204 */
    static const float colours[] = {1, 0,           0.033104767f, 0,          1,
                                    0, 0.13286832f, 0.31854678f,  0.60382734f};
    rt_mesh *mesh = sample_accept(
        "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty uchar blue\nproperty float v\n" XYZ
        "property float nz\nproperty double ny\nproperty float nx\nproperty float u\nproperty "
        "uchar red\n"
        "property uchar green\nproperty uchar alpha\nelement face 1\n" LIST "end_header\n"
        "51 0.5 0 0 0  1 0 0  0.25 255 0 9\n0 1 1 0 0  0 2 0  0.75 0 255 9\n204 0.125 0 1 0  0 0 3 "
        " 0 102 153 9\n"
        "3 0 1 2\n");
    sample_expect_floats(mesh->normals, normals, 9);
    sample_expect_floats(mesh->uv, uv, 6);
    for (int i = 0; i < 9; i++)
        assert_true(fabsf(mesh->colours[i] - colours[i]) < 1e-7f);
    rt_mesh_destroy(mesh);
}

static void other_properties_are_attributes(void **state)
{
    (void)state;
    static const float of_vertices[] = {1, 2, 0.5f, 0, 3, 4, 9, 1, 5, 6, -7, 0},
                       of_triangles[] = {1, 2, 3, 9, 1, 2, 3, 9, 4, 5, 6, 8};
    rt_mesh *mesh = sample_accept(
        "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\n" XYZ
        "property float set_u\nproperty double set_v\nproperty int label\nproperty float wear\n"
        "property uchar alpha\nproperty float wear_0\nelement face 2\n" LIST
        "property float tint_r\nproperty float tint_g\nproperty float tint_b\n"
        "property float tint_a\nproperty float heat_0\nproperty list uchar float more\n"
        "end_header\n"
        "0 0 0  1 2  70000 0.5 0 8\n1 0 0  3 4  -3 9 255 8\n1 1 0  5 6  0 -7 0 8\n"
        "4 0 1 2 0  1 2 3 4  9 0\n3 0 1 2  4 5 6 7  8 2 1 1\n");
    sample_expect_floats(mesh->of_vertices.values, of_vertices, 12);
    assert_int_equal(mesh->of_vertices.count, 3);
    assert_string_equal(mesh->of_vertices.list[0].name, "set");
    assert_string_equal(mesh->of_vertices.list[1].name, "wear");
    assert_string_equal(mesh->of_vertices.list[2].name, "alpha");
    sample_expect_floats(mesh->of_triangles.values, of_triangles, 12);
    assert_int_equal(mesh->of_triangles.count, 2);
    assert_string_equal(mesh->of_triangles.list[0].name, "tint");
    assert_int_equal(mesh->of_triangles.list[0].width, 3);
    assert_string_equal(mesh->of_triangles.list[1].name, "heat");
    rt_mesh_destroy(mesh);
}

/* Corners of faces with coordinates of their own are vertices: each has what its vertex has. */
static void split_vertices_keep_their_attributes(void **state)
{
    (void)state;
    static const float wear[] = {0.25f, 0.5f, 0.75f, 0.25f, 0.75f, 1};
    rt_mesh *mesh = sample_accept("a.ply", "ply\nformat ascii 1.0\nelement vertex 4\n" XYZ
                                           "property float wear\nelement face 2\n" LIST
                                           "property list uchar float texcoord\nend_header\n"
                                           "0 0 0 0.25\n1 0 0 0.5\n1 1 0 0.75\n0 1 0 1\n"
                                           "3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 6 0.5 0 1 0.5 1 1\n");
    assert_int_equal(mesh->vertex_count, 6);
    sample_expect_floats(mesh->of_vertices.values, wear, 6);
    rt_mesh_destroy(mesh);
}

static void texture_coordinates_go_by_many_names(void **state)
{
    (void)state;
    static const char *const names[][2] = {
        {"u", "v"}, {"s", "t"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}};
    static const float uv[] = {0.25f, 0.75f};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char text[512];
        snprintf(text, sizeof text,
                 "ply\nformat ascii 1.0\nelement vertex 1\n" XYZ
                 "property float %s\nproperty float %s\n"
                 "end_header\n1 2 3 0.25 0.75\n",
                 names[i][0], names[i][1]);
        rt_mesh *mesh = sample_accept("a.ply", text);
        sample_expect_floats(mesh->uv, uv, 2);
        rt_mesh_destroy(mesh);
    }
}

static void half_an_attribute_is_none(void **state)
{
    (void)state;
    rt_mesh *mesh = sample_accept(
        "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 1\n" XYZ "property float nx\n"
        "property float ny\nproperty float u\nproperty uchar red\nend_header\n1 2 3 4 5 6 7\n");
    assert_null(mesh->normals);
    assert_null(mesh->uv);
    assert_null(mesh->colours);
    rt_mesh_destroy(mesh);
}

/*
 * Each scalar type, in both byte orders: an extra before x, so that a wrong size shifts what
 * follows.
 */
static void every_type_is_read_in_both_byte_orders(void **state)
{
    (void)state;
    static const char *const types[][2] = {
        {"char", "int8"}, {"uchar", "uint8"}, {"short", "int16"},   {"ushort", "uint16"},
        {"int", "int32"}, {"uint", "uint32"}, {"float", "float32"}, {"double", "float64"}};
    static const float values[] = {-100, 200, -30000, 60000, -100000, 3e9f, 0.1f, -1e-3f};
    for (int big = 0; big < 2; big++)
        for (int type = 0; type < 8; type++) {
            sample s = {0};
            char text[512];
            snprintf(text, sizeof text,
                     "ply\nformat binary_%s_endian 1.0\nelement vertex 2\nproperty %s extra\n"
                     "property float z\nproperty %s x\nproperty double y\nend_header\n",
                     big ? "big" : "little", types[type][0], types[type][1]);
            sample_text(&s, text);
            for (int vertex = 0; vertex < 2; vertex++)
                for (int part = 0; part < 4; part++) {
                    float value = values[type];
                    if (part == 1)
                        sample_f32(&s, 5.5f, big);
                    else if (part == 3)
                        sample_f64(&s, 7.25, big);
                    else if (type < 2)
                        sample_u8(&s, (unsigned)(int)value & 0xffu);
                    else if (type < 4)
                        sample_u16(&s, (unsigned)(int)value & 0xffffu, big);
                    else if (type < 6)
                        sample_u32(&s, (unsigned long)(int64_t)value & 0xffffffffu, big);
                    else if (type == 6)
                        sample_f32(&s, value, big);
                    else
                        sample_f64(&s, (double)value, big);
                }
            rt_mesh *mesh;
            rt_error error;
            assert_int_equal(sample_read(&mesh, &s, "a.ply", &error), RT_OK);
            const float expected[6] = {values[type], 7.25f, 5.5f, values[type], 7.25f, 5.5f};
            sample_expect_floats(mesh->positions, expected, 6);
            rt_mesh_destroy(mesh);
            sample_free(&s);
        }
}

/* Counts and indices of every pair of integer types. */
static void lists_may_have_any_integer_types(void **state)
{
    (void)state;
    static const char *const types[] = {"char", "uchar", "short", "ushort", "int", "uint"};
    static const unsigned two[] = {0, 1, 2, 0, 2, 3};
    for (int big = 0; big < 2; big++)
        for (int pair = 0; pair < 36; pair++) {
            int size[2] = {1 << pair / 6 / 2, 1 << pair % 6 / 2};
            sample s = {0};
            char text[512];
            snprintf(text, sizeof text,
                     "ply\nformat binary_%s_endian 1.0\nelement vertex 4\n" XYZ "element face 1\n"
                     "property ushort flags\nproperty list %s %s vertex_index\nend_header\n",
                     big ? "big" : "little", types[pair / 6], types[pair % 6]);
            sample_text(&s, text);
            for (int i = 0; i < 12; i++)
                sample_f32(&s, square[i], big);
            sample_u16(&s, 0x0103, big);
            for (unsigned i = 0; i < 5; i++) {
                int bytes = size[i > 0];
                unsigned value = i == 0 ? 4 : i - 1;
                if (bytes == 1)
                    sample_u8(&s, value);
                else if (bytes == 2)
                    sample_u16(&s, value, big);
                else
                    sample_u32(&s, value, big);
            }
            rt_mesh *mesh;
            rt_error error;
            assert_int_equal(sample_read(&mesh, &s, "a.ply", &error), RT_OK);
            sample_expect_triangles(mesh, two, 2);
            rt_mesh_destroy(mesh);
            sample_free(&s);
        }
}

/*
 * The layout that most exporters write, whose triangles are copied as they are; a quad among them.
 */
static void plain_binary_triangles_and_a_quad_are_read(void **state)
{
    (void)state;
    static const unsigned indices[] = {0, 1, 2, 1, 2, 3, 0, 1, 2, 0, 2, 3, 3, 2, 1};
    static const unsigned rows[] = {3, 0, 1, 2, 3, 1, 2, 3, 4, 0, 1, 2, 3, 3, 3, 2, 1};
    for (int big = 0; big < 2; big++) {
        sample s = {0};
        sample_text(&s, big ? "ply\nformat binary_big_endian 1.0\n"
                            : "ply\nformat binary_little_endian 1.0\n");
        sample_text(&s, "element vertex 4\n" XYZ "element face 4\n" LIST "end_header\n");
        for (int i = 0; i < 12; i++)
            sample_f32(&s, square[i], big);
        for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
            if (i == 0 || i == 4 || i == 8 || i == 13)
                sample_u8(&s, rows[i]);
            else
                sample_u32(&s, rows[i], big);
        rt_mesh *mesh;
        rt_error error;
        assert_int_equal(sample_read(&mesh, &s, "a.ply", &error), RT_OK);
        sample_expect_triangles(mesh, indices, 5);
        rt_mesh_destroy(mesh);
        sample_free(&s);
    }
}

static void strips_are_unrolled_with_one_winding(void **state)
{
    (void)state;
    static const unsigned indices[] = {0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5, 5, 4, 3};
    rt_mesh *mesh = sample_accept(
        "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 6\n" XYZ "element tristrips 1\n" LIST
        "end_header\n0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n2 1 0\n12 0 1 2 3 4 5 -1 0 -1 5 4 3\n");
    sample_expect_triangles(mesh, indices, 5);
    assert_int_equal(mesh->zero_area, 0);
    rt_mesh_destroy(mesh);
}

static void elements_come_in_any_order(void **state)
{
    (void)state;
    static const unsigned one[] = {0, 2, 3};
    rt_mesh *mesh = sample_accept(
        "a.ply",
        "ply\nformat ascii 1.0\nelement edge 1\nproperty int a\nproperty list uchar float b\n"
        "element face 1\nproperty list uchar short extra\n" LIST "property float q\n"
        "element vertex 4\nproperty list uchar int more\n" XYZ
        "element tail 2\nproperty int c\nend_header\n"
        "7 2 0.5 nan\n2 8 9 3 0 2 3 inf\n1 5 0 0 0\n0 1 0 0\n2 5 5 1 1 0\n0 0 1 0\n1\n2\n");
    sample_expect_triangles(mesh, one, 1);
    sample_expect_floats(mesh->positions, square, 12);
    rt_mesh_destroy(mesh);
}

static void line_ends_and_white_space_do_not_matter(void **state)
{
    (void)state;
    static const char *const ends[] = {"\n", "\r\n", "\r"};
    static const char *const lines[] = {"ply",
                                        "format ascii 1.0 ",
                                        "comment a",
                                        "obj_info b c",
                                        "element vertex 4",
                                        "property float x",
                                        "  property\tfloat y",
                                        "property float z",
                                        "element face 1",
                                        "property list uchar int vertex_indices",
                                        "end_header  ",
                                        "0 0 0",
                                        "",
                                        "1 0 0 ",
                                        "1 1",
                                        "0",
                                        "\t0 1 0",
                                        "4 0 1",
                                        "2 3"};
    static const unsigned two[] = {0, 1, 2, 0, 2, 3};
    for (int end = 0; end < 3; end++) {
        char text[1024] = "";
        for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
            strcat(text, lines[i]);
            strcat(text, ends[end]);
        }
        rt_mesh *mesh = sample_accept("a.ply", text);
        sample_expect_floats(mesh->positions, square, 12);
        sample_expect_triangles(mesh, two, 2);
        rt_mesh_destroy(mesh);
    }
}

/* Data that begins with what could be more of a line end. */
static void binary_data_begins_right_after_the_header(void **state)
{
    (void)state;
    static const char *const ends[] = {"\n", "\r\n", "\r"};
    for (int end = 0; end < 3; end++) {
        sample s = {0};
        const char *const lines[] = {"ply",
                                     "format binary_little_endian 1.0",
                                     "element vertex 2",
                                     "property uchar x",
                                     "property uchar y",
                                     "property uchar z",
                                     "end_header"};
        for (int i = 0; i < 7; i++) {
            sample_text(&s, lines[i]);
            sample_text(&s, ends[end]);
        }
        sample_text(&s, "\n\n\r\r\n ");
        static const float expected[] = {10, 10, 13, 13, 10, 32};
        rt_mesh *mesh;
        rt_error error;
        assert_int_equal(sample_read(&mesh, &s, "a.ply", &error), RT_OK);
        sample_expect_floats(mesh->positions, expected, 6);
        rt_mesh_destroy(mesh);
        sample_free(&s);
    }
}

static void texture_file_keeps_its_spaces(void **state)
{
    (void)state;
    rt_mesh *mesh = sample_accept(
        "a.ply", "ply\nformat ascii 1.0\ncomment made by hand\ncomment TextureFile  my wood.png \n"
                 "element vertex 0\n" XYZ "end_header\n");
    assert_string_equal(mesh->textures, "my wood.png");
    assert_int_equal(mesh->vertex_count, 0);
    assert_int_equal(mesh->triangle_count, 0);
    rt_mesh_destroy(mesh);
}

static void texture_coordinates_by_face_split_vertices(void **state)
{
    (void)state;
    /*
     * Two triangles of a square; at vertex 2 they agree, at vertex 0 they do not. Vertex 4 is not
     * used.
     */
    static const unsigned two[] = {0, 1, 2, 3, 2, 4};
    static const float uv[] = {0, 0, 1, 0, 1, 1, 0.5f, 0.5f, 0, 1};
    static const float positions[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 0, 1, 0};
    static const float reds[] = {0.5f, 1, 0, 0.5f, 0.25f};
    rt_mesh *mesh = sample_accept(
        "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 5\n" XYZ "property float red\nproperty float green\n"
        "property float blue\nelement face 2\n" LIST
        "property list uchar float texcoord\nend_header\n"
        "0 0 0 .5 0 0\n1 0 0 1 0 0\n1 1 0 0 0 0\n0 1 0 .25 0 0\n9 9 9 0 0 0\n"
        "3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 6 0.5 0.5 1 1 0 1\n");
    sample_expect_triangles(mesh, two, 2);
    assert_int_equal(mesh->vertex_count, 5);
    sample_expect_floats(mesh->uv, uv, 10);
    sample_expect_floats(mesh->positions, positions, 15);
    for (int i = 0; i < 5; i++)
        assert_true(mesh->colours[3 * i] == reds[i]);
    assert_int_equal(mesh->file_vertices, 5);
    rt_mesh_destroy(mesh);
}

static void integer_colours_and_coordinates_are_scaled_to_one(void **state)
{
    (void)state;
    rt_mesh *mesh = sample_accept("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\n" XYZ
                                           "property ushort red\n"
                                           "property ushort green\nproperty ushort blue\nproperty "
                                           "uchar u\nproperty uchar v\nend_header\n"
                                           "1 2 3 65535 0 32768 255 51\n");
    assert_true(mesh->colours[0] == 1 && mesh->colours[1] == 0);
    assert_true(fabsf(mesh->colours[2] - 0.2140482f) < 1e-7f);
    assert_true(mesh->uv[0] == 1 && fabsf(mesh->uv[1] - 0.2f) < 1e-7f);
    rt_mesh_destroy(mesh);
}

static void colours_of_32_bits_go_to_255(void **state)
{
    (void)state;
    static const char *const types[] = {"int", "uint"};
    for (int i = 0; i < 2; i++) {
        char text[512];
        snprintf(text, sizeof text,
                 "ply\nformat ascii 1.0\nelement vertex 3\n" XYZ "element face 1\n" LIST
                 "property %s red\nproperty %s green\nproperty %s blue\nend_header\n"
                 "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 0 51\n",
                 types[i], types[i], types[i]);
        rt_mesh *mesh = sample_accept("a.ply", text);
        assert_true(mesh->colours[0] == 1 && mesh->colours[1] == 0);
        assert_true(fabsf(mesh->colours[2] - 0.033104767f) < 1e-7f);
        rt_mesh_destroy(mesh);
    }
}

#define TEXTURED                                                                                   \
    "ply\nformat ascii 1.0\ncomment TextureFile a.png\ncomment TextureFile b c.png\n"              \
    "element vertex 4\n" XYZ

static void colours_by_face_split_vertices(void **state)
{
    (void)state;
    static const float colours[] = {1, 0,           0, 1, 0,           0, 1, 0,           0,
                                    0, 0.21586051f, 0, 0, 0.21586051f, 0, 0, 0.21586051f, 0};
    static const unsigned two[] = {0, 1, 2, 3, 4, 5};
    rt_mesh *mesh = sample_accept(
        "a.ply", "ply\nformat ascii 1.0\nelement vertex 4\n" XYZ "element face 2\n" LIST
                 "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n"
                 "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 255 0 0\n3 0 2 3 0 128 0\n");
    sample_expect_triangles(mesh, two, 2);
    for (int i = 0; i < 18; i++)
        assert_true(fabsf(mesh->colours[i] - colours[i]) < 1e-6f);
    assert_null(mesh->uv);
    assert_int_equal(mesh->warnings.count, 0);
    rt_mesh_destroy(mesh);
}

static void colours_of_vertices_go_before_those_of_faces(void **state)
{
    (void)state;
    rt_mesh *mesh = sample_accept(
        "a.ply", "ply\nformat ascii 1.0\nelement vertex 3\n" XYZ
                 "property double r\nproperty double g\nproperty double b\nelement face 1\n" LIST
                 "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n"
                 "0 0 0 .5 .25 1\n1 0 0 .5 .25 1\n1 1 0 .5 .25 1\n3 0 1 2 255 0 0\n");
    assert_true(mesh->colours[0] == 0.5f && mesh->colours[1] == 0.25f && mesh->colours[2] == 1);
    assert_int_equal(mesh->warnings.count, 1);
    rt_mesh_destroy(mesh);
}

static void faces_say_which_texture_they_have(void **state)
{
    (void)state;
    static const uint32_t textures[] = {1, RT_MESH_BARE, 0, 0, RT_MESH_BARE};
    rt_mesh *mesh = sample_accept(
        "a.ply",
        TEXTURED "element face 4\n" LIST "property int texnumber\nend_header\n"
                 "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 1\n3 0 1 2 -1\n4 0 1 2 3 0\n3 0 2 3 7\n");
    assert_int_equal(mesh->texture_count, 2);
    assert_string_equal(mesh->textures, "a.png");
    assert_string_equal(mesh->textures + 6, "b c.png");
    assert_memory_equal(mesh->texture_of, textures, sizeof textures);
    assert_int_equal(mesh->warnings.count, 1);
    rt_mesh_destroy(mesh);
    mesh = sample_accept("a.ply", TEXTURED "element face 1\n" LIST "end_header\n"
                                           "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n");
    assert_null(mesh->texture_of);
    assert_string_equal(mesh->warnings.text[0],
                        "a.ply: 2 textures, but no texnumber of faces: all have the first");
    rt_mesh_destroy(mesh);
}

static void float_colours_keep_every_bit(void **state)
{
    (void)state;
    static const float colours[] = {0.1f, 0.75f, 1e-6f};
    rt_mesh *mesh = sample_accept(
        "a.ply", "ply\nformat ascii 1.0\nelement vertex 1\n" XYZ "property float red\n"
                 "property float green\nproperty float blue\nend_header\n1 2 3 0.1 0.75 1e-6\n");
    sample_expect_floats(mesh->colours, colours, 3);
    rt_mesh_destroy(mesh);
}

static void faces_without_area_are_counted(void **state)
{
    (void)state;
    static const unsigned three[] = {0, 1, 2, 0, 0, 1, 0, 1, 3};
    rt_mesh *mesh =
        sample_accept("a.ply", "ply\nformat ascii 1.0\nelement vertex 4\n" XYZ
                               "element face 5\n" LIST "end_header\n"
                               "0 0 0\n1 0 0\n0 1 0\n3 0 0\n3 0 1 2\n2 0 1\n3 0 0 1\n0\n3 0 1 3\n");
    sample_expect_triangles(mesh, three, 3);
    assert_int_equal(mesh->file_faces, 5);
    assert_int_equal(mesh->skipped_faces, 2);
    assert_int_equal(mesh->zero_area, 2);
    rt_mesh_destroy(mesh);
}

static void what_follows_the_data_is_ignored(void **state)
{
    (void)state;
    rt_mesh *mesh = sample_accept("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\n" XYZ
                                           "end_header\n1 2 3\n4 5 6\nxyz\n");
    assert_int_equal(mesh->vertex_count, 1);
    rt_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(polygons_become_fans),
        cmocka_unit_test(every_attribute_has_its_place),
        cmocka_unit_test(other_properties_are_attributes),
        cmocka_unit_test(split_vertices_keep_their_attributes),
        cmocka_unit_test(texture_coordinates_go_by_many_names),
        cmocka_unit_test(half_an_attribute_is_none),
        cmocka_unit_test(every_type_is_read_in_both_byte_orders),
        cmocka_unit_test(lists_may_have_any_integer_types),
        cmocka_unit_test(plain_binary_triangles_and_a_quad_are_read),
        cmocka_unit_test(strips_are_unrolled_with_one_winding),
        cmocka_unit_test(elements_come_in_any_order),
        cmocka_unit_test(line_ends_and_white_space_do_not_matter),
        cmocka_unit_test(binary_data_begins_right_after_the_header),
        cmocka_unit_test(texture_file_keeps_its_spaces),
        cmocka_unit_test(texture_coordinates_by_face_split_vertices),
        cmocka_unit_test(integer_colours_and_coordinates_are_scaled_to_one),
        cmocka_unit_test(colours_of_32_bits_go_to_255),
        cmocka_unit_test(colours_by_face_split_vertices),
        cmocka_unit_test(colours_of_vertices_go_before_those_of_faces),
        cmocka_unit_test(faces_say_which_texture_they_have),
        cmocka_unit_test(float_colours_keep_every_bit),
        cmocka_unit_test(faces_without_area_are_counted),
        cmocka_unit_test(what_follows_the_data_is_ignored),
    };
    return cmocka_run_group_tests_name("mesh/ply", tests, scratch_enter, scratch_leave);
}
