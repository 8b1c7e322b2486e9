/*
 * test_aim.c - paths aimed at specular shapes make the same caustics as paths in all directions.
 *
 * Caustic photons kept apart come from aimed paths. Without that, they are among those of all
 * paths, flagged. The two are independent estimates of the same flux in each cell of a grid over
 * the scene, and the squared difference over the sum of the variances is nearly chi-square with a
 * degree of freedom a cell.
 */
#include "kernels/statistics.h"
#include "support.h"

#include <math.h>
#include <string.h>

/* Cells of 0.25 m, 2.5 m around the middle; what lies farther out counts at the edge. */
enum { cells_across = 20, cells = cells_across * cells_across * cells_across, photons_a_cell = 60 };

/* Three sides of a room, and materials. */
#define ROOM                                                                                       \
    "material white { kd 0.6 0.7 0.8 }\n"                                                          \
    "material mirror { ks 0.9 }\n"                                                                 \
    "material coat { kd 0.3 0.2 0.1  ks 0.5 0.4 0.3 }\n"                                           \
    "material brushed { ks 0.8  roughness 0.2 }\n"                                                 \
    "material glass { kt 1  ior 1.5  fresnel dielectric }\n"                                       \
    "quad { corner -1 -1 -1  edge1 0 0 2  edge2 2 0 0  material white }\n"                         \
    "quad { corner -1 -1 1  edge1 0 2 0  edge2 2 0 0  material white }\n"                          \
    "quad { corner -1 -1 -1  edge1 0 2 0  edge2 0 0 2  material white }\n"

/* Balls that hide each other from most places, and one that a path is not followed from. */
#define BALLS                                                                                      \
    "sphere { centre 0.3 -0.5 0  radius 0.3  material glass }\n"                                   \
    "sphere { centre -0.3 -0.6 0.2  radius 0.3  material mirror }\n"                               \
    "sphere { centre 0 -0.1 0.4  radius 0.25  material coat }\n"                                   \
    "sphere { centre -0.5 -0.7 -0.6  radius 0.2  material brushed }\n"

/* Shapes of every other kind of ball around them. */
#define SHAPES                                                                                     \
    "mesh knot { file \"scenes/meshes/knot.ply\" }\n"                                              \
    "instance knot { material mirror  scale 0.3  translate 0.5 -0.4 0.4 }\n"                       \
    "torus { centre -0.3 -0.5 0.3  axis 1 1 0  major_radius 0.3  minor_radius 0.1  material "      \
    "glass }\n"                                                                                    \
    "cylinder { a -0.3 -0.9 -0.5  b 0.4 -0.7 -0.3  radius 0.1  material mirror }\n"                \
    "quad { corner 0.5 -0.9 -0.8  edge1 0.3 0.4 0  edge2 0 0.1 0.5  material mirror }\n"

typedef struct caustic_scene {
    const char *name, *text;
    double least; /* caustic photons an aimed path */
} caustic_scene;

static const caustic_scene scenes[] = {
    {"point", ROOM BALLS "light point { position 0.1 0.8 -0.2  power 3 4 5 }\n", 0.5},
    {"point and other shapes", ROOM SHAPES "light point { position 0.1 0.8 -0.2  power 3 4 5 }\n",
     0.2},
    {"point in glass", ROOM BALLS "light point { position 0.3 -0.4 0.1  power 3 4 5 }\n", 0.3},
    {"spot",
     ROOM BALLS
     "light spot { position 0.8 0.9 -0.6  target 0 -0.5 0  intensity 9  outer 35  inner 20 }\n",
     0.5},
    {"spot on one of them",
     ROOM BALLS
     "light spot { position 1 0.9 -0.9  target 0.3 -0.5 0  intensity 9  outer 8  inner 5 }\n",
     0.8},
    {"square",
     ROOM BALLS
     "quad { corner -0.2 0.9 -0.2  edge1 0.4 0 0  edge2 0 0 0.4  material white  power 3 4 5 }\n",
     0.3},
    {"square, both sides",
     ROOM BALLS "material sheet { emission 3 4 5  two_sided true }\n"
                "quad { corner 0.6 -0.9 -0.6  edge1 0.1 1 0  edge2 0 0 0.5  material sheet }\n",
     0.3},
    {"sphere",
     ROOM BALLS "sphere { centre 0.4 0.6 -0.4  radius 0.2  material white  power 3 4 5 }\n", 0.2},
    {"directional", ROOM BALLS "light directional { direction -0.4 -1 0.5  irradiance 2 3 4 }\n",
     0.3},
    {"environment", ROOM BALLS "light environment { radiance 1 2 3 }\n", 0.1},
    {"projector",
     ROOM BALLS "light projector { position 0.8 0.9 -0.6  target 0 -0.5 0  irradiance 9  fov 70  "
                "file \"scenes/textures/letter.png\" }\n",
     0.1},
    {"luminaire",
     ROOM BALLS "light goniometric { position 0.2 0.9 -0.2  target 0.2 0 -0.2  up -1 0 0  file "
                "\"scenes/luminaires/wallwasher.ies\" }\n",
     0.3},
    {"spot with an image",
     ROOM BALLS "light spot { position 0.8 0.9 -0.6  target 0 -0.5 0  intensity 9  outer 35  "
                "inner 20  file \"scenes/textures/letter.png\" }\n",
     0.1},
    {"two lights",
     ROOM BALLS "light directional { direction -0.4 -1 0.5  irradiance 1 }\n"
                "light point { position 0.1 0.8 -0.2  power 3 }\n",
     0.3},
    {"mirror without end",
     ROOM BALLS
     "plane { point 0 0 1.5  normal 0 0 -1  material mirror }\n"
     "light spot { position 0.8 0.9 -0.6  target 0 -0.5 0  intensity 9  outer 35  inner 20 }\n",
     0.1},
    {"many",
     ROOM "repeat i from 0 to 99 { sphere { centre (random(i) - 0.5) (random(i + 100) - 0.9) "
          "(random(i + 200) - 0.5)"
          "  radius 0.05  material glass } }\n"
          "light point { position 0.1 0.9 -0.2  power 3 4 5 }\n",
     0.1},
};

/* The flux of each cell, and the square of a path's. */
typedef struct flux_grid {
    double sum[cells], squares[cells];
    uint32_t count[cells];
    double total, total_squares;
    size_t photons;
} flux_grid;

static rt_photon_map *emit(rt_renderer *renderer, uint64_t photons, uint64_t caustic_photons,
                           uint32_t seed)
{
    rt_render_options render = {.photons = photons,
                                .caustic_photons = caustic_photons,
                                .max_depth = 8,
                                .seed = test_seed(seed),
                                .sampler = RT_SAMPLER_INDEPENDENT};
    rt_emit_options options = {.render = &render};
    rt_photon_map *map = NULL;
    rt_error error;
    expect_ok(rt_photon_map_emit(&map, renderer, &options, &error), &error);
    return map;
}

static size_t cell_of(const rt_photon *photon)
{
    size_t cell = 0;
    for (int axis = 0; axis < 3; axis++) {
        double place = floor((photon->position[axis] + 2.5) * 4);
        cell = cell * cells_across + (size_t)fmax(0, fmin(cells_across - 1, place));
    }
    return cell;
}

/* Lays out the caustic photons of a list; flux in the mean of the channels, a path. */
static void fill_grid(flux_grid *grid, const rt_photon_map *map, rt_photon_kind kind,
                      uint64_t paths)
{
    const rt_photon *photons = rt_photon_map_photons(map, kind);
    memset(grid, 0, sizeof *grid);
    for (size_t i = 0; i < rt_photon_map_count(map, kind); i++) {
        const float *f = photons[i].flux;
        double flux = ((double)f[0] + f[1] + f[2]) / (3 * (double)paths);
        size_t cell = cell_of(photons + i);
        if (!(photons[i].flags & RT_PHOTON_CAUSTIC))
            continue;
        grid->photons++;
        grid->count[cell]++;
        grid->sum[cell] += flux;
        grid->squares[cell] += flux * flux;
        grid->total += flux;
        grid->total_squares += flux * flux;
    }
}

static void aimed_paths_make_the_same_caustics(void **state)
{
    enum { all_paths = 1000000, aimed_paths = 200000 };
    const caustic_scene *scene = *state;
    static flux_grid all, aimed;
    rt_renderer *renderer = test_renderer(scene->text);
    rt_photon_map *map = emit(renderer, all_paths, 0, 1);
    fill_grid(&all, map, RT_PHOTONS_GLOBAL, all_paths);
    rt_photon_map_destroy(map);
    map = emit(renderer, 1, aimed_paths, 2);
    fill_grid(&aimed, map, RT_PHOTONS_CAUSTIC, aimed_paths);
    rt_photon_map_destroy(map);
    rt_renderer_destroy(renderer);

    double chi2 = 0, freedom = 0;
    for (size_t i = 0; i < cells; i++)
        if (all.count[i] >= photons_a_cell && aimed.count[i] >= photons_a_cell) {
            double difference = aimed.sum[i] - all.sum[i];
            chi2 += difference * difference / (all.squares[i] + aimed.squares[i]);
            freedom++;
        } else if (all.count[i] + aimed.count[i] >= 1000) {
            fail_msg("%s: cell %zu has %u photons of all paths and %u of aimed ones", scene->name,
                     i, all.count[i], aimed.count[i]);
        }
    double off = chi_square_deviate(chi2, freedom);
    double z = (aimed.total - all.total) / sqrt(all.total_squares + aimed.total_squares);
    print_message("%s: %.0f cells, %.2f deviations off; total %.4g W and %.4g W, %.2f; %.3f "
                  "photons a path, %.3f aimed\n",
                  scene->name, freedom, off, all.total, aimed.total, z,
                  (double)all.photons / all_paths, (double)aimed.photons / aimed_paths);
    assert_true(freedom >= 5);
    expect_deviate(off, "cells");
    expect_deviate(z, "total flux");
    assert_true((double)aimed.photons / aimed_paths > scene->least);
}

static void nothing_specular_makes_no_caustics(void **state)
{
    (void)state;
    rt_renderer *renderer =
        test_renderer(ROOM "light point { position 0.1 0.8 -0.2  power 3 4 5 }\n"
                           "light directional { direction -0.4 -1 0.5  irradiance 1 }\n");
    rt_photon_map *map = emit(renderer, 1, 10000, 1);
    assert_int_equal(rt_photon_map_count(map, RT_PHOTONS_CAUSTIC), 0);
    rt_photon_map_destroy(map);
    rt_renderer_destroy(renderer);
}

int main(void)
{
    enum { count = sizeof scenes / sizeof *scenes };
    static chance_test each[count];
    struct CMUnitTest tests[count + 1];
    for (size_t i = 0; i < count; i++) {
        each[i] = (chance_test){aimed_paths_make_the_same_caustics, (void *)(scenes + i)};
        tests[i] = (struct CMUnitTest){scenes[i].name, chance_run, NULL, NULL, each + i};
    }
    tests[count] = (struct CMUnitTest)cmocka_unit_test(nothing_specular_makes_no_caustics);
    return cmocka_run_group_tests_name("lib/photon/aim", tests, NULL, NULL);
}
