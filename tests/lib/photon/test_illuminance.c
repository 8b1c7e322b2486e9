/*
 * test_illuminance.c - irradiance and fluence rate at points, and their standard errors, in closed
 * form.
 */
#include "support.h"

#include <math.h>

#include "kernels/statistics.h"
#include "lib/photon/emitted.h"

static const double pi = 3.14159265358979323846;

static rt_photon_map *emit(const char *text, rt_render_options options)
{
    options.direct = RT_DIRECT_PHOTONS;
    options.sampler = RT_SAMPLER_INDEPENDENT;
    rt_renderer *renderer = test_renderer(text);
    rt_photon_map *map = emit_map(renderer, &(rt_emit_options){.render = &options});
    rt_renderer_destroy(renderer);
    return map;
}

static void read_points(rt_photon_reading *out, const rt_photon_map *map, const float *positions,
                        const float *normals, size_t count, rt_render_options options)
{
    rt_error error;
    expect_ok(rt_photon_map_illuminance(out, map, positions, normals, count, 3, &options, &error),
              &error);
}

/* A point light of 3, 2 and 1 W/sr, 1 m over the middle of a floor. */
#define LIT_FLOOR                                                                                  \
    "material grey { kd 0.5 }\nlight point { position 0 1 0  intensity 3 2 1 }\n"                  \
    "quad { corner -3 0 -3  edge1 0 0 6  edge2 6 0 0  material grey }\n"

enum { GRID = 10, POINTS = GRID * GRID };

/* Points so far apart that they share no photon. */
static void make_grid(float positions[POINTS][3], float normals[POINTS][3], float step)
{
    for (int i = 0; i < POINTS; i++) {
        const float at[3] = {step * (float)(i % GRID - GRID / 2), 0,
                             step * (float)(i / GRID - GRID / 2)};
        for (int c = 0; c < 3; c++) {
            positions[i][c] = at[c];
            normals[i][c] = c == 1;
        }
    }
}

/*
 * E = I cos / d^2. Over the points, the errors in units of the standard errors have the mean square
 * of Student's t with 15 degrees of freedom, 15/13, but for fewer photons than it assumes.
 */
static void a_floor_has_the_irradiance_of_a_point_light(void **state)
{
    static const double intensity[3] = {3, 2, 1};
    static const uint32_t k[] = {RT_K_ALL, 100};
    float positions[POINTS][3], normals[POINTS][3];
    rt_photon_reading found[POINTS];
    rt_photon_map *map = emit(
        LIT_FLOOR, (rt_render_options){.photons = 400000, .max_depth = 2, .seed = test_seed(1)});
    (void)state;
    make_grid(positions, normals, 0.15f);
    for (int i = 0; i < 2; i++) {
        double deviates[POINTS], squares[POINTS];
        read_points(found, map, positions[0], normals[0], POINTS,
                    (rt_render_options){.k = k[i], .radius = 0.06f});
        for (int p = 0; p < POINTS; p++) {
            const double x = positions[p][0], z = positions[p][2],
                         shape = 1 / pow(x * x + z * z + 1, 1.5);
            deviates[p] =
                (found[p].irradiance[1] - intensity[1] * shape) / found[p].irradiance_error[1];
            squares[p] = deviates[p] * deviates[p];
            assert_true(found[p].photons > 50 && found[p].volume_photons == 0);
            assert_true(found[p].radius <= 0.06f);
            /* A path has the colour of the light, and lux are those of all three channels. */
            assert_float_equal(found[p].irradiance[0], 1.5 * found[p].irradiance[1], 1e-4);
            assert_float_equal(found[p].irradiance[2], 0.5 * found[p].irradiance[1], 1e-4);
            assert_float_equal(found[p].illuminance,
                               179 * (0.2126 * 3 + 0.7152 * 2 + 0.0722) * found[p].irradiance[1] /
                                   2,
                               1e-3 * found[p].illuminance);
            assert_float_equal(found[p].illuminance_error / found[p].illuminance,
                               found[p].irradiance_error[1] / found[p].irradiance[1], 1e-4);
        }
        expect_mean(deviates, POINTS, 0, 0.05, "error");
        expect_mean(squares, POINTS, 15 / 13.0, 0.2, "square of the error");
    }
    rt_photon_map_destroy(map);
}

/* Photons of other sides do not count, and points without a surface have no irradiance. */
static void only_the_side_of_the_normal_counts(void **state)
{
    static const float positions[3][3] = {{0}}, normals[3][3] = {{0, 1, 0}, {0, -1, 0}, {0}};
    rt_photon_reading found[3];
    rt_photon_map *map =
        emit(LIT_FLOOR, (rt_render_options){.photons = 20000, .max_depth = 2, .seed = 1});
    (void)state;
    read_points(found, map, positions[0], normals[0], 3, (rt_render_options){.k = 20});
    assert_true(found[0].photons == 19 && found[0].irradiance[0] > 1);
    assert_true(found[1].photons == 0 && found[1].irradiance[0] == 0);
    assert_true(found[2].photons == 0 && found[2].irradiance[0] == 0);
    rt_photon_map_destroy(map);
}

/* Before it is scattered, light of a point has the fluence rate I exp(-sigma_t d) / d^2. */
static void a_medium_has_the_fluence_of_a_point_light(void **state)
{
    static const double sigma[3] = {1.5, 1, 0.5}, intensity[3] = {3, 2, 1};
    static const char *const names[3] = {"red", "green", "blue"};
    float positions[POINTS][3], normals[POINTS][3] = {{0}};
    rt_photon_reading found[POINTS];
    rt_photon_map *map =
        emit("light point { position 0 1 0  intensity 3 2 1 }\n"
             "medium { absorption 0.5 0.5 0  scattering 1 0.5 0.5  g 0.5 }\n",
             (rt_render_options){.photons = 600000, .max_depth = 2, .seed = test_seed(2)});
    (void)state;
    make_grid(positions, normals, 0.17f);
    for (int p = 0; p < POINTS; p++)
        positions[p][1] = 0.5f;
    read_points(found, map, positions[0], normals[0], POINTS,
                (rt_render_options){.volume_k = RT_K_ALL, .volume_radius = 0.08f});
    for (int c = 0; c < 3; c++) {
        double deviates[POINTS];
        for (int p = 0; p < POINTS; p++) {
            const double x = positions[p][0], z = positions[p][2], d = sqrt(x * x + z * z + 0.25);
            deviates[p] = (found[p].fluence[c] - intensity[c] * exp(-sigma[c] * d) / (d * d)) /
                          found[p].fluence_error[c];
            assert_true(found[p].volume_photons > 3 && found[p].photons == 0);
        }
        expect_mean(deviates, POINTS, 0, 0.15, names[c]);
    }
    rt_photon_map_destroy(map);
}

/* Where radiance is 1 everywhere and nothing is absorbed, the fluence rate is 4 pi. */
static void a_furnace_has_a_fluence_of_four_pi(void **state)
{
    static const float positions[4][3] = {{0}, {0.5f, 0, 0}, {0, -0.5f, 0.2f}, {0, 0, -0.6f}},
                       normals[4][3] = {{0}};
    rt_photon_reading found[4];
    rt_photon_map *map = emit(
        "material cloud { interface true  scattering 2  g 0.4 }\n"
        "sphere { centre 0 0 0  radius 1  material cloud }\nlight environment { radiance 1 }\n",
        (rt_render_options){.photons = 40000, .max_depth = 500, .seed = test_seed(3)});
    (void)state;
    read_points(found, map, positions[0], normals[0], 4, (rt_render_options){.volume_k = 500});
    for (int p = 0; p < 4; p++) {
        assert_int_equal(found[p].volume_photons, 499);
        expect_close(found[p].fluence[0], 4 * pi, 6 * found[p].fluence_error[0], "fluence");
        assert_true(found[p].fluence_error[0] < 0.15 * 4 * pi);
    }
    rt_photon_map_destroy(map);
}

static void what_cannot_be_read_is_refused(void **state)
{
    static const float origin[3] = {0}, far_out[3] = {1e16f, 0, 0}, tilted[3] = {0, 2, 0};
    rt_photon_reading found;
    rt_error error;
    (void)state;
    rt_photon_map *map = emit(LIT_FLOOR, (rt_render_options){.photons = 10, .max_depth = 2});
    assert_int_equal(rt_photon_map_illuminance(&found, map, origin, tilted, 1, 1, NULL, &error),
                     RT_ERROR_USAGE);
    assert_string_equal(error.field, "normals");
    assert_int_equal(rt_photon_map_illuminance(&found, map, far_out, origin, 1, 1, NULL, &error),
                     RT_ERROR_USAGE);
    assert_string_equal(error.field, "positions");
    const rt_render_options all = {.k = RT_K_ALL};
    assert_int_equal(rt_photon_map_illuminance(&found, map, origin, origin, 1, 1, &all, &error),
                     RT_ERROR_USAGE);
    assert_string_equal(error.field, "radius");
    rt_photon_map_destroy(map);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(a_floor_has_the_irradiance_of_a_point_light),
        cmocka_unit_test(only_the_side_of_the_normal_counts),
        statistical_test(a_medium_has_the_fluence_of_a_point_light),
        statistical_test(a_furnace_has_a_fluence_of_four_pi),
        cmocka_unit_test(what_cannot_be_read_is_refused),
    };
    return cmocka_run_group_tests_name("photon/illuminance", tests, NULL, NULL);
}
