/*
 * test_estimators.c - light sampling, BSDF sampling and MIS have the same mean for every kind of
 * light, and MIS the least noise.
 */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "image/image_file.h"
#include "kernels/statistics.h"
#include "lib/image/scratch.h"

enum { side = 32, pixels = side * side, spp = 32 };

static double values[pixels];

static rt_scene *scene;
static rt_error error;

static uint32_t material(const rt_material *m)
{
    uint32_t index = 0;
    expect_ok(rt_scene_add_material(scene, &index, NULL, m, &error), &error);
    return index;
}

/* A floor, seen from above, beside a wall that hides a part of what lights it. */
static void begin(float roughness)
{
    static const float corner[3] = {-2, 0, 2}, x[3] = {4, 0, 0}, z[3] = {0, 0, -4},
                       wall[3] = {-2, 0, -1}, up[3] = {0, 1, 0};
    rt_material floor_material = {.kd = {0.6f, 0.5f, 0.4f}};
    rt_camera camera = {.eye = {0, 5, 4}, .look_at = {0, 0, 0}, .fov = 30};
    rt_surface surface;
    if (roughness > 0) {
        floor_material = (rt_material){
            .kd = {0.3f, 0.3f, 0.3f}, .ks = {0.6f, 0.6f, 0.6f}, .roughness = roughness};
    }
    memset(&surface, 0, sizeof surface);
    expect_ok(rt_scene_create(&scene, &error), &error);
    expect_ok(rt_scene_set_camera(scene, &camera, &error), &error);
    surface.material = material(&floor_material);
    expect_ok(rt_scene_add_quad(scene, NULL, corner, x, z, &surface, &error), &error);
    expect_ok(rt_scene_add_quad(scene, NULL, wall, x, up, &surface, &error), &error);
}

static rt_surface emissive(void)
{
    static const rt_material black;
    rt_surface surface;
    memset(&surface, 0, sizeof surface);
    surface.material = material(&black);
    surface.radiance[0] = surface.radiance[1] = surface.radiance[2] = 5;
    surface.transform = (rt_transform){{{1, 0.2f, 0, 0}, {-0.2f, 1, 0.3f, 0.2f}, {0, 0, 1.2f, 0}}};
    return surface;
}

static rt_renderer *ready(void)
{
    rt_renderer *renderer = NULL;
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    rt_scene_destroy(scene);
    return renderer;
}

static rt_film *render(rt_renderer *renderer, rt_estimator estimator, uint32_t seed)
{
    rt_render_options options = {.width = side,
                                 .height = side,
                                 .spp = spp,
                                 .max_depth = 3,
                                 .seed = test_seed(seed),
                                 .roulette_threshold = 1,
                                 .sampler = RT_SAMPLER_INDEPENDENT,
                                 .estimator = estimator};
    rt_film *film = NULL;
    rt_film_stats stats;
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    rt_film_get_stats(film, &stats);
    assert_int_equal(stats.rejected, 0);
    return film;
}

/*
 * Half the square of the difference of two renders: the variance of a pixel's mean, if averaged
 * over many.
 */
static double variance(rt_film *const films[2], int pixel)
{
    double d = (double)rt_film_rgb(films[0])[3 * pixel + 1] - rt_film_rgb(films[1])[3 * pixel + 1];
    return 0.5 * d * d;
}

/*
 * The combination's variance is at most so many times that of one technique alone, but for chance.
 */
static void expect_less_noise(rt_film *const both[2], rt_film *const alone[2], double most,
                              const char *what)
{
    double excess = 0;
    for (int i = 0; i < pixels; i++) {
        values[i] = variance(both, i) - most * variance(alone, i);
        excess += values[i];
    }
    chance_compare(excess > 0 ? chance_of_mean(values, pixels, 0, 0) : 1, "%s: variance", what);
}

/*
 * All three have the same mean, to standard errors of the difference over the film. The variance of
 * the combination is at most `most` times that of material sampling, and 1.3 times that of light
 * sampling.
 */
static void expect_same_mean_and_less_noise(const char *what, double most)
{
    rt_renderer *renderer = ready();
    rt_film *films[3][2];
    for (int e = 0; e < 3; e++)
        for (uint32_t k = 0; k < 2; k++)
            films[e][k] = render(renderer, (rt_estimator)e, 2 * (uint32_t)e + k);
    for (int e = 1; e < 3; e++) {
        for (int i = 0; i < pixels; i++)
            values[i] = ((double)rt_film_rgb(films[e][0])[3 * i] + rt_film_rgb(films[e][1])[3 * i] -
                         rt_film_rgb(films[0][0])[3 * i] - rt_film_rgb(films[0][1])[3 * i]) /
                        2;
        expect_mean(values, pixels, 0, 1e-5, what);
    }
    expect_less_noise(films[0], films[1], 1.3, what);
    expect_less_noise(films[0], films[2], most, what);
    for (int e = 0; e < 3; e++)
        for (int k = 0; k < 2; k++)
            rt_film_destroy(films[e][k]);
    rt_renderer_destroy(renderer);
}

static void expect_same_mean(const char *what)
{
    expect_same_mean_and_less_noise(what, 1.3);
}

static void area_lights_of_every_shape(void **state)
{
    static const float at[3] = {0.5f, 1.5f, 0}, to[3] = {0.8f, 2.1f, -0.2f},
                       edge1[3] = {0, 0, 0.8f}, edge2[3] = {0.7f, -0.2f, 0},
                       radii[3] = {0.5f, 0.2f, 0.3f};
    static const char *const names[] = {"quad",     "sphere", "ellipsoid", "disc",
                                        "cylinder", "cone",   "torus",     "box"};
    (void)state;
    for (int kind = 0; kind < 8; kind++) {
        begin(0);
        rt_surface s = emissive();
        rt_status status =
            kind == 0   ? rt_scene_add_quad(scene, NULL, at, edge2, edge1, &s, &error)
            : kind == 1 ? rt_scene_add_sphere(scene, NULL, at, 0.4f,
                                              (s.transform = (rt_transform){{{0}}}, &s), &error)
            : kind == 2 ? rt_scene_add_ellipsoid(scene, NULL, at, radii, &s, &error)
            : kind == 3 ? rt_scene_add_disc(scene, NULL, at, (const float[3]){0, -1, 0}, 0.5f, 0.2f,
                                            &s, &error)
            : kind == 4 ? rt_scene_add_cylinder(scene, NULL, at, to, 0.3f, 1, &s, &error)
            : kind == 5 ? rt_scene_add_cone(scene, NULL, at, to, 0.4f, 0.1f, 1, &s, &error)
            : kind == 6 ? rt_scene_add_torus(scene, NULL, at, to, 0.4f, 0.15f, &s, &error)
                        : rt_scene_add_box(scene, NULL, at, radii, &s, &error);
        expect_ok(status, &error);
        expect_same_mean(names[kind]);
    }
}

/* A medium of higher priority hides the boundary of what emits, and not its light. */
static void area_light_in_a_stronger_medium(void **state)
{
    static const float at[3] = {0.5f, 1.5f, 0}, centre[3] = {0, 0, 0};
    const rt_material water = {.kt = {1, 1, 1}, .ior = 1, .priority = 2},
                      glow = {.kt = {1, 1, 1}, .ior = 1, .priority = 1};
    rt_surface around;
    (void)state;
    begin(0);
    memset(&around, 0, sizeof around);
    around.material = material(&water);
    expect_ok(rt_scene_add_sphere(scene, NULL, centre, 20, &around, &error), &error);
    rt_surface s = emissive();
    s.material = material(&glow);
    s.transform = (rt_transform){{{0}}};
    expect_ok(rt_scene_add_sphere(scene, NULL, at, 0.4f, &s, &error), &error);
    expect_same_mean("in a stronger medium");
}

/* The inside of its far half is seen through the near one, and through the far one from within. */
static void sphere_whose_far_side_is_seen(void **state)
{
    static const float at[3] = {0.5f, 1.5f, 0}, radii[2] = {0.4f, 9};
    const rt_material film = {.interface = 1, .two_sided = 1};
    (void)state;
    for (int i = 0; i < 2; i++) {
        begin(0);
        rt_surface s = emissive();
        s.material = material(&film);
        s.transform = (rt_transform){{{0}}};
        expect_ok(rt_scene_add_sphere(scene, NULL, at, radii[i], &s, &error), &error);
        expect_same_mean("a sphere whose far side is seen");
    }
}

/*
 * A tent of two triangles, placed twice by transforms, one of them with a texture on its
 * coordinates.
 */
static void area_lights_of_meshes(void **state)
{
    static const float positions[] = {0, 0, 0, 1, 0, 0, 0, 0.3f, 1, 1, 0, 1},
                       uv[] = {0, 0, 1, 0, 0, 1, 1, 1};
    static const uint32_t indices[] = {0, 1, 2, 1, 3, 2};
    rt_mesh_data mesh = {.positions = positions,
                         .uv = uv,
                         .indices = indices,
                         .vertex_count = 4,
                         .triangle_count = 2};
    rt_texture checker = {
        .kind = RT_TEXTURE_CHECKER, .a = {2, 2, 2}, .b = {0.1f, 0.1f, 0.1f}, .scale = {4, 4}};
    uint32_t handle, texture;
    (void)state;
    begin(0);
    rt_surface s = emissive();
    expect_ok(rt_scene_add_texture(scene, &texture, &checker, &error), &error);
    expect_ok(rt_scene_add_mesh(scene, &handle, &mesh, &error), &error);
    s.transform = (rt_transform){{{1, 0, 0, -1}, {0, 1, 0, 1.5f}, {0, 0, 1, 0}}};
    expect_ok(rt_scene_add_instance(scene, NULL, handle, &s, &error), &error);
    s.transform = (rt_transform){{{0.6f, 0, 0.3f, 0.5f}, {0, -1, 0, 1.8f}, {0, 0.2f, 0.8f, 0.1f}}};
    s.texture = texture;
    expect_ok(rt_scene_add_instance(scene, NULL, handle, &s, &error), &error);
    expect_same_mean("mesh");
}

/*
 * Two walls that emit, right beside the floor: rays meet them as often as points of them are
 * sampled.
 */
static void large_area_lights(void **state)
{
    static const float left[3] = {-2, 0, 2}, right[3] = {2, 0, -2}, up[3] = {0, 3, 0},
                       back[3] = {0, 0, -4}, front[3] = {0, 0, 4};
    (void)state;
    begin(0);
    rt_surface s = emissive();
    s.transform = (rt_transform){{{0}}};
    expect_ok(rt_scene_add_quad(scene, NULL, left, back, up, &s, &error), &error);
    expect_ok(rt_scene_add_quad(scene, NULL, right, front, up, &s, &error), &error);
    expect_same_mean("two large area lights");
}

/* Dim, with a sun of one pixel. */
static void write_sky(const char *path)
{
    static const char *const names[] = {"R", "G", "B"};
    rt_image *image = NULL;
    expect_ok(rt_image_create(&image, 64, 32, names, 3, &error), &error);
    for (uint32_t i = 0; i < 3 * 64 * 32; i++)
        image->data[i] = 0.3f + 0.2f * (float)(i / 3 % 7) / 7;
    for (uint32_t c = 0; c < 3; c++)
        image->data[3 * (10 * 64 + 20) + c] = 500;
    expect_ok(rt_image_write(image, path, NULL, &error), &error);
    rt_image_destroy(image);
}

static void environments(void **state)
{
    rt_environment even = {.radiance = {1, 1, 1}}, picture = {.path = "sky.exr"};
    (void)state;
    begin(0);
    expect_ok(rt_scene_set_environment(scene, &even, &error), &error);
    expect_same_mean("even environment");
    write_sky(picture.path);
    begin(0);
    expect_ok(rt_scene_set_environment(scene, &picture, &error), &error);
    expect_same_mean_and_less_noise("environment with a sun", 0.05);
}

/* On a rough floor each technique is the better one somewhere. */
static void rough_floors(void **state)
{
    static const float at[3] = {0, 1.5f, -0.8f};
    (void)state;
    begin(0.15f);
    rt_surface s = emissive();
    s.transform = (rt_transform){{{0}}};
    expect_ok(rt_scene_add_sphere(scene, NULL, at, 0.2f, &s, &error), &error);
    expect_same_mean("rough floor");
}

/* Points, spots and suns are sampled whatever the estimator is. */
static void delta_lights_are_always_sampled(void **state)
{
    rt_point_light point = {.position = {0, 2, 0}, .intensity = {3, 3, 3}};
    rt_spot_light spot = {.position = {1, 2, 1}, .target = {0, 0, 0}, .intensity = {4, 4, 4}};
    rt_directional_light sun = {.direction = {1, -2, -0.5f}, .irradiance = {1, 1, 1}};
    (void)state;
    begin(0);
    expect_ok(rt_scene_add_point_light(scene, &point, &error), &error);
    expect_ok(rt_scene_add_spot_light(scene, &spot, &error), &error);
    expect_ok(rt_scene_add_directional_light(scene, &sun, &error), &error);
    expect_same_mean("delta lights");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(area_lights_of_every_shape),
        statistical_test(sphere_whose_far_side_is_seen),
        statistical_test(area_lights_of_meshes),
        statistical_test(area_light_in_a_stronger_medium),
        statistical_test(large_area_lights),
        statistical_test(environments),
        statistical_test(rough_floors),
        statistical_test(delta_lights_are_always_sampled),
    };
    void *scratch = NULL;
    if (scratch_enter(&scratch) != 0)
        return 1;
    const int failed = cmocka_run_group_tests_name("lib/render/estimators", tests, NULL, NULL);
    return scratch_leave(&scratch) != 0 || failed != 0;
}
