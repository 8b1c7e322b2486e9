/*
 * test_gather_roughness.c - photons gathered by rough reflection: mode photon has the mean of mode
 * path, and maps say from which roughness on they hold photons.
 *
 * The light of each scene is the same all over the floor, so that gathering from a disc blurs
 * nothing. The pixels of a render share photons: a render is one value, its mean, and of the
 * differences of RENDERS pairs of renders Student's t is tested.
 */
#include "support.h"

#include <math.h>
#include <string.h>

#include "chance.h"
#include "photon/map_file.h"

enum { RENDERS = 10, SIDE = 4, PIXELS = SIDE * SIDE };

/* ---- Scenes -------------------------------------------------------------------------- */

#define CAMERA                                                                                     \
    "camera { projection orthographic  width 0.08  eye 0.03 0.05 0.02  look_at 0 0 0  up 0 0 1 "   \
    "}\n"
#define FLOOR "quad { corner -1 0 1  edge1 2 0 0  edge2 0 0 -2  material metal }\n"
#define METAL(roughness)                                                                           \
    "material metal { kd 0.1  ks 0.9  fresnel conductor  eta 0.44 0.53 1.09  k 3.7 2.77 1.83  "    \
    "roughness " roughness " }\n"
#define SKY "light environment { radiance 1 }\n"

/* In water the floor reflects a third as much: its index is relative to that of the water. */
#define POOL                                                                                       \
    CAMERA SKY                                                                                     \
        "material metal { ks 0.9  fresnel conductor  eta 1.6  k 0.1  roughness 0.3 }\n" FLOOR      \
        "material water { kt 1  fresnel dielectric  ior 1.33 }\n"                                  \
        "plane { point 0 0.1 0  normal 0 1 0  material water }\n"
/* A ball of fog, out of sight, has the kernels for media render. */
#define FOG                                                                                        \
    "material fog { interface true  scattering 0.1 }\n"                                            \
    "sphere { centre 0 -0.3 0  radius 0.1  material fog }\n"

/* ---- Means --------------------------------------------------------------------------- */

typedef struct means {
    double of[RENDERS][3];
} means;

static means render(const char *text, rt_render_options options)
{
    rt_renderer *renderer = test_renderer(text);
    means m = {{{0}}};
    options.width = options.height = SIDE;
    options.max_depth = 40;
    for (uint32_t i = 0; i < RENDERS; i++) {
        rt_film *film = NULL;
        rt_error error;
        options.seed = test_seed(100 * (uint32_t)options.mode + i);
        expect_ok(rt_render(&film, renderer, &options, &error), &error);
        for (int p = 0; p < PIXELS; p++)
            for (int c = 0; c < 3; c++)
                m.of[i][c] += rt_film_rgb(film)[3 * p + c] / (double)PIXELS;
        rt_film_destroy(film);
    }
    rt_renderer_destroy(renderer);
    return m;
}

static void compare(const means *photons, const means *paths, const char *name)
{
    for (int c = 0; c < 3; c++) {
        double mean = 0, square = 0, all = 0;
        for (int i = 0; i < RENDERS; i++) {
            mean += (photons->of[i][c] - paths->of[i][c]) / RENDERS;
            all += paths->of[i][c] / RENDERS;
        }
        for (int i = 0; i < RENDERS; i++)
            square += pow(photons->of[i][c] - paths->of[i][c] - mean, 2);
        const double error =
            sqrt(square / (RENDERS * (RENDERS - 1))) + 1e-6 * all; /* single precision */
        print_message("%s, channel %d: %.5f, off by %+.4f of it, %+.2f standard errors\n", name, c,
                      all, mean / all, mean / error);
        chance_compare(chance_of_student(mean / error, RENDERS - 1), "%s, channel %d", name, c);
    }
}

static const rt_render_options path = {.spp = 32};
static const rt_render_options photon = {.mode = RT_MODE_PHOTON,
                                         .spp = 16,
                                         .photons = 20000,
                                         .k = RT_K_ALL,
                                         .radius = 0.3f,
                                         .gather_roughness = 0.3f};

static rt_render_options gathered(rt_direct direct, uint32_t final_gather, uint64_t caustics)
{
    rt_render_options options = photon;
    options.direct = direct;
    options.final_gather = final_gather;
    options.caustic_photons = caustics;
    options.caustic_k = RT_K_ALL;
    options.caustic_radius = 0.3f;
    return options;
}

/* ---- Tests --------------------------------------------------------------------------- */

/* A directional light gives fr by itself: photons all come from one direction. */
static void a_directional_light(void **state)
{
    static const char *const texts[] = {
        CAMERA METAL("0.3") FLOOR "light directional { direction 1 -2 0.3  irradiance 3 }\n",
        CAMERA METAL("0.6") FLOOR "light directional { direction 1 -2 0.3  irradiance 3 }\n",
        CAMERA "material metal { kd 0.1  ks 0.9  exponent 15 }\n" FLOOR
               "light directional { direction 1 -2 0.3  irradiance 3 }\n"};
    static const char *const names[] = {"directional light", "directional light, roughness 0.6",
                                        "directional light, Phong"};
    (void)state;
    for (int i = 0; i < 3; i++) {
        const means paths = render(texts[i], path);
        means photons = render(texts[i], gathered(RT_DIRECT_PHOTONS, 0, 0));
        compare(&photons, &paths, names[i]);
        rt_render_options on_host = gathered(RT_DIRECT_PHOTONS, 0, 0);
        on_host.gather = RT_GATHER_FLANN;
        on_host.k = on_host.caustic_k = 500;
        photons = render(texts[i], on_host);
        compare(&photons, &paths, "directional light, neighbours from the host");
    }
}

static void a_uniform_sky(void **state)
{
    static const char *const texts[] = {CAMERA SKY METAL("0.3") FLOOR,
                                        CAMERA SKY METAL("0.3") FLOOR FOG};
    (void)state;
    for (int i = 0; i < 2; i++) {
        const char *const name = i ? "sky, scene with media" : "sky";
        const means paths = render(texts[i], path);
        means photons = render(texts[i], gathered(RT_DIRECT_PHOTONS, 0, 0));
        compare(&photons, &paths, name);
        photons = render(texts[i], gathered(RT_DIRECT_NEE, 0, 0));
        compare(&photons, &paths, name);
        photons = render(texts[i], gathered(RT_DIRECT_PHOTONS, 1, 0));
        compare(&photons, &paths, name);
    }
}

/* All light is a caustic: camera paths find the sky through the surface of the water alone. */
static void under_water(void **state)
{
    const means paths = render(POOL, path);
    (void)state;
    for (uint32_t bounces = 0; bounces <= 1; bounces++)
        for (uint64_t caustics = 0; caustics <= 10000; caustics += 10000) {
            const means photons = render(POOL, gathered(RT_DIRECT_NEE, bounces, caustics));
            compare(&photons, &paths, bounces ? "pool, final gather" : "pool");
        }
}

/* Below the threshold, and where light is refracted, no photon is stored. */
static uint64_t stored(const char *text, float least)
{
    rt_renderer *renderer = test_renderer(text);
    rt_render_options options = gathered(RT_DIRECT_PHOTONS, 0, 0);
    options.gather_roughness = least;
    options.photons = 100;
    const rt_emit_options emit = {.render = &options};
    rt_photon_map *map = NULL;
    rt_error error;
    expect_ok(rt_photon_map_emit(&map, renderer, &emit, &error), &error);
    const uint64_t count = rt_photon_map_count(map, RT_PHOTONS_GLOBAL);
    rt_photon_map_destroy(map);
    rt_renderer_destroy(renderer);
    return count;
}

static void photons_lie_on_rough_reflectors_alone(void **state)
{
#define LIT(material) "light directional { direction 1 -2 0.3  irradiance 3 }\n" material FLOOR
    static const char metal[] = LIT("material metal { ks 0.9  roughness 0.3 }\n"),
                      frosted[] = LIT("material metal { ks 0.4  kt 0.4  roughness 0.3 }\n"),
                      glass[] = LIT("material metal { kt 0.8  fresnel dielectric  ior 1.5  "
                                    "roughness 0.3 }\n");
    static const char fog[] = LIT("material metal { ks 0.9  roughness 0.3 }\n" FOG);
    static const char phong[] = LIT("material metal { ks 0.9  exponent 20 }\n");
    (void)state;
    assert_true(stored(phong, 0.3f) > 50); /* as rough as 0.3015 */
    assert_int_equal(stored(phong, 0.302f), 0);
    assert_true(stored(metal, 0.3f) > 50);
    assert_true(stored(fog, 0.3f) > 50);
    assert_int_equal(stored(metal, 0.31f), 0);
    assert_int_equal(stored(metal, 0), 0);
    assert_int_equal(stored(frosted, 0.3f), 0);
    assert_int_equal(stored(glass, 0.3f), 0);
}

/* A map says how it was emitted, and is not taken, joined or continued otherwise. */
static void maps_know_the_setting(void **state)
{
    rt_renderer *renderer = test_renderer(CAMERA SKY METAL("0.3") FLOOR);
    rt_render_options options = gathered(RT_DIRECT_PHOTONS, 0, 0);
    options.width = options.height = SIDE;
    options.photons = 100;
    const rt_emit_options emit = {.render = &options};
    rt_photon_map *maps[2] = {NULL, NULL}, *read = NULL, *merged = NULL;
    rt_photon_map_info info;
    rt_film *film = NULL;
    rt_bytes bytes = {0};
    rt_error error;
    (void)state;
    expect_ok(rt_photon_map_emit(&maps[0], renderer, &emit, &error), &error);
    expect_ok(rt_photon_map_encode_in(&bytes, maps[0], &error), &error);
    expect_ok(rt_photon_map_decode_in(&read, bytes.data, bytes.size, "map", NULL, &error), &error);
    rt_photon_map_get_info(read, &info);
    assert_true(info.gather_roughness == 0.3f);

    options.gather_roughness = 0.5f;
    options.photon_map = read;
    assert_int_equal(rt_render(&film, renderer, &options, &error), RT_ERROR_USAGE);
    assert_string_equal(error.field, "gather_roughness");
    assert_non_null(strstr(error.message, "emitted with gather_roughness 0.3, and here it is 0.5"));
    options.photon_map = NULL;
    options.seed = 7;
    expect_ok(rt_photon_map_emit(&maps[1], renderer, &emit, &error), &error);
    assert_int_equal(rt_photon_map_merge(&merged, (const rt_photon_map *const *)maps, 2, &error),
                     RT_ERROR_INPUT);
    assert_non_null(strstr(error.message, "gather_roughness of 0.3 and of 0.5"));
    assert_int_equal(rt_photon_map_covers(maps[1], maps[0], &error), RT_ERROR_USAGE);
    assert_string_equal(error.field, "gather_roughness");

    options = gathered(RT_DIRECT_NEE, 1, 0);
    options.k = 50;
    options.irradiance_step = 4;
    assert_int_equal(rt_render(&film, renderer, &options, &error), RT_ERROR_USAGE);
    assert_string_equal(error.field, "irradiance_step");
    rt_bytes_free(&bytes);
    rt_photon_map_destroy(maps[0]);
    rt_photon_map_destroy(maps[1]);
    rt_photon_map_destroy(read);
    rt_renderer_destroy(renderer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(a_directional_light),
        statistical_test(a_uniform_sky),
        statistical_test(under_water),
        cmocka_unit_test(photons_lie_on_rough_reflectors_alone),
        cmocka_unit_test(maps_know_the_setting),
    };
    return cmocka_run_group_tests_name("lib/mode/gather_roughness", tests, NULL, NULL);
}
