/*
 * test_estimators.c - all techniques render a room with the same mean in every pixel.
 *
 * Photons are gathered within a radius so small that what discs lose beyond edges is far below the
 * noise: the mean of such an estimate does not depend on how many photons a disc holds.
 */
#include <math.h>

#include "proof/proof.h"
#include "proof/room.h"

/* Eye paths and photon paths are cut off each by themselves: far beyond what light is left. */
enum { side = 12, depth = 24 };

static const rt_render_options path = {
    .width = side, .height = side, .spp = 64, .max_depth = depth};
static const rt_render_options map = {.width = side,
                                      .height = side,
                                      .spp = 32,
                                      .max_depth = depth,
                                      .seed = 1000,
                                      .mode = RT_MODE_PHOTON,
                                      .photons = 40000,
                                      .k = RT_K_ALL,
                                      .radius = 0.005f};

/* Path tracing as it is by default, rendered once. */
static proof_films peer;

static int render_peer(void **state)
{
    (void)state;
    proof_render(&peer, ROOM, &path);
    return 0;
}

static int free_peer(void **state)
{
    (void)state;
    proof_free(&peer);
    return 0;
}

static void expect_same(const char *by, const rt_render_options *options)
{
    proof_films films;
    proof_render(&films, ROOM, options);
    proof_same((proof_row){"room", by, "path"}, &films, &peer);
    proof_free(&films);
}

static void light_and_material_sampling(void **state)
{
    rt_render_options options = path;
    (void)state;
    options.seed = 100;
    options.estimator = RT_ESTIMATOR_LIGHT;
    expect_same("path, light sampling", &options);
    options.seed = 200;
    options.estimator = RT_ESTIMATOR_BSDF;
    expect_same("path, BSDF sampling", &options);
}

static void roulette_on_and_off(void **state)
{
    rt_render_options options = path;
    (void)state;
    options.seed = 300;
    options.roulette_depth = depth;
    expect_same("path without roulette", &options);
    options.seed = 400;
    options.roulette_depth = 1;
    options.roulette_threshold = 1;
    expect_same("path, roulette from the first surface on", &options);
}

static void independent_samples(void **state)
{
    rt_render_options options = path;
    (void)state;
    options.seed = 500;
    options.sampler = RT_SAMPLER_INDEPENDENT;
    expect_same("path, independent samples", &options);
}

static void photons(void **state)
{
    rt_render_options nee = map, direct = map, gathered = map, split = map;
    (void)state;
    expect_same("photons and shadow rays", &nee);
    direct.direct = RT_DIRECT_PHOTONS;
    expect_same("photons alone", &direct);
    gathered.final_gather = 1;
    expect_same("photons, final gather", &gathered);
    split.caustic_photons = 40000;
    expect_same("photons, caustic map", &split);
}

/* Each pass has fresh photons and a smaller radius; the mean of all is what counts. */
static void progressive_passes(void **state)
{
    rt_render_options options = map;
    (void)state;
    options.passes = 16;
    options.spp = 2;
    options.photons = 4000;
    expect_same("photons in 16 passes", &options);
}

/* Paths from both ends, joined in all ways, and by the one technique that finds all light. */
static void bidirectional(void **state)
{
    rt_render_options options = path;
    (void)state;
    options.mode = RT_MODE_VCM;
    options.spp = 16;
    options.seed = 700;
    options.techniques = RT_TECHNIQUES_BPT;
    expect_same("techniques bpt", &options);
    options.techniques = RT_TECHNIQUES_EMISSION;
    options.seed = 900;
    expect_same("vcm, emission alone", &options);
}

/*
 * Light that was scattered once, by a mode of its own and as the first part of the series of all
 * depths.
 */
static void direct_light(void **state)
{
    rt_render_options direct = path, shallow = path;
    proof_films a, b;
    (void)state;
    direct.mode = RT_MODE_DIRECT;
    direct.max_depth = 2;
    direct.seed = 600;
    shallow.max_depth = 2;
    proof_render(&a, ROOM, &direct);
    proof_render(&b, ROOM, &shallow);
    proof_same((proof_row){"room, light scattered once", "direct", "path"}, &a, &b);
    proof_free(&a);
    proof_free(&b);
}

static void the_page_has_the_rows(void **state)
{
    (void)state;
    proof_page("Estimators agree");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_and_material_sampling),
        cmocka_unit_test(roulette_on_and_off),
        cmocka_unit_test(independent_samples),
        cmocka_unit_test(photons),
        cmocka_unit_test(progressive_passes),
        cmocka_unit_test(bidirectional),
        cmocka_unit_test(direct_light),
        cmocka_unit_test(the_page_has_the_rows),
    };
    return cmocka_run_group_tests_name("proof/estimators", tests, render_peer, free_peer);
}
