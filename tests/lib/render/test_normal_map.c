/*
 * test_normal_map.c - normal maps: shading normals are those of tangent space, by both conventions
 * of y and where v runs the other way, what cannot be a normal is refused or left as it is, and
 * paths, photons, vertex connection and merging agree.
 */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "kernels/statistics.h"
#include "lib/render/means.h"
#include "render/renderer.h"

/* ---- Tangent space ---------------------------------------------------------------- */

/* What a ray hits, as tests/kernels/bump.cl has it. */
typedef struct row {
    float position[3], u, normal[3], v;
    float along_u[3], unused0, along_v[3], unused1;
} row;

/* A square of z = 0 whose u runs along x, and v along y times this. */
static void add_square(rt_scene *scene, float v, const rt_surface *surface)
{
    const float positions[4][3] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}},
                uv[4][2] = {{0, 0}, {1, 0}, {1, v}, {0, v}};
    static const uint32_t indices[2][3] = {{0, 1, 2}, {0, 2, 3}};
    const rt_mesh_data data = {.positions = positions[0],
                               .uv = uv[0],
                               .indices = indices[0],
                               .vertex_count = 4,
                               .triangle_count = 2};
    uint32_t mesh;
    rt_error error;
    expect_ok(rt_scene_add_mesh(scene, &mesh, &data, &error), &error);
    expect_ok(rt_scene_add_instance(scene, NULL, mesh, surface, &error), &error);
}

/* The shading normal of the square where a map has this value all over and is rotated. */
static void rotated_normal(float out[3], const float map[3], float v, float scale, int flip,
                           float rotate)
{
    rt_texture texture = {.kind = RT_TEXTURE_GRADIENT, .rotate = rotate, .scale = {2, -3}};
    rt_material material = {.kd = {0.5f, 0.5f, 0.5f}, .normal_scale = scale, .normal_flip = flip};
    rt_surface surface;
    rt_scene *scene = NULL;
    rt_renderer *renderer = NULL;
    rt_error error;
    const rt_ray ray = {{0.3f, 0.2f, 4}, 0, {0, 0, -1}, INFINITY};
    rt_u32 count = 1;
    row hit;
    float normal[4];
    memset(&surface, 0, sizeof surface);
    memcpy(texture.a, map, sizeof texture.a);
    memcpy(texture.b, map, sizeof texture.b);
    expect_ok(rt_scene_create(&scene, &error), &error);
    expect_ok(rt_scene_add_texture(scene, &material.normal_texture, &texture, &error), &error);
    expect_ok(rt_scene_add_material(scene, &surface.material, NULL, &material, &error), &error);
    add_square(scene, v, &surface);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    cl_kernel kernel = test_kernel("bump", "follow_parameters");
    cl_mem in = test_buffer(sizeof ray, &ray), rows = test_buffer(sizeof hit, NULL),
           normals = test_buffer(sizeof normal, NULL);
    rt_arg args[] = {RT_ARG(count), RT_ARG(renderer->scene), RT_ARG(in), RT_ARG(rows),
                     RT_ARG(normals)};
    test_run(kernel, args, 5, 1);
    test_read(rows, sizeof hit, &hit);
    test_read(normals, sizeof normal, normal);
    assert_float_equal(hit.position[0], 0.3f, 1e-5);
    memcpy(out, normal, 3 * sizeof *out);
    rt_buffer_release(test_device(), in);
    rt_buffer_release(test_device(), rows);
    rt_buffer_release(test_device(), normals);
    rt_kernel_release(kernel);
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
}

static void map_normal(float out[3], const float map[3], float v, float scale, int flip)
{
    rotated_normal(out, map, v, scale, flip, 0);
}

static void expect_normal(const float normal[3], double x, double y, double z)
{
    const double length = sqrt(x * x + y * y + z * z);
    assert_float_equal(normal[0], x / length, 1e-5);
    assert_float_equal(normal[1], y / length, 1e-5);
    assert_float_equal(normal[2], z / length, 1e-5);
}

static void maps_hold_normals_of_tangent_space(void **state)
{
    static const float map[3] = {0.7f, 0.6f, 0.9f}; /* 0.4, 0.2, 0.8 */
    float normal[3];
    (void)state;
    map_normal(normal, map, 1, 1, 0);
    expect_normal(normal, 0.4, 0.2, 0.8);
    map_normal(normal, map, 1, 1, 1);
    expect_normal(normal, 0.4, -0.2, 0.8);
    map_normal(normal, map, -1, 1, 0);
    expect_normal(normal, 0.4, -0.2, 0.8);
    map_normal(normal, map, 1, 0.5f, 0);
    expect_normal(normal, 0.2, 0.1, 0.8);
    map_normal(normal, map, 1, 0, 0);
    expect_normal(normal, 0.4, 0.2, 0.8);
}

/* x is along the picture's s, which at 90 degrees is where v was: normals turn clockwise. */
static void a_rotated_map_turns_its_normals(void **state)
{
    static const float map[3] = {0.7f, 0.6f, 0.9f}; /* 0.4, 0.2, 0.8 */
    float normal[3];
    (void)state;
    rotated_normal(normal, map, 1, 1, 0, 90);
    expect_normal(normal, 0.2, -0.4, 0.8);
    rotated_normal(normal, map, 1, 1, 0, 180);
    expect_normal(normal, -0.4, -0.2, 0.8);
    rotated_normal(normal, map, 1, 1, 1, -90);
    expect_normal(normal, 0.2, 0.4, 0.8);
    const double c = cos(0.5), s = sin(0.5);
    rotated_normal(normal, map, 1, 1, 0, (float)(0.5 * 180 / 3.14159265358979));
    expect_normal(normal, 0.4 * c + 0.2 * s, 0.2 * c - 0.4 * s, 0.8);
}

static void normals_stay_on_the_outside(void **state)
{
    static const float none[3] = {0.5f, 0.5f, 0.5f}, below[3] = {1, 0.5f, 0.2f};
    float normal[3];
    (void)state;
    map_normal(normal, none, 1, 1, 0);
    expect_normal(normal, 0, 0, 1);
    map_normal(normal, below, 1, 1, 0);
    assert_true(normal[0] > 0.99f && normal[2] > 0.01f && normal[2] < 0.03f);
}

static void a_map_of_srgb_is_refused(void **state)
{
    rt_texture texture = {.kind = RT_TEXTURE_IMAGE, .path = "scenes/textures/letter.png"};
    rt_material material = {.kd = {0.5f, 0.5f, 0.5f}};
    rt_scene *scene = NULL;
    rt_error error;
    (void)state;
    expect_ok(rt_scene_create(&scene, &error), &error);
    expect_ok(rt_scene_add_texture(scene, &material.normal_texture, &texture, &error), &error);
    assert_int_equal(rt_scene_add_material(scene, NULL, "m", &material, &error), RT_ERROR_INPUT);
    assert_string_equal(error.field, "normal_texture");
    texture.linear = 1;
    expect_ok(rt_scene_add_texture(scene, &material.normal_texture, &texture, &error), &error);
    expect_ok(rt_scene_add_material(scene, NULL, "m", &material, &error), &error);
    material.normal_scale = NAN;
    assert_int_equal(rt_scene_add_material(scene, NULL, "m", &material, &error), RT_ERROR_INPUT);
    assert_string_equal(error.field, "normal_scale");
    rt_scene_destroy(scene);
}

/* ---- Shadows of bumps ---------------------------------------------------------------- */

/* A sun `elevation` above a map that tilts the normal by `tilt` to it or away, in degrees. */
static void shadowed_radiance(double out[2], double elevation, double tilt,
                              rt_render_options options)
{
    static const double degree = 3.14159265358979323846 / 180;
    for (int is_shadowed = 0; is_shadowed < 2; is_shadowed++) {
        char text[1024];
        double means[3];
        snprintf(text, sizeof text,
                 "camera { projection orthographic  eye 0 0 2  look_at 0 0 0  width 1 }\n"
                 "texture map { pattern constant  a %.9g 0.5 %.9g }\n"
                 "material m { kd 0.5  normal_texture map  bump_shadowing %s }\n"
                 "quad { corner -1 -1 0  edge1 2 0 0  edge2 0 2 0  material m }\n"
                 "light directional { direction %.9g 0 %.9g  irradiance 2 }\n",
                 0.5 + 0.5 * sin(tilt * degree), 0.5 + 0.5 * cos(tilt * degree),
                 is_shadowed ? "true" : "false", -cos(elevation * degree),
                 -sin(elevation * degree));
        render_means(means, text, options);
        out[is_shadowed] = means[1];
    }
}

static void bumps_shadow_grazing_light(void **state)
{
    static const double degree = 3.14159265358979323846 / 180,
                        cases[][2] = {{60, 10}, {10, 40}, {5, 20}, {30, -25}, {12, 75}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const double elevation = cases[i][0] * degree, tilt = cases[i][1] * degree;
        const double lit = 1 / 3.14159265358979323846 * sin(elevation + tilt);
        const double square_alpha = fmin(tan(tilt) * tan(tilt) / 8, 1),
                     left = 2 / (1 + sqrt(1 + square_alpha / pow(tan(elevation), 2)));
        double found[2];
        shadowed_radiance(found, cases[i][0], cases[i][1],
                          (rt_render_options){.spp = 1, .max_depth = 2});
        assert_float_equal(found[0], lit, 1e-4 * lit);
        assert_float_equal(found[1], lit * left, 1e-4 * lit);
        /* Some 25000 photons lie in view: 5 % are eight standard deviations. */
        const rt_render_options photons = {.mode = RT_MODE_PHOTON,
                                           .direct = RT_DIRECT_PHOTONS,
                                           .photons = 100000,
                                           .k = 100,
                                           .spp = 4,
                                           .max_depth = 2};
        if (i < 2)
            continue;
        shadowed_radiance(found, cases[i][0], cases[i][1], photons);
        assert_float_equal(found[0], lit, 0.05 * lit);
        assert_float_equal(found[1], lit * left, 0.05 * lit * left);
    }
}

/* ---- A room -------------------------------------------------------------------------- */

/* Walls and a glossy ball of tilted squares, around a small light. */
static const char room[] =
    "camera { eye 0 0.1 1.9  look_at 0 -0.1 0  fov 50 }\n"
    "texture squares { pattern checker  a 0.7 0.6 0.9  b 0.4 0.25 0.9  scale 5 4 }\n"
    "material wall { kd 0.7 0.6 0.4  normal_texture squares  bump_shadowing true }\n"
    "material ball { kd 0.3  ks 0.5  roughness 0.3  normal_texture squares  normal_flip true }\n"
    "material lamp { emission 5 }\nbox { centre 0 0 0  size 2 2 4  material wall }\n"
    "sphere { centre 0.2 -0.5 -0.2  radius 0.5  material ball }\n"
    "quad { corner -0.4 0.95 -0.4  edge1 0.8 0 0  edge2 0 0 0.8  material lamp }\n";

static void modes_agree_in_a_room(void **state)
{
    (void)state;
    expect_modes_agree(room);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(maps_hold_normals_of_tangent_space),
        cmocka_unit_test(a_rotated_map_turns_its_normals),
        cmocka_unit_test(normals_stay_on_the_outside),
        cmocka_unit_test(a_map_of_srgb_is_refused),
        cmocka_unit_test(bumps_shadow_grazing_light),
        statistical_test(modes_agree_in_a_room),
    };
    return cmocka_run_group_tests_name("lib/render/normal_map", tests, NULL, NULL);
}
