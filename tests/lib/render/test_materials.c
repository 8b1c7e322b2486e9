/*
 * test_materials.c - absorption, nested solids, rough boundaries and textures: whole renders
 * against closed forms.
 */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/statistics.h"

enum { side = 16, pixels = side * side };

static double values[3][pixels];

/* Renders a scene text into values[channel][pixel]. */
static void render(const char *text, rt_render_options options)
{
    rt_scene *scene = NULL;
    rt_renderer *renderer = NULL;
    rt_film *film = NULL;
    rt_film_stats stats;
    rt_error error;
    options.width = options.height = side;
    options.seed = test_seed(options.seed);
    expect_ok(rt_scene_parse(&scene, text, "test", NULL, &error), &error);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    rt_film_get_stats(film, &stats);
    assert_int_equal(stats.rejected, 0);
    for (int i = 0; i < pixels; i++)
        for (int c = 0; c < 3; c++)
            values[c][i] = rt_film_rgb(film)[3 * i + c];
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
}

static double mean(const double *v)
{
    double sum = 0;
    for (int i = 0; i < pixels; i++)
        sum += v[i];
    return sum / pixels;
}

/*
 * Every pixel is exp(-depth) times a scale, by channel; red is not absorbed, which keeps roulette
 * away.
 */
static void expect_depths(double g, double b, double scale)
{
    const double depth[3] = {0, g, b};
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < pixels; i++)
            assert_float_equal(values[c][i], scale * exp(-depth[c]), 1e-3 * scale);
}

/* ---- Absorption and nesting -------------------------------------------------- */

#define SLAB(z0, z1, material)                                                                     \
    "quad { corner -50 -50 " z0 "  edge1 0 100 0  edge2 100 0 0  material " material " }\n"        \
    "quad { corner -50 -50 " z1 "  edge1 100 0 0  edge2 0 100 0  material " material " }\n"
#define FROM(z)                                                                                    \
    "camera { eye 0 0 " z "  look_at 0 0 100  fov 1 }\nlight environment { radiance 1 }\n"
#define SMOKE(options) "material smoke { kt 1  ior 1.5  absorption 0 0.5 2  " options " }\n"
#define WINE(options) "material wine { kt 1  ior 1.3  absorption 0 0.2 0.4  " options " }\n"

static const rt_render_options few = {.spp = 4};

static void a_slab_absorbs_by_its_thickness(void **state)
{
    (void)state;
    render(FROM("0") SMOKE("") SLAB("1", "1.75", "smoke"), few);
    expect_depths(0.375, 1.5, 1);
}

static void the_stronger_of_two_overlapping_solids_absorbs(void **state)
{
    (void)state;
    render(FROM("0") SMOKE("priority 1") WINE("") SLAB("1", "2", "smoke") SLAB("1.5", "3", "wine"),
           few);
    expect_depths(0.5 + 0.2, 2 + 0.4, 1);
    render(FROM("0") SMOKE("") WINE("priority 1") SLAB("1", "2", "smoke") SLAB("1.5", "3", "wine"),
           few);
    expect_depths(0.25 + 0.3, 1 + 0.6, 1);
}

/* Radiance in a medium is the square of its index times that outside. */
static void a_camera_in_solids_starts_in_the_right_medium(void **state)
{
    (void)state;
    render(FROM("1.7") SMOKE("priority 1") WINE("") SLAB("1", "2", "smoke")
               SLAB("1.5", "3", "wine"),
           few);
    expect_depths(0.15 + 0.2, 0.6 + 0.4, 2.25);
    render(FROM("1.7") SMOKE("") WINE("priority 1") SLAB("1", "2", "smoke")
               SLAB("1.5", "3", "wine"),
           few);
    expect_depths(0.26, 0.52, 1.69);
    render(FROM("2.5") SMOKE("priority 1") WINE("") SLAB("1", "2", "smoke")
               SLAB("1.5", "3", "wine"),
           few);
    expect_depths(0.1, 0.2, 1.69);
}

/* ---- Photons ------------------------------------------------------------------ */

#define FLOOR                                                                                      \
    "camera { eye 0 0.9 0  look_at 0 0 0  up 0 0 1  fov 10 }\n"                                    \
    "material grey { kd 0.6 }\nplane { point 0 0 0  normal 0 1 0  material grey }\n"
#define SPOT "light spot { position 0 3 0  target 0 0 0  intensity 10  inner 6  outer 7 }\n"

static const rt_render_options photons = {
    .mode = RT_MODE_PHOTON, .spp = 4, .photons = 100000, .k = 50, .max_depth = 8};

static void expect_floor(const double depth[3])
{
    for (int c = 0; c < 3; c++) {
        double exact = 0.6 / 3.14159265 * 10 / 9 * exp(-depth[c]);
        expect_close(mean(values[c]), exact, 0.05 * exact, "floor");
    }
}

static void photons_are_absorbed_on_their_way(void **state)
{
    static const double through[3] = {0.1, 0.5, 1};
    (void)state;
    render(FLOOR SPOT "material smoke { kt 1  ior 1  absorption 0.2 1 2 }\n"
                      "quad { corner -9 1.5 -9  edge1 0 0 18  edge2 18 0 0  material smoke }\n"
                      "quad { corner -9 1 -9  edge1 18 0 0  edge2 0 0 18  material smoke }\n",
           photons);
    expect_floor(through);
}

static void photons_start_in_the_solid_that_their_light_lies_in(void **state)
{
    static const double half[3] = {0.1, 0.5, 1};
    (void)state;
    render(FLOOR SPOT "material smoke { kt 1  ior 1  absorption 0.2 1 2 }\n"
                      "sphere { centre 0 3 0  radius 0.5  material smoke }\n",
           photons);
    expect_floor(half);
}

/*
 * Light through a rough pane, found by eye paths and by photons, whose transport is each other's
 * adjoint.
 */
static void photons_and_paths_agree_through_rough_glass(void **state)
{
    static const char text[] =
        FLOOR "material frosted { kt 1  ior 1.5  fresnel dielectric  roughness 0.3 }\n"
              "material emitter { emission 5 }\n"
              "quad { corner -9 1.5 -9  edge1 0 0 18  edge2 18 0 0  material frosted }\n"
              "quad { corner -9 1 -9  edge1 18 0 0  edge2 0 0 18  material frosted }\n"
              "quad { corner -0.5 2 -0.5  edge1 1 0 0  edge2 0 0 1  material emitter }\n";
    rt_render_options path = {.spp = 1024, .max_depth = 8}, map = photons;
    (void)state;
    render(text, path);
    double by_paths = mean(values[1]);
    map.photons = 2000000;
    map.k = 1000;
    render(text, map);
    assert_true(by_paths > 0.05);
    expect_close(mean(values[1]), by_paths, 0.08 * by_paths, "through rough glass");
}

/* ---- Rough boundaries ------------------------------------------------------------ */

/*
 * An area light in absorbing glass behind a rough boundary: sampling the light and sampling the
 * boundary bring the same light.
 */
static void light_is_sampled_through_a_rough_boundary(void **state)
{
    static const char text[] =
        "camera { eye 0 0 0  look_at 0.3 0 1  fov 60 }\n"
        "material frosted { kt 1  ior 1.5  fresnel dielectric  roughness 0.4  absorption 0.2 }\n"
        "material emitter { emission 1 }\n"
        "quad { corner -50 -50 1  edge1 0 100 0  edge2 100 0 0  material frosted }\n"
        "quad { corner -1 -1 3  edge1 0 2 0  edge2 2 0 0  material emitter }\n";
    static double difference[pixels];
    rt_render_options options = {.spp = 64,
                                 .max_depth = 2,
                                 .sampler = RT_SAMPLER_INDEPENDENT,
                                 .estimator = RT_ESTIMATOR_LIGHT};
    double light;
    (void)state;
    render(text, options);
    memcpy(difference, values[0], sizeof difference);
    light = mean(difference);
    options.estimator = RT_ESTIMATOR_BSDF;
    options.seed = 1;
    render(text, options);
    for (int i = 0; i < pixels; i++)
        difference[i] -= values[0][i];
    assert_true(light > 0.01);
    expect_mean(difference, pixels, 0, 1e-6 * light, "light and boundary sampling");
}

#define FURNACE "camera { eye 0 0 -3  look_at 0 0 0  fov 30 }\nlight environment { radiance 1 }\n"

static void clear_glass_disappears_in_a_white_furnace_and_rough_glass_never_gains(void **state)
{
    const rt_render_options deep = {.spp = 16, .max_depth = 60};
    (void)state;
    render(FURNACE "material glass { kt 1  fresnel dielectric }\nsphere { centre 0 0 0  radius 0.7 "
                   " material glass }\n",
           deep);
    for (int i = 0; i < pixels; i++)
        assert_float_equal(values[0][i], 1, 5e-3);
    render(FURNACE "material glass { kt 1  fresnel dielectric  roughness 0.3\n"
                   "                 facet_scattering single }\n"
                   "sphere { centre 0 0 0  radius 0.7  material glass }\n",
           deep);
    /*
     * The sphere fills two thirds of the picture and keeps three quarters: much is lost on the way
     * out.
     */
    assert_true(mean(values[0]) < 1 && mean(values[0]) > 0.75);
}

/* ---- Textures ------------------------------------------------------------------- */

static void textures_multiply_colours(void **state)
{
    const rt_render_options albedo = {.mode = RT_MODE_ALBEDO, .spp = 1};
    (void)state;
    /* Squares of a quarter of the picture, which the quad fills. */
    render("camera { eye 0 0 -1  look_at 0 0 0  fov 90 }\nlight environment { radiance 1 }\n"
           "texture squares { pattern checker  a 0.8 0.4 1  b 0.2 0.4 0  scale 2 2 }\n"
           "texture half { pattern checker  a 0.5  b 0.5 }\n"
           "material tiles { kd 0.9 0.5 0.25  kd_texture squares  ks 0.5  ks_texture half }\n"
           "quad { corner -1 -1 0  edge1 0 2 0  edge2 2 0 0  material tiles  texture half }\n",
           albedo);
    for (int i = 0; i < pixels; i++) {
        int odd = (i % side < side / 2) != (i / side < side / 2);
        assert_float_equal(values[0][i], (odd ? 0.09 : 0.36) + 0.25, 1e-5);
        assert_float_equal(values[1][i], 0.1 + 0.25, 1e-5);
        assert_float_equal(values[2][i], (odd ? 0 : 0.125) + 0.25, 1e-5);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_slab_absorbs_by_its_thickness),
        cmocka_unit_test(the_stronger_of_two_overlapping_solids_absorbs),
        cmocka_unit_test(a_camera_in_solids_starts_in_the_right_medium),
        statistical_test(photons_are_absorbed_on_their_way),
        statistical_test(photons_start_in_the_solid_that_their_light_lies_in),
        statistical_test(photons_and_paths_agree_through_rough_glass),
        statistical_test(light_is_sampled_through_a_rough_boundary),
        cmocka_unit_test(clear_glass_disappears_in_a_white_furnace_and_rough_glass_never_gains),
        cmocka_unit_test(textures_multiply_colours),
    };
    return cmocka_run_group_tests_name("render/materials", tests, NULL, NULL);
}
