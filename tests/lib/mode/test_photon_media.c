/*
 * test_photon_media.c - photon mapping in media that scatter: against closed forms, quadrature and
 * path tracing.
 *
 * The pixels of a render share photons, so means are taken over SEEDS renders of other seeds, whose
 * scatter gives the standard error: the bound is 5 of them (tests/chance.h).
 */
#include "support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/statistics.h"
#include "lib/mode/seed_means.h"
#include "lib/photon/emitted.h"
#include "photon/map_file.h"

static const double pi = 3.14159265358979323846;
static const char *const channel[3] = {"red", "green", "blue"};

static seed_mean mean_of_seeds(const char *text, rt_render_options options)
{
    rt_renderer *renderer = test_renderer(text);
    const seed_mean m = seed_mean_of(renderer, options);
    rt_renderer_destroy(renderer);
    return m;
}

static const rt_render_options photons = {
    .mode = RT_MODE_PHOTON, .width = 4, .height = 4, .spp = 1, .direct = RT_DIRECT_PHOTONS};

/* ---- The photons ------------------------------------------------------------------- */

#define FOG "medium { absorption 0.5 0.25 1  scattering 1 2 0.5  g 0.3 }\n"
#define LAMP "light point { position 0 0 0  power 3 2 1 }\n"

/* The sum of a path's photons for each of so many paths, out[channel][path]. */
static void sum_paths(double *out[3], const rt_photon_map *map, size_t paths)
{
    const rt_photon *p = rt_photon_map_photons(map, RT_PHOTONS_VOLUME);
    for (size_t i = 0; i < rt_photon_map_count(map, RT_PHOTONS_VOLUME); i++) {
        assert_int_equal(p[i].flags & RT_PHOTON_VOLUME, RT_PHOTON_VOLUME);
        for (int c = 0; c < 3; c++)
            out[c][p[i].path] += p[i].flux[c];
    }
    assert_int_equal(map->lists[RT_PHOTONS_VOLUME].emitted, paths);
}

/*
 * In a medium without end all light is absorbed: the fluence rate times sigma_a, over all space, is
 * the power of the light.
 */
static void an_endless_medium_absorbs_all_power(void **state)
{
    static const double power[3] = {3, 2, 1}, absorption[3] = {0.5, 0.25, 1};
    enum { PATHS = 20000 };
    rt_render_options options = {.photons = PATHS,
                                 .max_depth = 300,
                                 .direct = RT_DIRECT_PHOTONS,
                                 .sampler = RT_SAMPLER_INDEPENDENT,
                                 .seed = test_seed(1)};
    const rt_emit_options emission = {.render = &options};
    double *sums[3];
    (void)state;
    rt_renderer *renderer = test_renderer(FOG LAMP);
    rt_photon_map *map = emit_map(renderer, &emission);
    for (int c = 0; c < 3; c++)
        assert_non_null(sums[c] = calloc(PATHS, sizeof *sums[c]));
    sum_paths(sums, map, PATHS);
    for (int c = 0; c < 3; c++) {
        expect_mean(sums[c], PATHS, power[c] / absorption[c], 0, channel[c]);
        free(sums[c]);
    }
    rt_photon_map_destroy(map);
    rt_renderer_destroy(renderer);
}

/*
 * What a ball of smoke absorbs by the ledger is what its photons say, sigma_a times their flux, and
 * the ledger adds up.
 */
static void the_ledger_books_what_media_absorb(void **state)
{
    static const double absorption[3] = {0.5, 0.25, 1};
    double differences[3][SEEDS], booked = 0;
    (void)state;
    rt_renderer *renderer = test_renderer(
        LAMP "material smoke { interface true  absorption 0.5 0.25 1  scattering 1 2 0.5 }\n"
             "sphere { centre 0 0 0.5  radius 1.5  material smoke }\n");
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
            double fluence = 0;
            for (size_t j = 0; j < rt_photon_map_count(map, RT_PHOTONS_VOLUME); j++)
                fluence += p[j].flux[c] / (double)options.photons;
            differences[c][i] = row.absorbed[c] - absorption[c] * fluence;
            booked = row.absorbed[c] + row.escaped[c] + row.cut_off[c] + row.roulette[c];
            assert_float_equal(booked, row.emitted[c], 1e-5 * row.emitted[c]);
            assert_true(row.absorbed[c] > 0.3 * row.emitted[c]);
        }
        rt_photon_map_destroy(map);
    }
    for (int c = 0; c < 3; c++) {
        double sum = 0, squares = 0;
        for (int i = 0; i < SEEDS; i++)
            sum += differences[c][i] / SEEDS;
        for (int i = 0; i < SEEDS; i++)
            squares += pow(differences[c][i] - sum, 2) / (SEEDS * (SEEDS - 1));
        expect_close(sum, 0, 5 * sqrt(squares), channel[c]);
    }
    rt_renderer_destroy(renderer);
}

/* ---- Single scattering ----------------------------------------------------------------- */

/*
 * The camera looks along z past a light at a distance of 0.5; Simpson's rule over the angle at the
 * light, in which the integrand is smooth.
 */
#define PAST_A_LIGHT                                                                               \
    FOG "camera { projection orthographic  width 1e-3  eye 0 0 0  look_at 0 0 9 }\n"               \
        "light point { position 0.3 0.4 1  intensity 5 }\n"
static double single_scattering(int c)
{
    static const double absorption[3] = {0.5, 0.25, 1}, scattering[3] = {1, 2, 0.5};
    const int steps = 2000;
    const double g = 0.3, h = 0.5, sigma = absorption[c] + scattering[c];
    const double from = atan(-1 / h), to = atan(40 / h);
    double sum = 0;
    for (int i = 0; i <= steps; i++) {
        const double angle = from + (to - from) * i / steps, dz = h * tan(angle);
        const double d = hypot(h, dz), cosine = -dz / d;
        const double phase = (1 - g * g) / (4 * pi * pow(1 + g * g - 2 * g * cosine, 1.5));
        const double weight = i == 0 || i == steps ? 1 : i % 2 ? 4 : 2;
        sum += weight * scattering[c] * phase * 5 / (d * d) * exp(-sigma * (1 + dz + d)) * h /
               (cos(angle) * cos(angle));
    }
    return sum * (to - from) / steps / 3;
}

/*
 * By sampled lights alone, by photons whose discs the ray crosses, and by those around points on
 * it. Discs of 0.1 blur what falls off by the square of the distance 0.5: by 1 %.
 */
static void fog_scatters_light_once(void **state)
{
    rt_render_options options = photons;
    const double exact[3] = {single_scattering(0), single_scattering(1), single_scattering(2)};
    (void)state;
    options.max_depth = 2;
    options.photons = 10;
    options.direct = RT_DIRECT_NEE;
    options.spp = 64;
    seed_mean m = mean_of_seeds(PAST_A_LIGHT, options);
    expect_mean_near(&m, exact, 0);
    options.direct = RT_DIRECT_PHOTONS;
    options.photons = 20000;
    options.volume_k = RT_K_ALL;
    options.volume_radius = 0.1f;
    m = mean_of_seeds(PAST_A_LIGHT, options);
    expect_mean_near(&m, exact, 0.012);
    options.volume_estimate = RT_VOLUME_POINT;
    m = mean_of_seeds(PAST_A_LIGHT, options);
    expect_mean_near(&m, exact, 0.02);
}

/* Discs of 0.5 err by a tenth; with a small alpha, 60 passes leave less than half of that. */
static void passes_shrink_the_discs(void **state)
{
    rt_render_options options = photons;
    (void)state;
    options.max_depth = 2;
    options.volume_k = RT_K_ALL;
    options.volume_radius = 0.5f;
    options.photons = 2000;
    options.alpha = 0.01f;
    options.passes = 2;
    const seed_mean few = mean_of_seeds(PAST_A_LIGHT, options);
    options.passes = 60;
    const seed_mean many = mean_of_seeds(PAST_A_LIGHT, options);
    for (int c = 0; c < 3; c++) {
        const double exact = single_scattering(c), before = fabs(few.value[c] - exact),
                     after = fabs(many.value[c] - exact);
        assert_true(before > 0.1 * exact);
        expect_close(after / before, 0, 0.5, channel[c]);
    }
}

/* ---- Whole light -------------------------------------------------------------------------- */

#define WALL(corner, a, b)                                                                         \
    "quad { corner " corner "  edge1 " a "  edge2 " b "  material wall  radiance 1 }\n"

/* A medium that absorbs nothing cannot be seen in a room whose walls emit as much everywhere. */
static void albedo_of_1_disappears_between_even_walls(void **state)
{
    static const char text[] =
        "camera { eye 0 0 0  look_at 0 0 1  fov 30 }\n"
        "medium { scattering 0.5 1 2  g 0.4 }\nmaterial wall { kd 0 }\n" WALL(
            "-1 -1 -1", "2 0 0", "0 2 0") WALL("-1 -1 1", "0 2 0", "2 0 0")
            WALL("-1 -1 -1", "0 0 2", "2 0 0") WALL("-1 1 -1", "2 0 0", "0 0 2")
                WALL("-1 -1 -1", "0 2 0", "0 0 2") WALL("1 -1 -1", "0 0 2", "0 2 0");
    static const double one[3] = {1, 1, 1};
    rt_render_options options = photons;
    (void)state;
    options.max_depth = 200;
    options.photons = 10000;
    options.volume_k = RT_K_ALL;
    options.volume_radius = 0.05f;
    seed_mean m = mean_of_seeds(text, options);
    expect_mean_near(&m, one, 0.004);
    options.direct = RT_DIRECT_NEE;
    options.spp = 4;
    m = mean_of_seeds(text, options);
    expect_mean_near(&m, one, 0.004);
}

/* Fog, glass that casts a caustic through it, and milk: as by paths. */
static void photons_and_paths_agree(void **state)
{
    static const char text[] =
        "camera { eye 0 1 -4  look_at 0 0.7 0  fov 40 }\n"
        "medium { absorption 0.05 0.1 0  scattering 0.2 0.1 0.15  g 0.4 }\n"
        "material grey { kd 0.5 }\nmaterial glass { kt 1  fresnel dielectric  ior 1.5 }\n"
        "material milk { kt 1  fresnel dielectric  ior 1.3  scattering 4 3 2  g 0.5 }\n"
        "material smoke { interface true  absorption 1  scattering 1 }\n"
        "box { centre 0 1 0  size 3 2 9  material grey }\n"
        "quad { corner -0.4 1.9 -0.4  edge1 0.8 0 0  edge2 0 0 0.8  material grey  radiance 6 }\n"
        "sphere { centre 0.4 1.1 0  radius 0.3  material glass }\n"
        "sphere { centre -0.4 0.4 -0.3  radius 0.3  material milk }\n"
        "sphere { centre 0.7 0.4 0.5  radius 0.3  material smoke }\n";
    static const rt_render_options paths = {.width = 16, .height = 16, .spp = 64, .max_depth = 24};
    static const struct {
        rt_direct direct;
        uint32_t final_gather;
        uint64_t caustic_photons;
    } cases[] = {{RT_DIRECT_NEE, 0, 0}, {RT_DIRECT_PHOTONS, 0, 3000}, {RT_DIRECT_NEE, 1, 3000}};
    const seed_mean reference = mean_of_seeds(text, paths);
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        rt_render_options options = {.mode = RT_MODE_PHOTON,
                                     .width = 16,
                                     .height = 16,
                                     .spp = 2,
                                     .max_depth = 24,
                                     .photons = 10000,
                                     .radius = 0.1f,
                                     .volume_radius = 0.1f,
                                     .direct = cases[i].direct,
                                     .final_gather = cases[i].final_gather,
                                     .caustic_photons = cases[i].caustic_photons};
        const seed_mean m = mean_of_seeds(text, options);
        expect_same_mean(&m, &reference, 0.02);
    }
}

/* A medium without end lets nothing through from infinitely far, but in channels that it lacks. */
static void endless_fog_hides_the_sky(void **state)
{
    static const char text[] = "camera { eye 0 0 -3  look_at 0 0 0  fov 40 }\n"
                               "medium { absorption 0.1 0.1 0  scattering 0.2 0 0 }\n"
                               "material grey { kd 0.8 }\nlight environment { radiance 1 }\n"
                               "light directional { direction 0 -1 0  irradiance 2 }\n"
                               "sphere { centre 0 0 0  radius 0.5  material grey }\n";
    rt_render_options options = photons;
    rt_renderer *renderer = test_renderer(text);
    (void)state;
    options.photons = 2000;
    for (int i = 0; i < 2; i++) {
        rt_photon_map *map = emit_map(renderer, &(rt_emit_options){.render = &options});
        rt_light_ledger rows[2];
        assert_int_equal(rt_photon_map_ledger(map, rows, 2), 2);
        for (int row = 0; row < 2; row++) {
            assert_float_equal(rows[row].absorbed[0], rows[row].emitted[0], 1e-6);
            assert_true(rows[row].absorbed[2] < rows[row].emitted[2]);
        }
        rt_photon_map_destroy(map);
        const seed_mean m = seed_mean_of(renderer, options);
        assert_true(m.value[0] == 0 && m.value[1] == 0 && m.value[2] > 0.1);
        options.direct = RT_DIRECT_NEE;
    }
    rt_renderer_destroy(renderer);
}

/* ---- Maps ------------------------------------------------------------------------------------ */

#define SMOKY_ROOM ROOM "medium { absorption 0.3 0.1 0  scattering 0.6 0.9 0.4  g -0.2 }\n"

static void parts_join_and_come_back_with_their_volume_photons(void **state)
{
    rt_render_options render_options = {.photons = 5003, .caustic_photons = 1001, .max_depth = 10};
    rt_emit_options options = {.render = &render_options};
    rt_photon_map *parts[3], *joined = NULL, *back = NULL;
    rt_photon_map_info info;
    rt_error error;
    (void)state;
    rt_renderer *renderer = test_renderer(SMOKY_ROOM);
    rt_photon_map *whole = emit_map(renderer, &options);
    rt_photon_map_get_info(whole, &info);
    assert_true(info.media && info.photons[RT_PHOTONS_VOLUME] > 3000);
    assert_int_equal(info.paths[RT_PHOTONS_VOLUME], 5003);
    options.parts = 3;
    for (options.part = 0; options.part < 3; options.part++)
        parts[options.part] = emit_map(renderer, &options);
    rt_photon_map *order[] = {parts[2], parts[0], parts[1]};
    expect_ok(rt_photon_map_merge(&joined, (const rt_photon_map *const *)order, 3, &error), &error);
    expect_same_map(joined, whole);
    /* The first third, continued to the whole. */
    rt_photon_map_destroy(joined);
    options = (rt_emit_options){.render = &render_options, .resume = parts[1]};
    joined = emit_map(renderer, &options);
    expect_same_map(joined, whole);
    rt_bytes bytes = {0};
    expect_ok(rt_photon_map_encode_in(&bytes, whole, &error), &error);
    expect_ok(rt_photon_map_decode(&back, bytes.data, bytes.size, NULL, &error), &error);
    rt_bytes_free(&bytes);
    expect_same_map(back, whole);
    for (int i = 0; i < 3; i++)
        rt_photon_map_destroy(parts[i]);
    rt_photon_map_destroy(joined);
    rt_photon_map_destroy(back);
    rt_photon_map_destroy(whole);
    rt_renderer_destroy(renderer);
}

/* The same bytes by other threads and work-groups, and by a map that was emitted before. */
static void pictures_do_not_depend_on_threads(void **state)
{
    static const uint32_t devices[][2] = {{1, 1}, {3, 64}};
    static const char text[] = SMOKY_ROOM "camera { eye 0 0 -0.9  look_at 0 0 0  fov 60 }\n";
    rt_render_options options = {
        .mode = RT_MODE_PHOTON, .width = 13, .height = 9, .spp = 2, .photons = 4000};
    rt_film *films[3] = {NULL};
    rt_error error;
    (void)state;
    for (int i = 0; i < 2; i++) {
        rt_device *device = test_device_open(devices[i][0], devices[i][1]);
        rt_renderer *renderer = renderer_on(device, text, RT_ACCEL_BVH);
        expect_ok(rt_render(&films[i], renderer, &options, &error), &error);
        rt_renderer_destroy(renderer);
        rt_device_close(device);
    }
    rt_renderer *renderer = test_renderer(text);
    rt_photon_map *map = emit_map(renderer, &(rt_emit_options){.render = &options});
    options.photon_map = map;
    expect_ok(rt_render(&films[2], renderer, &options, &error), &error);
    for (int i = 1; i < 3; i++)
        assert_memory_equal(rt_film_rgb(films[0]), rt_film_rgb(films[i]),
                            (size_t)options.width * options.height * 3 * sizeof(float));
    for (int i = 0; i < 3; i++)
        rt_film_destroy(films[i]);
    rt_photon_map_destroy(map);
    rt_renderer_destroy(renderer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(an_endless_medium_absorbs_all_power),
        statistical_test(the_ledger_books_what_media_absorb),
        statistical_test(fog_scatters_light_once),
        statistical_test(passes_shrink_the_discs),
        statistical_test(albedo_of_1_disappears_between_even_walls),
        cmocka_unit_test(endless_fog_hides_the_sky),
        statistical_test(photons_and_paths_agree),
        cmocka_unit_test(parts_join_and_come_back_with_their_volume_photons),
        cmocka_unit_test(pictures_do_not_depend_on_threads),
    };
    return cmocka_run_group_tests_name("mode/photon_media", tests, NULL, NULL);
}
