/* test_import_pbrt_shapes.c - shapes of pbrt that become meshes, and parameters of Attribute. */
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

#define TETRAHEDRON                                                                                \
    "\"point3 P\" [1 1 1 -1 -1 1 -1 1 -1 1 -1 -1] \"integer indices\" [0 2 1 0 1 3 0 3 2 1 2 3]"
#define OCTAHEDRON                                                                                 \
    "\"point3 P\" [2 0 0 -2 0 0 0 2 0 0 -2 0 0 0 2 0 0 -2]\n"                                      \
    "\"integer indices\" [0 2 4 2 1 4 1 3 4 3 0 4 2 0 5 1 2 5 3 1 5 0 3 5]"

/* Imports what stands in the world of a scene, whose warnings are returned. */
static run import(const char *text)
{
    char scene[2048];
    snprintf(scene, sizeof scene, "WorldBegin\n%s\n", text);
    scratch_write("s.pbrt", scene);
    run run = run_rtc("import s.pbrt --out s.rts");
    expect_status(&run, 0);
    return run;
}

static void expect_no_note(const run *run)
{
    expect_no_err(run, "became");
    expect_no_err(run, "left out");
}

/* The mesh of the only shape, of a scene without a note. To be destroyed. */
static rt_mesh *import_mesh_of(const char *text)
{
    static const char *const names[] = {"s_files/mesh_0.ply", "s_files/mesh_1.ply",
                                        "s_files/mesh_2.ply", "s_files/mesh_3.ply"};
    rt_mesh *mesh = NULL;
    rt_error error;
    for (int i = 0; i < 4; i++)
        remove(names[i]);
    run run = import(text);
    expect_no_note(&run);
    run_free(&run);
    for (int i = 0; i < 4 && !mesh; i++)
        if (rt_mesh_load(&mesh, names[i], NULL, &error) != RT_OK)
            mesh = NULL;
    assert_non_null(mesh);
    return mesh;
}

static void expect_point(const float *p, double x, double y, double z, double within)
{
    const double wanted[3] = {x, y, z};
    for (int c = 0; c < 3; c++)
        assert_true(fabs(p[c] - wanted[c]) <= within);
}

/* ---- Subdivision ------------------------------------------------------------- */

/* A face's normal by its corners, of any length. */
static void face_normal(const rt_mesh *mesh, size_t triangle, double out[3])
{
    double e[2][3];
    const uint32_t *v = mesh->indices + 3 * triangle;
    for (int i = 0; i < 2; i++)
        for (size_t c = 0; c < 3; c++)
            e[i][c] = mesh->positions[3 * v[i + 1] + c] - (double)mesh->positions[3 * v[0] + c];
    for (int c = 0; c < 3; c++)
        out[c] = e[0][(c + 1) % 3] * e[1][(c + 2) % 3] - e[0][(c + 2) % 3] * e[1][(c + 1) % 3];
}

/* How often the triangles run along an edge from a to b. */
static int count_runs(const rt_mesh *mesh, uint32_t a, uint32_t b)
{
    int count = 0;
    for (size_t i = 0; i < 3 * (size_t)mesh->triangle_count; i++)
        count += mesh->indices[i] == a && mesh->indices[i % 3 == 2 ? i - 2 : i + 1] == b;
    return count;
}

/* Expects a closed surface around the origin, which faces it, as its normals do. */
static void expect_closed(const rt_mesh *mesh)
{
    assert_int_equal(mesh->vertex_count, mesh->triangle_count / 2 + 2);
    for (size_t i = 0; i < 3 * (size_t)mesh->triangle_count; i++) {
        const uint32_t a = mesh->indices[i], b = mesh->indices[i % 3 == 2 ? i - 2 : i + 1];
        double normal[3], towards = 0, away = 0;
        assert_true(count_runs(mesh, a, b) == 1 && count_runs(mesh, b, a) == 1);
        face_normal(mesh, i / 3, normal);
        for (size_t c = 0; c < 3; c++) {
            towards += normal[c] * mesh->normals[3 * a + c];
            away += normal[c] * mesh->positions[3 * a + c];
        }
        assert_true(towards > 0 && away < 0);
    }
}

/* 1 - n w of a vertex and w of its n neighbours: w is 1/5 for 3, 1/8 for 4 of them. */
static void vertices_are_on_the_limit_surface(void **state)
{
    static const char *const levels[] = {"0", "1", "3"};
    const double slope = 1 / sqrt(3);
    (void)state;
    for (int i = 0; i < 3; i++) {
        char text[512];
        snprintf(text, sizeof text, "Shape \"loopsubdiv\" \"integer levels\" %s %s", levels[i],
                 TETRAHEDRON);
        rt_mesh *mesh = import_mesh_of(text);
        assert_int_equal(mesh->triangle_count, i == 0 ? 4 : i == 1 ? 16 : 256);
        expect_closed(mesh);
        expect_point(mesh->positions, 0.2, 0.2, 0.2, 1e-6);
        expect_point(mesh->normals, -slope, -slope, -slope, 1e-6);
        rt_mesh_destroy(mesh);
        snprintf(text, sizeof text, "Shape \"loopsubdiv\" \"integer levels\" %s %s", levels[i],
                 OCTAHEDRON);
        mesh = import_mesh_of(text);
        expect_closed(mesh);
        expect_point(mesh->positions, 1, 0, 0, 1e-6);
        expect_point(mesh->normals, -1, 0, 0, 1e-6);
        rt_mesh_destroy(mesh);
    }
}

/* New vertices: 3/8 of the ends of an edge, 1/8 of the corners beside it, then their limit. */
static void edges_are_split_by_their_four_corners(void **state)
{
    (void)state;
    rt_mesh *mesh = import_mesh_of("Shape \"loopsubdiv\" \"integer levels\" 1 " OCTAHEDRON);
    /* (0.75, 0.75, 0) by half, and a twelfth of 1.25 + 0.75 + 0.75, as those around it have. */
    float largest = 0;
    for (size_t i = 6; i < mesh->vertex_count; i++)
        for (int c = 0; c < 3; c++)
            largest = fmaxf(largest, fabsf(mesh->positions[3 * i + (size_t)c]));
    assert_true(fabsf(largest - 29.0f / 48) < 1e-6f);
    rt_mesh_destroy(mesh);
}

static void a_flat_grid_stays_flat(void **state)
{
    char text[2048] = "Shape \"loopsubdiv\" \"integer levels\" 2 \"point3 P\" [";
    (void)state;
    for (int i = 0; i < 25; i++)
        snprintf(text + strlen(text), sizeof text - strlen(text), "%d %d 5 ", i % 5, i / 5);
    strcat(text, "] \"integer indices\" [");
    for (int i = 0; i < 16; i++) {
        const int at = i % 4 + 5 * (i / 4);
        snprintf(text + strlen(text), sizeof text - strlen(text), "%d %d %d %d %d %d ", at, at + 1,
                 at + 6, at, at + 6, at + 5);
    }
    strcat(text, "]");
    rt_mesh *mesh = import_mesh_of(text);
    assert_int_equal(mesh->triangle_count, 32 * 16);
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        assert_true(fabsf(mesh->positions[3 * i + 2] - 5) < 1e-5f);
        expect_point(mesh->normals + 3 * i, 0, 0, -1, 1e-6);
    }
    expect_point(mesh->positions + 3 * 12, 2, 2, 5, 1e-6); /* the inner ones stay */
    rt_mesh_destroy(mesh);
}

/* A fan of seven neighbours has its tangents in its plane; ReverseOrientation turns it over. */
static void a_wide_fan_is_flat(void **state)
{
    (void)state;
    rt_mesh *mesh =
        import_mesh_of("ReverseOrientation Shape \"loopsubdiv\" \"integer levels\" 0\n"
                       "\"point3 P\" [0 0 3 1 0 3 .9 .5 3 .5 .8 3 0 1 3 -.5 .8 3 -.9 .5 3 -1 0 3]\n"
                       "\"integer indices\" [0 1 2 0 2 3 0 3 4 0 4 5 0 5 6 0 6 7]");
    expect_point(mesh->positions, 0, 0, 3, 1e-6);
    for (size_t i = 0; i < mesh->vertex_count; i++)
        expect_point(mesh->normals + 3 * i, 0, 0, 1, 1e-6);
    double normal[3];
    face_normal(mesh, 0, normal);
    assert_true(normal[2] > 0);
    rt_mesh_destroy(mesh);
}

/* At first 3/5 and 1/5 of its neighbours along it, at last 2/3 and 1/6: a cubic B-spline. */
static void a_boundary_is_a_spline(void **state)
{
    (void)state;
    rt_mesh *mesh = import_mesh_of("Shape \"loopsubdiv\" \"integer levels\" 0\n"
                                   "\"point3 P\" [0 0 0 6 0 0 0 6 0]");
    expect_point(mesh->positions, 1.2, 1.2, 0, 1e-6);
    rt_mesh_destroy(mesh);
    mesh = import_mesh_of("Shape \"loopsubdiv\" \"integer levels\" 6\n"
                          "\"point3 P\" [0 0 0 6 0 0 0 6 0]");
    expect_point(mesh->positions, 1, 1, 0, 1e-4);
    rt_mesh_destroy(mesh);
}

static void wrong_surfaces_stay_as_they_are(void **state)
{
    static const char *const cases[] = {
        "0 1 2 0 1 3",       /* two triangles run along an edge the same way */
        "0 1 2 1 0 3 0 1 4", /* three at an edge */
        "0 1 2 0 3 4",       /* two fans at a vertex */
        "0 1 2 0 1 1",       /* a corner twice */
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[512];
        snprintf(text, sizeof text,
                 "Shape \"loopsubdiv\" \"point3 P\" [0 0 0 1 0 0 0 1 0 0 0 1 0 2 2]\n"
                 "\"integer indices\" [%s]",
                 cases[i]);
        run run = import(text);
        expect_err(&run, "s.pbrt:2: a loopsubdiv became the triangles of its control mesh");
        run_free(&run);
        expect_rtc(0, "check s.rts");
    }
    run run = import("Shape \"loopsubdiv\" \"integer levels\" 99 \"point3 P\" [0 0 0 1 0 0 0 1 0]");
    expect_err(&run, "s.pbrt:2: a loopsubdiv of 99 levels became one of 6");
    run_free(&run);
}

/* A light emits on the side of its normals, however its corners run. */
static void meshes_face_their_normals(void **state)
{
    static const char *const words[] = {"", "ReverseOrientation"};
    (void)state;
    for (int i = 0; i < 4; i++) {
        char text[512];
        double normal[3];
        snprintf(text, sizeof text,
                 "%s Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]\n"
                 "\"integer indices\" [0 %s] \"normal N\" [0 0 -1 0 0 -1 0 0 -1]",
                 words[i % 2], i < 2 ? "1 2" : "2 1");
        rt_mesh *mesh = import_mesh_of(text);
        face_normal(mesh, 0, normal);
        assert_true(normal[2] == (i % 2 ? 1 : -1) && mesh->normals[2] == (i % 2 ? 1 : -1));
        rt_mesh_destroy(mesh);
    }
}

/* ---- Parts ------------------------------------------------------------------- */

/* A part, the area that it has, and the angle and length (or radius) at u = v = 1. */
static const struct {
    const char *text;
    double area, phi;
    double inner; /* of a disk; else 0 */
} parts[] = {
    {"Shape \"sphere\" \"float radius\" 2 \"float zmin\" -1 \"float zmax\" 1.5 "
     "\"float phimax\" 90",
     2 * 2.5 * 1.5707963, 1.5707963, 0},
    {"Shape \"sphere\" \"float radius\" 2 \"float phimax\" 180", 2 * 4 * 3.1415927, 3.1415927, 0},
    {"Shape \"cylinder\" \"float radius\" 2 \"float zmin\" -1 \"float zmax\" 1.5 "
     "\"float phimax\" 270",
     2 * 2.5 * 4.712389, 4.712389, 0},
    {"Shape \"disk\" \"float radius\" 2 \"float height\" 1 \"float innerradius\" 0.5 "
     "\"float phimax\" 60",
     (4 - 0.25) / 2 * 1.0471976, 1.0471976, 0.5},
    {"Texture \"t\" \"spectrum\" \"checkerboard\"\nMaterial \"diffuse\" \"texture reflectance\" "
     "\"t\"\nShape \"disk\" \"float radius\" 2",
     4 * 3.1415927, 6.2831853, 1e-12},
};

static double area_of(const rt_mesh *mesh)
{
    double sum = 0;
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        const float *v[3];
        double a[3], b[3];
        for (size_t k = 0; k < 3; k++)
            v[k] = mesh->positions + 3 * mesh->indices[3 * i + k];
        for (int c = 0; c < 3; c++) {
            a[c] = v[1][c] - v[0][c];
            b[c] = v[2][c] - v[0][c];
        }
        sum += sqrt(pow(a[1] * b[2] - a[2] * b[1], 2) + pow(a[2] * b[0] - a[0] * b[2], 2) +
                    pow(a[0] * b[1] - a[1] * b[0], 2)) /
               2;
    }
    return sum;
}

/* Each vertex is where pbrt has its u and v; the normals point outwards, or inwards if turned. */
static void parts_of_shapes_are_meshes(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        for (int is_turned = 0; is_turned < 2; is_turned++) {
            char text[512];
            const double side = is_turned ? -1 : 1;
            snprintf(text, sizeof text, "%s%s", is_turned ? "ReverseOrientation\n" : "",
                     parts[i].text);
            rt_mesh *mesh = import_mesh_of(text);
            assert_true(fabs(area_of(mesh) / parts[i].area - 1) < 4e-4);
            for (size_t k = 0; k < mesh->vertex_count; k++) {
                const float *p = mesh->positions + 3 * k, *n = mesh->normals + 3 * k,
                            *uv = mesh->uv + 2 * k;
                const double phi = uv[0] * parts[i].phi, across = hypot(p[0], p[1]);
                expect_point(p, across * cos(phi), across * sin(phi), p[2], 1e-5);
                if (parts[i].inner > 0) {
                    expect_point(n, 0, 0, side, 1e-6);
                    assert_true(fabs(across - 2 - uv[1] * (parts[i].inner - 2)) < 1e-5);
                } else if (strstr(parts[i].text, "sphere")) {
                    expect_point(n, side * p[0] / 2, side * p[1] / 2, side * p[2] / 2, 1e-5);
                } else {
                    expect_point(n, side * p[0] / 2, side * p[1] / 2, 0, 1e-5);
                    assert_true(fabs(p[2] + 1 - 2.5 * uv[1]) < 1e-5);
                }
            }
            rt_mesh_destroy(mesh);
        }
}

/* From its pole at -z to that at +z, by equal angles. */
static void a_sphere_that_emits_inwards_is_a_mesh(void **state)
{
    (void)state;
    rt_mesh *mesh = import_mesh_of("ReverseOrientation AreaLightSource \"diffuse\"\n"
                                   "Shape \"sphere\" \"float radius\" 2");
    for (size_t k = 0; k < mesh->vertex_count; k++) {
        const float *p = mesh->positions + 3 * k;
        const double v = mesh->uv[2 * k + 1];
        expect_point(mesh->normals + 3 * k, -p[0] / 2, -p[1] / 2, -p[2] / 2, 1e-5);
        assert_true(fabs(p[2] + 2 * cos(v * 3.14159265)) < 1e-5);
    }
    rt_mesh_destroy(mesh);
}

/* ---- Lights ------------------------------------------------------------------ */

/* The power of a light is pi times the area and the radiance, of one side or two. */
static void power_is_by_area(void **state)
{
    static const struct {
        const char *light, *shape, *radiance, *says;
    } cases[] = {
        {"9.8696044011", "\"disk\"", "radiance 1 1 1", NULL},
        {"9.8696044011", "\"sphere\" \"float radius\" 0.5", "radiance 1 1 1", NULL},
        {"9.8696044011 \"bool twosided\" true", "\"sphere\" \"float radius\" 0.5",
         "radiance 0.5 0.5 0.5", NULL},
        {"4.93480220055", "\"sphere\" \"float radius\" 0.5 \"float phimax\" 180", "radiance 1 1 1",
         NULL},
        {"9.8696044011 \"float scale\" 2 \"rgb L\" [1 2 3]",
         "\"cylinder\" \"float radius\" 0.5 \"float zmin\" 0", "radiance 2 4 6", NULL},
        {"3.14159265359", "\"bilinearmesh\" \"point3 P\" [0 0 0 2 0 0 0 2 0 2 2 0]",
         "radiance 1 1 1", NULL},
        {"6.28318530718", "\"trianglemesh\" \"point3 P\" [0 0 0 2 0 0 0 2 0]", "radiance 4 4 4",
         NULL},
        {"3.14159265359",
         "\"trianglemesh\" \"point3 P\" [0 0 0 2 0 0 0 2 0 4 2 0] \"integer indices\" [0 1 2 1 3 "
         "2]",
         "radiance 1", "the power of a light of unlike faces is spread evenly"},
        {"3", "\"loopsubdiv\" \"point3 P\" [0 0 0 1 0 0 0 1 0]", "radiance 1 1 1",
         "the power of a light of this shape is left out"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[500];
        /* Meshes are half as large where they stand. */
        snprintf(text, sizeof text, "%sAreaLightSource \"diffuse\" \"float power\" %s\nShape %s",
                 strstr(cases[i].shape, "mesh") ? "Scale .5 .5 .5\n" : "", cases[i].light,
                 cases[i].shape);
        run run = import(text);
        expect_in_file("s.rts", cases[i].radiance);
        if (cases[i].says)
            expect_err(&run, cases[i].says);
        else
            expect_no_note(&run);
        run_free(&run);
    }
}

static void objects_are_placed_without_their_lights(void **state)
{
    (void)state;
    run run = import("ObjectBegin \"o\"\nAreaLightSource \"diffuse\" \"rgb L\" [7 7 7]\n"
                     "Shape \"sphere\"\nObjectEnd\nObjectInstance \"o\"");
    expect_err(&run, "s.pbrt:4: an area light inside of an object is left out, as by pbrt");
    run_free(&run);
    expect_in_file("s.rts", "sphere");
    expect_not_in_file("s.rts", "radiance 7");
}

/* What has no area or no end is left out, with the numbers that make it so. */
static void shapes_without_area_are_left_out(void **state)
{
    static const struct {
        const char *shape, *says;
    } cases[] = {
        {"\"sphere\" \"float radius\" -1", "a sphere of radius -1, from z"},
        {"\"sphere\" \"float phimax\" -5", "from z -1 to 1, phimax -5, is left out"},
        {"\"sphere\" \"float zmin\" 2 \"float zmax\" 3", "of radius 1, from z 2 to 3, phimax 360"},
        {"\"disk\" \"float innerradius\" 2", "a disk of radius 1, innerradius 2"},
        {"\"sphere\" \"float radius\" 1e30", "a sphere of radius 1e+30"},
        {"\"cylinder\" \"float zmin\" -1e20", "from z -1e+20 to 1"},
        {"\"disk\" \"float height\" 1e20", "a disk of radius 1, "},
        {"\"cylinder\" \"float radius\" 0", "a cylinder of radius 0, from z -1 to 1"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[300];
        snprintf(text, sizeof text, "Shape \"sphere\"\nShape %s", cases[i].shape);
        run run = import(text);
        expect_err(&run, "s.pbrt:3: ");
        expect_err(&run, cases[i].says);
        run_free(&run);
    }
}

/* ---- Curves ------------------------------------------------------------------ */

/* Expects a tube along the first axis, u from 0 to 1 in each of `segments` of equal length. */
static void expect_tube(const char *text, double from, double to, double radius, int segments)
{
    rt_mesh *mesh = import_mesh_of(text);
    assert_int_equal(mesh->triangle_count, segments * 4 * 2 * 24);
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const float *p = mesh->positions + 3 * i, *n = mesh->normals + 3 * i;
        const double along = (p[0] - from) / (to - from) * segments, u = mesh->uv[2 * i];
        assert_true(p[0] > from - 1e-5 && p[0] < to + 1e-5);
        assert_true(fabs(hypot(p[1], p[2]) - radius) < 1e-5);
        expect_point(n, 0, p[1] / radius, p[2] / radius, 1e-5);
        assert_true(fabs(along - u - floor(along - u + 0.5)) < 1e-5);
    }
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        double normal[3];
        const float *p = mesh->positions + 3 * mesh->indices[3 * i];
        face_normal(mesh, i, normal);
        assert_true(normal[1] * p[1] + normal[2] * p[2] > 0);
    }
    rt_mesh_destroy(mesh);
}

static void curves_become_tubes(void **state)
{
    (void)state;
    expect_tube("Shape \"curve\" \"string type\" \"cylinder\" \"float width\" 0.5\n"
                "\"integer splitdepth\" 2 \"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0]",
                0, 3, 0.25, 1);
    expect_tube("Shape \"curve\" \"string type\" \"cylinder\" \"float width\" 0.5\n"
                "\"integer degree\" 2 \"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0 4 0 0]",
                0, 4, 0.25, 2);
    expect_tube("Shape \"curve\" \"string type\" \"cylinder\" \"string basis\" \"bspline\"\n"
                "\"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0 4 0 0]",
                1, 3, 0.5, 2);
    expect_tube("Shape \"curve\" \"string type\" \"cylinder\" \"string basis\" \"bspline\"\n"
                "\"integer degree\" 2 \"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0]",
                0.5, 2.5, 0.5, 2);
    run run = import("Shape \"curve\" \"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0]");
    expect_err(&run, "s.pbrt:2: a flat curve became a tube of its width");
    run_free(&run);
}

/* The ends of a bent curve are its end points, its middle by the weights 1 3 3 1 or 1 2 1. */
static void curves_follow_their_points(void **state)
{
    static const struct {
        const char *text;
        double middle[2];
    } cases[] = {
        {"\"point3 P\" [0 0 0 0 4 0 4 4 0 4 0 0]", {2, 3}},
        {"\"integer degree\" 2 \"point3 P\" [0 0 0 2 4 0 4 0 0]", {2, 2}},
        {"\"string basis\" \"bspline\" \"point3 P\" [-4 -8 0 0 1 0 4 1 0 8 -8 0]", {2, 0.625}}};
    (void)state;
    for (int i = 0; i < 3; i++) {
        char text[512];
        double nearest = 1;
        snprintf(text, sizeof text,
                 "Shape \"curve\" \"string type\" \"ribbon\" \"normal N\" [0 0 2 0 0 1]\n"
                 "\"float width\" 0.01 %s",
                 cases[i].text);
        rt_mesh *mesh = import_mesh_of(text);
        for (size_t k = 0; k < mesh->vertex_count; k++)
            nearest = fmin(nearest, hypot(mesh->positions[3 * k] - cases[i].middle[0],
                                          mesh->positions[3 * k + 1] - cases[i].middle[1]));
        assert_true(nearest < 0.0051 + 0.05 * (mesh->triangle_count / 2 % 2));
        rt_mesh_destroy(mesh);
    }
}

/* It faces its normals, which turn at an even rate; v grows to the right of who looks along it. */
static void ribbons_lie_across_their_normals(void **state)
{
    (void)state;
    rt_mesh *mesh = import_mesh_of("Shape \"curve\" \"string type\" \"ribbon\" \"float width0\" 2\n"
                                   "\"float width1\" 4 \"normal N\" [0 0 1 0 1 0]\n"
                                   "\"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0]");
    const size_t last = 3 * (mesh->vertex_count - 2), half = 3 * (mesh->vertex_count / 2 - 1);
    assert_int_equal(mesh->vertex_count, 10);
    expect_point(mesh->positions, 0, 1, 0, 1e-6);
    expect_point(mesh->positions + 3, 0, -1, 0, 1e-6);
    assert_true(mesh->uv[0] == 0 && mesh->uv[1] == 0 && mesh->uv[3] == 1);
    expect_point(mesh->normals, 0, 0, 1, 1e-6);
    expect_point(mesh->normals + half, 0, sqrt(0.5), sqrt(0.5), 1e-6);
    expect_point(mesh->positions + last, 3, 0, -2, 1e-6);
    expect_point(mesh->normals + last, 0, 1, 0, 1e-6);
    double normal[3];
    face_normal(mesh, 0, normal);
    assert_true(normal[2] > 0);
    rt_mesh_destroy(mesh);
}

/* Curves of one surface share a mesh, others and those of an object do not. */
static void curves_share_meshes(void **state)
{
    static const char *const curve =
        "Shape \"curve\" \"string type\" \"cylinder\" \"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0]\n";
    char text[1024];
    (void)state;
    snprintf(text, sizeof text, "%s%s", curve, curve);
    rt_mesh *mesh = import_mesh_of(text);
    assert_int_equal(mesh->triangle_count, 2 * 4 * 2 * 24);
    rt_mesh_destroy(mesh);
    expect_no_file("s_files/mesh_2.ply");
    snprintf(text, sizeof text, "%sTranslate 0 1 0\n%s", curve, curve);
    run run = import(text);
    run_free(&run);
    expect_in_file("s.rts", "instance mesh_4 { material material_0  matrix 1 0 0 0 0 1 0 1 ");
    snprintf(text, sizeof text,
             "%sObjectBegin \"o\"\n%sObjectEnd\nTranslate 0 1 0\n%sObjectInstance \"o\"\n", curve,
             curve, curve);
    run = import(text);
    run_free(&run);
    expect_in_file("s.rts", "instance mesh_2 { material material_0 }");
    expect_in_file("s.rts", "instance mesh_4 { material material_0  matrix 1 0 0 0 0 1 0 1 ");
    expect_in_file("s.rts", "instance mesh_6 { material material_0  matrix 1 0 0 0 0 1 0 1 ");
}

static void wrong_curves_are_told(void **state)
{
    static const struct {
        const char *text, *says;
        int status;
    } cases[] = {
        {"\"point3 P\" [0 0 0 1 0 0 2 0 0]", "of 9 numbers is no bezier curve of degree 3", 1},
        {"\"point3 P\" [0 0 0 1 0 0 2 0 0 3 0]", "of 11 numbers is no bezier", 1},
        {"\"integer degree\" 2 \"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0]", "of 12 numbers", 1},
        {"\"string basis\" \"bspline\" \"point3 P\" [0 0 0]", "is no bspline curve", 1},
        {"", "of 0 numbers", 1},
        {"\"integer degree\" 4 \"point3 P\" [0 0 0]",
         "a curve of basis 'bezier' and degree 4 is left out", 1},
        {"\"string basis\" \"hermite\"", "a curve of basis 'hermite'", 1},
        {"\"string type\" \"ribbon\" \"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0]",
         "a ribbon of 1 segments is left out: it takes 2 normals", 1},
        {"\"float width\" -1 \"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0]",
         "a curve of width -1 to -1 is left out", 1},
        {"\"string type\" \"wire\" \"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0]",
         "a curve of type 'wire' became a tube", 0},
        {"\"point3 P\" [0 0 0 1e20 0 0 -1e20 0 0 3 0 0]", "it must lie within", 1},
        {"\"string type\" \"cylinder\" \"point3 P\" [1 1 1 1 1 1 1 1 1 1 1 1]",
         "without a triangle that has an area", 1},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[512];
        snprintf(text, sizeof text, "WorldBegin\nShape \"curve\" %s\n", cases[i].text);
        scratch_write("w.pbrt", text);
        run run = run_rtc("import w.pbrt --out w.rts");
        expect_status(&run, cases[i].status);
        expect_err(&run, "w.pbrt:2: ");
        expect_err(&run, cases[i].says);
        run_free(&run);
    }
}

/* ---- Attribute --------------------------------------------------------------- */

/* They are of those directives of their target in the block that do not say otherwise. */
static void attributes_are_defaults_of_their_block(void **state)
{
    (void)state;
    run run = import("AttributeBegin\nAttribute \"shape\" \"float radius\" 2\nShape \"sphere\"\n"
                     "Shape \"sphere\" \"float radius\" 3\n"
                     "AttributeBegin\nAttribute \"shape\" \"float radius\" 4\nShape \"sphere\"\n"
                     "AttributeEnd\nTranslate 0 5 0\nShape \"sphere\"\nAttributeEnd\n"
                     "Translate 0 6 0\nShape \"sphere\"\n");
    expect_no_note(&run);
    run_free(&run);
    expect_in_file("s.rts", "radius 2  material material_0 }");
    expect_in_file("s.rts", "radius 3 ");
    expect_in_file("s.rts", "radius 4 ");
    expect_in_file("s.rts", "radius 2  material material_0  matrix 1 0 0 0 0 1 0 5 0");
    expect_in_file("s.rts", "radius 1  material material_0  matrix 1 0 0 0 0 1 0 6 0");
}

static void attributes_have_targets(void **state)
{
    (void)state;
    run run = import("Attribute \"light\" \"rgb I\" [1 2 3] \"rgb L\" [4 5 6]\n"
                     "Attribute \"material\" \"rgb reflectance\" [0.1 0.2 0.3]\n"
                     "Attribute \"texture\" \"float uscale\" 7\n"
                     "Attribute \"medium\" \"rgb sigma_s\" [8 9 10] \"rgb sigma_a\" [0 0 0]\n"
                     "LightSource \"point\"\nMaterial \"diffuse\"\nShape \"disk\"\n"
                     "Texture \"t\" \"spectrum\" \"checkerboard\"\n"
                     "Material \"diffuse\" \"texture reflectance\" \"t\"\n"
                     "AreaLightSource \"diffuse\"\n"
                     "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]\n"
                     "MakeNamedMedium \"m\" \"string type\" \"homogeneous\"\n"
                     "MediumInterface \"m\" \"\" Material \"interface\" Shape \"sphere\"\n");
    expect_no_note(&run);
    run_free(&run);
    expect_in_file("s.rts", "intensity 1 2 3");
    expect_in_file("s.rts", "kd 0.1 0.2 0.3");
    expect_in_file("s.rts", "scale 7 1");
    expect_in_file("s.rts", "radiance 4 5 6");
    expect_in_file("s.rts", "scattering 8 9 10");
}

static void attributes_that_do_nothing_are_told(void **state)
{
    (void)state;
    run run = import("Attribute \"shape\" \"float radus\" 2\nAttribute \"camera\" \"float fov\" 2\n"
                     "Attribute \"light\" \"float scale\" 2\nShape \"sphere\"\n");
    expect_err(&run, "s.pbrt:2: \"float radus\" of an Attribute is left out");
    expect_err(&run, "s.pbrt:3: an Attribute of 'camera' is left out");
    expect_no_err(&run, "scale");
    run_free(&run);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_enter, scratch_leave)
    const struct CMUnitTest tests[] = {
        TEST(vertices_are_on_the_limit_surface),
        TEST(edges_are_split_by_their_four_corners),
        TEST(a_flat_grid_stays_flat),
        TEST(a_wide_fan_is_flat),
        TEST(a_boundary_is_a_spline),
        TEST(wrong_surfaces_stay_as_they_are),
        TEST(meshes_face_their_normals),
        TEST(parts_of_shapes_are_meshes),
        TEST(a_sphere_that_emits_inwards_is_a_mesh),
        TEST(power_is_by_area),
        TEST(objects_are_placed_without_their_lights),
        TEST(shapes_without_area_are_left_out),
        TEST(curves_become_tubes),
        TEST(curves_follow_their_points),
        TEST(ribbons_lie_across_their_normals),
        TEST(curves_share_meshes),
        TEST(wrong_curves_are_told),
        TEST(attributes_are_defaults_of_their_block),
        TEST(attributes_have_targets),
        TEST(attributes_that_do_nothing_are_told),
    };
    if (spawn_find_rtc() != 0)
        return 1;
    return cmocka_run_group_tests_name("import_pbrt_shapes", tests, NULL, NULL);
}
