/*
 * test_media.c - integrating spheres filled with media.
 *
 * In a sphere of radius R a wall element dA gives every other one the same part dA / (4 pi R^2) of
 * its light, over chords d whose density is so d / (2 R^2). A medium that absorbs lets through
 *
 *   t = integral from 0 to 2 R of exp(-sigma d) d / (2 R^2) = (1 - (1 + 2 sigma R) exp(-2 sigma R))
 *                                                             / (2 sigma^2 R^2)
 *
 * of it, so that the irradiance is E0 (1 + a t + (a t)^2 + ...), with E0 that from the light in the
 * centre. A medium that only scatters takes nothing away: the wall absorbs all power P in the end,
 * (1 - a) 4 pi R^2 E = P, and where the wall emits L, the radiance is L / (1 - a) everywhere.
 */
#include <math.h>

#include "proof/proof.h"

static const double pi = 3.14159265358979323846;

static const rt_render_options path = {.width = 8, .height = 8, .spp = 8, .max_depth = 1000};
static const rt_render_options map = {.width = 8,
                                      .height = 8,
                                      .spp = 4,
                                      .mode = RT_MODE_PHOTON,
                                      .max_depth = 400,
                                      .direct = RT_DIRECT_PHOTONS,
                                      .photons = 4000,
                                      .k = RT_K_ALL,
                                      .radius = 0.2f};

#define SPHERE                                                                                     \
    "material wall { kd 0.2 0.5 0.8 }\nsphere { centre 0 0 0  radius 1  material wall }\n"         \
    "light point { position 0 0 0  power 7 }\n"
#define LOOKING_UP(height)                                                                         \
    "camera { projection orthographic  eye 0 " height " 0  look_at 0 1 0  up 0 0 1  width 0.01 "   \
    "}\n"

static const double albedo[3] = {0.2, 0.5, 0.8};

/* What the three channels of a film should be. */
static void expect_channels(const char *scene, const char *by, const char *formula,
                            const double expected[3], const char *text,
                            const rt_render_options *options)
{
    proof_films films;
    proof_render(&films, text, options);
    for (int c = 0; c < 3; c++) {
        proof_values values = proof_mean(&films, c);
        proof_check((proof_row){proof_text("%s, albedo %g", scene, albedo[c]), by, formula},
                    expected[c], &values);
    }
    proof_free(&films);
}

/* The camera looks at the wall from the centre, through 1 m of the medium. */
static void an_integrating_sphere_absorbs(void **state)
{
    static const double sigma[3] = {0.3, 0.8, 2};
    static const char scene[] = "integrating sphere, absorbing",
                      formula[] = "a/pi E0 exp(-sigma R)/(1 - a t)",
                      text[] = SPHERE LOOKING_UP("0") "medium { absorption 0.3 0.8 2 }\n";
    double expected[3];
    (void)state;
    for (int c = 0; c < 3; c++) {
        const double s = sigma[c], t = (1 - (1 + 2 * s) * exp(-2 * s)) / (2 * s * s);
        const double straight = 7 / (4 * pi) * exp(-s);
        expected[c] = albedo[c] / pi * straight * exp(-s) / (1 - albedo[c] * t);
    }
    expect_channels(scene, "path", formula, expected, text, &path);
    expect_channels(scene, "photons", formula, expected, text, &map);
}

/*
 * Through a tenth of a millimetre of the medium. The light is in a bubble without it: close to
 * the light, light sampling from segments has a variance that is infinite, if barely.
 */
static void an_integrating_sphere_scatters(void **state)
{
    static const char scene[] = "integrating sphere, scattering", formula[] = "a/pi P/(1 - a)/4 pi",
                      text[] = SPHERE LOOKING_UP(
                          "0.9999") "medium { scattering 0.5 1.5 1  g 0.4 }\n"
                                    "material nothing { interface true }\n"
                                    "sphere { centre 0 0 0  radius 0.4  material nothing }\n";
    double expected[3];
    (void)state;
    for (int c = 0; c < 3; c++)
        expected[c] = albedo[c] / pi * 7 / (4 * pi) / (1 - albedo[c]);
    expect_channels(scene, "path", formula, expected, text, &path);
    expect_channels(scene, "photons", formula, expected, text, &map);
}

static void a_furnace_scatters(void **state)
{
    static const char text[] = "camera { eye 0.3 0.2 -0.1  look_at -0.2 0.1 1  fov 90 }\n"
                               "material wall { emission 0.6  two_sided true  kd 0.7 }\n"
                               "sphere { centre 0 0 0  radius 1  material wall }\n"
                               "medium { scattering 0.5 1.5 1  g 0.4 }\n";
    (void)state;
    proof_radiance((proof_row){"emissive sphere, diffuse, scattering", "path", "L / (1 - a)"}, 2,
                   text, &path);
}

static void the_page_has_the_rows(void **state)
{
    (void)state;
    proof_page("Media");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_integrating_sphere_absorbs),
        cmocka_unit_test(an_integrating_sphere_scatters),
        cmocka_unit_test(a_furnace_scatters),
        cmocka_unit_test(the_page_has_the_rows),
    };
    return cmocka_run_group_tests_name("proof/media", tests, NULL, NULL);
}
