/*
 * test_import_heights.c - height fields of Mitsuba 0.x, whose patches and normals follow their
 * formulas, and of pbrt-v3.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "expect.h"
#include "lib/image/scratch.h"
#include "mesh/load.h"
#include "spawn.h"

/* A field of Mitsuba, with these elements inside. */
static run import_field(const char *inside)
{
    char text[1024];
    snprintf(text, sizeof text,
             "<scene version=\"0.6.0\"><sensor type=\"perspective\"/>"
             "<shape type=\"heightfield\">%s</shape></scene>",
             inside);
    scratch_write("s.xml", text);
    run run = run_rtc("import s.xml --out s.rts");
    expect_status(&run, 0);
    return run;
}

/* The mesh of the only shape of s.rts. To be destroyed. */
static rt_mesh *load_mesh(void)
{
    rt_mesh *mesh = NULL;
    rt_error error;
    for (int i = 0; i < 4 && !mesh; i++) {
        char name[32];
        snprintf(name, sizeof name, "s_files/mesh_%d.ply", i);
        if (rt_mesh_load(&mesh, name, NULL, &error) != RT_OK)
            mesh = NULL;
        remove(name);
    }
    assert_non_null(mesh);
    return mesh;
}

static rt_mesh *import_mesh_of(const char *inside)
{
    run run = import_field(inside);
    expect_no_err(&run, "left out");
    run_free(&run);
    return load_mesh();
}

/* An image of linear grey, [rows][columns] from its top row, whose bytes are those of this CPU. */
static void write_image(const char *name, const float *grey, int columns, int rows)
{
    unsigned char bytes[1024];
    size_t size = (size_t)sprintf((char *)bytes, "Pf\n%d %d\n-1\n", columns, rows);
    for (int y = rows; y-- > 0; size += (size_t)columns * sizeof *grey)
        memcpy(bytes + size, grey + y * columns, (size_t)columns * sizeof *grey);
    scratch_write_bytes(name, bytes, size);
}

/* z of the normal of a triangle. */
static double face_z(const rt_mesh *mesh, size_t triangle)
{
    const float *p[3];
    for (size_t c = 0; c < 3; c++)
        p[c] = mesh->positions + 3 * (size_t)mesh->indices[3 * triangle + c];
    return ((double)p[1][0] - p[0][0]) * ((double)p[2][1] - p[0][1]) -
           ((double)p[1][1] - p[0][1]) * ((double)p[2][0] - p[0][0]);
}

static void expect_faces(const rt_mesh *mesh, double side)
{
    for (size_t i = 0; i < mesh->triangle_count; i++)
        assert_true(side * face_z(mesh, i) > 0);
}

/* The top row of the image is at y = -1, and between pixels heights are bilinear. */
static void patches_are_bilinear(void **state)
{
    static const float grey[4] = {0.1f, 0.7f, 0.4f, -0.3f};
    (void)state;
    write_image("h.pfm", grey, 2, 2);
    rt_mesh *mesh = import_mesh_of("<string name=\"filename\" value=\"h.pfm\"/><float "
                                   "name=\"scale\" value=\"2\"/><boolean "
                                   "name=\"shadingNormals\" value=\"false\"/>");
    double lowest = 0, highest = 0;
    assert_true(mesh->vertex_count >= 17 * 17);
    assert_null(mesh->normals);
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const float *const p = mesh->positions + 3 * i, *const uv = mesh->uv + 2 * i;
        const double u = (p[0] + 1) / 2, v = (p[1] + 1) / 2;
        const double z = 2 * ((1 - v) * ((1 - u) * grey[0] + u * grey[1]) +
                              v * ((1 - u) * grey[2] + u * grey[3]));
        assert_true(fabs(p[2] - z) < 1e-6);
        assert_true(fabs(uv[0] - u) < 1e-6 && fabs(uv[1] - v) < 1e-6);
        lowest = fmin(lowest, p[0] + p[1]);
        highest = fmax(highest, p[0] + p[1]);
    }
    assert_true(lowest == -2 && highest == 2);
    expect_faces(mesh, 1);
    rt_mesh_destroy(mesh);
}

/* Those of a plane are its own, however long its pixels are; those of a ridge lie between. */
static void normals_are_of_the_cells_around(void **state)
{
    static const char inside[] = "<texture type=\"bitmap\"><string name=\"filename\" "
                                 "value=\"h.pfm\"/></texture>%s";
    static const float ridge[9] = {0, 1, 0, 0, 1, 0, 0, 1, 0};
    float plane[15];
    char text[512];
    (void)state;
    for (int i = 0; i < 15; i++)
        plane[i] = 0.2f * (float)(i % 3) - 0.05f * (float)(i / 3); /* 0.2 x - 0.1 y, and more */
    write_image("h.pfm", plane, 3, 5);
    for (int turned = 0; turned < 2; turned++) {
        const double sign = turned ? -1 : 1, length = sqrt(1 + 0.04 + 0.01);
        snprintf(text, sizeof text, inside,
                 turned ? "<boolean name=\"flipNormals\" value=\"true\"/>" : "");
        rt_mesh *mesh = import_mesh_of(text);
        for (size_t i = 0; i < mesh->vertex_count; i++) {
            assert_true(fabs(mesh->normals[3 * i] + sign * 0.2 / length) < 1e-6);
            assert_true(fabs(mesh->normals[3 * i + 1] - sign * 0.1 / length) < 1e-6);
            assert_true(fabs(mesh->normals[3 * i + 2] - sign / length) < 1e-6);
        }
        expect_faces(mesh, sign);
        rt_mesh_destroy(mesh);
    }
    write_image("h.pfm", ridge, 3, 3);
    snprintf(text, sizeof text, inside, "");
    rt_mesh *mesh = import_mesh_of(text);
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const double x = mesh->positions[3 * i];
        const double slope = x > 0.5 || x < -0.5 ? copysign(1, x) : 2 * x; /* at the pixels only */
        if (fabs(x) == 1 || x == 0)
            assert_true(fabs(mesh->normals[3 * i] - slope * sqrt(0.5)) < 1e-6);
    }
    rt_mesh_destroy(mesh);
}

static void what_is_no_field_is_told(void **state)
{
    static const float grey[12] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
    static const char file[] = "<string name=\"filename\" value=\"h.pfm\"/>";
    static const struct {
        int columns, rows;
        const char *inside, *told;
    } cases[] = {
        {2, 2, "", "s.xml:1: a heightfield without an image file is left out"},
        {2, 2, "<texture type=\"checkerboard\"/>", "a heightfield without an image file is"},
        {2, 2, "<string name=\"filename\" value=\"g.pfm\"/>", "g.pfm"},
        {1, 2, file, "s.xml:1: a heightfield of 1 x 2 pixels is left out"},
        {4, 3, file, "s.xml:1: a heightfield keeps its 4 x 3 pixels"},
        {3, 2, "<string name=\"filename\" value=\"h.pfm\"/><float name=\"scael\" value=\"2\"/>",
         "did you mean 'scale'?"}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_image("h.pfm", grey, cases[i].columns, cases[i].rows);
        run run = import_field(cases[i].inside);
        expect_err(&run, cases[i].told);
        run_free(&run);
        expect_rtc(0, "check s.rts");
    }
    scratch_write("h.pfm", "no image");
    run run = import_field(file);
    expect_err(&run, "the image of a height field is left out");
    run_free(&run);
}

static void fields_of_pbrt_are_grids(void **state)
{
    static const char *const wrong[] = {"\"integer nu\" 3 \"integer nv\" 3 \"float Pz\" [1 2 3]",
                                        "\"integer nu\" 3 \"integer nv\" 1 \"float Pz\" [1 2 3]",
                                        "\"integer nu\" 2 \"integer nv\" 2", ""};
    (void)state;
    scratch_write("s.pbrt", "WorldBegin\nShape \"heightfield\" \"integer nu\" 3 \"integer nv\" 2 "
                            "\"float Pz\" [1 2 3 4 5 6]\n");
    run run = run_rtc("import s.pbrt --out s.rts");
    expect_status(&run, 0);
    expect_no_err(&run, "left out");
    run_free(&run);
    rt_mesh *mesh = load_mesh();
    assert_int_equal(mesh->vertex_count, 6);
    assert_int_equal(mesh->triangle_count, 4);
    for (size_t i = 0; i < 6; i++) {
        const float *const p = mesh->positions + 3 * i;
        assert_true(p[0] == 0.5 * (double)(i % 3) && p[1] == (double)(i / 3));
        assert_true(p[2] == (double)i + 1);
    }
    expect_faces(mesh, 1);
    rt_mesh_destroy(mesh);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        char text[256];
        snprintf(text, sizeof text, "WorldBegin\nShape \"heightfield\" %s\nLightSource \"point\"\n",
                 wrong[i]);
        scratch_write("s.pbrt", text);
        run = run_rtc("import s.pbrt --out s.rts");
        expect_status(&run, 0);
        expect_err(&run, "s.pbrt:2: a heightfield of ");
        run_free(&run);
    }
}

int main(void)
{
#define IN_SCRATCH(test) cmocka_unit_test_setup_teardown(test, scratch_enter, scratch_leave)
    const struct CMUnitTest tests[] = {
        IN_SCRATCH(patches_are_bilinear),
        IN_SCRATCH(normals_are_of_the_cells_around),
        IN_SCRATCH(what_is_no_field_is_told),
        IN_SCRATCH(fields_of_pbrt_are_grids),
    };
    if (spawn_find_rtc() != 0)
        return 1;
    return cmocka_run_group_tests_name("import_heights", tests, NULL, NULL);
}
