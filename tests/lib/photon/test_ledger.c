/*
 * test_ledger.c - the energy ledger balances, has the right columns, and does not depend on how
 * paths are distributed.
 *
 * In a closed room of one albedo all columns are known: escaped is 0, the flux left after n bounces
 * is albedo^n of the power, the rest is absorbed. Random sums are held to standard errors.
 */
#include "support.h"

#include <glob.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/statistics.h"
#include "photon/emit.h"
#include "photon/ledger.h"
#include "render/renderer.h"

#define PI 3.14159265358979323846

static const char room[] = "material wall { kd 0.2 0.5 0.8 }\n"
                           "material mirror { ks 1 }\n"
                           "quad { corner -1 -1 -1  edge1 0 0 2  edge2 2 0 0  material wall }\n"
                           "quad { corner -1 1 -1  edge1 2 0 0  edge2 0 0 2  material wall }\n"
                           "quad { corner -1 -1 -1  edge1 2 0 0  edge2 0 2 0  material wall }\n"
                           "quad { corner -1 -1 1  edge1 0 2 0  edge2 2 0 0  material wall }\n"
                           "quad { corner -1 -1 -1  edge1 0 2 0  edge2 0 0 2  material wall }\n"
                           "quad { corner 1 -1 -1  edge1 0 0 2  edge2 0 2 0  material wall }\n"
                           "sphere { centre 0.5 0.5 0.5  radius 0.2  material mirror }\n"
                           "light point { position 0.1 0.2 -0.1  power 2 3 5 }\n"
                           "sphere { centre -0.5 0 0  radius 0.1  material wall  power 1 1 0.5 }\n";

static rt_photon_map *emit(rt_renderer *renderer, const rt_render_options *render)
{
    rt_emit_options options = {.render = render};
    rt_photon_map *map = NULL;
    rt_error error;
    expect_ok(rt_photon_map_emit(&map, renderer, &options, &error), &error);
    return map;
}

/*
 * Fails unless emitted = absorbed + escaped + cut off + roulette to 1e-5 of the light's emission.
 */
static void expect_closed(const rt_light_ledger *l, const char *what)
{
    double largest = fmax(l->emitted[0], fmax(l->emitted[1], l->emitted[2]));
    for (int c = 0; c < 3; c++) {
        double rest =
            l->emitted[c] - l->absorbed[c] - l->escaped[c] - l->cut_off[c] - l->roulette[c];
        if (!(fabs(rest) <= 1e-5 * largest))
            fail_msg("%s: channel %d: %g W of %g W are missing", what, c, rest, l->emitted[c]);
    }
}

static void closed_rooms_follow_the_geometric_series(void **state)
{
    static const char box[] = "material wall { kd 0.2 0.5 0.8 }\n"
                              "sphere { centre 0 0 0  radius 1  material wall }\n"
                              "light point { position 0.1 0.2 -0.1  power 2 3 5 }\n";
    static const double power[3] = {2, 3, 5}, kd[3] = {0.2, 0.5, 0.8};
    enum { paths = 50000, depth = 4 };
    rt_render_options render = {.photons = paths, .max_depth = depth, .seed = test_seed(0)};
    rt_light_ledger l;
    (void)state;
    rt_renderer *renderer = test_renderer(box);
    rt_photon_map *map = emit(renderer, &render);
    assert_int_equal(rt_photon_map_ledger(map, &l, 1), 1);
    assert_int_equal(l.paths, paths);
    assert_true(l.shape == RT_NONE && l.share == 1);
    expect_closed(&l, "closed room");
    for (int c = 0; c < 3; c++) {
        /* depth - 1 bounces are followed: that many times the albedo is left. */
        double left = power[c] * pow(kd[c], depth - 1), sigma = power[c] * depth / sqrt(paths);
        assert_float_equal(l.power[c], power[c], 1e-5);
        assert_float_equal(l.emitted[c], power[c], 1e-5);
        assert_true(l.escaped[c] == 0);
        expect_deviate((l.cut_off[c] - left) / sigma, "cut off");
        expect_deviate((l.absorbed[c] - power[c] + left) / sigma, "absorbed");
        expect_deviate(l.roulette[c] / sigma, "roulette");
        assert_true(l.roulette[c] != 0 && l.cut_off[c] > 0.9 * left);
    }
    rt_photon_map_destroy(map);
    rt_renderer_destroy(renderer);
}

/* Half of the light that this scene emits, of all channels alike, is absorbed in solids. */
static void expect_half_absorbed(const char *text, const char *what)
{
    enum { paths = 20000 };
    rt_render_options render = {.photons = paths, .max_depth = 8, .seed = test_seed(0)};
    rt_light_ledger l;
    rt_renderer *renderer = test_renderer(text);
    rt_photon_map *map = emit(renderer, &render);
    assert_int_equal(rt_photon_map_ledger(map, &l, 1), 1);
    expect_closed(&l, what);
    for (int c = 0; c < 3; c++)
        expect_deviate((l.absorbed[c] / l.emitted[c] - 0.5) / (0.5 / sqrt(paths)), what);
    rt_photon_map_destroy(map);
    rt_renderer_destroy(renderer);
}

/* What a transparent shape emits into its own inside is in its medium, which here absorbs it. */
static void light_emitted_inside_is_absorbed_there(void **state)
{
    (void)state;
    expect_half_absorbed(
        "material glow { kt 1  ior 1  absorption 1e6  emission 1  two_sided true }\n"
        "sphere { centre 0 0 0  radius 1  material glow }\n",
        "two-sided ball");
}

/* What is not absorbed leaves a clear ball, in which it would be if it began in the wrong solid. */
#define SOOT_IN_A_BALL                                                                             \
    "material glow { kt 1  ior 1  emission 1  two_sided true }\n"                                  \
    "material lamp { emission 1  two_sided true }\n"                                               \
    "material soot { kt 1  ior 1  absorption 1e9  priority 1 }\n"                                  \
    "material clear { kt 1  ior 1 }\n"                                                             \
    "sphere { centre 0 0 0  radius 5  material clear }\n"

/*
 * A flat lamp that lies half in a sheet that absorbs. The light of the other half, on both sides,
 * hits the edge of the sheet with a chance of the order of its thickness.
 */
static void light_begins_in_the_solid_around_its_start(void **state)
{
    (void)state;
    expect_half_absorbed(SOOT_IN_A_BALL
                         "box { centre -1 0 0  size 2 1e-4 4  material soot }\n"
                         "quad { corner -1 0 -1  edge1 2 0 0  edge2 0 0 2  material glow }\n",
                         "lamp half in soot");
}

/* Flat lamps in the face of a box, of either orientation: one side shines into the box. */
static void light_begins_on_its_side_of_a_face(void **state)
{
#define BOX SOOT_IN_A_BALL "box { centre 0 1 0  size 4 2 4  material soot }\n"
    (void)state;
    expect_half_absorbed(BOX "quad { corner -1 0 -1  edge1 2 0 0  edge2 0 0 2  material lamp }\n",
                         "lamp, outwards");
    expect_half_absorbed(BOX "quad { corner -1 0 -1  edge1 0 0 2  edge2 2 0 0  material lamp }\n",
                         "lamp, inwards");
    expect_half_absorbed(BOX "quad { corner -1 0 -1  edge1 0 0 2  edge2 2 0 0  material glow }\n",
                         "a sheet");
#undef BOX
}

/* The sun shines down to an endless solid that absorbs, or begins in it, and then never arrives. */
static void light_from_afar_ends_in_an_endless_solid(void **state)
{
#define SUN_AND_PLANE(normal, inside)                                                              \
    "material soot { " inside "  absorption 1 }\nmaterial clear { kt 1  ior 1 }\n"                 \
    "light directional { direction 0.1 -1 0.2  irradiance 1 }\n"                                   \
    "sphere { centre 0 0 0  radius 1  material clear }\n"                                          \
    "plane { point 0 3 0  normal " normal "  material soot }\n"
    static const char *const scenes[] = {SUN_AND_PLANE("0 -1 0", "kt 1  ior 1"),
                                         SUN_AND_PLANE("0 -1 0", "interface true  scattering 1"),
                                         SUN_AND_PLANE("0 1 0", "kt 1  ior 1")};
    (void)state;
    for (int i = 0; i < 3; i++) {
        rt_render_options render = {.photons = 1000, .max_depth = 8};
        rt_light_ledger l;
        rt_renderer *renderer = test_renderer(scenes[i]);
        rt_photon_map *map = emit(renderer, &render);
        assert_int_equal(rt_photon_map_ledger(map, &l, 1), 1);
        expect_closed(&l, "sun and soot");
        assert_true(i < 2 ? l.escaped[0] == 0 && l.absorbed[0] == l.emitted[0]
                          : l.escaped[0] > 0 && l.absorbed[0] > 0.1 * l.emitted[0]);
        rt_photon_map_destroy(map);
        rt_renderer_destroy(renderer);
    }
#undef SUN_AND_PLANE
}

static void light_that_meets_nothing_escapes(void **state)
{
    rt_render_options render = {.photons = 1000};
    rt_light_ledger l;
    (void)state;
    rt_renderer *renderer = test_renderer("light point { position 0 0 0  power 1 2 3 }\n");
    rt_photon_map *map = emit(renderer, &render);
    assert_int_equal(rt_photon_map_ledger(map, &l, 1), 1);
    for (int c = 0; c < 3; c++) {
        assert_true(l.escaped[c] == l.emitted[c]);
        assert_float_equal(l.escaped[c], 1 + c, 1e-5);
        assert_true(l.absorbed[c] == 0 && l.cut_off[c] == 0 && l.roulette[c] == 0);
    }
    rt_photon_map_destroy(map);
    rt_renderer_destroy(renderer);
}

/* From the middle of a ball of index 1, exp(-absorption radius) comes out. */
static void what_a_solid_absorbs_is_booked(void **state)
{
    rt_render_options render = {.photons = 1000};
    rt_light_ledger l;
    (void)state;
    rt_renderer *renderer = test_renderer("material ink { kt 1  ior 1  absorption 0.5 1 2 }\n"
                                          "sphere { centre 0 0 0  radius 0.8  material ink }\n"
                                          "light point { position 0 0 0  power 1 }\n");
    rt_photon_map *map = emit(renderer, &render);
    assert_int_equal(rt_photon_map_ledger(map, &l, 1), 1);
    expect_closed(&l, "ball of ink");
    for (int c = 0; c < 3; c++) {
        double left = exp(-0.5 * (1 << c) * 0.8);
        assert_float_equal(l.escaped[c], left, 1e-4);
        assert_float_equal(l.absorbed[c], 1 - left, 1e-4);
    }
    rt_photon_map_destroy(map);
    rt_renderer_destroy(renderer);
}

/*
 * Fails unless all paths are booked and took the light's power over its share: `noise` is how far
 * they may be off, as a part; next to nothing for lights that emit evenly, whose paths are all
 * alike.
 */
static void expect_all_booked(const rt_light_ledger *rows, size_t lights, uint64_t photons,
                              double noise, const char *what)
{
    uint64_t paths = 0;
    for (size_t i = 0; i < lights; i++) {
        const rt_light_ledger *l = rows + i;
        double part = (double)l->paths / (l->share * (double)photons);
        paths += l->paths;
        for (int c = 0; c < 3; c++)
            if (!(fabs(l->emitted[c] - part * l->power[c]) <= noise * part * l->power[c]))
                fail_msg("%s: light %zu, channel %d: %g W emitted, not %g W", what, i, c,
                         l->emitted[c], part * l->power[c]);
    }
    if (paths != photons)
        fail_msg("%s: %llu of %llu paths are booked", what, (unsigned long long)paths,
                 (unsigned long long)photons);
}

/*
 * What emission differs by in the scenes whose light paths do not all start with the same flux: by
 * the cells of tables, and where one in ten misses the portals and has most of the flux.
 */
static double emission_noise(const char *path)
{
    return strstr(path, "luminaires") ? 0.01 : strstr(path, "interior") ? 0.1 : 1e-5;
}

static void expect_closed_scene(const char *path)
{
    rt_render_options render = {.photons = 50000, .max_depth = 24, .direct = RT_DIRECT_PHOTONS};
    rt_scene *scene = NULL;
    rt_renderer *renderer = NULL;
    rt_error error;
    expect_ok(rt_scene_load(&scene, path, NULL, &error), &error);
    expect_ok(rt_renderer_create(&renderer, scene, test_device(), NULL, &error), &error);
    rt_photon_map *map = emit(renderer, &render);
    size_t lights = rt_photon_map_ledger(map, NULL, 0);
    rt_light_ledger *rows = calloc(lights, sizeof *rows);
    assert_true(lights > 0 && rows);
    rt_photon_map_ledger(map, rows, lights);
    for (size_t i = 0; i < lights; i++)
        expect_closed(rows + i, path);
    expect_all_booked(rows, lights, render.photons, emission_noise(path), path);
    free(rows);
    rt_photon_map_destroy(map);
    rt_renderer_destroy(renderer);
    rt_scene_destroy(scene);
}

static void closes_in_every_scene_that_ships(void **state)
{
    glob_t found;
    (void)state;
    assert_int_equal(glob("scenes/*.rts", 0, NULL, &found), 0);
    for (size_t i = 0; i < found.gl_pathc; i++)
        expect_closed_scene(found.gl_pathv[i]);
    assert_true(found.gl_pathc >= 15);
    globfree(&found);
}

/*
 * What photons brought to diffuse surfaces is what these and roulette took off and what went on:
 * the albedo says.
 */
static void stored_flux_agrees_with_what_is_absorbed(void **state)
{
    static const double kd[3] = {0.2, 0.5, 0.8};
    rt_render_options render = {.photons = 100000, .max_depth = 64, .direct = RT_DIRECT_PHOTONS};
    rt_light_ledger l[2];
    double stored[3] = {0};
    (void)state;
    rt_renderer *renderer = test_renderer(room);
    rt_photon_map *map = emit(renderer, &render);
    const rt_photon *photons = rt_photon_map_photons(map, RT_PHOTONS_GLOBAL);
    for (size_t i = 0; i < rt_photon_map_count(map, RT_PHOTONS_GLOBAL); i++)
        for (int c = 0; c < 3; c++)
            stored[c] += photons[i].flux[c] / (double)render.photons;
    assert_int_equal(rt_photon_map_ledger(map, l, 2), 2);
    for (int c = 0; c < 3; c++)
        assert_float_equal((1 - kd[c]) * stored[c], l[0].absorbed[c] + l[1].absorbed[c], 1e-4);
    rt_photon_map_destroy(map);
    rt_renderer_destroy(renderer);
}

static void lights_are_counted_apart(void **state)
{
    rt_render_options render = {.photons = 20000, .max_depth = 16, .seed = test_seed(0)};
    rt_light_ledger l[3];
    (void)state;
    rt_renderer *renderer = test_renderer(room);
    rt_photon_map *map = emit(renderer, &render);
    assert_int_equal(rt_photon_map_ledger(map, l, 3), 2);
    assert_int_equal(l[0].shape, RT_NONE);
    assert_int_equal(l[1].shape, 7);
    assert_int_equal(l[0].paths + l[1].paths, render.photons);
    /* Paths in proportion to power: 10 W and 2.5 W. */
    assert_float_equal(l[0].share, 0.8, 1e-6);
    expect_deviate(((double)l[0].paths - 0.8 * render.photons) / sqrt(0.16 * render.photons),
                   "paths of a light");
    for (int i = 0; i < 2; i++)
        expect_closed(l + i, "two lights");
    rt_photon_map_destroy(map);
    rt_renderer_destroy(renderer);
}

/* The disc of the scene: that of the sphere around the bounding box of one of 10 m. */
static const double disc = 300 * PI;

/* The shares of the sun, the sky and a point light of 6 W, beside a portal. */
static void expect_shares(const char *portal, double sun, double sky)
{
    static const char lights[] = "material floor { kd 0.5 }\n"
                                 "sphere { centre 0 0 0  radius 10  material floor }\n"
                                 "light directional { direction 0 -1 0  irradiance 3 }\n"
                                 "light point { position 0 12 0  power 6 }\n"
                                 "light environment { radiance 0.5 }\n";
    const double total = sun + sky + 6;
    rt_render_options render = {.photons = 1000, .max_depth = 2};
    rt_light_ledger l[3];
    char text[sizeof lights + 128];
    snprintf(text, sizeof text, "%s%s", lights, portal);
    rt_renderer *renderer = test_renderer(text);
    rt_photon_map *map = emit(renderer, &render);
    assert_int_equal(rt_photon_map_ledger(map, l, 3), 3);
    assert_float_equal(l[0].share, sun / total, 1e-5);
    assert_float_equal(l[1].share, 6 / total, 1e-5);
    assert_float_equal(l[2].share, sky / total, 1e-5);
    assert_float_equal(l[0].power[0] / (3 * disc), 1, 1e-3); /* whatever its share */
    rt_photon_map_destroy(map);
    rt_renderer_destroy(renderer);
}

/* None, one so small that a hundredth is left, and one of 200 m^2 from above and edge on. */
static void distant_lights_share_by_what_goes_through_portals(void **state)
{
    (void)state;
    expect_shares("", 3 * disc, 2 * PI * disc);
    expect_shares("portal { corner 9 0 0  edge1 0 0 2  edge2 1 0 0 }\n", 0.03 * disc,
                  0.02 * PI * disc);
    expect_shares("portal { corner 0 12 0  edge1 0 0 20  edge2 10 0 0 }\n", 600, 200 * PI);
    expect_shares("portal { corner 12 0 0  edge1 0 0 20  edge2 0 10 0 }\n", 3 * disc, 200 * PI);
}

/* Whatever else emits, the flux of a light is accounted for to 1e-5 of what it emits. */
static void weak_lights_beside_strong_ones_are_booked(void **state)
{
    static const double powers[] = {1e-20, 1e-9, 1e-6, 1, 1e6};
    enum { lights = sizeof powers / sizeof *powers };
    const float shares[lights] = {1, 1, 1, 1, 1};
    rt_render_options render = {
        .photons = 5000, .light_shares = shares, .light_share_count = lights};
    rt_emit_options options = {.render = &render};
    rt_photon_map *map = NULL;
    rt_light_ledger l[lights];
    char text[2000] =
        "material wall { kd 0.2 0.5 0.8 }\nsphere { centre 0 0 0  radius 1  material wall }\n";
    rt_error error;
    (void)state;
    for (int i = 0; i < lights; i++)
        sprintf(text + strlen(text), "light point { position 0 0 0.1  power %g }\n", powers[i]);
    rt_renderer *renderer = test_renderer(text);
    expect_ok(rt_photon_map_emit(&map, renderer, &options, &error), &error);
    assert_int_equal(rt_photon_map_ledger(map, l, lights), lights);
    for (int i = 0; i < lights; i++) {
        assert_float_equal(l[i].power[0] / powers[i], 1, 1e-5);
        expect_closed(l + i, "a light among others");
    }
    expect_all_booked(l, lights, render.photons, 1e-5, "weak and strong lights");
    rt_photon_map_destroy(map);
    rt_renderer_destroy(renderer);
}

static void accounts_that_are_not_finite_are_left_out(void **state)
{
    rt_light_sources lights = {0};
    rt_ledger ledger = {0};
    rt_light_ledger l;
    rt_error error;
    rt_path_account accounts[3];
    (void)state;
    rt_renderer *renderer = test_renderer("light point { position 0 0 0  power 3 3 3 }\n");
    expect_ok(rt_light_sources_read(&lights, test_device(), renderer->scene, NULL, 0, &error),
              &error);
    expect_ok(rt_ledger_create(&ledger, &lights, &error), &error);
    memset(accounts, 0, sizeof accounts);
    for (int i = 0; i < 3; i++) {
        for (int c = 0; c < 3; c++)
            accounts[i].emitted[c] = accounts[i].left[c] = 3;
        accounts[i].end = RT_END_ESCAPED;
    }
    accounts[1].left[1] = NAN;
    accounts[2].roulette[2] = INFINITY;
    expect_ok(rt_ledger_book(&ledger, &lights, accounts, 3, 2, &error), &error);
    assert_int_equal(ledger.rejected, 2);
    assert_int_equal(ledger.paths, 3);
    rt_ledger_read(&ledger, 0, &l);
    assert_true(l.paths == 1 && l.emitted[0] == 1 && l.escaped[2] == 1);
    rt_ledger_free(&ledger);
    rt_light_sources_free(&lights);
    rt_renderer_destroy(renderer);
}

static void sums_do_not_depend_on_shares_of_the_work(void **state)
{
    enum { count = 5000 };
    static rt_path_account accounts[count];
    rt_light_sources lights = {0};
    rt_ledger whole = {0}, parts = {0}, half = {0};
    rt_error error;
    (void)state;
    rt_renderer *renderer = test_renderer(room);
    expect_ok(rt_light_sources_read(&lights, test_device(), renderer->scene, NULL, 0, &error),
              &error);
    expect_ok(rt_ledger_create(&whole, &lights, &error), &error);
    expect_ok(rt_ledger_create(&half, &lights, &error), &error);
    for (int i = 0; i < count; i++) {
        accounts[i].light = (rt_u32)i % 2;
        for (int c = 0; c < 3; c++) {
            accounts[i].emitted[c] = 1.0f / (float)(i + 3);
            accounts[i].roulette[c] = -1.0f / (float)(i + 7);
        }
    }
    expect_ok(rt_ledger_book(&whole, &lights, accounts, count, 1, &error), &error);
    for (int i = 0; i < 2; i++) {
        rt_ledger_reset(&half);
        expect_ok(
            rt_ledger_book(&half, &lights, accounts + (1 - i) * 2000, i ? 2000 : 3000, 3, &error),
            &error);
        expect_ok(rt_ledger_add(&parts, &half, &error), &error);
    }
    assert_true(rt_ledger_matches(&whole, &parts));
    assert_int_equal(whole.paths, parts.paths);
    assert_memory_equal(whole.rows, parts.rows, 2 * sizeof *whole.rows);
    rt_ledger_free(&whole);
    rt_ledger_free(&parts);
    rt_ledger_free(&half);
    rt_light_sources_free(&lights);
    rt_renderer_destroy(renderer);
}

static void sums_that_overflow_are_refused(void **state)
{
    rt_ledger_row a = {.sums = {{INT64_MAX}}}, b = {.sums = {{1}}};
    rt_ledger x = {.rows = &a, .count = 1}, y = {.rows = &b, .count = 1};
    rt_error error;
    (void)state;
    assert_int_equal(rt_ledger_add(&x, &y, &error), RT_ERROR_USAGE);
    assert_true(a.sums[0][0] == INT64_MAX);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(light_emitted_inside_is_absorbed_there),
        statistical_test(light_begins_in_the_solid_around_its_start),
        statistical_test(light_begins_on_its_side_of_a_face),
        cmocka_unit_test(light_from_afar_ends_in_an_endless_solid),
        statistical_test(closed_rooms_follow_the_geometric_series),
        cmocka_unit_test(light_that_meets_nothing_escapes),
        cmocka_unit_test(what_a_solid_absorbs_is_booked),
        cmocka_unit_test(closes_in_every_scene_that_ships),
        cmocka_unit_test(stored_flux_agrees_with_what_is_absorbed),
        statistical_test(lights_are_counted_apart),
        cmocka_unit_test(distant_lights_share_by_what_goes_through_portals),
        cmocka_unit_test(weak_lights_beside_strong_ones_are_booked),
        cmocka_unit_test(accounts_that_are_not_finite_are_left_out),
        cmocka_unit_test(sums_do_not_depend_on_shares_of_the_work),
        cmocka_unit_test(sums_that_overflow_are_refused),
    };
    return cmocka_run_group_tests_name("lib/photon/ledger", tests, NULL, NULL);
}
