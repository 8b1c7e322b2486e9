/*
 * test_batch.c - eight paths at a time have the same radiance, but for rounding, as the scalar
 * integrator computes: in path tracing, of direct light alone, too, and as eye paths of photon
 * mapping.
 */
#include "support.h"

#include <glob.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { width = 36, height = 29, values = 3 * width * height, spp = 16 };

/* The device of the tests at both widths. */
static rt_device *device_one, *device_eight;

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

/* Lights of every kind that sampling tells apart. */
static void add_lights(rt_scene *scene)
{
    static const rt_material emitter = {.emission = {3, 3, 2}},
                             both = {.emission = {2, 1, 1}, .two_sided = 1};
    static const float high[3] = {-1, -1, 3}, x[3] = {1, 0, 0}, y[3] = {0, 1, 0},
                       skew[3] = {0.5f, 1, 0.2f}, aside[3] = {2, -2, 2}, low[3] = {-3, -2, 1.5f};
    static const float facing[9] = {1, 1, 3, 1, 2, 3, 2, 1, 3};
    static const uint32_t indices[3] = {0, 1, 2};
    static const rt_point_light point = {.position = {-2, -3, 2}, .intensity = {3, 3, 3}};
    static const rt_directional_light sun = {.direction = {1, 1, -2},
                                             .irradiance = {0.3f, 0.3f, 0.3f}};
    static const rt_environment sky = {.radiance = {0.1f, 0.2f, 0.3f}};
    rt_surface down = add_material(scene, &emitter), two_sided = add_material(scene, &both);
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

/* The device of the tests at another width. */
static rt_device *device_of_width(uint32_t paths)
{
    rt_device_options options = {.select = getenv("RT_TEST_DEVICE"), .width = paths};
    rt_device *device = NULL;
    rt_error error;
    expect_ok(rt_device_open(&device, &options, &error), &error);
    return device;
}

/* How films are rendered: by paths, all or short ones, and by photons, also with a final gather. */
static const rt_render_options modes[] = {
    {.mode = RT_MODE_PATH, .spp = spp},
    {.mode = RT_MODE_DIRECT, .spp = spp},
    {.mode = RT_MODE_PHOTON, .spp = spp, .photons = 2000, .k = RT_K_ALL, .radius = 0.3f},
    {.mode = RT_MODE_PHOTON,
     .spp = spp,
     .photons = 2000,
     .k = RT_K_ALL,
     .radius = 0.3f,
     .direct = RT_DIRECT_PHOTONS},
    {.mode = RT_MODE_PHOTON,
     .spp = spp,
     .photons = 2000,
     .k = RT_K_ALL,
     .radius = 0.3f,
     .caustic_k = RT_K_ALL,
     .caustic_radius = 0.3f,
     .final_gather = 1},
};
enum { mode_count = sizeof modes / sizeof *modes };
static int films_compared[mode_count];

/* Returns 0 where the mode does not know the scene's media. */
static int render(float *rgb, const rt_scene *scene, rt_device *device,
                  const rt_render_options *mode, uint32_t times)
{
    rt_render_options options = *mode;
    options.spp *= times;
    options.width = width;
    options.height = height;
    options.max_depth = 9;
    options.seed = 5;
    options.roulette_depth = 2;
    options.roulette_threshold = 0.5f;
    rt_renderer *renderer = NULL;
    rt_film *film = NULL;
    rt_error error;
    expect_ok(rt_renderer_create(&renderer, scene, device, NULL, &error), &error);
    const rt_status status = rt_render(&film, renderer, &options, &error);
    const int is_known = mode->mode != RT_MODE_DIRECT || status != RT_ERROR_USAGE;
    if (is_known) {
        expect_ok(status, &error);
        memcpy(rgb, rt_film_rgb(film), values * sizeof *rgb);
    }
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
    return is_known;
}

/*
 * Equal but for rounding, which now and then changes a path: so all values but one in a
 * hundred are equal to a thousandth. Takes the scene. Where paths seldom find light, as many
 * samples are taken as light a fiftieth of the values; mode direct may find none, as where all
 * comes through glass.
 */
static void expect_equal_films(rt_scene *scene, const char *name)
{
    static float one[values], eight[values];
    for (int mode = 0; mode < mode_count; mode++) {
        const int least = modes[mode].mode == RT_MODE_DIRECT ? 0 : values / 50;
        int differ = 0, lit = 0, is_known = 1;
        uint32_t times = 1;
        for (; is_known && (times == 1 || (lit < least && times <= 8)); times *= 2) {
            is_known = render(one, scene, device_one, modes + mode, times);
            lit = 0;
            for (int i = 0; is_known && i < values; i++)
                lit += one[i] > 0;
        }
        if (!is_known)
            continue;
        render(eight, scene, device_eight, modes + mode, times / 2);
        films_compared[mode]++;
        for (int i = 0; i < values; i++)
            differ += fabs((double)one[i] - eight[i]) > 1e-3 * (one[i] + 1e-3);
        if (differ > values / 100 || lit < least)
            fail_msg("%s, mode %d: %d of %d values differ, %d are lit", name, mode, differ, values,
                     lit);
    }
    rt_scene_destroy(scene);
}

static void all_surfaces_under_all_lights(void **state)
{
    (void)state;
    rt_scene *scene = new_scene();
    add_shapes(scene);
    add_lights(scene);
    expect_equal_films(scene, __func__);
}

/* Area lights and surfaces are all flat: what is wholly done in lanes. */
static void flat_surfaces_under_flat_lights(void **state)
{
    (void)state;
    static const rt_material grey = {.kd = {0.7f, 0.6f, 0.5f}}, emitter = {.emission = {9, 9, 7}};
    static const float positions[] = {-4, -4, 0, 4, -4, 0, 0, 4, 0, -2, 3, 0, 2, 3, 0, 0, 3, 3,
                                      -1, 0,  1, 0, -1, 1, 0, 0, 2, 0,  0, 3, 1, 1, 3, 1, 0, 3};
    static const uint32_t walls[] = {0, 1, 2, 3, 4, 5, 6, 7, 8}, emitters[] = {9, 10, 11};
    rt_scene *scene = new_scene();
    rt_surface wall = add_material(scene, &grey), emissive = add_material(scene, &emitter);
    rt_error error;
    expect_ok(rt_scene_add_triangles(scene, NULL, positions, 12, walls, 3, NULL, &wall, &error),
              &error);
    expect_ok(
        rt_scene_add_triangles(scene, NULL, positions, 12, emitters, 1, NULL, &emissive, &error),
        &error);
    expect_equal_films(scene, __func__);
}

/* Of surfaces with another material behind, lanes take the fronts alone. */
static void backs_are_told_from_fronts(void **state)
{
    static const rt_material red = {.kd = {0.8f, 0.2f, 0.1f}};
    static const rt_environment sky = {.radiance = {1, 0.8f, 0.6f}};
    static const float floor[3] = {-5, -5, 0}, x[3] = {10, 0, 0}, y[3] = {0, 10, 0},
                       left[3] = {-2, 0, 0.1f}, right[3] = {1, 0, 0.1f}, side[3] = {1.5f, 0, 0},
                       up[3] = {0, 0, 2}, top[3] = {0, -1, 0.6f};
    static const float tent[9] = {-3, -1, 0.1f, -1, -1, 0.2f, -2, 0, 2},
                       bent[9] = {0.3f, -0.5f, 1, 0.2f, -0.6f, 1, 0.1f, -0.3f, 1};
    static const float turned[9] = {2, 1, 0.1f, 3, 1, 2, 4, 0, 0.2f};
    static const uint32_t indices[3] = {0, 1, 2};
    (void)state;
    rt_error error;
    rt_scene *scene = new_scene();
    const rt_material black_behind = {.kd = {0.5f, 0.6f, 0.7f}, .back = RT_MATERIAL_BLACK},
                      red_behind = {.kd = {0.5f, 0.6f, 0.7f},
                                    .back = 1 + add_material(scene, &red).material};
    const rt_surface one = add_material(scene, &black_behind),
                     other = add_material(scene, &red_behind);
    expect_ok(rt_scene_add_quad(scene, NULL, floor, x, y, &one, &error), &error);
    expect_ok(rt_scene_add_quad(scene, NULL, left, side, up, &other, &error), &error);
    expect_ok(rt_scene_add_quad(scene, NULL, right, up, side, &other, &error), &error);
    expect_ok(rt_scene_add_triangles(scene, NULL, tent, 3, indices, 1, bent, &one, &error), &error);
    expect_ok(rt_scene_add_triangles(scene, NULL, turned, 3, indices, 1, NULL, &other, &error),
              &error);
    expect_ok(rt_scene_add_sphere(scene, NULL, top, 0.4f, &one, &error), &error);
    expect_ok(rt_scene_set_environment(scene, &sky, &error), &error);
    expect_equal_films(scene, __func__);
}

/* A texture that takes the roughness from smooth to rough. */
static rt_surface add_worn_metal(rt_scene *scene)
{
    static const rt_texture checks = {
        .kind = RT_TEXTURE_CHECKER, .a = {0, 0, 0}, .b = {1, 1, 1}, .scale = {6, 6}};
    rt_material worn = {.ks = {0.9f, 0.7f, 0.4f}, .roughness = 0.35f};
    rt_error error;
    expect_ok(rt_scene_add_texture(scene, &worn.roughness_texture, &checks, &error), &error);
    return add_material(scene, &worn);
}

/*
 * Rough metals, by their index or by a colour, of facets that scatter light often or once, one of
 * them masked and shadowed independently, with another back, and one whose roughness a texture
 * varies: flat, curved and smoothed.
 */
static void rough_metals(void **state)
{
    static const rt_material gold = {.ks = {1, 1, 1},
                                     .fresnel = RT_FRESNEL_CONDUCTOR,
                                     .eta = {0.14f, 0.38f, 1.44f},
                                     .k = {3.98f, 2.39f, 1.6f},
                                     .roughness = 0.3f},
                             single = {.ks = {1, 0.9f, 0.8f},
                                       .fresnel = RT_FRESNEL_CONDUCTOR,
                                       .eta = {0.2f, 0.92f, 1.1f},
                                       .k = {3.9f, 2.45f, 2.14f},
                                       .roughness = 0.15f,
                                       .facet_scattering = RT_FACET_SCATTERING_SINGLE},
                             tinted = {.ks = {0.9f, 0.6f, 0.2f},
                                       .fresnel = RT_FRESNEL_SCHLICK,
                                       .roughness = 0.4f},
                             coarse = {.ks = {0.6f, 0.7f, 0.8f},
                                       .roughness = 0.8f,
                                       .facet_scattering = RT_FACET_SCATTERING_SEPARABLE,
                                       .back = RT_MATERIAL_BLACK},
                             grey = {.kd = {0.5f, 0.5f, 0.5f}};
    static const float floor[3] = {-5, -5, 0}, x[3] = {10, 0, 0}, y[3] = {0, 10, 0},
                       wall[3] = {-5, 3, 0}, up[3] = {0, 0, 4}, side[3] = {3, -2, 0},
                       along[3] = {0, 4, 0}, centre[3] = {0.8f, 0, 0.7f}, low[3] = {-0.9f, 0, 0.4f},
                       front[3] = {0, -1, 0.4f};
    static const float tent[9] = {-3, -1, 0.1f, -1, -1, 0.2f, -2, 0, 2},
                       bent[9] = {0.3f, -0.5f, 1, 0.2f, -0.6f, 1, 0.1f, -0.3f, 1};
    static const uint32_t indices[3] = {0, 1, 2};
    (void)state;
    rt_error error;
    rt_scene *scene = new_scene();
    const rt_surface one = add_material(scene, &gold), other = add_material(scene, &single),
                     backed = add_material(scene, &coarse), worn = add_worn_metal(scene),
                     diffuse = add_material(scene, &grey), by_colour = add_material(scene, &tinted);
    expect_ok(rt_scene_add_quad(scene, NULL, floor, x, y, &one, &error), &error);
    expect_ok(rt_scene_add_sphere(scene, NULL, front, 0.4f, &by_colour, &error), &error);
    expect_ok(rt_scene_add_quad(scene, NULL, wall, x, up, &worn, &error), &error);
    expect_ok(rt_scene_add_quad(scene, NULL, side, along, up, &backed, &error), &error);
    expect_ok(rt_scene_add_triangles(scene, NULL, tent, 3, indices, 1, bent, &other, &error),
              &error);
    expect_ok(rt_scene_add_sphere(scene, NULL, centre, 0.7f, &other, &error), &error);
    expect_ok(rt_scene_add_sphere(scene, NULL, low, 0.4f, &diffuse, &error), &error);
    add_lights(scene);
    expect_equal_films(scene, __func__);
}

/* The worn part of a coat, by a pattern: it is there in whole, in part and not at all. */
static rt_surface add_worn_coat(rt_scene *scene)
{
    static const rt_texture checks = {
        .kind = RT_TEXTURE_CHECKER, .a = {0, 0, 0}, .b = {1, 1, 1}, .scale = {6, 6}};
    rt_material worn = {
        .kd = {0.7f, 0.2f, 0.1f}, .coat = 0.8f, .coat_ior = 1.5f, .coat_roughness = 0.3f};
    rt_error error;
    expect_ok(rt_scene_add_texture(scene, &worn.coat_texture, &checks, &error), &error);
    worn.coat_roughness_texture = worn.coat_texture;
    return add_material(scene, &worn);
}

/*
 * Diffuse surfaces that reflect, too: below coats, smooth and rough, in whole and in part, that
 * deepen colours or leave them, and by facets or a mirror of ks; flat, curved and smoothed.
 */
static void coats_and_gloss(void **state)
{
    static const rt_material materials[] = {
        {.kd = {0.7f, 0.6f, 0.5f}, .coat = 1, .coat_ior = 1.5f},
        {.kd = {0.2f, 0.6f, 0.8f}, .coat = 1, .coat_ior = 1.4f, .coat_roughness = 0.25f},
        {.kd = {0.8f, 0.3f, 0.2f}, .coat = 0.6f, .coat_ior = 1.7f, .coat_linear = 1},
        {.kd = {0.3f, 0.2f, 0.1f}, .ks = {0.5f, 0.5f, 0.6f}, .roughness = 0.4f},
        {.kd = {0.3f, 0.4f, 0.5f}, .ks = {0.5f, 0.4f, 0.3f}},
        {.kd = {0.6f, 0.6f, 0.6f}}};
    enum { count = sizeof materials / sizeof *materials };
    static const float floor[3] = {-5, -5, 0}, x[3] = {10, 0, 0}, y[3] = {0, 10, 0},
                       wall[3] = {-5, 3, 0}, up[3] = {0, 0, 4};
    static const float tent[9] = {-3, -1, 0.1f, -1, -1, 0.2f, -2, 0, 2},
                       bent[9] = {0.3f, -0.5f, 1, 0.2f, -0.6f, 1, 0.1f, -0.3f, 1};
    static const uint32_t indices[3] = {0, 1, 2};
    rt_surface surfaces[count];
    (void)state;
    rt_error error;
    rt_scene *scene = new_scene();
    const rt_surface worn = add_worn_coat(scene);
    for (int i = 0; i < count; i++) {
        const float centre[3] = {0.9f * (float)i - 2, 0.5f * (float)(i % 2), 0.4f};
        surfaces[i] = add_material(scene, materials + i);
        expect_ok(rt_scene_add_sphere(scene, NULL, centre, 0.4f, surfaces + i, &error), &error);
    }
    expect_ok(rt_scene_add_quad(scene, NULL, floor, x, y, surfaces, &error), &error);
    expect_ok(rt_scene_add_quad(scene, NULL, wall, x, up, &worn, &error), &error);
    expect_ok(rt_scene_add_triangles(scene, NULL, tent, 3, indices, 1, bent, surfaces + 1, &error),
              &error);
    add_lights(scene);
    expect_equal_films(scene, __func__);
}

static void all_surfaces_under_an_environment_alone(void **state)
{
    (void)state;
    static const rt_environment sky = {.radiance = {1, 1, 1}};
    rt_scene *scene = new_scene();
    rt_error error;
    add_shapes(scene);
    expect_ok(rt_scene_set_environment(scene, &sky, &error), &error);
    expect_equal_films(scene, __func__);
}

static void the_shipped_scenes(void **state)
{
    (void)state;
    glob_t found;
    assert_int_equal(glob("scenes/*.rts", 0, NULL, &found), 0);
    for (size_t i = 0; i < found.gl_pathc; i++) {
        rt_scene *scene = NULL;
        rt_error error;
        expect_ok(rt_scene_load(&scene, found.gl_pathv[i], NULL, &error), &error);
        expect_equal_films(scene, found.gl_pathv[i]);
    }
    globfree(&found);
    for (int mode = 1; mode < mode_count; mode++)
        assert_true(2 * films_compared[mode] > films_compared[0]);
}

static int open_devices(void **state)
{
    (void)state;
    device_one = device_of_width(1);
    device_eight = device_of_width(8);
    return 0;
}

static int close_devices(void **state)
{
    (void)state;
    rt_device_close(device_one);
    rt_device_close(device_eight);
    return 0;
}

static void other_widths_are_refused(void **state)
{
    const rt_device_options options = {.select = getenv("RT_TEST_DEVICE"), .width = 4};
    rt_device *device = NULL;
    rt_error error;
    (void)state;
    assert_int_equal(rt_device_open(&device, &options, &error), RT_ERROR_USAGE);
    assert_null(device);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flat_surfaces_under_flat_lights),
        cmocka_unit_test(backs_are_told_from_fronts),
        cmocka_unit_test(all_surfaces_under_all_lights),
        cmocka_unit_test(rough_metals),
        cmocka_unit_test(coats_and_gloss),
        cmocka_unit_test(all_surfaces_under_an_environment_alone),
        cmocka_unit_test(the_shipped_scenes),
        cmocka_unit_test(other_widths_are_refused),
    };
    return cmocka_run_group_tests(tests, open_devices, close_devices);
}
