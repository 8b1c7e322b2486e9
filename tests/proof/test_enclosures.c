/*
 * test_enclosures.c - interreflection in closed spheres and boxes, and bodies under a uniform sky.
 *
 * In a sphere of radius r and albedo a, every point gets the same light from every other: a light
 * of power P that illuminates the wall evenly gives the irradiance
 * P / (4 pi r^2) (1 + a + a^2 + ...) (Ulbricht's integrating sphere). Where walls both emit L and
 * reflect a, the radiance is L / (1 - a) everywhere, whatever the shape (the white furnace).
 */
#include <math.h>

#include "proof/optics.h"
#include "proof/proof.h"

static const double pi = 3.14159265358979323846;

static const rt_render_options path = {.width = 8, .height = 8, .spp = 16, .max_depth = 64};
static const rt_render_options map = {.width = 8,
                                      .height = 8,
                                      .spp = 4,
                                      .mode = RT_MODE_PHOTON,
                                      .max_depth = 40,
                                      .direct = RT_DIRECT_PHOTONS,
                                      .photons = 10000,
                                      .k = RT_K_ALL,
                                      .radius = 0.2f};

/* ---- The integrating sphere ----------------------------------------------------------- */

#define INSIDE "camera { eye 0.3 0.2 -0.1  look_at -0.2 0.1 1  fov 90 }\n"
#define ULBRICHT                                                                                   \
    "material wall { kd 0.2 0.5 0.8 }\nsphere { centre 0 0 0  radius 1  material wall }\n"

static const double albedo[3] = {0.2, 0.5, 0.8};

/* Radiance of light that was reflected up to `most` times, by 7 W. */
static double reflected(double a, int most)
{
    return 7 / (4 * pi) / pi * a * (1 - pow(a, most)) / (1 - a);
}

/* What the camera sees of the sphere, in three channels. */
static void expect_sphere(const char *by, const rt_render_options *options)
{
    proof_films films;
    proof_render(&films, INSIDE ULBRICHT "light point { position 0 0 0  power 7 }", options);
    for (int c = 0; c < 3; c++) {
        proof_values values = proof_mean(&films, c);
        proof_check((proof_row){proof_text("integrating sphere of albedo %g", albedo[c]), by,
                                proof_text("a (1 + a + ... + a^%d) P/(2 pi r)^2/pi",
                                           (int)options->max_depth - 2)},
                    reflected(albedo[c], (int)options->max_depth - 1), &values);
    }
    proof_free(&films);
}

static void integrating_spheres(void **state)
{
    rt_render_options nee = map, gathered = map, irradiance;
    (void)state;
    nee.direct = gathered.direct = RT_DIRECT_NEE;
    gathered.final_gather = 1;
    irradiance = gathered;
    irradiance.irradiance_step = 3;
    expect_sphere("path", &path);
    expect_sphere("photons", &map);
    expect_sphere("photons and shadow rays", &nee);
    expect_sphere("photons, final gather", &gathered);
    expect_sphere("photons, irradiance", &irradiance);
}

/* The bias of merging falls as the square of the radius, which is small here. */
static void from_both_ends(void **state)
{
    static const struct {
        const char *by;
        rt_techniques techniques;
    } cases[] = {{"vcm", RT_TECHNIQUES_VCM},
                 {"techniques bpt", RT_TECHNIQUES_BPT},
                 {"techniques bpm", RT_TECHNIQUES_BPM},
                 {"vcm, light tracing alone", RT_TECHNIQUES_CAMERA},
                 {"vcm, merging alone", RT_TECHNIQUES_MERGING}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        expect_sphere(cases[i].by, &(rt_render_options){.width = 16,
                                                        .height = 16,
                                                        .spp = 16,
                                                        .mode = RT_MODE_VCM,
                                                        .max_depth = 40,
                                                        .seed = 100,
                                                        .radius = 0.05f,
                                                        .alpha = 0.99f,
                                                        .techniques = cases[i].techniques});
}

static void depth_by_depth(void **state)
{
    (void)state;
    for (uint32_t depth = 2; depth <= 5; depth++) {
        rt_render_options by_path = path, by_map = map;
        by_path.max_depth = by_map.max_depth = depth;
        expect_sphere("path", &by_path);
        expect_sphere("photons", &by_map);
    }
}

/* Reflected light is uniform, wherever the light is. A small part of the wall is seen. */
static void off_centre(void **state)
{
    static const char text[] = ULBRICHT
        "light point { position 0.4 0 0  power 7 }\n"
        "camera { projection orthographic  eye 0 0 0  look_at 0 1 0  up 0 0 1  width 0.01 }\n";
    double d2 = 1 + 0.4 * 0.4, straight = 7 / (4 * pi) / (d2 * sqrt(d2)) * 0.5 / pi;
    (void)state;
    proof_radiance((proof_row){"integrating sphere, off centre", "path",
                               "direct + a^2/(1 - a) P/(2 pi r)^2/pi"},
                   straight + 0.5 * reflected(0.5, 62), text, &path);
    proof_radiance((proof_row){"integrating sphere, off centre", "photons and shadow rays",
                               "direct + a^2/(1 - a) P/(2 pi r)^2/pi"},
                   straight + 0.5 * reflected(0.5, 62), text,
                   &(rt_render_options){.width = 8,
                                        .height = 8,
                                        .spp = 4,
                                        .mode = RT_MODE_PHOTON,
                                        .max_depth = 64,
                                        .photons = 20000,
                                        .k = RT_K_ALL,
                                        .radius = 0.3f});
}

/* ---- The white furnace --------------------------------------------------------------- */

static const char *const estimators[] = {"path", "path, light sampling", "path, BSDF sampling"};

static void closed_furnaces(void **state)
{
    static const struct {
        const char *name, *material;
        double a;
    } walls[] = {
        {"emissive sphere, diffuse", "kd 0.7", 0.7},
        {"emissive sphere, mirror", "ks 0.7", 0.7},
        {"emissive sphere, diffuse and mirror", "kd 0.3  ks 0.4", 0.7},
    };
    (void)state;
    for (size_t i = 0; i < sizeof walls / sizeof *walls; i++) {
        const char *text = proof_text(INSIDE "material wall { emission 0.6  two_sided true  %s }\n"
                                             "sphere { centre 0 0 0  radius 1  material wall }\n",
                                      walls[i].material);
        for (int e = 0; e < 3; e++) {
            rt_render_options options = path;
            options.estimator = (rt_estimator)e;
            proof_radiance((proof_row){walls[i].name, estimators[e], "L / (1 - a)"},
                           0.6 / (1 - walls[i].a), text, &options);
        }
        if (i != 1)
            proof_radiance((proof_row){walls[i].name, "photons", "L / (1 - a)"},
                           0.6 / (1 - walls[i].a), text, &map);
    }
}

#define WALL(corner, edge1, edge2)                                                                 \
    "quad { corner " corner "  edge1 " edge1 "  edge2 " edge2 "  material wall }\n"

/* Estimates at edges would lose photons: paths alone. */
static void box_furnace(void **state)
{
    static const char text[] =
        INSIDE "material wall { emission 0.6  kd 0.7 }\n" WALL("-1 -1 -1", "0 0 3", "2 0 0")
            WALL("-1 1 -1", "2 0 0", "0 0 3") WALL("-1 -1 -1", "0 2 0", "0 0 3")
                WALL("1 -1 -1", "0 0 3", "0 2 0") WALL("-1 -1 -1", "2 0 0", "0 2 0")
                    WALL("-1 -1 2", "0 2 0", "2 0 0");
    (void)state;
    for (int e = 0; e < 3; e++) {
        rt_render_options options = path;
        options.estimator = (rt_estimator)e;
        proof_radiance((proof_row){"emissive box, diffuse", estimators[e], "L / (1 - a)"}, 2, text,
                       &options);
    }
}

/* Every ray from the centre comes back to it, always at right angles to the wall. */
static void metal_furnace(void **state)
{
    (void)state;
    proof_radiance(
        (proof_row){"emissive sphere, metal, seen from its centre", "path", "L / (1 - R(0))"},
        0.6 / (1 - optics_fresnel(1, 0.42 + 2.35 * I)),
        "camera { eye 0 0 0  look_at 0.2 0.1 1  fov 90 }\n"
        "material wall { emission 0.6  two_sided true  ks 1  fresnel conductor  eta 0.42  k 2.35 "
        "}\n"
        "sphere { centre 0 0 0  radius 1  material wall }\n",
        &path);
}

/* ---- Bodies under a uniform sky ------------------------------------------------------------- */

/* A ball fills the view. */
static void balls_in_a_white_furnace(void **state)
{
    static const struct {
        const char *name, *formula, *material;
        double expected;
    } balls[] = {
        {"diffuse ball", "a L", "kd 0.7", 0.7},
        {"mirror ball", "a L", "ks 0.7", 0.7},
        {"diffuse and mirror ball", "a L", "kd 0.3  ks 0.4", 0.7},
        {"ball of the roughest white metal, by its colour", "L",
         "ks 1  fresnel schlick  roughness 1", 1},
        {"ball of clear glass", "L", "kt 1", 1},
        {"ball of glass with Fresnel reflection", "L", "kt 1  fresnel dielectric", 1},
        {"ball of diamond", "L", "kt 1  fresnel dielectric  ior 2.42", 1},
        {"ball of diffuse, mirror and clear parts that lose nothing", "L",
         "kd 0.3  ks 0.3  kt 0.4  ior 1.3", 1},
    };
    rt_render_options options = path;
    (void)state;
    options.max_depth = 1000;
    for (size_t i = 0; i < sizeof balls / sizeof *balls; i++)
        proof_radiance(
            (proof_row){proof_text("%s under a uniform sky", balls[i].name), "path",
                        balls[i].formula},
            balls[i].expected,
            proof_text(
                "camera { eye 0 0 -2  look_at 0 0 0  fov 40 }\nlight environment { radiance 1 }\n"
                "material stuff { %s }\nsphere { centre 0 0 0  radius 1  material stuff }\n",
                balls[i].material),
            &options);
}

/* A plate, seen at an angle. What goes through it is lost in a black plate behind. */
static void plates_in_a_white_furnace(void **state)
{
    static const struct {
        const char *name, *material;
        double alpha, eta, k;
    } plates[] = {
        {"gold (green)", "ks 1  fresnel conductor  eta 0.42  k 2.35", 0, 0.42, 2.35},
        {"glass", "kt 1  fresnel dielectric", 0, 1.5, 0},
        {"rough white metal", "ks 1  roughness 0.5  facet_scattering single", 0.5, 1e-9, 0},
        {"rough gold (green)",
         "ks 1  fresnel conductor  eta 0.42  k 2.35  roughness 0.3  facet_scattering single", 0.3,
         0.42, 2.35},
        {"rough glass", "kt 1  fresnel dielectric  roughness 0.4  facet_scattering single", 0.4,
         1.5, 0},
    };
    static const int degrees[] = {0, 45, 75};
    (void)state;
    for (size_t i = 0; i < sizeof plates / sizeof *plates; i++)
        for (int a = 0; a < 3; a++) {
            double angle = degrees[a] * pi / 180;
            double complex index = plates[i].eta + plates[i].k * I;
            double expected = plates[i].alpha > 0 ? optics_rough(cos(angle), plates[i].alpha, index)
                                                  : optics_fresnel(cos(angle), index);
            proof_radiance(
                (proof_row){proof_text("plate of %s under a uniform sky, from %d degrees",
                                       plates[i].name, degrees[a]),
                            "path", plates[i].alpha > 0 ? "integral of the GGX lobe" : "R L"},
                expected,
                proof_text(
                    "camera { projection orthographic  width 0.1  eye %.9g 0 %.9g  look_at 0 0 0 "
                    "}\n"
                    "light environment { radiance 1 }\nmaterial black { }\nmaterial stuff { %s }\n"
                    "plane { point 0 0 0  normal 0 0 1  material stuff }\n"
                    "plane { point 0 0 -1  normal 0 0 1  material black }\n",
                    sin(angle), cos(angle), plates[i].material),
                &path);
        }
}

static void the_page_has_the_rows(void **state)
{
    (void)state;
    proof_page("Enclosures and white furnaces");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(integrating_spheres),
        cmocka_unit_test(from_both_ends),
        cmocka_unit_test(depth_by_depth),
        cmocka_unit_test(off_centre),
        cmocka_unit_test(closed_furnaces),
        cmocka_unit_test(box_furnace),
        cmocka_unit_test(metal_furnace),
        cmocka_unit_test(balls_in_a_white_furnace),
        cmocka_unit_test(plates_in_a_white_furnace),
        cmocka_unit_test(the_page_has_the_rows),
    };
    return cmocka_run_group_tests_name("proof/enclosures", tests, NULL, NULL);
}
