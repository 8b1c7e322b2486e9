/*
 * test_lights.c - lights over a floor against closed forms, by path tracing and from the photon
 * map.
 */
#include "kernels/statistics.h"
#include "lib/render/means.h"
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

enum { side = 12, pixels = side * side };

static rt_error error;

/*
 * A white floor of 4 m x 4 m, of which the camera sees `width` m x `width` m in the middle from
 * straight above.
 */
static rt_scene *floor_scene(float width)
{
    static const float corner[3] = {-2, 0, 2}, x[3] = {4, 0, 0}, z[3] = {0, 0, -4};
    static const rt_material half = {.kd = {0.5f, 0.5f, 0.5f}};
    rt_camera camera = {.kind = RT_CAMERA_ORTHOGRAPHIC,
                        .eye = {0, 3, 0},
                        .look_at = {0, 0, 0},
                        .up = {0, 0, 1},
                        .width = width};
    rt_scene *scene = NULL;
    rt_surface surface;
    memset(&surface, 0, sizeof surface);
    expect_ok(rt_scene_create(&scene, &error), &error);
    expect_ok(rt_scene_set_camera(scene, &camera, &error), &error);
    expect_ok(rt_scene_add_material(scene, &surface.material, NULL, &half, &error), &error);
    expect_ok(rt_scene_add_quad(scene, NULL, corner, x, z, &surface, &error), &error);
    return scene;
}

/* The mean over the film, which is half the irradiance over pi. */
static double irradiance(rt_scene *scene, rt_mode mode, rt_direct direct)
{
    rt_render_options options = {.width = side,
                                 .height = side,
                                 .mode = mode,
                                 .spp = mode == RT_MODE_PHOTON && direct ? 4 : 64,
                                 .photons = direct ? 400000 : 1000,
                                 .k = 400,
                                 .direct = direct,
                                 .seed = test_seed(3)};
    rt_renderer *renderer = NULL;
    rt_film *film = NULL;
    double sum = 0;
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    for (int i = 0; i < 3 * pixels; i++)
        sum += rt_film_rgb(film)[i];
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
    return sum / (3 * pixels) / 0.5 * pi;
}

/*
 * Path tracing to `close` of the exact value; the map, of which the film sees about 10^4 photons,
 * to 3 %, and so the shadow rays of gather points, which light sampling alone aims.
 */
static void expect_irradiance(rt_scene *(*make)(void), double exact, double close)
{
    expect_close(irradiance(make(), RT_MODE_PATH, RT_DIRECT_NEE), exact, close * exact,
                 "irradiance");
    expect_close(irradiance(make(), RT_MODE_DIRECT, RT_DIRECT_NEE), exact, close * exact,
                 "irradiance");
    expect_close(irradiance(make(), RT_MODE_PHOTON, RT_DIRECT_PHOTONS), exact, 0.03 * exact,
                 "irradiance");
    expect_close(irradiance(make(), RT_MODE_PHOTON, RT_DIRECT_NEE), exact, 0.03 * exact,
                 "irradiance");
}

/* Seen 0.4 m wide, so that the light is nearly even there. */
static rt_scene *with_spot(rt_spot_light spot)
{
    rt_scene *scene = floor_scene(0.4f);
    expect_ok(rt_scene_add_spot_light(scene, &spot, &error), &error);
    return scene;
}

static rt_scene *spot_above(void)
{
    return with_spot(
        (rt_spot_light){.position = {0, 2, 0}, .intensity = {8, 8, 8}, .inner = 20, .outer = 40});
}

static rt_scene *spot_aside(void)
{
    return with_spot((rt_spot_light){.position = {2, 2, 0},
                                     .target = {2, 0, 0},
                                     .intensity = {8, 8, 8},
                                     .inner = 30,
                                     .outer = 60});
}

/* The mean of f over the square of 0.4 m that the camera sees. */
static double mean_over_square(double (*f)(double x, double z))
{
    enum { steps = 100 };
    double sum = 0;
    for (int i = 0; i < steps; i++)
        for (int j = 0; j < steps; j++)
            sum += f(0.4 * ((i + 0.5) / steps - 0.5), 0.4 * ((j + 0.5) / steps - 0.5));
    return sum / (steps * steps);
}

/* I h / d^3, d the distance. */
static double inside_the_cone(double x, double z)
{
    return 8 * 2 / pow(x * x + z * z + 4, 1.5);
}

static double in_the_edge(double x, double z)
{
    double d = sqrt((x - 2) * (x - 2) + z * z + 4),
           t = (2 / d - cos(pi / 3)) / (cos(pi / 6) - cos(pi / 3));
    return 8 * t * t * (3 - 2 * t) * 2 / (d * d * d);
}

static void spots_by_the_cosine_cubed_and_their_edge(void **state)
{
    (void)state;
    expect_irradiance(spot_above, mean_over_square(inside_the_cone), 1e-3);
    expect_irradiance(spot_aside, mean_over_square(in_the_edge), 1e-3);
}

static rt_scene *sun(void)
{
    rt_directional_light light = {.direction = {1, -2, 1}, .irradiance = {3, 3, 3}};
    rt_scene *scene = floor_scene(2);
    expect_ok(rt_scene_add_directional_light(scene, &light, &error), &error);
    return scene;
}

static void directional_lights_by_the_cosine(void **state)
{
    (void)state;
    expect_irradiance(sun, 3 * 2 / sqrt(6), 1e-5);
}

static rt_scene *even_sky(void)
{
    rt_environment sky = {.radiance = {2, 2, 2}};
    rt_scene *scene = floor_scene(2);
    expect_ok(rt_scene_set_environment(scene, &sky, &error), &error);
    return scene;
}

static void even_environments_by_pi(void **state)
{
    (void)state;
    expect_irradiance(even_sky, 2 * pi, 5e-3);
}

/*
 * The same through a pane without end, which stands between the floor and where the light comes
 * from.
 */
static rt_scene *sky_behind_pane(void)
{
    static const rt_material clear = {.kt = {1, 1, 1}, .ior = 1};
    static const float point[3] = {0, 1, 0}, up[3] = {0, 1, 0};
    rt_scene *scene = even_sky();
    rt_surface pane;
    memset(&pane, 0, sizeof pane);
    expect_ok(rt_scene_add_material(scene, &pane.material, NULL, &clear, &error), &error);
    expect_ok(rt_scene_add_plane(scene, NULL, point, up, &pane, &error), &error);
    return scene;
}

static void distant_light_comes_through_clear_planes(void **state)
{
    (void)state;
    expect_close(irradiance(sky_behind_pane(), RT_MODE_PATH, RT_DIRECT_NEE), 2 * pi, 5e-3 * 2 * pi,
                 "irradiance");
    expect_close(irradiance(sky_behind_pane(), RT_MODE_PHOTON, RT_DIRECT_PHOTONS), 2 * pi,
                 0.03 * 2 * pi, "irradiance");
}

/* A black disc over the middle of the floor, which emits downwards when it has radiance. */
static void add_disc(rt_scene *scene, float height, float radius, float radiance)
{
    static const rt_material black;
    static const float down[3] = {0, -1, 0};
    const float centre[3] = {0, height, 0};
    rt_surface surface;
    memset(&surface, 0, sizeof surface);
    expect_ok(rt_scene_add_material(scene, &surface.material, NULL, &black, &error), &error);
    surface.radiance[0] = surface.radiance[1] = surface.radiance[2] = radiance;
    expect_ok(rt_scene_add_disc(scene, NULL, centre, down, radius, 0, &surface, &error), &error);
}

/* The floor from below all that hangs over it. */
static rt_scene *spot_of_floor(void)
{
    rt_scene *scene = floor_scene(0.02f);
    rt_camera camera = {.kind = RT_CAMERA_ORTHOGRAPHIC,
                        .eye = {0, 0.9f, 0},
                        .look_at = {0, 0, 0},
                        .up = {0, 0, 1},
                        .width = 0.02f};
    expect_ok(rt_scene_set_camera(scene, &camera, &error), &error);
    return scene;
}

/* On the axis of a disc, E = pi L r^2 / (r^2 + h^2). */
static rt_scene *disc_light(void)
{
    rt_scene *scene = spot_of_floor();
    add_disc(scene, 1, 0.5f, 4);
    return scene;
}

static void discs_by_their_form_factor(void **state)
{
    (void)state;
    expect_close(irradiance(disc_light(), RT_MODE_PATH, RT_DIRECT_NEE), pi * 4 * 0.25 / 1.25,
                 3e-3 * pi * 0.8, "irradiance");
}

/*
 * The irradiance by a light of a metre's height and a disc that hides it, or does not, at another
 * height.
 */
static double past_disc(int is_point, float height)
{
    rt_point_light point = {.position = {0, 1, 0}, .intensity = {1, 1, 1}};
    rt_scene *scene = spot_of_floor();
    add_disc(scene, height, 0.3f, 0);
    if (is_point)
        expect_ok(rt_scene_add_point_light(scene, &point, &error), &error);
    else
        add_disc(scene, 1, 0.1f, 100);
    return irradiance(scene, RT_MODE_DIRECT, RT_DIRECT_NEE);
}

static void shadows_are_cast_by_what_is_before_the_light(void **state)
{
    (void)state;
    for (int is_point = 0; is_point < 2; is_point++) {
        double whole = is_point ? 1 : pi * 100 * 0.01 / 1.01;
        expect_close(past_disc(is_point, 1.001f), whole, 3e-3 * whole, "irradiance");
        assert_true(past_disc(is_point, 0.999f) == 0);
    }
}

/* Each by intensity over squared height, however unlike they are. */
static void point_lights_add_up(void **state)
{
    static const float intensities[] = {2, 3, 4}, heights[] = {1, 2, 4};
    double whole = 0;
    (void)state;
    rt_scene *scene = spot_of_floor();
    for (int i = 0; i < 3; i++) {
        rt_point_light point = {.position = {0, heights[i], 0}};
        point.intensity[0] = point.intensity[1] = point.intensity[2] = intensities[i];
        expect_ok(rt_scene_add_point_light(scene, &point, &error), &error);
        whole += intensities[i] / (heights[i] * heights[i]);
    }
    expect_close(irradiance(scene, RT_MODE_DIRECT, RT_DIRECT_NEE), whole, 0.03 * whole,
                 "irradiance");
}

/* What the camera, a mirror and a clear pane show of an environment is the environment. */
static void environments_are_seen(void **state)
{
    static const rt_material mirror = {.ks = {1, 1, 1}}, clear = {.kt = {1, 1, 1}, .ior = 1};
    static const float origin[3] = {0, 0, 0};
    (void)state;
    for (int i = 0; i < 3; i++) {
        rt_environment sky = {.radiance = {2, 1, 0.5f}};
        rt_camera camera = {.eye = {0, 0, -4}, .look_at = {0, 0, 0}, .fov = 40};
        rt_render_options options = {.width = side, .height = side, .spp = 4, .max_depth = 4};
        rt_scene *scene = NULL;
        rt_renderer *renderer = NULL;
        rt_film *film = NULL;
        rt_surface surface;
        memset(&surface, 0, sizeof surface);
        expect_ok(rt_scene_create(&scene, &error), &error);
        expect_ok(rt_scene_set_camera(scene, &camera, &error), &error);
        expect_ok(rt_scene_set_environment(scene, &sky, &error), &error);
        if (i > 0) {
            expect_ok(rt_scene_add_material(scene, &surface.material, NULL,
                                            i == 1 ? &mirror : &clear, &error),
                      &error);
            expect_ok(rt_scene_add_sphere(scene, NULL, origin, 1, &surface, &error), &error);
        }
        expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
        expect_ok(rt_render(&film, renderer, &options, &error), &error);
        for (int k = 0; k < 3 * pixels; k++)
            assert_float_equal(rt_film_rgb(film)[k], sky.radiance[k % 3], 1e-5);
        rt_film_destroy(film);
        rt_renderer_destroy(renderer);
        rt_scene_destroy(scene);
    }
}

/* A lamp 0.05 mm behind a wall, in a room, with air or a medium: no light passes the wall. */
static void walls_close_to_a_light_hide_it(void **state)
{
    static const char *const rooms[] = {"", "medium { scattering 0.1 }\n"};
    static const rt_mode modes[] = {RT_MODE_PATH, RT_MODE_VCM, RT_MODE_PATH};
    (void)state;
    for (int i = 0; i < 3; i++) {
        char text[512];
        double means[3];
        snprintf(text, sizeof text,
                 "camera { eye 0 1 -0.9  look_at 0 1 1  fov 90 }\nmaterial white { kd 0.7 }\n%s"
                 "box { centre 0 1 0  size 2 2 2  material white }\n"
                 "light spot { position 0 1 1.00005  target 0 1 0  outer 80  intensity 3 }\n",
                 rooms[i / 2]);
        render_means(means, text, (rt_render_options){.mode = modes[i], .spp = 4});
        assert_true(means[0] == 0 && means[1] == 0 && means[2] == 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(spots_by_the_cosine_cubed_and_their_edge),
        statistical_test(directional_lights_by_the_cosine),
        statistical_test(even_environments_by_pi),
        statistical_test(distant_light_comes_through_clear_planes),
        statistical_test(discs_by_their_form_factor),
        statistical_test(shadows_are_cast_by_what_is_before_the_light),
        statistical_test(point_lights_add_up),
        cmocka_unit_test(walls_close_to_a_light_hide_it),
        cmocka_unit_test(environments_are_seen),
    };
    return cmocka_run_group_tests_name("lib/render/lights", tests, NULL, NULL);
}
