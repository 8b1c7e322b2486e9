/*
 * test_cloth.c - cloth in whole renders: in every mode that scatters light, against double
 * precision and against each other.
 */
#include "support.h"

#include <math.h>

#include "kernels/statistics.h"
#include "statistics/fuzz_reference.h"

enum { side = 16, pixels = side * side };

/* Renders a scene text; the mean of each channel. */
static void render(double mean[3], const char *text, rt_render_options options)
{
    rt_scene *scene = NULL;
    rt_renderer *renderer = NULL;
    rt_film *film = NULL;
    rt_error error;
    options.width = options.height = side;
    options.seed = test_seed(options.seed);
    expect_ok(rt_scene_parse(&scene, text, "test", NULL, &error), &error);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    mean[0] = mean[1] = mean[2] = 0;
    for (int i = 0; i < pixels; i++)
        for (int c = 0; c < 3; c++)
            mean[c] += rt_film_rgb(film)[3 * i + c] / (double)pixels;
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
}

/* ---- A floor --------------------------------------------------------------------- */

/* Seen from 59 degrees, lit at as much from the other side, where fuzz is bright. */
static const char floor_text[] =
    "camera { eye 2 1.2 0  look_at 0 0 0  fov 2 }\n"
    "material velvet { kd 0.3 0.1 0.05  fuzz 0.9 0.6 0.3  fuzz_roughness 0.4 }\n"
    "quad { corner -9 0 -9  edge1 0 0 18  edge2 18 0 0  material velvet }\n"
    "light spot { position -3 1.8 0  target 0 0 0  intensity 10  inner 6  outer 7 }\n";

static void expect_floor(rt_render_options options, double tolerance, const char *what)
{
    static const double kd[3] = {0.3, 0.1, 0.05}, fuzz[3] = {0.9, 0.6, 0.3};
    const double d2 = 3 * 3 + 1.8 * 1.8, cosine = 1.8 / sqrt(d2);
    const double between = (-3 * 2 + 1.8 * 1.2) / sqrt(d2 * (2 * 2 + 1.2 * 1.2));
    double mean[3];
    render(mean, floor_text, options);
    for (int c = 0; c < 3; c++) {
        const double exact =
            fuzz_fr(kd[c], fuzz[c], 0.9, 0.4, cosine, cosine, between) * 10 / d2 * cosine;
        expect_close(mean[c], exact, tolerance * exact, what);
    }
}

static void a_floor_scatters_by_the_definition(void **state)
{
    (void)state;
    expect_floor((rt_render_options){.spp = 16, .max_depth = 2}, 0.01, "by paths");
    expect_floor((rt_render_options){.mode = RT_MODE_DIRECT, .spp = 16}, 0.01, "in mode direct");
}

static void photons_scatter_by_the_lobe_that_gathers_them(void **state)
{
    rt_render_options map = {.mode = RT_MODE_PHOTON,
                             .spp = 4,
                             .photons = 400000,
                             .k = 200,
                             .direct = RT_DIRECT_PHOTONS,
                             .max_depth = 8};
    (void)state;
    map.gather = RT_GATHER_DEVICE;
    expect_floor(map, 0.05, "by photons of the tree");
    map.gather = RT_GATHER_FLANN;
    expect_floor(map, 0.05, "by photons of neighbour lists");
}

/* ---- A white furnace --------------------------------------------------------------- */

static void white_disappears_in_a_white_furnace(void **state)
{
    static const char text[] =
        "camera { eye 0 0 -3  look_at 0 0 0  fov 20 }\nlight environment { radiance 1 }\n"
        "material felt { kd 1  fuzz 1  fuzz_roughness 0.5 }\n"
        "sphere { centre 0 0 0  radius 0.8  material felt }\n";
    double mean[3];
    (void)state;
    render(mean, text, (rt_render_options){.spp = 256, .max_depth = 2});
    expect_close(mean[0], 1, 5e-3, "by paths");
}

/* ---- A room -------------------------------------------------------------------------- */

/* Light comes to the middle of a wall mostly by way of the others; one has no kd. */
static const char room[] =
    "camera { eye 0 0 0.9  look_at 0.2 0 -1  fov 25 }\n"
    "material felt { kd 0.7 0.5 0.3  fuzz 0.5 0.7 0.9  fuzz_roughness 0.5 }\n"
    "material plush { fuzz 0.9  fuzz_roughness 0.7 }\nmaterial emitter { emission 5 }\n"
    "quad { corner -1 -1 -1  edge1 2 0 0  edge2 0 2 0  material felt }\n"
    "quad { corner -1 -1 1  edge1 0 2 0  edge2 2 0 0  material felt }\n"
    "quad { corner -1 -1 -1  edge1 0 2 0  edge2 0 0 2  material plush }\n"
    "quad { corner 1 -1 -1  edge1 0 0 2  edge2 0 2 0  material felt }\n"
    "quad { corner -1 -1 -1  edge1 0 0 2  edge2 2 0 0  material felt }\n"
    "quad { corner -1 1 -1  edge1 2 0 0  edge2 0 0 2  material felt }\n"
    "quad { corner -0.3 0.9 -0.3  edge1 0.6 0 0  edge2 0 0 0.6  material emitter }\n";

static void modes_agree_in_a_room(void **state)
{
    double by_paths[3], mean[3];
    (void)state;
    render(by_paths, room, (rt_render_options){.spp = 256, .max_depth = 12});
    for (int m = 0; m < 3; m++) {
        rt_render_options options = {.mode = m == 2 ? RT_MODE_VCM : RT_MODE_PHOTON,
                                     .spp = m == 2 ? 32 : 16,
                                     .max_depth = 12,
                                     .final_gather = m == 1};
        if (m < 2) {
            options.photons = 200000;
            options.k = 100;
        }
        render(mean, room, options);
        for (int c = 0; c < 3; c++)
            expect_close(mean[c], by_paths[c], 0.03 * by_paths[c],
                         m == 0   ? "by the map alone"
                         : m == 1 ? "with a final gather"
                                  : "by vcm");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(a_floor_scatters_by_the_definition),
        statistical_test(photons_scatter_by_the_lobe_that_gathers_them),
        statistical_test(white_disappears_in_a_white_furnace),
        statistical_test(modes_agree_in_a_room),
    };
    return cmocka_run_group_tests_name("lib/render/cloth", tests, NULL, NULL);
}
