/*
 * test_grid_photons.c - photons in media whose density lies on a grid: what they carry, the energy
 * ledger, and files of photon maps.
 */
#include "support.h"

#include <math.h>
#include <string.h>

#include "kernels/statistics.h"
#include "lib/mode/grid_scenes.h"
#include "lib/photon/emitted.h"
#include "photon/map_file.h"

enum { SEEDS = 14 };

static const char *const channel[3] = {"red", "green", "blue"};

/*
 * What an uneven cloud absorbs by the ledger is what its photons say: their flux times sigma_a,
 * which is in proportion to the density that they hold. And the ledger adds up.
 */
static void the_ledger_books_what_grids_absorb(void **state)
{
    double differences[3][SEEDS];
    float values[voxels];
    (void)state;
    uneven_fill(values);
    const rt_grid grid = {
        .values = values, .size = {nx, ny, nz}, .lo = {-1, -1, -1}, .hi = {1, 1, 1}};
    rt_renderer *renderer =
        foggy_renderer("light point { position 0 0 0  power 3 2 1 }\n", &grid, 0);
    for (uint32_t i = 0; i < SEEDS; i++) {
        rt_render_options options = {.photons = 4000,
                                     .max_depth = 300,
                                     .direct = RT_DIRECT_PHOTONS,
                                     .seed = test_seed(i + 1)};
        rt_photon_map *map = emit_map(renderer, &(rt_emit_options){.render = &options});
        const rt_photon *p = rt_photon_map_photons(map, RT_PHOTONS_VOLUME);
        rt_light_ledger row;
        assert_int_equal(rt_photon_map_ledger(map, &row, 1), 1);
        for (int c = 0; c < 3; c++) {
            double absorbed = 0;
            for (size_t j = 0; j < rt_photon_map_count(map, RT_PHOTONS_VOLUME); j++)
                absorbed += (double)smoke_absorption[c] * p[j].shading * p[j].flux[c] / 4000;
            differences[c][i] = row.absorbed[c] - absorbed;
            const double booked =
                row.absorbed[c] + row.escaped[c] + row.cut_off[c] + row.roulette[c];
            assert_float_equal(booked, row.emitted[c], 1e-5 * row.emitted[c]);
            assert_true(row.absorbed[c] > 0.02 * row.emitted[c]);
            assert_true(fabs(row.roulette[c]) < 0.03 * row.emitted[c]);
        }
        rt_photon_map_destroy(map);
    }
    for (int c = 0; c < 3; c++)
        expect_mean(differences[c], SEEDS, 0, 0, channel[c]);
    rt_renderer_destroy(renderer);
}

/* What it has at a photon, in the box from -1 to 1. */
static double at_photon(const rt_grid *grid, const rt_photon *p, uint32_t channel)
{
    double voxels_at[3];
    for (int axis = 0; axis < 3; axis++)
        voxels_at[axis] = ((double)p->position[axis] + 1) / 2 * grid->size[axis];
    return grid_number(grid, voxels_at, channel);
}

/*
 * The same of an albedo on a grid and a density of three channels: the flux of photons is per
 * density of collisions, so that of any channel is absorbed in proportion to its own density there.
 */
static void the_ledger_books_what_colours_absorb(void **state)
{
    static float densities[3 * voxels], albedos[3 * voxels];
    double differences[3][SEEDS];
    float values[voxels];
    (void)state;
    uneven_fill(values);
    for (int i = 0; i < 3 * voxels; i++) {
        densities[i] = values[i / 3] * (1 + (float)(i % 7)) / 4;
        albedos[i] = (float)(i % 5) / 4;
    }
    const rt_grid grid = {.values = densities,
                          .size = {nx, ny, nz},
                          .channels = 3,
                          .lo = {-1, -1, -1},
                          .hi = {1, 1, 1}},
                  albedo = {.values = albedos,
                            .size = {nz, nx, ny},
                            .channels = 3,
                            .lo = {-1, -1, -1},
                            .hi = {1, 1, 1}};
    rt_renderer *renderer =
        coloured_renderer("light point { position 0 0 0  power 3 2 1 }\n", &grid, &albedo);
    for (uint32_t i = 0; i < SEEDS; i++) {
        rt_render_options options = {.photons = 4000,
                                     .max_depth = 300,
                                     .direct = RT_DIRECT_PHOTONS,
                                     .seed = test_seed(i + 1)};
        rt_photon_map *map = emit_map(renderer, &(rt_emit_options){.render = &options});
        const rt_photon *p = rt_photon_map_photons(map, RT_PHOTONS_VOLUME);
        rt_light_ledger row;
        assert_int_equal(rt_photon_map_ledger(map, &row, 1), 1);
        for (uint32_t c = 0; c < 3; c++) {
            double absorbed = 0;
            for (size_t j = 0; j < rt_photon_map_count(map, RT_PHOTONS_VOLUME); j++)
                absorbed += ((double)smoke_absorption[c] +
                             smoke_scattering[c] * (1 - at_photon(&albedo, p + j, c))) *
                            at_photon(&grid, p + j, c) * p[j].flux[c] / 4000;
            differences[c][i] = (row.absorbed[c] - absorbed) / row.emitted[c];
            const double booked =
                row.absorbed[c] + row.escaped[c] + row.cut_off[c] + row.roulette[c];
            assert_float_equal(booked, row.emitted[c], 1e-5 * row.emitted[c]);
            assert_true(row.absorbed[c] > 0.02 * row.emitted[c]);
        }
        rt_photon_map_destroy(map);
    }
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < SEEDS; i++)
            assert_float_equal(differences[c][i], 0, 1e-4);
    rt_renderer_destroy(renderer);
}

enum { POINTS = 49 };

/* Before it is scattered, light of a point has the fluence rate I exp(-sigma_t S) / d^2. */
static void a_ramp_has_the_fluence_of_a_point_light(void **state)
{
    float values[40], positions[POINTS][3], normals[POINTS][3] = {{0}};
    rt_photon_reading found[POINTS];
    rt_render_options options = {.photons = 600000,
                                 .max_depth = 2,
                                 .direct = RT_DIRECT_PHOTONS,
                                 .sampler = RT_SAMPLER_INDEPENDENT,
                                 .seed = test_seed(2)};
    const rt_render_options within = {.volume_k = RT_K_ALL, .volume_radius = 0.08f};
    rt_error error;
    (void)state;
    for (int i = 0; i < 40; i++)
        values[i] = 0.5f + 0.05f * (float)i; /* from 0.475 to 2.475 over 2 m */
    const rt_grid grid = {
        .values = values, .size = {1, 40, 1}, .lo = {-3, -1, -3}, .hi = {3, 1, 3}};
    rt_renderer *renderer =
        foggy_renderer("light point { position 0 0.6 0  intensity 3 2 1 }\n", &grid, 0);
    rt_photon_map *map = emit_map(renderer, &(rt_emit_options){.render = &options});
    for (int p = 0; p < POINTS; p++) {
        const float at[3] = {0.17f * (float)(p % 7 - 3), -0.1f, 0.17f * (float)(p / 7 - 3)};
        memcpy(positions[p], at, sizeof at);
    }
    expect_ok(
        rt_photon_map_illuminance(found, map, positions[0], normals[0], POINTS, 3, &within, &error),
        &error);
    for (int c = 0; c < 3; c++) {
        double deviates[POINTS];
        for (int p = 0; p < POINTS; p++) {
            const double x = positions[p][0], y = positions[p][1], z = positions[p][2];
            const double d = sqrt(x * x + (0.6 - y) * (0.6 - y) + z * z);
            const double mean_density = 0.475 + (0.5 * (0.6 + y) + 1); /* 1 more a metre */
            const double exact =
                (3 - c) *
                exp(-((double)smoke_absorption[c] + smoke_scattering[c]) * mean_density * d) /
                (d * d);
            deviates[p] = (found[p].fluence[c] - exact) / found[p].fluence_error[c];
            assert_true(found[p].volume_photons > 3);
        }
        expect_mean(deviates, POINTS, 0, 0.15, channel[c]);
    }
    rt_photon_map_destroy(map);
    rt_renderer_destroy(renderer);
}

#define GLASS_BALL                                                                                 \
    "material grey { kd 0.5 }\nmaterial glass { kt 1  fresnel dielectric  ior 1.5 }\n"             \
    "light point { position 0 1 0  intensity 3 2 1 }\n"                                            \
    "sphere { centre 0 0.4 0  radius 0.25  material glass }\n"                                     \
    "quad { corner -3 -1 -3  edge1 0 0 6  edge2 6 0 0  material grey }\n"

/* Paths for caustics are attenuated alone, and have the same numbers in both media. */
static void caustics_are_attenuated_by_grids(void **state)
{
    float values[voxels];
    rt_render_options options = {.photons = 10, .caustic_photons = 500, .max_depth = 8, .seed = 1};
    const rt_emit_options emission = {.render = &options};
    (void)state;
    for (int i = 0; i < voxels; i++)
        values[i] = 2;
    const rt_grid grid = {
        .values = values, .size = {nx, ny, nz}, .lo = {-5, -4, -5}, .hi = {5, 4, 5}};
    rt_renderer *on_grid = foggy_renderer(GLASS_BALL, &grid, 0),
                *plain = test_renderer(GLASS_BALL "medium { absorption 0.2 0.8 1.2  "
                                                  "scattering 1 0.4 3.6  g 0.5 }\n");
    rt_photon_map *found = emit_map(on_grid, &emission), *exact = emit_map(plain, &emission);
    const rt_photon *a = rt_photon_map_photons(found, RT_PHOTONS_CAUSTIC),
                    *b = rt_photon_map_photons(exact, RT_PHOTONS_CAUSTIC);
    const size_t count = rt_photon_map_count(exact, RT_PHOTONS_CAUSTIC);
    assert_int_equal(rt_photon_map_count(found, RT_PHOTONS_CAUSTIC), count);
    assert_true(count > 100);
    for (size_t i = 0; i < count; i++)
        for (int c = 0; c < 3; c++)
            assert_float_equal(a[i].flux[c], b[i].flux[c], 1e-4 * b[i].flux[c]);
    rt_photon_map_destroy(found);
    rt_photon_map_destroy(exact);
    rt_renderer_destroy(on_grid);
    rt_renderer_destroy(plain);
}

/* A map that comes back from its file renders the same bytes. */
static void files_keep_the_density_of_photons(void **state)
{
    float values[voxels];
    rt_film *films[2] = {NULL, NULL};
    rt_photon_map *back = NULL;
    rt_bytes bytes = {0};
    rt_error error;
    rt_render_options options = {.mode = RT_MODE_PHOTON,
                                 .width = 16,
                                 .height = 16,
                                 .spp = 1,
                                 .max_depth = 24,
                                 .photons = 5000,
                                 .caustic_photons = 500,
                                 .final_gather = 1};
    (void)state;
    uneven_fill(values);
    const rt_grid grid = {
        .values = values, .size = {nx, ny, nz}, .lo = {-1, 0, -1}, .hi = {1, 1.5f, 1}};
    rt_renderer *renderer = smoky_renderer(SMOKE_ROOM, &grid);
    rt_photon_map *map = emit_map(renderer, &(rt_emit_options){.render = &options});
    assert_true(rt_photon_map_count(map, RT_PHOTONS_VOLUME) > 100);
    expect_ok(rt_photon_map_encode_in(&bytes, map, &error), &error);
    expect_ok(rt_photon_map_decode(&back, bytes.data, bytes.size, NULL, &error), &error);
    expect_same_map(back, map);
    expect_ok(rt_render(films, renderer, &options, &error), &error);
    options.photon_map = back;
    expect_ok(rt_render(films + 1, renderer, &options, &error), &error);
    assert_memory_equal(rt_film_rgb(films[0]), rt_film_rgb(films[1]), 16 * 16 * 3 * sizeof(float));
    rt_bytes_free(&bytes);
    rt_film_destroy(films[0]);
    rt_film_destroy(films[1]);
    rt_photon_map_destroy(back);
    rt_photon_map_destroy(map);
    rt_renderer_destroy(renderer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(the_ledger_books_what_grids_absorb),
        cmocka_unit_test(the_ledger_books_what_colours_absorb),
        statistical_test(a_ramp_has_the_fluence_of_a_point_light),
        cmocka_unit_test(caustics_are_attenuated_by_grids),
        cmocka_unit_test(files_keep_the_density_of_photons),
    };
    return cmocka_run_group_tests_name("lib/photon/grid_photons", tests, NULL, NULL);
}
