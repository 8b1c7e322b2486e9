/* test_vertices.c - normals and colours of mesh vertices, seen by the modes normals and albedo. */
#include "support.h"

#include <math.h>
#include <string.h>

enum { spots = 5 };

static rt_error error;

static const float corners[3][3] = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
static const uint32_t indices[3] = {0, 1, 2};

/* Barycentric weights of the three corners. */
static const double weights[spots][3] = {{1 / 3.0, 1 / 3.0, 1 / 3.0},
                                         {0.9, 0.05, 0.05},
                                         {0.05, 0.9, 0.05},
                                         {0.05, 0.05, 0.9},
                                         {0.1, 0.3, 0.6}};

/* A placement that keeps the plane z = 0, but shears what stands on it; and the same mirrored. */
static const rt_transform placements[] = {
    {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}},
    {{{4, 0.3f, 0.2f, 0.5f}, {0, 0.5f, 0.4f, -2}, {0, 0, 3, 0}}},
    {{{-4, 0.3f, 0.2f, 0.5f}, {0, 0.5f, 0.4f, -2}, {0, 0, 3, 0}}}};

/* A triangle of these vertices, and, for an instance, a second one elsewhere. */
static rt_scene *triangle(const rt_mesh_data *attributes, const rt_material *material,
                          const rt_transform *placement, int is_instance)
{
    rt_mesh_data mesh = *attributes;
    rt_surface surface;
    rt_scene *scene = NULL;
    uint32_t handle;
    memset(&surface, 0, sizeof surface);
    mesh.positions = corners[0];
    mesh.indices = indices;
    mesh.vertex_count = 3;
    mesh.triangle_count = 1;
    surface.transform = *placement;
    expect_ok(rt_scene_create(&scene, &error), &error);
    expect_ok(rt_scene_add_material(scene, NULL, NULL, material, &error), &error);
    expect_ok(rt_scene_add_mesh(scene, &handle, &mesh, &error), &error);
    expect_ok(rt_scene_add_instance(scene, NULL, handle, &surface, &error), &error);
    surface.transform.m[2][3] -= 100;
    if (is_instance)
        expect_ok(rt_scene_add_instance(scene, NULL, handle, &surface, &error), &error);
    return scene;
}

/*
 * What a mode shows at a spot of the placed triangle: one pixel, too small for anything to change
 * across it.
 */
static void look(float rgb[3], rt_scene *scene, const rt_transform *placement,
                 const double weight[3], rt_mode mode)
{
    rt_render_options options = {
        .width = 1, .height = 1, .mode = mode, .spp = mode == RT_MODE_PATH ? 16384 : 4};
    rt_camera camera = {.kind = RT_CAMERA_ORTHOGRAPHIC, .width = 1e-4f, .eye = {0, 0, 5}};
    rt_renderer *renderer = NULL;
    rt_film *film = NULL;
    for (int i = 0; i < 2; i++) {
        double at = placement->m[i][3];
        for (int j = 0; j < 2; j++)
            for (int c = 0; c < 3; c++)
                at += placement->m[i][j] * weight[c] * corners[c][j];
        camera.eye[i] = camera.look_at[i] = (float)at;
    }
    expect_ok(rt_scene_set_camera(scene, &camera, &error), &error);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    memcpy(rgb, rt_film_rgb(film), 3 * sizeof *rgb);
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
}

/* The solution of the transposed upper rows for n, which maps normals: Cramer's rule. */
static void map_normal(double out[3], const rt_transform *t, const double n[3])
{
    double length = 0;
    for (int i = 0; i < 3; i++) {
        const double *a = t->m[(i + 1) % 3], *b = t->m[(i + 2) % 3];
        out[i] = n[0] * (a[1] * b[2] - a[2] * b[1]) + n[1] * (a[2] * b[0] - a[0] * b[2]) +
                 n[2] * (a[0] * b[1] - a[1] * b[0]);
        length += out[i] * out[i];
    }
    for (int i = 0; i < 3; i++)
        out[i] /= sqrt(length) * (out[2] < 0 ? -1 : 1);
}

/*
 * The mix of the corners' unit normals, mapped; whether the mesh is placed once or is an instance.
 */
static void normals_are_mixed_and_then_placed(void **state)
{
    /* one not a unit */
    static const float normals[3][3] = {{0.6f, 0, 0.8f}, {0, 3, 4}, {-0.48f, -0.64f, 0.6f}};
    static const double units[3][3] = {{0.6, 0, 0.8}, {0, 0.6, 0.8}, {-0.48, -0.64, 0.6}};
    const rt_mesh_data attributes = {.normals = normals[0]};
    const rt_material white = {.kd = {1, 1, 1}};
    (void)state;
    for (size_t p = 0; p < sizeof placements / sizeof *placements; p++)
        for (int is_instance = 0; is_instance < 2; is_instance++) {
            rt_scene *scene = triangle(&attributes, &white, placements + p, is_instance);
            for (int s = 0; s < spots; s++) {
                double mixed[3] = {0, 0, 0}, n[3], dot = 0;
                float seen[3];
                for (int i = 0; i < 3; i++)
                    for (int c = 0; c < 3; c++)
                        mixed[i] += weights[s][c] * units[c][i];
                map_normal(n, placements + p, mixed);
                look(seen, scene, placements + p, weights[s], RT_MODE_NORMALS);
                for (int i = 0; i < 3; i++) {
                    assert_float_equal(2 * seen[i] - 1, n[i], 3e-4);
                    dot += n[i] * n[i];
                }
                assert_float_equal(dot, 1, 1e-9);
            }
            rt_scene_destroy(scene);
        }
}

/* Corners' colours are mixed and multiply kd. */
static void colours_are_mixed(void **state)
{
    static const float colours[3][3] = {{1, 0, 0.5f}, {0.2f, 1, 0}, {0, 0.3f, 1}};
    const rt_mesh_data attributes = {.colours = colours[0]};
    const rt_material material = {.kd = {0.5f, 0.6f, 0.7f}, .ks = {0.1f, 0.1f, 0.1f}};
    (void)state;
    for (int is_instance = 0; is_instance < 2; is_instance++) {
        rt_scene *scene = triangle(&attributes, &material, placements + 1, is_instance);
        for (int s = 0; s < spots; s++) {
            float seen[3];
            look(seen, scene, placements + 1, weights[s], RT_MODE_ALBEDO);
            for (int i = 0; i < 3; i++) {
                double mixed = 0;
                for (int c = 0; c < 3; c++)
                    mixed += weights[s][c] * colours[c][i];
                assert_float_equal(seen[i], material.kd[i] * mixed + material.ks[i], 3e-4);
            }
        }
        rt_scene_destroy(scene);
    }
}

/*
 * Colours above 1 may ask for more light than arrives: then all that is scattered is scaled down,
 * its hue kept.
 */
static void colours_above_one_gain_no_energy(void **state)
{
    static const float colours[3][3] = {{4, 1, 0}, {4, 1, 0}, {4, 1, 0}};
    static const double expected[3] = {1, 0.75 / 2.25, 0.25 / 2.25};
    const rt_mesh_data attributes = {.colours = colours[0]};
    const rt_material material = {.kd = {0.5f, 0.5f, 0.5f}, .ks = {0.25f, 0.25f, 0.25f}};
    float seen[3];
    (void)state;
    rt_scene *scene = triangle(&attributes, &material, placements, 0);
    look(seen, scene, placements, weights[0], RT_MODE_ALBEDO);
    for (int i = 0; i < 3; i++)
        assert_float_equal(seen[i], expected[i], 1e-5);

    /* So path tracing has it under an even sky: in red, all that arrives. */
    rt_environment sky = {.radiance = {1, 1, 1}};
    expect_ok(rt_scene_set_environment(scene, &sky, &error), &error);
    look(seen, scene, placements, weights[0], RT_MODE_PATH);
    for (int i = 0; i < 3; i++)
        assert_float_equal(seen[i], expected[i], 5e-3);
    rt_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(normals_are_mixed_and_then_placed),
        cmocka_unit_test(colours_are_mixed),
        cmocka_unit_test(colours_above_one_gain_no_energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
