/*
 * test_far_mesh.c - meshes far from the origin: read and placed in double precision, so that a
 * transform that brings one back gives the mesh that was modelled there; and what is told.
 */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "lib/image/scratch.h"
#include "lib/mesh/sample.h"
#include "lib/scene/scenes.h"
#include "scene/scene.h"

enum { STEPS = 8, VERTICES = 2 * (STEPS + 1), TEXT = 8192 };

/* Where the maps of a country have it: metres to the east, to the north, and up. */
static const double far_away[3] = {448262.375, 5411932.6875, 312.25};

/* A staircase; its corners, and its quads as triangles. */
static void get_vertex(double p[3], int vertex)
{
    const int step = vertex / 2;
    p[0] = step / 64.0;
    p[1] = vertex % 2;
    p[2] = step / 4 / 16.0;
}

static void get_triangle(int corners[3], int triangle)
{
    static const int order[2][3] = {{0, 2, 3}, {0, 3, 1}};
    for (int i = 0; i < 3; i++)
        corners[i] = 2 * (triangle / 2) + order[triangle % 2][i];
}

typedef enum format { PLY_DOUBLE, PLY_ASCII, OBJ, OFF, STL, FORMATS } format;
static const char *const names[FORMATS] = {"d.ply", "a.ply", "a.obj", "a.off", "a.stl"};

static void add(sample *s, const char *format, ...)
{
    char line[256];
    va_list args;
    va_start(args, format);
    vsnprintf(line, sizeof line, format, args);
    va_end(args);
    sample_text(s, line);
}

static void add_vertex(sample *s, const char *before, const double offset[3], int vertex)
{
    double p[3];
    get_vertex(p, vertex);
    add(s, "%s%.17g %.17g %.17g\n", before, offset[0] + p[0], offset[1] + p[1], offset[2] + p[2]);
}

static void add_faces(sample *s, const char *before, int from)
{
    int t[3];
    for (int i = 0; i < 2 * STEPS; i++) {
        get_triangle(t, i);
        add(s, "%s %d %d %d\n", before, t[0] + from, t[1] + from, t[2] + from);
    }
}

static void add_ply(sample *s, const double offset[3], int is_double)
{
    const char *const type = is_double ? "double" : "float";
    add(s, "ply\nformat %s 1.0\nelement vertex %d\nproperty %s x\nproperty %s y\nproperty %s z\n",
        is_double ? "binary_big_endian" : "ascii", VERTICES, type, type, type);
    add(s, "element face %d\nproperty list uchar int vertex_indices\nend_header\n", 2 * STEPS);
    for (int i = 0; i < VERTICES; i++) {
        double p[3];
        get_vertex(p, i);
        if (!is_double)
            add_vertex(s, "", offset, i);
        for (int c = 0; c < 3 && is_double; c++)
            sample_f64(s, offset[c] + p[c], 1);
    }
    if (!is_double)
        add_faces(s, "3", 0);
    for (int i = 0; i < 2 * STEPS && is_double; i++) {
        int t[3];
        get_triangle(t, i);
        sample_u8(s, 3);
        for (int c = 0; c < 3; c++)
            sample_u32(s, (unsigned long)t[c], 1);
    }
}

static void add_stl(sample *s, const double offset[3])
{
    sample_text(s, "solid a\n");
    for (int i = 0; i < 2 * STEPS; i++) {
        int t[3];
        get_triangle(t, i);
        sample_text(s, "facet normal 0 0 0\nouter loop\n");
        for (int c = 0; c < 3; c++)
            add_vertex(s, "vertex ", offset, t[c]);
        sample_text(s, "endloop\nendfacet\n");
    }
    sample_text(s, "endsolid a\n");
}

static void write_mesh(format format, const double offset[3])
{
    sample s = {0};
    switch (format) {
    case PLY_DOUBLE:
    case PLY_ASCII:
        add_ply(&s, offset, format == PLY_DOUBLE);
        break;
    case OFF:
        add(&s, "OFF\n%d %d 0\n", VERTICES, 2 * STEPS);
        for (int i = 0; i < VERTICES; i++)
            add_vertex(&s, "", offset, i);
        add_faces(&s, "3", 0);
        break;
    case OBJ:
        for (int i = 0; i < VERTICES; i++)
            add_vertex(&s, "v ", offset, i);
        add_faces(&s, "f", 1);
        break;
    case STL:
        add_stl(&s, offset);
        break;
    case FORMATS:
        break;
    }
    scratch_write_bytes(names[format], s.data, s.size);
    sample_free(&s);
}

/* A scene with the mesh at an offset, placed `times` by a transform; the mesh is handle 0. */
static rt_scene *place(format format, const double offset[3], const rt_transform *transform,
                       int times, rt_mesh_info *info)
{
    rt_scene *scene = new_scene();
    rt_error error;
    uint32_t mesh;
    rt_surface surface = {.transform = *transform};
    write_mesh(format, offset);
    if (rt_scene_load_mesh(scene, &mesh, names[format], RT_SHADING_FILE, info, &error) != RT_OK)
        fail_msg("%s", error.message);
    for (int i = 0; i < times; i++)
        assert_int_equal(rt_scene_add_instance(scene, NULL, mesh, &surface, &error), RT_OK);
    return scene;
}

/* The map that first takes `from` to the origin, and then turns and shifts. */
static rt_transform after(const double from[3])
{
    static const double turn[3][4] = {{0.6, -0.8, 0, 0.25}, {0.8, 0.6, 0, -0.5}, {0, 0, 1, 2}};
    rt_transform t;
    for (int i = 0; i < 3; i++) {
        memcpy(t.m[i], turn[i], sizeof t.m[i]);
        for (int k = 0; k < 3; k++)
            t.m[i][3] -= turn[i][k] * from[k];
    }
    return t;
}

static void expect_vertices(const rt_scene *scene, const rt_scene *local, double slack)
{
    for (size_t i = 0; i < local->meshes[0].vertex_count; i++) {
        float at[3], expected[3];
        rt_scene_vertex(scene, scene->shapes, i, at);
        rt_scene_vertex(local, local->shapes, i, expected);
        for (int c = 0; c < 3; c++)
            assert_true(fabs((double)at[c] - expected[c]) <= slack);
    }
}

static size_t findings;
static char message[256];

static void on_finding(void *user, const rt_finding *finding)
{
    (void)user;
    if (finding->kind != RT_FINDING_ROUNDED)
        return;
    findings++;
    assert_int_equal(finding->severity, RT_SEVERITY_WARNING);
    snprintf(message, sizeof message, "%s", finding->message);
}

static size_t count_rounded(const rt_scene *scene)
{
    findings = 0;
    rt_scene_check(scene, on_finding, NULL);
    return findings;
}

static void a_transform_brings_a_far_mesh_back(void **state)
{
    (void)state;
    static const double here[3] = {0, 0, 0};
    static const rt_transform none;
    rt_transform back = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    for (int c = 0; c < 3; c++)
        back.m[c][3] = -far_away[c];
    for (format format = PLY_DOUBLE; format < FORMATS; format++)
        for (int times = 1; times <= 2; times++) {
            rt_mesh_info info;
            const rt_transform turned = after(far_away), turn = after(here);
            rt_scene *local = place(format, here, &none, times, &info);
            assert_int_equal(info.warnings.count, 0);
            rt_scene *scene = place(format, far_away, &back, times, &info);
            assert_int_equal(info.warnings.count, 0);
            assert_true(info.lo[1] == (float)far_away[1]);
            expect_vertices(scene, local, 0);
            assert_int_equal(count_rounded(scene), 0);
            rt_scene_destroy(scene);
            rt_scene_destroy(local);
            local = place(format, here, &turn, times, &info);
            scene = place(format, far_away, &turned, times, &info);
            expect_vertices(scene, local, 2e-7);
            rt_scene_destroy(scene);
            rt_scene_destroy(local);
        }
}

static void what_rounding_still_moves_is_told(void **state)
{
    (void)state;
    static const rt_transform none;
    rt_mesh_info info;
    rt_scene *scene = place(PLY_DOUBLE, far_away, &none, 1, &info);
    assert_int_equal(count_rounded(scene), 1);
    assert_non_null(strstr(message, "of 16 triangles by up to 0.19 m, 0.19 of a triangle"));
    rt_scene_destroy(scene);

    /* a mesh of single precision has the place that it says, wherever it is */
    static const float positions[3][3] = {{1e6f, 0, 0}, {1e6f + 1, 0, 0}, {1e6f, 1, 0}};
    static const uint32_t corners[3] = {0, 1, 2};
    rt_surface surface = {.material = 0};
    rt_error error;
    scene = new_scene();
    assert_int_equal(
        rt_scene_add_triangles(scene, NULL, positions[0], 3, corners, 1, NULL, &surface, &error),
        RT_OK);
    assert_true(scene->meshes[0].finest == sqrt(2));
    assert_int_equal(count_rounded(scene), 0);
    for (size_t i = 0; i < 3; i++) {
        float at[3];
        rt_scene_vertex(scene, scene->shapes, i, at);
        assert_memory_equal(at, positions[i], sizeof at);
    }
    rt_scene_destroy(scene);
}

/* Parts so small beside the whole that no one origin does for them. */
static void what_rounding_of_the_file_moves_is_told(void **state)
{
    (void)state;
    rt_mesh *mesh = sample_accept("a.obj", "v 0 0 0\nv 1e5 0 0\nv 0 1e5 0\nf 1 2 3\n"
                                           "v 90000.01 0 0\nv 90000.02 0 0\nv 90000.01 .01 0\n"
                                           "f 4 5 6\n");
    assert_int_equal(mesh->warnings.count, 1);
    assert_non_null(strstr(mesh->warnings.text[0],
                           "a.obj: single precision moves vertices of 1 of 2 triangles by up to"));
    rt_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_transform_brings_a_far_mesh_back),
        cmocka_unit_test(what_rounding_still_moves_is_told),
        cmocka_unit_test(what_rounding_of_the_file_moves_is_told),
    };
    return cmocka_run_group_tests_name("scene/far_mesh", tests, scratch_enter, scratch_leave);
}
