/*
 * test_oren_nayar.c - rough diffuse surfaces in whole renders: by paths and by photons, against
 * double precision and against each other.
 */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/statistics.h"
#include "statistics/oren_nayar_reference.h"

enum { side = 16, pixels = side * side };

#define PI 3.14159265358979323846

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

static double mean(int channel)
{
    double sum = 0;
    for (int i = 0; i < pixels; i++)
        sum += values[channel][i];
    return sum / pixels;
}

/* ---- A floor --------------------------------------------------------------------- */

/* Seen from 59 degrees, lit from the same side or, with the light at -x, from the other. */
#define FLOOR(x)                                                                                   \
    "camera { eye 2 1.2 0  look_at 0 0 0  fov 2 }\n"                                               \
    "material clay { kd 0.9 0.6 0.2  roughness 1 }\n"                                              \
    "quad { corner -9 0 -9  edge1 0 0 18  edge2 18 0 0  material clay }\n"                         \
    "light spot { position " x " 1.8 0  target 0 0 0  intensity 10  inner 6  outer 7 }\n"

/* The radiance at the middle, by the definition. */
static double floor_radiance(double kd, double light_x)
{
    const double d2 = 3 * 3 + 1.8 * 1.8, cosine = 1.8 / sqrt(d2);
    const double between = (light_x * 2 + 1.8 * 1.2) / sqrt(d2 * (2 * 2 + 1.2 * 1.2));
    return oren_nayar_fr(kd, 1, cosine, cosine, between) * 10 / d2 * cosine;
}

static void expect_floor(rt_render_options options, double tolerance, const char *what)
{
    static const float kd[3] = {0.9f, 0.6f, 0.2f};
    for (int back = 0; back < 2; back++) {
        render(back ? FLOOR("-3") : FLOOR("3"), options);
        for (int c = 0; c < 3; c++) {
            const double exact = floor_radiance(kd[c], back ? -3 : 3);
            expect_close(mean(c), exact, tolerance * exact, what);
        }
    }
}

/* The way back is four times as bright as the way on, in blue: no Lambert surface is. */
static void a_floor_scatters_by_the_definition(void **state)
{
    (void)state;
    assert_true(floor_radiance(0.2, 3) > 4 * floor_radiance(0.2, -3));
    expect_floor((rt_render_options){.spp = 16, .max_depth = 2}, 3e-3, "by paths");
    expect_floor((rt_render_options){.mode = RT_MODE_DIRECT, .spp = 16}, 3e-3, "in mode direct");
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
    map.area = RT_AREA_HULL;
    expect_floor(map, 0.05, "by photons of the hull");
}

/* ---- A white furnace --------------------------------------------------------------- */

#define FURNACE                                                                                    \
    "camera { eye 0 0 -3  look_at 0 0 0  fov 20 }\nlight environment { radiance 1 }\n"             \
    "material chalk { kd 1  roughness 1 }\nsphere { centre 0 0 0  radius 0.8  material chalk }\n"

static void white_disappears_in_a_white_furnace(void **state)
{
    (void)state;
    render(FURNACE, (rt_render_options){.spp = 256, .max_depth = 2});
    expect_close(mean(0), 1, 2e-3, "by paths");
    render(FURNACE, (rt_render_options){.mode = RT_MODE_PHOTON,
                                        .spp = 4,
                                        .photons = 400000,
                                        .k = 200,
                                        .direct = RT_DIRECT_PHOTONS});
    expect_close(mean(0), 1, 0.03, "by photons");
    render(FURNACE, (rt_render_options){.mode = RT_MODE_ALBEDO, .spp = 4});
    for (int i = 0; i < pixels; i++)
        if (values[0][i] > 0)
            assert_float_equal(values[0][i], 1, 1e-5);
}

/* ---- A room -------------------------------------------------------------------------- */

/* Light comes to the middle of a wall mostly by way of the others. */
#define ROOM                                                                                       \
    "camera { eye 0 0 0.9  look_at 0.2 0 -1  fov 25 }\n"                                           \
    "material clay { kd 0.8 0.6 0.4  roughness 1 }\nmaterial emitter { emission 5 }\n"             \
    "quad { corner -1 -1 -1  edge1 2 0 0  edge2 0 2 0  material clay }\n"                          \
    "quad { corner -1 -1 1  edge1 0 2 0  edge2 2 0 0  material clay }\n"                           \
    "quad { corner -1 -1 -1  edge1 0 2 0  edge2 0 0 2  material clay }\n"                          \
    "quad { corner 1 -1 -1  edge1 0 0 2  edge2 0 2 0  material clay }\n"                           \
    "quad { corner -1 -1 -1  edge1 0 0 2  edge2 2 0 0  material clay }\n"                          \
    "quad { corner -1 1 -1  edge1 2 0 0  edge2 0 0 2  material clay }\n"                           \
    "quad { corner -0.3 0.9 -0.3  edge1 0.6 0 0  edge2 0 0 0.6  material emitter }\n"

static void paths_and_photons_agree_in_a_room(void **state)
{
    rt_render_options map = {
        .mode = RT_MODE_PHOTON, .spp = 16, .photons = 200000, .k = 100, .max_depth = 12};
    double by_paths[3];
    (void)state;
    render(ROOM, (rt_render_options){.spp = 256, .max_depth = 12});
    for (int c = 0; c < 3; c++)
        by_paths[c] = mean(c);
    for (uint32_t final_gather = 0; final_gather < 2; final_gather++) {
        map.final_gather = final_gather;
        render(ROOM, map);
        for (int c = 0; c < 3; c++)
            expect_close(mean(c), by_paths[c], 0.03 * by_paths[c],
                         final_gather ? "with a final gather" : "by the map alone");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(a_floor_scatters_by_the_definition),
        statistical_test(photons_scatter_by_the_lobe_that_gathers_them),
        statistical_test(white_disappears_in_a_white_furnace),
        statistical_test(paths_and_photons_agree_in_a_room),
    };
    return cmocka_run_group_tests_name("lib/render/oren_nayar", tests, NULL, NULL);
}
