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
        rt_gather gather;
        uint32_t k;
        float radius;
        uint32_t passes, spp;
        uint64_t photons, caustic_photons;
    } ways[] = {
        {"direct light by shadow rays", RT_DIRECT_NEE, 0, RT_GATHER_FLANN, 50, 0, 0, 16, 300000, 0},
        {"direct light from the map", RT_DIRECT_PHOTONS, 0, RT_GATHER_FLANN, 50, 0, 0, 16, 300000, 0},
        {"final gather", RT_DIRECT_NEE, 1, RT_GATHER_FLANN, 50, 0, 0, 16, 300000, 0},
        {"final gather of all light", RT_DIRECT_PHOTONS, 1, RT_GATHER_FLANN, 50, 0, 0, 16, 300000, 0},
        {"two final bounces", RT_DIRECT_NEE, 2, RT_GATHER_DEVICE, 50, 0, 0, 16, 300000, 0},
        {"gather on the device", RT_DIRECT_NEE, 0, RT_GATHER_DEVICE, 50, 0, 0, 16, 300000, 0},
        {"fixed radius", RT_DIRECT_PHOTONS, 0, RT_GATHER_AUTO, RT_K_ALL, 0.02f, 0, 16, 300000, 0},
        {"caustics apart", RT_DIRECT_NEE, 0, RT_GATHER_FLANN, 50, 0, 0, 16, 300000, 300000},
        {"caustics apart, final gather", RT_DIRECT_NEE, 1, RT_GATHER_DEVICE, 50, 0, 0, 16, 300000, 300000},
        {"passes", RT_DIRECT_NEE, 0, RT_GATHER_AUTO, 50, 0, 50, 1, 20000, 0},
        {"passes, all light from the map", RT_DIRECT_PHOTONS, 0, RT_GATHER_AUTO, 50, 0.03f, 50, 1, 20000, 0},
        {"passes, final gather, caustics apart", RT_DIRECT_NEE, 1, RT_GATHER_AUTO, 20, 0, 50, 1, 20000, 5000},
    };
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
        options.gather = ways[i].gather;
        options.k = ways[i].k;
        options.radius = ways[i].radius;
        options.passes = ways[i].passes;
        options.spp = ways[i].spp;
        options.photons = ways[i].photons;
        options.caustic_photons = ways[i].caustic_photons;
        rt_film *film = render(renderer, &options);
        double ratio = mean_of(film) / expected;
        print_message("%s: %.4f of path tracing\n", ways[i].name, ratio);
        assert_true(fabs(ratio - 1) < tolerance);
        rt_film_destroy(film);
    }
    rt_film_destroy(path);
    rt_renderer_destroy(renderer);
}

static void both_gathers_make_the_same_picture(void **state)
{
    rt_render_options options = photon_options();
    (void)state;
    rt_renderer *renderer = make_renderer(test_device());
    options.final_gather = 1;
    options.gather = RT_GATHER_FLANN;
    rt_film *host = render(renderer, &options);
    options.gather = RT_GATHER_DEVICE;
    rt_film *device = render(renderer, &options);
    for (int i = 0; i < side * side * 3; i++)
        assert_float_equal(rt_film_rgb(host)[i], rt_film_rgb(device)[i], 1e-5 * (1 + rt_film_rgb(host)[i]));
    rt_film_destroy(host);
    rt_film_destroy(device);
    rt_renderer_destroy(renderer);
}

/* A floor under a glass sphere and a point light: eye paths can never find the light through the glass. */
static rt_renderer *make_point_caustic(void)
{
    const float corner[3] = {-1, 0, -1}, x[3] = {2, 0, 0}, z[3] = {0, 0, 2}, ball[3] = {0, 0.5f, 0};
    rt_point_light light = {{0.5f, 1.6f, 0}, {1, 1, 1}, {0}};
    rt_camera camera = {.eye = {0, 3, -0.01f}, .up = {0, 0, 1}, .fov = 36};
    rt_renderer *renderer = NULL;
    rt_scene *scene = NULL;
    rt_error error;

    expect_ok(rt_scene_create(&scene, &error), &error);
    rt_surface clear = {.material = add(scene, 0, 0, 1)};
    add_quad(scene, add(scene, 0.6f, 0, 0), 0, corner, z, x);
    expect_ok(rt_scene_add_sphere(scene, NULL, ball, 0.3f, &clear, &error), &error);
    expect_ok(rt_scene_add_point_light(scene, &light, &error), &error);
    expect_ok(rt_scene_set_camera(scene, &camera, &error), &error);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    rt_scene_destroy(scene);
    return renderer;
}

static void a_final_gather_keeps_the_caustics_of_point_lights(void **state)
{
    rt_render_options options = photon_options();
    (void)state;
    rt_renderer *renderer = make_point_caustic();
    options.k = RT_K_ALL; /* else the other photons would make the discs smaller where all are in one list */
    options.radius = 0.03f;
    rt_film *film = render(renderer, &options);
    double plain = mean_of(film);
    rt_film_destroy(film);
    options.mode = RT_MODE_PATH;
    film = render(renderer, &options);
    double without = mean_of(film);
    rt_film_destroy(film);
    options.mode = RT_MODE_PHOTON;
    for (int i = 0; i < 4; i++) {
        options.direct = i % 2 ? RT_DIRECT_PHOTONS : RT_DIRECT_NEE;
        options.caustic_photons = i / 2 ? options.photons : 0;
        options.final_gather = 1;
        film = render(renderer, &options);
        print_message("way %d: %.4f of no final gather; path tracing, without caustics, %.4f\n", i,
                      mean_of(film) / plain, without / plain);
        assert_true(fabs(mean_of(film) / plain - 1) < tolerance);
        rt_film_destroy(film);
    }
    assert_true(without / plain < 1 - 5 * tolerance);
    rt_renderer_destroy(renderer);
}

/* A white ball inside a ball of glass, in a room with a shining ceiling; the ball fills the picture. */
static rt_renderer *make_ball_in_glass(const float eye[3], float fov)
{
    const float x[3] = {2, 0, 0}, y[3] = {0, 2, 0}, z[3] = {0, 0, 2}, low[3] = {-1, -1, -1}, high[3] = {-1, 1, -1},
                back[3] = {-1, -1, 1}, right[3] = {1, -1, -1}, centre[3] = {0};
    rt_camera camera = {.eye = {eye[0], eye[1], eye[2]}, .fov = fov};
    rt_renderer *renderer = NULL;
    rt_scene *scene = NULL;
    rt_error error;

    expect_ok(rt_scene_create(&scene, &error), &error);
    uint32_t walls = add(scene, 0.5f, 0, 0), black = add(scene, 0, 0, 0);
    rt_surface clear = {.material = add(scene, 0, 0, 1)}, white = {.material = add(scene, 0.5f, 0, 0)};
    add_quad(scene, walls, 0, low, z, x);
    add_quad(scene, black, 1, high, x, z);
    add_quad(scene, walls, 0, back, y, x);
    add_quad(scene, walls, 0, low, y, z);
    add_quad(scene, walls, 0, right, z, y);
    expect_ok(rt_scene_add_sphere(scene, NULL, centre, 0.6f, &clear, &error), &error);
    expect_ok(rt_scene_add_sphere(scene, NULL, centre, 0.3f, &white, &error), &error);
    expect_ok(rt_scene_set_camera(scene, &camera, &error), &error);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    rt_scene_destroy(scene);
    return renderer;
}

/*
 * Photons bring flux into glass and the eye sees radiance: without the factor (eta_i/eta_t)^2 of radiance, the two
 * would differ by 2.25, in one direction from outside and in the other from inside.
 */
static void inside_glass_and_through_it_photons_agree_with_paths(void **state)
{
    static const struct {
        const char *name;
        float eye[3], fov;
    } views[] = {{"from outside", {0, 0, -3}, 4}, {"from inside the glass", {0, 0, -0.5f}, 30}};
    rt_render_options options = photon_options();
    (void)state;
    for (size_t i = 0; i < sizeof views / sizeof *views; i++) {
        rt_renderer *renderer = make_ball_in_glass(views[i].eye, views[i].fov);
        options.radius = 0.03f;
        options.photons = 3000000; /* of which some thousands come into the picture: noise of 2 % */
        options.mode = RT_MODE_PATH;
        options.spp = 256;
        rt_film *path = render(renderer, &options);
        options.mode = RT_MODE_PHOTON;
        options.spp = 16;
        rt_film *photon = render(renderer, &options);
        double ratio = mean_of(photon) / mean_of(path);
        print_message("%s: %.4f of path tracing\n", views[i].name, ratio);
        assert_true(fabs(ratio - 1) < 0.08);
        rt_film_destroy(path);
        rt_film_destroy(photon);
        rt_renderer_destroy(renderer);
    }
}

/* A dark wall behind clear glass that reflects nothing. */
static void every_eye_path_through_glass_comes_to_the_map(void **state)
{
    const float pane[3] = {-2, -2, 0}, behind[3] = {-2, -2, 0.2f}, wall[3] = {-2, -2, 1}, x[3] = {4, 0, 0},
                y[3] = {0, 4, 0};
    rt_point_light light = {{0, 0, 0.5f}, {1, 1, 1}, {0}};
    rt_camera camera = {.eye = {0, 0, -2}, .fov = 40};
    rt_material glass = {.kt = {1, 1, 1}, .ior = 1.5f};
    rt_render_options options = photon_options();
    rt_renderer *renderer = NULL;
    rt_scene *scene = NULL;
    rt_film_stats stats;
    rt_error error;
    uint32_t clear;
    (void)state;
    expect_ok(rt_scene_create(&scene, &error), &error);
    expect_ok(rt_scene_add_material(scene, &clear, NULL, &glass, &error), &error);
    add_quad(scene, clear, 0, pane, y, x);
    add_quad(scene, clear, 0, behind, x, y);
    add_quad(scene, add(scene, 0.1f, 0, 0), 0, wall, y, x);
    expect_ok(rt_scene_add_point_light(scene, &light, &error), &error);
    expect_ok(rt_scene_set_camera(scene, &camera, &error), &error);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    rt_scene_destroy(scene);
    options.photons = 1000;
    rt_film *film = render(renderer, &options);
    rt_film_get_stats(film, &stats);
    assert_int_equal(stats.gathers, side * side * options.spp);
    rt_film_destroy(film);
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

static void films_are_the_same(const rt_render_options *how)
{
    static const rt_device_options devices[] = {{NULL, 1, 1}, {NULL, 2, 16}, {NULL, 2, 64}};
    rt_render_options options = *how;
    rt_film *first = NULL;
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

static void films_do_not_depend_on_threads_and_work_groups(void **state)
{
    rt_render_options options = photon_options();
    (void)state;
    options.spp = 2;
    options.photons = 50000;
    films_are_the_same(&options);
    options.final_gather = 1;
    options.gather = RT_GATHER_DEVICE;
    films_are_the_same(&options);
    options.passes = 3;
    options.final_gather = 0;
    films_are_the_same(&options);
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

static void layers_tell_what_was_gathered(void **state)
{
    const double pi = 3.14159265358979323846;
    rt_render_options options = photon_options();
    uint32_t channels = 0;
    (void)state;
    rt_renderer *renderer = make_renderer(test_device());
    options.photon_layers = 1;
    for (int on_device = 0; on_device < 2; on_device++) {
        options.gather = on_device ? RT_GATHER_DEVICE : RT_GATHER_FLANN;
        rt_film *film = render(renderer, &options);
        const float *counts = rt_film_layer(film, "photon.count", &channels);
        const float *radii = rt_film_layer(film, "photon.radius", NULL);
        const float *densities = rt_film_layer(film, "photon.density", NULL);
        const float *variances = rt_film_layer(film, "photon.variance", NULL);
        assert_int_equal(channels, 1);
        assert_null(rt_film_layer(film, "photon.flux", NULL));
        int whole = 0;
        for (int i = 0; i < side * side; i++) {
            assert_true(counts[i] >= 0 && counts[i] <= 49 && radii[i] >= 0 && variances[i] >= 0);
            if (counts[i] == 49) { /* the mean of 49 over the areas is at least that over the mean radius squared */
                assert_true(densities[i] >= 0.999 * 49 / (pi * radii[i] * radii[i]));
                whole++;
            }
        }
        assert_true(whole > side * side / 2);
        rt_film_destroy(film);
    }
    options.photon_layers = 0;
    rt_film *film = render(renderer, &options);
    assert_null(rt_film_layer(film, "photon.count", NULL));
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
}

/*
 * A grey floor of 5 m under a directional light that meets it at right angles, seen 4 m wide. The photons in a disc of
 * it are Poisson distributed, to a thousandth.
 */
static const double floor_radius = 3.5355339, irradiance = 2, albedo = 0.5; /* of the sphere around it; in W/m^2 */

static rt_renderer *make_sunny_floor(void)
{
    const float corner[3] = {-2.5f, 0, -2.5f}, x[3] = {5, 0, 0}, z[3] = {0, 0, 5};
    rt_directional_light light = {.direction = {0, -1, 0}, .irradiance = {2, 2, 2}};
    rt_camera camera = {.kind = RT_CAMERA_ORTHOGRAPHIC, .eye = {0, 1, 0}, .up = {0, 0, 1}, .width = 4};
    rt_renderer *renderer = NULL;
    rt_scene *scene = NULL;
    rt_error error;
    expect_ok(rt_scene_create(&scene, &error), &error);
    add_quad(scene, add(scene, (float)albedo, 0, 0), 0, corner, z, x);
    expect_ok(rt_scene_add_directional_light(scene, &light, &error), &error);
    expect_ok(rt_scene_set_camera(scene, &camera, &error), &error);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    rt_scene_destroy(scene);
    return renderer;
}

/*
 * In passes, the variance layer is what theory says of counted photons, and foretells how far renders of two seeds
 * are apart. With n photons expected in a disc a pass, a box kernel's mean over P passes has the variance L^2 / (n P).
 * Over 20 pairs of seeds the layer was 0.3 % above, as the radius that shrinks a little has it, with a standard
 * deviation of 0.34 %, the squared difference 0.6 % with one of 3 %; both are held to five of them.
 */
static void the_variance_layer_is_that_of_other_seeds(void **state)
{
    enum { passes = 64 };
    const double radius = 0.05, pi = 3.14159265358979323846;
    rt_render_options options = photon_options();
    double foretold = 0, seen = 0;
    (void)state;
    rt_renderer *renderer = make_sunny_floor();
    options.passes = passes;
    options.spp = 1;
    options.photons = 3000;
    options.radius = (float)radius;
    options.kernel = RT_DENSITY_BOX;
    options.direct = RT_DIRECT_PHOTONS;
    options.sampler = RT_SAMPLER_INDEPENDENT;
    options.alpha = 0.999f; /* all passes nearly alike */
    options.photon_layers = 1;
    rt_film *a = render(renderer, &options);
    options.seed = 77;
    rt_film *b = render(renderer, &options);
    for (int i = 0; i < side * side; i++) {
        double difference = (double)rt_film_rgb(a)[3 * i] - rt_film_rgb(b)[3 * i];
        seen += difference * difference / (2 * side * side);
        foretold += rt_film_layer(a, "photon.variance", NULL)[i] / (2 * side * side) +
                    rt_film_layer(b, "photon.variance", NULL)[i] / (2 * side * side);
    }
    double radiance = albedo / pi * irradiance, expected = (double)options.photons * pow(radius / floor_radius, 2);
    double truth = radiance * radiance / (expected * passes);
    print_message("variance %g; of the layer %.4f, of other seeds %.4f of it\n", truth, foretold / truth, seen / truth);
    assert_float_equal(foretold, truth, 0.02 * truth);
    assert_float_equal(seen, truth, 0.16 * truth);
    rt_film_destroy(a);
    rt_film_destroy(b);
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
        rt_hooks hooks = {.progress = cancel_in_stage, .user = &stage};
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
        cmocka_unit_test(both_gathers_make_the_same_picture),
        cmocka_unit_test(a_final_gather_keeps_the_caustics_of_point_lights),
        cmocka_unit_test(inside_glass_and_through_it_photons_agree_with_paths),
        cmocka_unit_test(every_eye_path_through_glass_comes_to_the_map),
        cmocka_unit_test(smooth_surfaces_agree_with_path_tracing),
        cmocka_unit_test(films_do_not_depend_on_threads_and_work_groups),
        cmocka_unit_test(the_film_tells_what_was_done),
        cmocka_unit_test(layers_tell_what_was_gathered),
        cmocka_unit_test(the_variance_layer_is_that_of_other_seeds),
        cmocka_unit_test(a_cancel_ends_the_render),
    };
    return cmocka_run_group_tests_name("lib/render/photon_mode", tests, NULL, NULL);
}
