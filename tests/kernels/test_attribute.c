/* test_attribute.c - attributes of meshes on the device, against the numbers of their corners. */
#include "support.h"

#include <math.h>
#include <string.h>

#include "render/renderer.h"
#include "types.h"

enum { points = 512, vertices = 5, triangles = 2 };

/* Two triangles that share no vertex 0, so that a vertex is not its corner. */
static const float positions[vertices][3] = {{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
static const uint32_t indices[triangles][3] = {{1, 2, 3}, {4, 1, 3}};
static const float own_uv[vertices][2] = {{7, 7}, {0, 0}, {1, 0}, {1, 1}, {0, 1}},
                   second[vertices][2] = {{7, 7},
                                          {0.1f, 0.2f},
                                          {0.9f, 0.3f},
                                          {0.4f, 0.7f},
                                          {0.6f, 0.05f}},
                   by_triangle[triangles][2] = {{0.5f, 0.25f}, {0.5f, 0.75f}},
                   wear[vertices] = {7, 0.25f, 0.5f, 1, 0},
                   tint[triangles][3] = {{0.1f, 0.2f, 0.3f}, {0.4f, 0.5f, 0.6f}};
static const rt_mesh_attribute attributes[] = {
    {.name = "by_triangle", .values = by_triangle[0], .width = 2, .of_triangles = 1},
    {.name = "second", .values = second[0], .width = 2},
    {.name = "tint", .values = tint[0], .width = 3, .of_triangles = 1},
    {.name = "wear", .values = wear, .width = 1}};

/* A scene of the mesh, placed so many times, whose material has this texture. */
static rt_scene *mesh_scene(const rt_texture *textures, size_t count, int placed)
{
    const rt_mesh_data mesh = {.positions = positions[0],
                               .uv = own_uv[0],
                               .indices = indices[0],
                               .vertex_count = vertices,
                               .triangle_count = triangles,
                               .attributes = attributes,
                               .attribute_count = sizeof attributes / sizeof *attributes};
    rt_scene *scene = NULL;
    rt_material material = {.kd = {0.5f, 0.5f, 0.5f}};
    rt_surface surface = {.material = 0};
    rt_error error;
    uint32_t handle;
    expect_ok(rt_scene_create(&scene, &error), &error);
    for (size_t i = 0; i < count; i++)
        expect_ok(rt_scene_add_texture(scene, &material.kd_texture, textures + i, &error), &error);
    expect_ok(rt_scene_add_material(scene, &surface.material, NULL, &material, &error), &error);
    expect_ok(rt_scene_add_mesh(scene, &handle, &mesh, &error), &error);
    for (int i = 0; i < placed; i++)
        expect_ok(rt_scene_add_instance(scene, NULL, handle, &surface, &error), &error);
    return scene;
}

static void make_points(float at[points][4])
{
    uint32_t seed = 5;
    for (int i = 0; i < points; i++) {
        float r[2];
        for (int k = 0; k < 2; k++) {
            seed = seed * 1664525u + 1013904223u;
            r[k] = (float)(seed >> 8) / 16777216;
        }
        at[i][0] = r[0] + r[1] > 1 ? 1 - r[0] : r[0];
        at[i][1] = r[0] + r[1] > 1 ? 1 - r[1] : r[1];
        at[i][2] = (float)(i % triangles);
        at[i][3] = 0;
    }
}

/* Evaluates the texture of this handle on the first shape, and destroys the scene. */
static void evaluate(rt_scene *scene, uint32_t handle, float at[points][4], float out[points][4])
{
    rt_renderer *renderer = NULL;
    rt_error error;
    const cl_uint count = points, texture = handle - 1;
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    cl_kernel kernel = test_kernel("texture", "on_mesh");
    cl_mem in = test_buffer(points * sizeof at[0], at),
           result = test_buffer(points * sizeof out[0], NULL);
    rt_arg args[] = {RT_ARG(count), RT_ARG(renderer->scene), RT_ARG(texture), RT_ARG(in),
                     RT_ARG(result)};
    test_run(kernel, args, 5, count);
    test_read(result, points * sizeof out[0], out);
    rt_buffer_release(test_device(), result);
    rt_buffer_release(test_device(), in);
    rt_kernel_release(kernel);
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
}

/* The second coordinate of an attribute of two numbers, mixed over a triangle. */
static double mixed_v(const float (*numbers)[2], const float at[4])
{
    const uint32_t *corner = indices[(int)at[2]];
    return (1 - (double)at[0] - at[1]) * (double)numbers[corner[0]][1] +
           (double)at[0] * (double)numbers[corner[1]][1] +
           (double)at[1] * (double)numbers[corner[2]][1];
}

static void coordinates_are_mixed_from_the_corners(void **state)
{
    (void)state;
    static float at[points][4], out[points][4];
    const rt_texture ramp = {.kind = RT_TEXTURE_GRADIENT,
                             .b = {0.25f, 0.5f, 0.75f},
                             .attribute = "second",
                             .scale = {1, 0.5f}};
    make_points(at);
    for (int placed = 1; placed <= 2; placed++) { /* alone, and as an instance */
        evaluate(mesh_scene(&ramp, 1, placed), 1, at, out);
        for (int i = 0; i < points; i++)
            for (int c = 0; c < 3; c++)
                assert_float_equal(out[i][c], (c + 1) * 0.125 * mixed_v(second, at[i]), 1e-6);
    }
}

static void those_of_triangles_are_the_same_all_over(void **state)
{
    (void)state;
    static float at[points][4], out[points][4];
    const rt_texture ramp = {
        .kind = RT_TEXTURE_GRADIENT, .b = {1, 1, 1}, .attribute = "by_triangle"};
    make_points(at);
    evaluate(mesh_scene(&ramp, 1, 1), 1, at, out);
    for (int i = 0; i < points; i++)
        assert_float_equal(out[i][0], at[i][2] == 0 ? 0.25 : 0.75, 1e-6);
}

/* Each part of a mixture is looked up by its own, and what names none by u and v. */
static void textures_inside_have_their_own(void **state)
{
    (void)state;
    static float at[points][4], out[points][4];
    const rt_texture all[] = {
        {.kind = RT_TEXTURE_GRADIENT, .b = {1, 1, 1}, .attribute = "second"},
        {.kind = RT_TEXTURE_GRADIENT, .b = {1, 1, 1}},
        {.kind = RT_TEXTURE_GRADIENT, .b = {1, 1, 1}, .attribute = "by_triangle"},
        {.kind = RT_TEXTURE_MIX, .a_texture = 1, .b_texture = 2, .weight_texture = 3},
        /* a checker whose squares are by one set, the colours by others */
        {.kind = RT_TEXTURE_CHECKER,
         .a_texture = 4,
         .b_texture = 2,
         .attribute = "by_triangle",
         .scale = {1, 2}}};
    make_points(at);
    evaluate(mesh_scene(all, 5, 1), 5, at, out);
    for (int i = 0; i < points; i++) {
        const double a = mixed_v(second, at[i]), b = mixed_v(own_uv, at[i]),
                     expected = at[i][2] == 0 ? 0.75 * a + 0.25 * b : b;
        assert_float_equal(out[i][1], expected, 1e-6);
    }
}

/* One number is grey; a product has the attribute as it is, wherever it is moved. */
static void patterns_show_attributes(void **state)
{
    (void)state;
    static float at[points][4], out[points][4];
    const rt_texture all[] = {{.kind = RT_TEXTURE_ATTRIBUTE, .attribute = "wear"},
                              {.kind = RT_TEXTURE_ATTRIBUTE, .attribute = "tint"},
                              {.kind = RT_TEXTURE_MULTIPLY,
                               .a_texture = 1,
                               .b_texture = 2,
                               .b = {0.5f, 1, 1},
                               .scale = {3, 3}}};
    make_points(at);
    for (uint32_t handle = 1; handle <= 3; handle++) {
        evaluate(mesh_scene(all, 3, 1), handle, at, out);
        for (int i = 0; i < points; i++) {
            const int triangle = (int)at[i][2];
            const uint32_t *corner = indices[triangle];
            const double grey = (1 - (double)at[i][0] - at[i][1]) * wear[corner[0]] +
                                (double)at[i][0] * wear[corner[1]] +
                                (double)at[i][1] * wear[corner[2]];
            for (int c = 0; c < 3; c++) {
                const double colour = (handle == 3 && c == 0 ? 0.5 : 1) * tint[triangle][c];
                assert_float_equal(out[i][c], (handle == 2 ? 1 : grey) * (handle == 1 ? 1 : colour),
                                   1e-6);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coordinates_are_mixed_from_the_corners),
        cmocka_unit_test(those_of_triangles_are_the_same_all_over),
        cmocka_unit_test(textures_inside_have_their_own),
        cmocka_unit_test(patterns_show_attributes),
    };
    return cmocka_run_group_tests_name("kernels/attribute", tests, NULL, NULL);
}
