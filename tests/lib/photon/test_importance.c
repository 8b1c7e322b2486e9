/*
 * test_importance.c - photon paths that start by visual importance: the tables of a pilot, the same
 * mean light in the picture, and less noise where the camera sees a small part of the scene.
 */
#include "support.h"

#include <math.h>
#include <string.h>

#include "chance.h"
#include "photon/importance.h"
#include "photon/seen_cells.h"

enum { RENDERS = 10, WIDTH = 12, HEIGHT = 8, VALUES = 3 * WIDTH * HEIGHT };

static rt_error error;

/* ---- Cells ------------------------------------------------------------------------------ */

static void cells_hold_points_and_what_is_around(void **state)
{
    enum { count = 1000 };
    static float points[count][3];
    rt_seen_cells cells;
    (void)state;
    for (int i = 0; i < count; i++) { /* 10 m along x, from 5 on, and one outlier */
        points[i][0] = 5 + 10 * (float)i / (count - 1);
        points[i][1] = 2;
    }
    points[0][0] = 1e12f;
    expect_ok(rt_seen_cells_make(&cells, (const float(*)[3])points, count, NULL, &error), &error);
    assert_true(cells.side > 0.1 && cells.side < 0.2);
    for (int i = 0; i < count; i++)
        assert_true(rt_seen_cells_hold(&cells, points[i]));
    assert_true(rt_seen_cells_hold(&cells, (float[]){7, 2.1f, -0.1f}));
    assert_false(rt_seen_cells_hold(&cells, (float[]){7, 2.5f, 0}));
    assert_false(rt_seen_cells_hold(&cells, (float[]){4, 2, 0}));
    assert_false(rt_seen_cells_hold(&cells, (float[]){-1e15f, 1e15f, 0}));
    rt_seen_cells_free(&cells);
}

static void no_points_have_no_cells(void **state)
{
    rt_seen_cells cells;
    (void)state;
    expect_ok(rt_seen_cells_make(&cells, NULL, 0, NULL, &error), &error);
    assert_false(rt_seen_cells_hold(&cells, (float[]){0, 0, 0}));
    rt_seen_cells_free(&cells);
    const float one[1][3] = {{1, 2, 3}};
    expect_ok(rt_seen_cells_make(&cells, one, 1, NULL, &error), &error);
    assert_true(rt_seen_cells_hold(&cells, one[0]));
    rt_seen_cells_free(&cells);
}

/* ---- Tables ----------------------------------------------------------------------------- */

/* Two lights, the second with a quarter of the paths. */
typedef struct two_lights {
    rt_light_source sources[2];
    rt_u32 of_light[2];
    rt_light_share shares[2];
} two_lights;

static const two_lights two = {{{.share = 0.75}, {.share = 0.25}},
                               {0, 1},
                               {{.pmf = 0.75f, .cdf = 0.75f}, {.pmf = 0.25f, .cdf = 1}}};

static rt_light_sources sources_of(two_lights *two_of)
{
    return (rt_light_sources){.sources = two_of->sources,
                              .count = 2,
                              .of_light = two_of->of_light,
                              .shares = two_of->shares,
                              .light_count = 2};
}

/* Of the first light one cell of 256 counts, as a whole; of the second none does. */
static void what_counts_becomes_frequent(void **state)
{
    enum { paths = 1 << 16, seen = 100 };
    static rt_pilot_path pilot[paths];
    two_lights lights = two;
    rt_light_sources sources = sources_of(&lights);
    rt_importance found;
    double sum = 0, below = 0;
    (void)state;
    for (int i = 0; i < paths; i++) {
        pilot[i].start = (rt_path_start){i % 4 == 3, (rt_u32)(i / 4 % 256)};
        pilot[i].weight = 1;
        pilot[i].counts = pilot[i].start.light == 0 && pilot[i].start.cell == seen;
    }
    assert_int_equal(rt_importance_levels(paths, 2), 3);
    assert_int_equal(rt_importance_levels(paths, 5), 2);
    assert_int_equal(rt_importance_levels(paths, 1u << 11), 0);
    expect_ok(rt_importance_make(&found, &sources, 2, 1, pilot, paths, &error), &error);

    /* The mean factor is 1, and no share is below a quarter of what it was. */
    for (int i = 0; i < 2; i++)
        sum += sources.sources[i].share * found.factors[i];
    assert_float_equal(sum, 1, 1e-12);
    assert_true(found.factors[0] > 1.2 && found.factors[1] >= RT_IMPORTANCE_LEAST &&
                found.factors[1] < 0.5);

    /* Nor is that of a cell; most of the first light's paths are those that count. */
    for (int i = 0; i < 512; i++) {
        const double share = (double)found.sums[i] - (i % 256 ? below : 0);
        assert_true(share >= 0.99 * RT_IMPORTANCE_LEAST / 256);
        if (i == seen)
            assert_true(share > 0.4);
        below = found.sums[i];
    }
    assert_true(found.sums[255] == 1 && found.sums[511] == 1);
    assert_float_equal(found.seen, 0.75 / 256, 1e-12);
    assert_true(found.expected > 0.35);

    /* Shares are weighed by the factors. */
    rt_light_sources_weigh(&sources, found.factors);
    assert_float_equal(lights.shares[0].pmf, 0.75 * found.factors[0], 1e-6);
    assert_float_equal(lights.shares[0].cdf, lights.shares[0].pmf, 1e-6);
    assert_true(lights.shares[1].cdf == 1);
    assert_float_equal(lights.sources[1].share, 0.25 * found.factors[1], 1e-12);
    rt_importance_free(&found);
}

/* Paths of a later round count by their weights, which undo what they followed. */
static void paths_count_by_their_weights(void **state)
{
    static const rt_pilot_path paths[2] = {{{0, 0}, 3, 1}, {{0, 1}, 1, 0}};
    two_lights lights = two;
    const rt_light_sources sources = sources_of(&lights);
    rt_importance found;
    (void)state;
    expect_ok(rt_importance_make(&found, &sources, 1, 0, paths, 2, &error), &error);
    assert_float_equal(found.seen, 0.75, 1e-12);
    assert_true(found.factors[0] == 1 && found.factors[1] == 1);
    const double share = (double)found.sums[0];
    assert_float_equal(rt_importance_weight(&found, &sources, &paths[0].start), 1 / (16 * share),
                       1e-5);
    rt_importance_free(&found);
}

static void where_nothing_counts_nothing_is_followed(void **state)
{
    static const rt_pilot_path paths[3] = {{{0, 0}, 1, 0}, {{1, 5}, 1, 0}, {{RT_NONE, 0}, 1, 1}};
    two_lights lights = two;
    const rt_light_sources sources = sources_of(&lights);
    rt_importance found;
    (void)state;
    expect_ok(rt_importance_make(&found, &sources, 1, 1, paths, 3, &error), &error);
    assert_true(found.seen == 0);
    rt_importance_free(&found);
}

/* ---- Pictures --------------------------------------------------------------------------- */

/* A floor of which the camera sees a small part, below a ball of glass. */
#define FLOOR                                                                                      \
    "camera { eye 0 1.5 -2  look_at 0 0.2 0  fov 30 }\n"                                           \
    "material white { kd 0.7 }\nmaterial glass { kt 1  ior 1.5  fresnel dielectric }\n"            \
    "material black { }\n"                                                                         \
    "quad { corner -5 0 -5  edge1 0 0 10  edge2 10 0 0  material white }\n"                        \
    "sphere { centre 0 0.5 0.3  radius 0.3  material glass }\n"
#define AROUND "quad { corner -5 6.5 5  edge1 0 0 -10  edge2 10 0 0  material white }\n"
static const char *const scenes[][2] = {
    {"point and spot", FLOOR "light point { position 3 5 2  intensity 200 }\n"
                             "light spot { position -3 5 1  target 0 0 0  inner 5  outer 60  "
                             "intensity 300 }\n"},
    {"sun", FLOOR "light directional { direction 0.3 -1 0.2  irradiance 3 }\n"},
    {"sky", FLOOR "light environment { file \"scenes/textures/bricks.png\"  radiance 1 }\n"},
    {"areas",
     FLOOR AROUND "quad { corner -1 6 -1  edge1 2 0 0  edge2 0 0 2  material black  radiance 40 }\n"
                  "sphere { centre 4 3 0  radius 0.3  material black  radiance 60 }\n"
                  "cylinder { a -4 1 4  b -4 4 4  radius 0.2  material black  radiance 90 }\n"},
};

static rt_film *render(rt_renderer *renderer, rt_render_options options, int importance)
{
    rt_film *film = NULL;
    options.width = WIDTH;
    options.height = HEIGHT;
    options.photon_importance = importance;
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    return film;
}

static const rt_render_options photons = {.mode = RT_MODE_PHOTON,
                                          .spp = 4,
                                          .photons = 60000,
                                          .k = RT_K_ALL,
                                          .radius = 0.2f,
                                          .direct = RT_DIRECT_PHOTONS};

/* What renders of a scene have in each value. */
typedef struct pictures {
    double of[RENDERS][VALUES];
} pictures;

static void render_all(pictures *out, const char *text, int importance)
{
    rt_renderer *renderer = test_renderer(text);
    for (uint32_t i = 0; i < RENDERS; i++) {
        rt_render_options options = photons;
        options.seed = test_seed(1000 * (uint32_t)importance + i);
        rt_film *film = render(renderer, options, importance);
        for (int k = 0; k < VALUES; k++)
            out->of[i][k] = (double)rt_film_rgb(film)[k];
        rt_film_destroy(film);
    }
    rt_renderer_destroy(renderer);
}

/* The variance of a value over renders. */
static double variance(const pictures *of, int k)
{
    double mean = 0, sum = 0;
    for (int i = 0; i < RENDERS; i++)
        mean += of->of[i][k] / RENDERS;
    for (int i = 0; i < RENDERS; i++)
        sum += pow(of->of[i][k] - mean, 2) / (RENDERS - 1);
    return sum;
}

/*
 * The geometric mean of the ratios of variances: where edges are sampled, camera paths make the
 * noise, and those values say nothing.
 */
static double compare_noise(const pictures *without, const pictures *with)
{
    double sum = 0;
    for (int k = 0; k < VALUES; k++)
        sum += log(variance(without, k) / variance(with, k)) / VALUES;
    return exp(sum);
}

/* Student's t of the whole picture, where both have the same light. */
static void compare(const pictures *with, const pictures *without, const char *name)
{
    double totals[2][RENDERS] = {{0}}, mean = 0, square = 0;
    for (int i = 0; i < RENDERS; i++) {
        for (int k = 0; k < VALUES; k++) {
            totals[0][i] += with->of[i][k] / VALUES;
            totals[1][i] += without->of[i][k] / VALUES;
        }
        mean += (totals[0][i] - totals[1][i]) / RENDERS;
    }
    for (int i = 0; i < RENDERS; i++)
        square += pow(totals[0][i] - totals[1][i] - mean, 2);
    const double deviation = sqrt(square / (RENDERS * (RENDERS - 1)));
    print_message("%s: off by %+.4f of the mean, %+.2f standard errors\n", name,
                  mean / totals[1][0], mean / deviation);
    chance_compare(chance_of_student(mean / deviation, RENDERS - 1), "%s", name);
}

static void importance_leaves_the_mean_and_takes_the_noise(void **state)
{
    static pictures with, without;
    (void)state;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        render_all(&with, scenes[i][1], 1);
        render_all(&without, scenes[i][1], 0);
        compare(&with, &without, scenes[i][0]);
        const double ratio = compare_noise(&without, &with);
        print_message("%s: variance %.1f times as large without\n", scenes[i][0], ratio);
        assert_true(ratio > 1.4);
    }
}

/* What the ledger and the stats tell of it. */
static void what_is_seen_is_told(void **state)
{
    rt_renderer *renderer = test_renderer(scenes[0][1]);
    rt_film_stats plain, guided;
    rt_light_ledger rows[2];
    rt_film *film = render(renderer, photons, 0);
    (void)state;
    rt_film_get_stats(film, &plain);
    rt_film_destroy(film);
    assert_true(plain.paths_seen == 0 && plain.paths_seen_by_importance == 0);
    film = render(renderer, photons, 1);
    rt_film_get_stats(film, &guided);
    assert_true(guided.paths_seen > 0 && guided.paths_seen_by_importance > 3 * guided.paths_seen);
    assert_true(guided.photons_emitted == plain.photons_emitted);
    assert_int_equal(rt_film_get_ledger(film, rows, 2), 2);
    for (int i = 0; i < 2; i++)
        for (int c = 0; c < 3; c++)
            assert_float_equal(rows[i].emitted[c], rows[i].power[c], 0.05 * rows[i].power[c]);
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
}

/* So many paths that a trial is due: on a GPU 32 million. */
static rt_render_options many(void)
{
    rt_device_info info;
    rt_device_get_info(test_device(), &info);
    return (rt_render_options){.mode = RT_MODE_PHOTON,
                               .passes = 4,
                               .photons = info.is_cpu ? 250000 : 8000000,
                               .radius = 0.2f,
                               .direct = RT_DIRECT_PHOTONS};
}

/* Nothing is seen around the floor, in the first pieces of a large film. */
static void where_much_is_seen_importance_brings_little(void **state)
{
    rt_renderer *renderer = test_renderer(
        "camera { eye 0 4 0  look_at 0 0 0  up 0 0 1  fov 130 }\nmaterial white { kd 0.7 }\n"
        "quad { corner -5 0 -5  edge1 0 0 10  edge2 10 0 0  material white }\n"
        "light spot { position 0 3 0  target 0 0 0  inner 20  outer 50  intensity 10 }\n");
    rt_render_options options = many();
    rt_film *film = NULL;
    rt_film_stats stats;
    (void)state;
    options.width = options.height = 160;
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    rt_film_get_stats(film, &stats);
    assert_true(stats.paths_seen > 0.5 && stats.paths_seen <= 1);
    assert_true(stats.paths_seen_by_importance < 2 * stats.paths_seen);
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
}

/* Parts make none, and join to the same picture. */
static void a_trial_tells_what_importance_would_bring_and_changes_no_picture(void **state)
{
    rt_renderer *renderer = test_renderer(scenes[0][1]);
    rt_render_options options = many();
    rt_film_stats tried, asked, of_part;
    rt_film *parts[2] = {NULL, NULL};
    (void)state;
    rt_film *whole = render(renderer, options, 0), *guided = render(renderer, photons, 1);
    rt_film_get_stats(whole, &tried);
    rt_film_get_stats(guided, &asked);
    /* 16384 paths, of which some 200 are seen. */
    assert_float_equal(tried.paths_seen, asked.paths_seen, 0.4 * asked.paths_seen);
    assert_true(tried.paths_seen < 0.05);
    assert_true(tried.paths_seen_by_importance > 3 * tried.paths_seen);
    options.parts = 2;
    for (uint32_t i = 0; i < 2; i++) {
        options.part = i + 1;
        parts[i] = render(renderer, options, 0);
        rt_film_get_stats(parts[i], &of_part);
        assert_true(of_part.paths_seen == 0);
    }
    expect_ok(rt_film_add(parts[0], parts[1], &error), &error);
    expect_ok(rt_film_resolve(parts[0], NULL, &error), &error);
    assert_memory_equal(rt_film_rgb(whole), rt_film_rgb(parts[0]), VALUES * sizeof(float));
    rt_film_destroy(parts[0]);
    rt_film_destroy(parts[1]);
    rt_film_destroy(guided);
    rt_film_destroy(whole);
    rt_renderer_destroy(renderer);
}

/* Shares of the caller's stay, and a map that is given has its starts already. */
static void what_does_not_go_with_it(void **state)
{
    static const float shares[2] = {1, 3};
    rt_renderer *renderer = test_renderer(scenes[0][1]);
    rt_render_options options = photons;
    rt_light_ledger rows[2];
    rt_photon_map *map = NULL;
    rt_film *film;
    (void)state;
    options.light_shares = shares;
    options.light_share_count = 2;
    film = render(renderer, options, 1);
    assert_int_equal(rt_film_get_ledger(film, rows, 2), 2);
    assert_float_equal(rows[1].share, 0.75, 1e-6);
    rt_film_destroy(film);
    options = photons;
    expect_ok(rt_photon_map_emit(&map, renderer, &(rt_emit_options){.render = &photons}, &error),
              &error);
    options.photon_map = map;
    options.photon_importance = 1;
    film = NULL;
    assert_int_equal(rt_render(&film, renderer, &options, &error), RT_ERROR_USAGE);
    assert_string_equal(error.field, "photon_importance");
    rt_photon_map_destroy(map);
    rt_renderer_destroy(renderer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cells_hold_points_and_what_is_around),
        cmocka_unit_test(no_points_have_no_cells),
        cmocka_unit_test(what_counts_becomes_frequent),
        cmocka_unit_test(paths_count_by_their_weights),
        cmocka_unit_test(where_nothing_counts_nothing_is_followed),
        statistical_test(importance_leaves_the_mean_and_takes_the_noise),
        cmocka_unit_test(what_is_seen_is_told),
        cmocka_unit_test(where_much_is_seen_importance_brings_little),
        cmocka_unit_test(a_trial_tells_what_importance_would_bring_and_changes_no_picture),
        cmocka_unit_test(what_does_not_go_with_it),
    };
    return cmocka_run_group_tests_name("lib/importance", tests, NULL, NULL);
}
