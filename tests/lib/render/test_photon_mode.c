/*
 * test_photon_mode.c - photon mapping makes the picture that path tracing makes, by each of its ways,
 * and the same bytes however the work is shared out.
 */
#include "support.h"

#include <math.h>
#include <string.h>

enum { side = 48 };

/*
 * Means over the film may be off by so much: the estimate blurs light over edges of the room, and both
 * renders are noisy (path tracing 0.3 %, the map 0.5 %, one standard error each).
 */
static const double tolerance = 0.01;

static uint32_t add(rt_scene *scene, float kd, float ks, float kt)
{
    rt_material material = {.kd = {kd, kd, kd}, .ks = {ks, ks, ks}, .kt = {kt, kt, kt}, .ior = 1.5f,
                            .fresnel = kt > 0 ? RT_FRESNEL_DIELECTRIC : RT_FRESNEL_OFF};
    uint32_t index = 0;
    rt_error error;
    expect_ok(rt_scene_add_material(scene, &index, NULL, &material, &error), &error);
    return index;
}

static void add_quad(rt_scene *scene, uint32_t material, float radiance, const float c[3], const float a[3],
                     const float b[3])
{
    rt_surface surface = {.material = material, .radiance = {radiance, radiance, radiance}};
    rt_error error;
    expect_ok(rt_scene_add_quad(scene, NULL, c, a, b, &surface, &error), &error);
}

/* A room of half-white walls, open to the camera, with a mirror and a glass sphere under a lamp. */
static rt_renderer *make_renderer(rt_device *device)
{
    const float x[3] = {2, 0, 0}, y[3] = {0, 2, 0}, z[3] = {0, 0, 2}, low[3] = {-1, -1, -1}, high[3] = {-1, 1, -1},
                back[3] = {-1, -1, 1}, right[3] = {1, -1, -1}, lamp[3] = {-0.5f, 0.99f, -0.5f},
                lamp_x[3] = {1, 0, 0}, lamp_z[3] = {0, 0, 1}, mirror[3] = {-0.5f, -0.6f, 0.3f},
                glass[3] = {0.5f, -0.6f, 0};
    rt_camera camera = {.eye = {0, 0, -4}, .fov = 40};
    rt_renderer *renderer = NULL;
    rt_scene *scene = NULL;
    rt_error error;

    expect_ok(rt_scene_create(&scene, &error), &error);
    uint32_t walls = add(scene, 0.5f, 0, 0), black = add(scene, 0, 0, 0);
    rt_surface silver = {.material = add(scene, 0, 0.9f, 0)}, clear = {.material = add(scene, 0, 0, 1)};
    add_quad(scene, walls, 0, low, x, z);
    add_quad(scene, walls, 0, high, x, z);
    add_quad(scene, walls, 0, back, x, y);
    add_quad(scene, walls, 0, low, y, z);
    add_quad(scene, walls, 0, right, y, z);
    add_quad(scene, black, 5, lamp, lamp_x, lamp_z);
    expect_ok(rt_scene_add_sphere(scene, NULL, mirror, 0.4f, &silver, &error), &error);
    expect_ok(rt_scene_add_sphere(scene, NULL, glass, 0.4f, &clear, &error), &error);
    expect_ok(rt_scene_set_camera(scene, &camera, &error), &error);
    expect_ok(rt_renderer_create(&renderer, scene, device, NULL, &error), &error);
    rt_scene_destroy(scene);
    return renderer;
}

static rt_render_options photon_options(void)
{
    rt_render_options options;
    memset(&options, 0, sizeof options);
    options.width = options.height = side;
    options.mode = RT_MODE_PHOTON;
    options.spp = 16;
    options.photons = 300000;
    options.seed = 4;
    return options;
}

static rt_film *render(rt_renderer *renderer, const rt_render_options *options)
{
    rt_film *film = NULL;
    rt_error error;
    expect_ok(rt_render(&film, renderer, options, &error), &error);
    return film;
}

static double mean_of(const rt_film *film)
{
    const float *rgb = rt_film_rgb(film);
    double sum = 0;
    for (int i = 0; i < side * side * 3; i++)
        sum += rgb[i] / (side * side * 3.0);
    return sum;
}

static void every_way_agrees_with_path_tracing(void **state)
{
    static const struct {
        const char *name;
        rt_direct direct;
        uint32_t final_gather;
    } ways[] = {{"direct light by shadow rays", RT_DIRECT_NEE, 0},
                {"direct light from the map", RT_DIRECT_PHOTONS, 0},
                {"final gather", RT_DIRECT_NEE, 1},
                {"final gather of all light", RT_DIRECT_PHOTONS, 1}};
    rt_render_options options = photon_options();
    (void)state;
    rt_renderer *renderer = make_renderer(test_device());
    options.mode = RT_MODE_PATH;
    options.spp = 512;
    rt_film *path = render(renderer, &options);
    double expected = mean_of(path);
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        options = photon_options();
        options.direct = ways[i].direct;
        options.final_gather = ways[i].final_gather;
        rt_film *film = render(renderer, &options);
        double ratio = mean_of(film) / expected;
        print_message("%s: %.4f of path tracing\n", ways[i].name, ratio);
        assert_true(fabs(ratio - 1) < tolerance);
        rt_film_destroy(film);
    }
    rt_film_destroy(path);
    rt_renderer_destroy(renderer);
}

/* A floor whose shading normals lean away from each other, under a point light. */
static rt_renderer *make_smooth_floor(void)
{
    const float positions[12] = {-1, 0, -1, 1, 0, -1, 1, 0, 1, -1, 0, 1};
    const float normals[12] = {-0.6f, 0.8f, 0, 0.6f, 0.8f, 0, 0.6f, 0.8f, 0, -0.6f, 0.8f, 0};
    const uint32_t indices[6] = {0, 2, 1, 0, 3, 2};
    rt_point_light light = {{-0.3f, 0.8f, 0.2f}, {1, 1, 1}, {0}};
    rt_camera camera = {.eye = {0, 3, -0.01f}, .up = {0, 0, 1}, .fov = 30};
    rt_renderer *renderer = NULL;
    rt_scene *scene = NULL;
    rt_error error;

    expect_ok(rt_scene_create(&scene, &error), &error);
    rt_surface surface = {.material = add(scene, 0.8f, 0, 0)};
    expect_ok(rt_scene_add_triangles(scene, NULL, positions, 4, indices, 2, normals, &surface, &error), &error);
    expect_ok(rt_scene_add_point_light(scene, &light, &error), &error);
    expect_ok(rt_scene_set_camera(scene, &camera, &error), &error);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    rt_scene_destroy(scene);
    return renderer;
}

static void smooth_surfaces_agree_with_path_tracing(void **state)
{
    rt_render_options options = photon_options();
    (void)state;
    rt_renderer *renderer = make_smooth_floor();
    options.direct = RT_DIRECT_PHOTONS;
    options.photons = 1000000;
    rt_film *photon = render(renderer, &options);
    options.mode = RT_MODE_PATH;
    rt_film *path = render(renderer, &options);
    print_message("smooth floor: %.4f of path tracing\n", mean_of(photon) / mean_of(path));
    for (int y = 0; y < side; y += 8)
        for (int x = 0; x < side; x += 8) {
            double sums[2] = {0};
            for (int i = 0; i < 64; i++) {
                size_t at = 3 * ((size_t)(y + i / 8) * side + (size_t)(x + i % 8));
                sums[0] += rt_film_rgb(photon)[at];
                sums[1] += rt_film_rgb(path)[at];
            }
            /* Thousands of photons lie in a block: noise of about 1 %. */
            assert_true(fabs(sums[0] / sums[1] - 1) < 0.05);
        }
    rt_film_destroy(photon);
    rt_film_destroy(path);
    rt_renderer_destroy(renderer);
}

static void films_do_not_depend_on_threads_and_work_groups(void **state)
{
    static const rt_device_options devices[] = {{NULL, 1, 1}, {NULL, 2, 16}, {NULL, 2, 64}};
    rt_render_options options = photon_options();
    rt_film *first = NULL;
    (void)state;
    options.spp = 2;
    options.photons = 50000;
    for (size_t i = 0; i < sizeof devices / sizeof *devices; i++) {
        rt_device *device = NULL;
        rt_error error;
        expect_ok(rt_device_open(&device, devices + i, &error), &error);
        rt_renderer *renderer = make_renderer(device);
        rt_film *film = render(renderer, &options);
        if (first)
            assert_memory_equal(rt_film_rgb(first), rt_film_rgb(film), side * side * 3 * sizeof(float));
        rt_renderer_destroy(renderer);
        rt_device_close(device);
        if (first)
            rt_film_destroy(film);
        else
            first = film;
    }
    rt_film_destroy(first);
}

static void the_film_tells_what_was_done(void **state)
{
    rt_render_options options = photon_options();
    rt_film_stats stats;
    (void)state;
    options.spp = 3;
    rt_renderer *renderer = make_renderer(test_device());
    rt_film *film = render(renderer, &options);
    rt_film_get_stats(film, &stats);
    assert_int_equal(stats.photons_emitted, options.photons);
    assert_true(stats.photons_stored > options.photons / 4 && stats.photons_stored < options.photons);
    assert_true(stats.gathers > 0 && stats.gathers <= 3 * side * side);
    assert_int_equal(stats.spp, 3);
    assert_int_equal(stats.rejected, 0);
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
}

static int cancel_in_stage(void *user, const rt_progress *progress)
{
    return progress->stage == *(const rt_stage *)user && progress->fraction > 0;
}

static void a_cancel_ends_the_render(void **state)
{
    static const rt_stage stages[] = {RT_STAGE_EMIT, RT_STAGE_GATHER};
    (void)state;
    rt_renderer *renderer = make_renderer(test_device());
    for (size_t i = 0; i < sizeof stages / sizeof *stages; i++) {
        rt_stage stage = stages[i];
        rt_hooks hooks = {cancel_in_stage, NULL, &stage};
        rt_render_options options = photon_options();
        rt_film *film = NULL;
        rt_error error;
        options.spp = 10000;
        options.hooks = &hooks;
        assert_int_equal(rt_render(&film, renderer, &options, &error), RT_CANCELLED);
        if (stage == RT_STAGE_EMIT)
            assert_null(film);
        if (stage == RT_STAGE_GATHER) {
            assert_non_null(film);
            rt_film_stats stats;
            rt_film_get_stats(film, &stats);
            assert_true(stats.spp >= 1 && stats.spp < 10000);
        }
        rt_film_destroy(film);
    }
    rt_renderer_destroy(renderer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_way_agrees_with_path_tracing),
        cmocka_unit_test(smooth_surfaces_agree_with_path_tracing),
        cmocka_unit_test(films_do_not_depend_on_threads_and_work_groups),
        cmocka_unit_test(the_film_tells_what_was_done),
        cmocka_unit_test(a_cancel_ends_the_render),
    };
    return cmocka_run_group_tests_name("lib/render/photon_mode", tests, NULL, NULL);
}
