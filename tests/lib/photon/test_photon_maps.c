/*
 * test_photon_maps.c - photon maps by the public interface: caustic photons apart, shares of
 * lights, warnings, and what the photons say of the light against theory and path tracing.
 *
 * Random sums are held to standard errors or to a stated bound.
 */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/statistics.h"
#include "lib/image/scratch.h"
#include "lib/photon/emitted.h"
#include "photon/photon_map.h"
#include "render/renderer.h"

#define PI 3.14159265358979323846

/* ---- Caustics and shares --------------------------------------------------------- */

static double flux_of(const rt_photon_map *map, rt_photon_kind kind, int caustic_only, int channel)
{
    const rt_photon *photons = rt_photon_map_photons(map, kind);
    rt_photon_map_info info;
    double sum = 0;
    rt_photon_map_get_info(map, &info);
    for (size_t i = 0; i < rt_photon_map_count(map, kind); i++)
        if (!caustic_only || (photons[i].flags & RT_PHOTON_CAUSTIC))
            sum += photons[i].flux[channel];
    return sum / (double)info.paths[kind];
}

static void caustic_photons_are_kept_apart_when_asked(void **state)
{
    rt_render_options render = {.photons = 300000, .seed = test_seed(0)};
    rt_emit_options options = {.render = &render};
    size_t j = 0;
    (void)state;
    rt_renderer *renderer = test_renderer(ROOM);
    rt_photon_map *one = emit_map(renderer, &options);
    render.caustic_photons = 300000;
    rt_photon_map *two = emit_map(renderer, &options);
    const rt_photon *all = rt_photon_map_photons(one, RT_PHOTONS_GLOBAL);
    const rt_photon *global = rt_photon_map_photons(two, RT_PHOTONS_GLOBAL);
    const rt_photon *caustic = rt_photon_map_photons(two, RT_PHOTONS_CAUSTIC);
    assert_int_equal(rt_photon_map_count(one, RT_PHOTONS_CAUSTIC), 0);
    /* The global list is the one map without its caustic photons. */
    for (size_t i = 0; i < rt_photon_map_count(one, RT_PHOTONS_GLOBAL); i++)
        if (!(all[i].flags & RT_PHOTON_CAUSTIC)) {
            assert_true(j < rt_photon_map_count(two, RT_PHOTONS_GLOBAL));
            assert_memory_equal(global + j++, all + i, sizeof *all);
        }
    assert_int_equal(j, rt_photon_map_count(two, RT_PHOTONS_GLOBAL));
    /*
     * The caustic list has only such photons, of other paths, with the flux of those that the
     * global one lacks.
     */
    assert_true(rt_photon_map_count(two, RT_PHOTONS_CAUSTIC) > 3000);
    for (size_t i = 0; i < rt_photon_map_count(two, RT_PHOTONS_CAUSTIC); i++)
        assert_true(caustic[i].flags & RT_PHOTON_CAUSTIC);
    /* Some 15 000 photons on either side: a standard error of 1.2 %. */
    for (int c = 0; c < 3; c++) {
        double expected = flux_of(one, RT_PHOTONS_GLOBAL, 1, c);
        assert_true(expected > 0.1);
        expect_close(flux_of(two, RT_PHOTONS_CAUSTIC, 0, c), expected, 0.05 * expected,
                     "caustic flux");
    }
    rt_photon_map_destroy(one);
    rt_photon_map_destroy(two);
    rt_renderer_destroy(renderer);
}

/* Lights in the order of the ledger: the point light first, then the quad. */
static void shares_move_paths_but_not_flux(void **state)
{
    static const float shares[] = {1, 9};
    rt_render_options render = {
        .photons = 100000, .direct = RT_DIRECT_PHOTONS, .seed = test_seed(0)};
    rt_emit_options options = {.render = &render};
    rt_light_ledger by_power[2], by_shares[2];
    (void)state;
    rt_renderer *renderer = test_renderer(ROOM);
    rt_photon_map *plain = emit_map(renderer, &options);
    render.light_shares = shares;
    render.light_share_count = 2;
    rt_photon_map *shared = emit_map(renderer, &options);
    assert_int_equal(rt_photon_map_ledger(plain, by_power, 2), 2);
    assert_int_equal(rt_photon_map_ledger(shared, by_shares, 2), 2);
    assert_true(by_shares[0].shape == RT_NONE && by_shares[1].shape == 2);
    assert_float_equal(by_shares[1].share, 0.9, 1e-6);
    expect_deviate(((double)by_shares[1].paths / 1e5 - 0.9) / (0.3 / sqrt(1e5)), "paths by shares");
    expect_deviate(((double)by_power[1].paths / 1e5 - 0.375) / (0.5 / sqrt(1e5)), "paths by power");
    for (int i = 0; i < 2; i++)
        for (int c = 0; c < 3; c++) {
            expect_close(by_shares[i].emitted[c], by_shares[i].power[c],
                         0.05 * by_shares[i].power[c], "emitted");
            assert_float_equal(by_shares[i].power[c], by_power[i].power[c], 0);
        }
    for (int c = 0; c < 3; c++) {
        double expected = flux_of(plain, RT_PHOTONS_GLOBAL, 0, c);
        expect_close(flux_of(shared, RT_PHOTONS_GLOBAL, 0, c), expected, 0.05 * expected,
                     "stored by shares");
    }
    rt_photon_map_destroy(plain);
    rt_photon_map_destroy(shared);
    rt_renderer_destroy(renderer);
}

/* The mean of a film and, for its two lights, the ledger. */
static double render_shared(rt_light_ledger ledger[2], rt_renderer *renderer,
                            const rt_render_options *options)
{
    rt_film *film = NULL;
    rt_error error;
    double sum = 0;
    expect_ok(rt_render(&film, renderer, options, &error), &error);
    assert_int_equal(rt_film_get_ledger(film, ledger, 2), 2);
    for (uint32_t i = 0; i < 3 * options->width * options->height; i++)
        sum += rt_film_rgb(film)[i];
    rt_film_destroy(film);
    return sum / (3.0 * options->width * options->height);
}

/*
 * Shares move noise between the lights of a picture, and leave its mean alone; once and in passes.
 */
static void shares_leave_the_mean_of_a_picture(void **state)
{
    static const float shares[] = {1, 9};
    rt_render_options options = {.mode = RT_MODE_PHOTON,
                                 .width = 24,
                                 .height = 24,
                                 .photons = 100000,
                                 .spp = 2,
                                 .radius = 0.1f,
                                 .direct = RT_DIRECT_PHOTONS};
    (void)state;
    rt_renderer *renderer = test_renderer("camera { eye 0 0 0.9  look_at 0 0 0  fov 80 }\n" ROOM);
    for (options.passes = 1; options.passes <= 4; options.passes += 3) {
        rt_light_ledger by_power[2], by_shares[2];
        double paths = (double)options.photons * options.passes;
        options.light_shares = NULL;
        options.light_share_count = 0;
        double expected = render_shared(by_power, renderer, &options);
        options.light_shares = shares;
        options.light_share_count = 2;
        double mean = render_shared(by_shares, renderer, &options);
        assert_float_equal((double)by_power[1].paths / paths, 0.375, 5 * 0.5 / sqrt(paths));
        assert_float_equal((double)by_shares[1].paths / paths, 0.9, 5 * 0.3 / sqrt(paths));
        assert_float_equal(by_shares[1].share, 0.9, 1e-6);
        assert_true(expected > 0);
        assert_float_equal(mean, expected, 0.02 * expected);
    }
    rt_renderer_destroy(renderer);
}

static void wrong_options_are_refused(void **state)
{
    static const float zero[] = {1, 0}, negative[] = {1, -1}, nan[] = {1, NAN}, one[] = {1};
    static const rt_emit_options cases[] = {{.part = 1}, {.part = 3, .parts = 3}};
    static const struct {
        rt_render_options render;
        const char *field;
    } bad[] = {
        {{.caustic_k = 1}, "caustic_k"},
        {{.light_shares = zero, .light_share_count = 2}, "light_shares"},
        {{.light_shares = negative, .light_share_count = 2}, "light_shares"},
        {{.light_shares = nan, .light_share_count = 2}, "light_shares"},
        {{.light_shares = one, .light_share_count = 1}, "light_shares"},
    };
    rt_photon_map *map = NULL;
    rt_error error;
    (void)state;
    rt_renderer *renderer = test_renderer(ROOM "render { photons 100 }\n");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_int_equal(rt_photon_map_emit(&map, renderer, &cases[i], &error), RT_ERROR_USAGE);
        assert_string_equal(error.field, "part");
    }
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        rt_emit_options options = {.render = &bad[i].render};
        assert_int_equal(rt_photon_map_emit(&map, renderer, &options, &error), RT_ERROR_USAGE);
        assert_string_equal(error.field, bad[i].field);
    }
    assert_null(map);
    /* Without options the scene's own count. */
    map = emit_map(renderer, NULL);
    assert_int_equal(rt_photon_map_merge(&map, NULL, 0, &error), RT_ERROR_USAGE);
    rt_photon_map_info info;
    rt_photon_map_get_info(map, &info);
    assert_int_equal(info.paths[RT_PHOTONS_GLOBAL], 100);
    rt_photon_map_destroy(map);
    rt_renderer_destroy(renderer);
}

/* ---- Warnings ---------------------------------------------------------------------- */

static void keep_warning(void *user, const char *line)
{
    char *text = user;
    size_t used = strlen(text);
    snprintf(text + used, 2000 - used, "%s\n", line);
}

static int cancel(void *user, const rt_progress *progress)
{
    (void)user;
    return progress->stage == RT_STAGE_EMIT;
}

static void starved_lights_are_told(void **state)
{
    char warnings[2000] = "";
    rt_hooks hooks = {.user = warnings, .warning = keep_warning};
    rt_render_options render = {.photons = 2000, .caustic_photons = 20, .hooks = &hooks};
    rt_emit_options options = {.render = &render};
    (void)state;
    rt_renderer *renderer = test_renderer(ROOM "light point { position 0 0 0.5  power 1e-9 }\n");
    rt_photon_map_destroy(emit_map(renderer, &options));
    assert_non_null(
        strstr(warnings, "fewer than 100 of 2000 photon paths came from a light with power"));
    assert_non_null(strstr(warnings, ": light 1, 1e-09 W, 0 paths; more photons help"));
    assert_null(strstr(warnings, "light 0"));
    assert_null(strstr(warnings, "global"));
    assert_non_null(strstr(warnings, "the caustic photon map has only "));
    rt_renderer_destroy(renderer);
}

static void estimates_of_a_large_part_of_a_map_are_told(void **state)
{
    char warnings[2000] = "";
    rt_hooks hooks = {.user = warnings, .warning = keep_warning};
    rt_render_options render = {.photons = 2000, .k = 50, .hooks = &hooks};
    rt_emit_options options = {.render = &render};
    (void)state;
    rt_renderer *renderer = test_renderer(ROOM);
    rt_photon_map *map = emit_map(renderer, &options);
    assert_string_equal(warnings, "");
    render.k = (uint32_t)(rt_photon_map_count(map, RT_PHOTONS_GLOBAL) / 2);
    rt_photon_map_destroy(map);
    rt_photon_map_destroy(emit_map(renderer, &options));
    assert_non_null(strstr(warnings, "an estimate takes "));
    assert_non_null(strstr(warnings, ", which spreads light over a large part of the scene"));
    rt_renderer_destroy(renderer);
}

static void radii_of_a_large_part_of_the_scene_are_told(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        char warnings[2000] = "";
        const rt_hooks hooks = {.user = warnings, .warning = keep_warning};
        const rt_render_options options = {.mode = RT_MODE_PHOTON,
                                           .width = 2,
                                           .height = 2,
                                           .spp = 1,
                                           .photons = 2000,
                                           .k = RT_K_ALL,
                                           .radius = i ? 5 : 0.1f,
                                           .hooks = &hooks};
        rt_film *film = NULL;
        rt_error error;
        rt_renderer *renderer = test_renderer("camera { eye 0 0 0  look_at 0 0 1 }\n" ROOM);
        expect_ok(rt_render(&film, renderer, &options, &error), &error);
        assert_int_equal(strstr(warnings, "of that of the scene, are one estimate") != NULL, i);
        rt_film_destroy(film);
        rt_renderer_destroy(renderer);
    }
}

#define INDIRECT                                                                                   \
    "; it holds indirect light alone, of which a scene may have none, for shadow rays bring what " \
    "is direct\n"

static void empty_maps_are_told(void **state)
{
    char warnings[2000] = "";
    rt_hooks hooks = {.user = warnings, .warning = keep_warning};
    rt_render_options render = {.photons = 2000, .hooks = &hooks};
    rt_emit_options options = {.render = &render};
    rt_photon_map *map = NULL;
    rt_error error;
    (void)state;
    rt_renderer *renderer = test_renderer("light point { position 0 0 0  power 1 }\n");
    rt_photon_map_destroy(emit_map(renderer, &options));
    assert_string_equal(warnings,
                        "the photon map is empty: none of 2000 photon paths left a photon in "
                        "it" INDIRECT);
    /* Why that is so is told where it is known, and of which pass it is. */
    warnings[0] = '\0';
    render.max_depth = 1;
    rt_photon_map_destroy(emit_map(renderer, &options));
    assert_string_equal(
        warnings, "the photon map is empty: none of 2000 photon paths left a photon in it; with "
                  "max_depth 1 all light is direct, which shadow rays bring\n");
    warnings[0] = '\0';
    rt_render_options passes = {.mode = RT_MODE_PHOTON,
                                .width = 2,
                                .height = 2,
                                .photons = 100,
                                .passes = 3,
                                .radius = 0.1f,
                                .hooks = &hooks};
    rt_film *film = NULL;
    rt_renderer *seen = test_renderer(
        "camera { eye 0 0 1  look_at 0 0 0 }\nlight point { position 0 0 0  power 1 }\n");
    expect_ok(rt_render(&film, seen, &passes, &error), &error);
    assert_string_equal(
        warnings,
        "the photon map of pass 3 is empty: none of 100 photon paths left a photon in it" INDIRECT);
    rt_film_destroy(film);
    rt_renderer_destroy(seen);
    hooks.progress = cancel;
    assert_int_equal(rt_photon_map_emit(&map, renderer, &options, &error), RT_CANCELLED);
    assert_null(map);
    rt_renderer_destroy(renderer);
}

static void many_starved_lights_are_told_in_one_line(void **state)
{
    char text[2000] = ROOM, warnings[2000] = "";
    rt_hooks hooks = {.user = warnings, .warning = keep_warning};
    rt_render_options render = {.photons = 2000, .k = 10, .hooks = &hooks};
    rt_emit_options options = {.render = &render};
    (void)state;
    for (int i = 0; i < 6; i++)
        strcat(text, "light point { position 0 0 0.5  power 1e-9 }\n");
    rt_renderer *renderer = test_renderer(text);
    rt_photon_map_destroy(emit_map(renderer, &options));
    assert_non_null(strstr(warnings, "each of some lights with power"));
    assert_non_null(strstr(warnings, "light 1, 1e-09 W, 0 paths; light 2, "));
    assert_non_null(strstr(warnings, "light 4, 1e-09 W, 0 paths; and 2 more; more photons help"));
    assert_ptr_equal(strchr(warnings, '\n'), warnings + strlen(warnings) - 1);

    /* A share of the paths is what they lack. */
    const float shares[] = {2, 1, 1, 1, 1, 1, 1, 2};
    render.light_shares = shares;
    render.light_share_count = 8;
    warnings[0] = '\0';
    rt_photon_map_destroy(emit_map(renderer, &options));
    assert_string_equal(warnings, "");
    rt_renderer_destroy(renderer);
}

/* Without other shapes, light falls on planes about the origin. */
static void planes_alone_are_told_of_the_origin(void **state)
{
    char warnings[2000] = "";
    rt_hooks hooks = {.user = warnings, .warning = keep_warning};
    rt_render_options render = {.photons = 2000, .hooks = &hooks};
    rt_emit_options options = {.render = &render};
    (void)state;
    rt_renderer *renderer = test_renderer("material wall { kd 0.5 }\n"
                                          "plane { point 0 -2 0  normal 0 1 0  material wall }\n"
                                          "light directional { direction 0 -1 0  irradiance 1 }\n");
    rt_photon_map_destroy(emit_map(renderer, &options));
    assert_non_null(strstr(
        warnings, "fall on planes only within 1 m of the origin, for want of other shapes: "));
    assert_null(strstr(warnings, "middle"));
    rt_renderer_destroy(renderer);
}

static void light_that_does_not_reach_planes_is_told(void **state)
{
    static const char sun[] = "light directional { direction 0 -1 0  irradiance 1 }\n",
                      floor[] = "plane { point 0 -2 0  normal 0 1 0  material wall }\n",
                      bulb[] = "light point { position 0 0 0.5  power 1 }\n",
                      *const rooms[] = {floor, "", floor}, *const lights[] = {sun, sun, bulb};
    (void)state;
    for (int i = 0; i < 3; i++) {
        char text[2000], warnings[2000] = "";
        rt_hooks hooks = {.user = warnings, .warning = keep_warning};
        rt_render_options render = {
            .photons = 2000, .mode = RT_MODE_PHOTON, .width = 4, .height = 4, .hooks = &hooks};
        rt_emit_options options = {.render = &render};
        rt_film *film = NULL;
        rt_error error;
        snprintf(text, sizeof text, "%s%s%scamera { eye 0 0 -0.9  look_at 0 0 0 }\n", ROOM,
                 rooms[i], lights[i]);
        rt_renderer *renderer = test_renderer(text);
        rt_photon_map_destroy(emit_map(renderer, &options));
        assert_int_equal(strstr(warnings, "m of the middle of the other shapes: ") != NULL, i == 0);
        warnings[0] = '\0';
        expect_ok(rt_render(&film, renderer, &render, &error), &error);
        assert_int_equal(strstr(warnings, "fall on planes only within") != NULL, i == 0);
        rt_film_destroy(film);
        for (int finds_all = 0; finds_all < 2; finds_all++) {
            warnings[0] = '\0';
            render.mode = RT_MODE_VCM;
            render.spp = 1;
            render.techniques = finds_all ? RT_TECHNIQUES_BPT : RT_TECHNIQUES_BPM;
            expect_ok(rt_render(&film, renderer, &render, &error), &error);
            assert_int_equal(strstr(warnings, "so that these techniques lose the light") != NULL,
                             i == 0 && !finds_all);
            rt_film_destroy(film);
        }
        rt_renderer_destroy(renderer);
    }
}

/* ---- The light ------------------------------------------------------------------------- */

/*
 * A sphere of radius 2 with the light in its middle: everywhere the same irradiance, power / ((1 -
 * kd) area), of which rt_render sees kd/pi. The three agree, and path tracing, which knows no
 * photons, is one of them.
 */
static const char furnace[] = "camera { eye 0 0 0.5  look_at 0 0 -1  fov 90 }\n"
                              "material wall { kd 0.2 0.5 0.7 }\n"
                              "sphere { centre 0 0 0  radius 2  material wall }\n"
                              "light point { position 0 0 0  power 2 3 5 }\n";

static void stored_flux_is_what_path_tracing_says(void **state)
{
    static const double power[3] = {2, 3, 5}, kd[3] = {0.2, 0.5, 0.7}, area = 16 * PI;
    rt_render_options render = {
        .photons = 200000, .max_depth = 100, .direct = RT_DIRECT_PHOTONS, .seed = test_seed(0)};
    rt_render_options path = {
        .width = 24, .height = 24, .spp = 64, .max_depth = 100, .seed = test_seed(0)};
    rt_emit_options options = {.render = &render};
    rt_film *film = NULL;
    rt_error error;
    (void)state;
    rt_renderer *renderer = test_renderer(furnace);
    rt_photon_map *map = emit_map(renderer, &options);
    expect_ok(rt_render(&film, renderer, &path, &error), &error);
    for (int c = 0; c < 3; c++) {
        double stored = flux_of(map, RT_PHOTONS_GLOBAL, 0, c), mean = 0;
        for (int i = 0; i < 24 * 24; i++)
            mean += rt_film_rgb(film)[3 * i + c] / (24 * 24);
        expect_close(stored, power[c] / (1 - kd[c]), 0.01 * stored, "stored flux");
        expect_close(mean, kd[c] / PI * stored / area, 0.017 * mean,
                     "what path tracing sees of it");
    }
    rt_film_destroy(film);
    rt_photon_map_destroy(map);
    rt_renderer_destroy(renderer);
}

enum { places = 400 };

/* Points all over the inside of the furnace, with their inner normals, and what arrives there. */
typedef struct inside {
    float positions[places][3], normals[places][3], rgb[places][3];
} inside;

static void make_places(inside *in)
{
    for (int i = 0; i < places; i++) {
        double z = (i + 0.5) / places * 2 - 1, turn = 2.399963 * i, r = sqrt(1 - z * z);
        const double n[3] = {r * cos(turn), r * sin(turn), z};
        for (int c = 0; c < 3; c++) {
            in->positions[i][c] = (float)(2 * n[c]);
            in->normals[i][c] = (float)-n[c];
        }
    }
}

static rt_status find_irradiance(inside *in, const rt_photon_map *map,
                                 const rt_render_options *options, rt_error *error)
{
    return rt_photon_map_irradiance(in->rgb[0], map, test_device(), in->positions[0],
                                    in->normals[0], places, options, error);
}

static double mean_irradiance(const inside *in, int channel)
{
    double mean = 0;
    for (int i = 0; i < places; i++)
        mean += in->rgb[i][channel] / places;
    return mean;
}

/* The device finds the same photons; a fixed radius gives the same mean. */
static void expect_same_irradiance(const rt_photon_map *map, const inside *nearest)
{
    static inside again;
    rt_render_options query = {.k = 100, .kernel = RT_DENSITY_BOX, .gather = RT_GATHER_DEVICE};
    rt_error error;
    make_places(&again);
    expect_ok(find_irradiance(&again, map, &query, &error), &error);
    for (int i = 0; i < places; i++)
        for (int c = 0; c < 3; c++)
            assert_float_equal(again.rgb[i][c], nearest->rgb[i][c], 1e-4 * nearest->rgb[i][c]);
    query.k = RT_K_ALL;
    assert_int_equal(find_irradiance(&again, map, &query, &error), RT_ERROR_USAGE);
    assert_string_equal(error.field, "radius");
    query.radius = 0.15f;
    expect_ok(find_irradiance(&again, map, &query, &error), &error);
    const double expected = mean_irradiance(nearest, 1);
    expect_close(mean_irradiance(&again, 1), expected, 0.03 * expected,
                 "irradiance by a fixed radius");
}

/* Nothing arrives on the outside, and no points are no work. */
static void expect_dark_outside(const rt_photon_map *map)
{
    static inside outside;
    const rt_render_options query = {.k = 100, .kernel = RT_DENSITY_BOX, .radius = 0.1f};
    rt_error error;
    make_places(&outside);
    for (int i = 0; i < places; i++)
        for (int c = 0; c < 3; c++)
            outside.normals[i][c] = -outside.normals[i][c];
    expect_ok(find_irradiance(&outside, map, &query, &error), &error);
    for (int i = 0; i < places; i++)
        for (int c = 0; c < 3; c++)
            assert_true(outside.rgb[i][c] == 0);
    expect_ok(rt_photon_map_irradiance(NULL, map, test_device(), NULL, NULL, 0, NULL, &error),
              &error);
}

static void irradiance_is_flux_over_area(void **state)
{
    static const double power[3] = {2, 3, 5}, kd[3] = {0.2, 0.5, 0.7};
    static inside nearest;
    rt_render_options render = {
        .photons = 100000, .max_depth = 100, .direct = RT_DIRECT_PHOTONS, .seed = test_seed(0)};
    const rt_render_options query = {.k = 100, .kernel = RT_DENSITY_BOX};
    rt_emit_options options = {.render = &render};
    rt_error error;
    (void)state;
    rt_renderer *renderer = test_renderer(furnace);
    rt_photon_map *map = emit_map(renderer, &options);
    make_places(&nearest);
    expect_ok(find_irradiance(&nearest, map, &query, &error), &error);
    for (int c = 0; c < 3; c++) {
        const double expected = power[c] / (1 - kd[c]) / (16 * PI);
        /*
         * Each of 100 photons: 10 % a point, 0.5 % in the mean; a curved surface makes discs look
         * small.
         */
        expect_close(mean_irradiance(&nearest, c), expected, 0.03 * expected, "irradiance");
    }
    expect_same_irradiance(map, &nearest);
    expect_dark_outside(map);
    rt_photon_map_destroy(map);
    rt_renderer_destroy(renderer);
}

/*
 * As the contract says: a square of 2 m in even light, asked in its middle, at the middle of an
 * edge, and at a corner, relative to the middle.
 */
static void irradiance_is_too_low_at_an_edge(void **state)
{
    static const float positions[3][3] = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}},
                       normals[3][3] = {{0, 1, 0}, {0, 1, 0}, {0, 1, 0}};
    static const double expected[2][3] = {{1, 0.5, 0.25}, {1, 1, 1}};
    static const char *const names[2][3] = {{"disc", "disc at an edge", "disc at a corner"},
                                            {"hull", "hull at an edge", "hull at a corner"}};
    rt_render_options render = {.photons = 200000,
                                .direct = RT_DIRECT_PHOTONS,
                                .sampler = RT_SAMPLER_INDEPENDENT,
                                .seed = test_seed(0)};
    rt_emit_options options = {.render = &render};
    rt_error error;
    (void)state;
    rt_renderer *renderer =
        test_renderer("material m { kd 0.5 }\n"
                      "quad { corner -1 0 -1  edge1 0 0 2  edge2 2 0 0  material m }\n"
                      "light directional { direction 0 -1 0  irradiance 1 }\n");
    rt_photon_map *map = emit_map(renderer, &options);
    for (int area = 0; area < 2; area++) {
        const rt_render_options query = {
            .k = 2000, .kernel = RT_DENSITY_BOX, .area = area ? RT_AREA_HULL : RT_AREA_DISC};
        float rgb[3][3];
        expect_ok(rt_photon_map_irradiance(rgb[0], map, test_device(), positions[0], normals[0], 3,
                                           &query, &error),
                  &error);
        /* 2000 photons: 2.2 % of the value. */
        for (int i = 0; i < 3; i++)
            expect_close(rgb[i][0], expected[area][i], 0.11 * expected[area][i], names[area][i]);
    }
    rt_photon_map_destroy(map);
    rt_renderer_destroy(renderer);
}

/* Neither a point that is nowhere nor a normal that is none gets a number. */
static void irradiance_is_refused_where_there_is_no_surface(void **state)
{
    static const struct {
        float position[3], normal[3];
        const char *field; /* at fault, or NULL */
    } cases[] = {
        {{0, 2, 0}, {0, -1, 0}, NULL},
        {{0, 2, 0}, {0, -0.9999f, 0.01f}, NULL},
        {{0, 2, 0}, {0, 0, 0}, "normals"},
        {{0, 2, 0}, {0, -2, 0}, "normals"},
        {{0, 2, 0}, {0, -0.9f, 0}, "normals"},
        {{0, 2, 0}, {0, -1, NAN}, "normals"},
        {{0, 2, 0}, {-INFINITY, 0, 0}, "normals"},
        {{0, NAN, 0}, {0, -1, 0}, "positions"},
        {{0, 2, INFINITY}, {0, -1, 0}, "positions"},
        {{-1e16f, 2, 0}, {0, -1, 0}, "positions"},
    };
    rt_render_options render = {.photons = 500, .direct = RT_DIRECT_PHOTONS};
    rt_emit_options options = {.render = &render};
    (void)state;
    rt_renderer *renderer = test_renderer(furnace);
    rt_photon_map *map = emit_map(renderer, &options);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        float positions[2][3] = {{0, 2, 0}}, normals[2][3] = {{0, -1, 0}}, rgb[2][3];
        rt_error error = {0};
        memcpy(positions[1], cases[i].position, sizeof positions[1]);
        memcpy(normals[1], cases[i].normal, sizeof normals[1]);
        rt_status status = rt_photon_map_irradiance(rgb[0], map, test_device(), positions[0],
                                                    normals[0], 2, NULL, &error);
        if (status != (cases[i].field ? RT_ERROR_USAGE : RT_OK))
            fail_msg("case %zu: status %d: %s", i, (int)status, error.message);
        assert_string_equal(error.field, cases[i].field ? cases[i].field : "");
        assert_true(!cases[i].field || strstr(error.message, "point 1"));
    }
    rt_photon_map_destroy(map);
    rt_renderer_destroy(renderer);
}

/*
 * Where light grazes a plane it lands as far out as one likes; a map keeps what it can be read back
 * with.
 */
static void photons_beyond_all_coordinates_are_left_out(void **state)
{
    static const char text[] = "material wall { kd 0.5 }\n"
                               "plane { point 0 -1e14 0  normal 0 1 0  material wall }\n"
                               "light point { position 0 0 0  power 1 }\n";
    rt_render_options render = {.photons = 2000, .direct = RT_DIRECT_PHOTONS};
    rt_emit_options options = {.render = &render};
    rt_photon_map *back = NULL;
    rt_photon_map_info info;
    rt_error error;
    (void)state;
    rt_renderer *renderer = test_renderer(text);
    rt_photon_map *map = emit_map(renderer, &options);
    rt_photon_map_get_info(map, &info);
    /*
     * Half of the paths go down, and of these a tenth lands farther out: 100, with a deviation of
     * 10.
     */
    assert_in_range(info.rejected, 50, 150);
    expect_ok(rt_photon_map_save(map, "far.rtp", &error), &error);
    expect_ok(rt_photon_map_load(&back, "far.rtp", &error), &error);
    expect_same_map(map, back);
    rt_photon_map_destroy(back);
    rt_photon_map_destroy(map);
    rt_renderer_destroy(renderer);
}

/* The number of a scene can be forged; the shapes that photons lie on are counted besides. */
static void maps_with_photons_on_no_shape_are_not_rendered(void **state)
{
    rt_render_options render = {.photons = 200};
    rt_emit_options options = {.render = &render};
    rt_film *film = NULL;
    rt_error error;
    (void)state;
    rt_renderer *renderer = test_renderer("camera { eye 0 0 -0.9  look_at 0 0 0 }\n" ROOM);
    rt_photon_map *map = emit_map(renderer, &options);
    rt_render_options use = {
        .mode = RT_MODE_PHOTON, .width = 2, .height = 2, .spp = 1, .photon_map = map};
    expect_ok(rt_render(&film, renderer, &use, &error), &error);
    rt_film_destroy(film);
    film = NULL;
    map->lists[RT_PHOTONS_GLOBAL].photons[7].shape = 3;
    assert_int_equal(rt_render(&film, renderer, &use, &error), RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "a photon on shape 3 of a scene of 3 shapes"));
    assert_null(film);
    rt_photon_map_destroy(map);
    rt_renderer_destroy(renderer);
}

/*
 * A point light inside a glass ball: all light is caustic at first, and both lists together are all
 * of it.
 */
static void irradiance_sums_both_lists(void **state)
{
    static const char text[] = "material wall { kd 0.5 }\n"
                               "material glass { kt 1  ior 1.5  fresnel dielectric }\n"
                               "sphere { centre 0 0 0  radius 2  material wall }\n"
                               "sphere { centre 0 0 0  radius 0.5  material glass }\n"
                               "light point { position 0 0 0  power 3 3 3 }\n";
    static const float position[3] = {0, 2, 0}, normal[3] = {0, -1, 0};
    rt_render_options render = {.photons = 100000,
                                .max_depth = 60,
                                .k = 2000,
                                .caustic_photons = 50000,
                                .seed = test_seed(0)};
    rt_emit_options options = {.render = &render};
    rt_photon_map_info info;
    rt_error error;
    float rgb[3];
    (void)state;
    rt_renderer *renderer = test_renderer(text);
    rt_photon_map *map = emit_map(renderer, &options);
    rt_photon_map_get_info(map, &info);
    assert_true(info.split && info.photons[RT_PHOTONS_CAUSTIC] > 49000);
    expect_ok(
        rt_photon_map_irradiance(rgb, map, test_device(), position, normal, 1, &render, &error),
        &error);
    /* 3 W directly and as much again after bounces; 2000 photons: 3 %. */
    expect_close(rgb[0], 6 / (16 * PI), 0.1 * 6 / (16 * PI), "irradiance of both lists");
    rt_photon_map_destroy(map);
    rt_renderer_destroy(renderer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(caustic_photons_are_kept_apart_when_asked),
        statistical_test(shares_move_paths_but_not_flux),
        cmocka_unit_test(shares_leave_the_mean_of_a_picture),
        cmocka_unit_test(wrong_options_are_refused),
        cmocka_unit_test(starved_lights_are_told),
        cmocka_unit_test(radii_of_a_large_part_of_the_scene_are_told),
        cmocka_unit_test(estimates_of_a_large_part_of_a_map_are_told),
        cmocka_unit_test(empty_maps_are_told),
        cmocka_unit_test(many_starved_lights_are_told_in_one_line),
        cmocka_unit_test(light_that_does_not_reach_planes_is_told),
        cmocka_unit_test(planes_alone_are_told_of_the_origin),
        statistical_test(stored_flux_is_what_path_tracing_says),
        statistical_test(irradiance_is_flux_over_area),
        statistical_test(irradiance_is_too_low_at_an_edge),
        cmocka_unit_test(irradiance_is_refused_where_there_is_no_surface),
        cmocka_unit_test_setup_teardown(photons_beyond_all_coordinates_are_left_out, scratch_enter,
                                        scratch_leave),
        cmocka_unit_test(maps_with_photons_on_no_shape_are_not_rendered),
        statistical_test(irradiance_sums_both_lists),
    };
    return cmocka_run_group_tests_name("lib/photon/photon_maps", tests, NULL, NULL);
}
