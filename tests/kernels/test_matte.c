/*
 * test_matte.c - vertices that eight paths take together come out as those that each takes by
 * itself.
 */
#include "support.h"

#include <math.h>
#include <string.h>

#include "render/renderer.h"
#include "statistics.h"
#include "types.h"

enum { width = 36, height = 29, pixels = width * height, spp = 16 };

static rt_surface add_material(rt_scene *scene, const rt_material *material)
{
    rt_surface surface = {0};
    rt_error error;
    expect_ok(rt_scene_add_material(scene, &surface.material, NULL, material, &error), &error);
    return surface;
}

/*
 * A floor, a wall with a texture, one placed by a mirroring transform, a smooth triangle, and
 * spheres of all sorts.
 */
static void add_shapes(rt_scene *scene)
{
    static const rt_material grey = {.kd = {0.7f, 0.6f, 0.5f}}, black = {.kd = {0, 0, 0}},
                             glass = {.kt = {1, 1, 1}, .ior = 1.5f, .fresnel = 1},
                             mirror = {.ks = {0.9f, 0.9f, 0.9f}},
                             mixed = {.kd = {0.4f, 0.4f, 0.4f}, .ks = {0.4f, 0.4f, 0.4f}};
    static const float corner[3] = {-5, -5, 0}, x[3] = {10, 0, 0}, y[3] = {1, 10, 0},
                       up[3] = {0, 0, 4}, back[3] = {-5, 3, 0};
    static const float tent[9] = {-3, -1, 0.1f, -1, -1, 0.2f, -2, 0, 2},
                       bent[9] = {0.3f, -0.5f, 1, 0.2f, -0.6f, 1, 0.1f, -0.3f, 1};
    static const uint32_t indices[3] = {0, 1, 2};
    static const rt_transform mirroring = {{{-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    static const float side[3] = {4, -5, 0}, along[3] = {0, 10, 1};
    const rt_material *spheres[] = {&grey, &glass, &mirror, &mixed, &black};
    static const rt_texture checks = {
        .kind = RT_TEXTURE_CHECKER, .a = {1, 0.5f, 0.2f}, .b = {0.1f, 0.1f, 0.1f}};
    rt_error error;
    rt_surface plain = add_material(scene, &grey), varied = plain, turned = plain;

    expect_ok(rt_scene_add_texture(scene, &varied.texture, &checks, &error), &error);
    turned.transform = mirroring;
    expect_ok(rt_scene_add_quad(scene, NULL, corner, x, y, &plain, &error), &error);
    expect_ok(rt_scene_add_quad(scene, NULL, back, x, up, &varied, &error), &error);
    expect_ok(rt_scene_add_quad(scene, NULL, side, along, up, &turned, &error), &error);
    expect_ok(rt_scene_add_triangles(scene, NULL, tent, 3, indices, 1, bent, &plain, &error),
              &error);
    for (int i = 0; i < 5; i++) {
        const float centre[3] = {(float)i - 2, 0.5f * (float)(i % 2), 0.4f};
        rt_surface surface = add_material(scene, spheres[i]);
        expect_ok(rt_scene_add_sphere(scene, NULL, centre, 0.4f, &surface, &error), &error);
    }
}

/* Lamps of every kind that sampling tells apart. */
static void add_lights(rt_scene *scene)
{
    static const rt_material lamp = {.emission = {3, 3, 2}},
                             both = {.emission = {2, 1, 1}, .two_sided = 1};
    static const float high[3] = {-1, -1, 3}, x[3] = {1, 0, 0}, y[3] = {0, 1, 0},
                       skew[3] = {0.5f, 1, 0.2f}, aside[3] = {2, -2, 2}, low[3] = {-3, -2, 1.5f};
    static const float facing[9] = {1, 1, 3, 1, 2, 3, 2, 1, 3};
    static const uint32_t indices[3] = {0, 1, 2};
    static const rt_point_light point = {.position = {-2, -3, 2}, .intensity = {3, 3, 3}};
    static const rt_directional_light sun = {.direction = {1, 1, -2},
                                             .irradiance = {0.3f, 0.3f, 0.3f}};
    static const rt_environment sky = {.radiance = {0.1f, 0.2f, 0.3f}};
    rt_surface down = add_material(scene, &lamp), two_sided = add_material(scene, &both);
    rt_error error;

    expect_ok(rt_scene_add_quad(scene, NULL, high, y, x, &down, &error), &error);
    expect_ok(rt_scene_add_quad(scene, NULL, low, skew, x, &two_sided, &error), &error);
    expect_ok(rt_scene_add_triangles(scene, NULL, facing, 3, indices, 1, NULL, &down, &error),
              &error);
    expect_ok(rt_scene_add_sphere(scene, NULL, aside, 0.3f, &down, &error), &error);
    expect_ok(rt_scene_add_point_light(scene, &point, &error), &error);
    expect_ok(rt_scene_add_directional_light(scene, &sun, &error), &error);
    expect_ok(rt_scene_set_environment(scene, &sky, &error), &error);
}

static rt_scene *new_scene(void)
{
    static const rt_camera camera = {
        .eye = {0, -6, 2.5f}, .look_at = {0, 0, 0.8f}, .up = {0, 0, 1}, .fov = 60};
    rt_scene *scene = NULL;
    rt_error error;
    expect_ok(rt_scene_create(&scene, &error), &error);
    expect_ok(rt_scene_set_camera(scene, &camera, &error), &error);
    return scene;
}

/* Renders by the library, which aims the camera, to means, and by the test's kernel to sums. */
static void render_both(rt_scene *scene, rt_film_pixel *singly, float *together)
{
    rt_render_options options = {.width = width,
                                 .height = height,
                                 .spp = spp,
                                 .max_depth = 9,
                                 .seed = test_seed(5),
                                 .roulette_depth = 2,
                                 .roulette_threshold = 0.5f};
    rt_renderer *renderer = NULL;
    rt_film *film = NULL;
    rt_error error;
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    memcpy(together, rt_film_rgb(film), 3 * pixels * sizeof *together);
    rt_film_destroy(film);

    rt_params params = rt_params_make(&options);
    params.item_count = pixels;
    params.sample_count = spp;
    memset(singly, 0, pixels * sizeof *singly);
    cl_kernel kernel = test_kernel("matte", "path_singly");
    cl_mem sums = test_buffer(pixels * sizeof *singly, singly);
    rt_arg args[] = {RT_ARG(params), RT_ARG(renderer->scene), RT_ARG(sums)};
    test_run(kernel, args, 3, pixels);
    test_read(sums, pixels * sizeof *singly, singly);
    rt_buffer_release(sums);
    rt_kernel_release(kernel);
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
}

/*
 * Equal but for rounding, which now and then sends a path another way: so all pixels but one in a
 * hundred are equal to a thousandth.
 */
static void expect_equal_films(rt_scene *scene)
{
    static rt_film_pixel singly[pixels];
    static float together[3 * pixels];
    int off = 0, lit = 0;
    render_both(scene, singly, together);
    for (int i = 0; i < 3 * pixels; i++) {
        const double one = singly[i / 3].sum[i % 3] / spp;
        off += fabs(one - together[i]) > 1e-3 * (one + 1e-3);
        lit += one > 0;
    }
    assert_true(lit > pixels);
    expect_close(off, 0, 3 * pixels / 100, "values that differ");
}

static void all_surfaces_under_all_lights(void **state)
{
    rt_scene *scene = new_scene();
    (void)state;
    add_shapes(scene);
    add_lights(scene);
    expect_equal_films(scene);
}

/*
 * The lamps are all flat and sampled by area, the surfaces as well: what is wholly done in lanes.
 */
static void flat_surfaces_under_flat_lights(void **state)
{
    static const rt_material grey = {.kd = {0.7f, 0.6f, 0.5f}}, lamp = {.emission = {9, 9, 7}};
    static const float positions[] = {-4, -4, 0, 4, -4, 0, 0, 4, 0, -2, 3, 0, 2, 3, 0, 0, 3, 3,
                                      -1, 0,  1, 0, -1, 1, 0, 0, 2, 0,  0, 3, 1, 1, 3, 1, 0, 3};
    static const uint32_t walls[] = {0, 1, 2, 3, 4, 5, 6, 7, 8}, lamps[] = {9, 10, 11};
    rt_scene *scene = new_scene();
    rt_surface wall = add_material(scene, &grey), shining = add_material(scene, &lamp);
    rt_error error;
    (void)state;
    expect_ok(rt_scene_add_triangles(scene, NULL, positions, 12, walls, 3, NULL, &wall, &error),
              &error);
    expect_ok(rt_scene_add_triangles(scene, NULL, positions, 12, lamps, 1, NULL, &shining, &error),
              &error);
    expect_equal_films(scene);
}

static void all_surfaces_under_a_sky_alone(void **state)
{
    static const rt_environment sky = {.radiance = {1, 1, 1}};
    rt_scene *scene = new_scene();
    rt_error error;
    (void)state;
    add_shapes(scene);
    expect_ok(rt_scene_set_environment(scene, &sky, &error), &error);
    expect_equal_films(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(flat_surfaces_under_flat_lights),
        statistical_test(all_surfaces_under_all_lights),
        statistical_test(all_surfaces_under_a_sky_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
