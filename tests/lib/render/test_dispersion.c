/*
 * test_dispersion.c - glass that disperses light, in whole renders: a prism deviates each
 * wavelength by its angle, white light stays white in an even environment, all modes have the same
 * means, and what cannot be is refused.
 */
#include "support.h"

#include <math.h>
#include <stdio.h>

#include "chance.h"
#include "lib/render/means.h"
#include "sample/responses.h"
#include "scene/scene.h"

static const double pi = 3.14159265358979323846;

enum { seeds = 12 };

/* That renders with different seeds have the means `expected`. */
static void expect_means(const double expected[3], const char *text, rt_render_options options,
                         const char *what)
{
    double sum[3] = {0}, squares[3] = {0};
    for (uint32_t i = 0; i < seeds; i++) {
        double means[3];
        options.seed = 100 + i;
        render_means(means, text, options);
        for (int c = 0; c < 3; c++) {
            sum[c] += means[c] / seeds;
            squares[c] += means[c] * means[c] / seeds;
        }
    }
    for (int c = 0; c < 3; c++) {
        const double variance = fmax(squares[c] - sum[c] * sum[c], 0) / (seeds - 1);
        const double error = sqrt(variance) + 1e-5;
        chance_compare(chance_of_student((sum[c] - expected[c]) / error, seeds - 1),
                       "%s, channel %d: %g for %g", what, c, sum[c], expected[c]);
    }
}

/* ---- A prism ---------------------------------------------------------------------- */

/*
 * A prism of 60 degrees with its apex up, and a beam that meets the middle of its left face. SF11
 * has the terms of the catalogue.
 */
static const double apex = 0.57735, base = -0.288675, middle[2] = {-0.25, 0.144338};
static const double beam = 33.2; /* degrees above the horizontal */

static double sf11(double length)
{
    static const double b[3] = {1.73848403, 0.311168974, 1.17490871},
                        c[3] = {0.0136068604, 0.0615960463, 121.922711};
    double sum = 1;
    for (int i = 0; i < 3; i++)
        sum += b[i] * length * length / (length * length - c[i]);
    return sqrt(sum);
}

/* The part of light that a boundary passes, from the sine and the cosines on both sides. */
static double passed(double n_i, double cos_i, double n_t, double cos_t)
{
    const double s = (n_i * cos_i - n_t * cos_t) / (n_i * cos_i + n_t * cos_t),
                 p = (n_t * cos_i - n_i * cos_t) / (n_t * cos_i + n_i * cos_t);
    return 1 - (s * s + p * p) / 2;
}

/* Where the beam meets the plane x = 5, and what of it the two faces pass, by Snell's law. */
static double prism_height(double n, double *through)
{
    const double first = beam * pi / 180 + pi / 6; /* of incidence, to the normal at -30 degrees */
    const double inside = asin(sin(first) / n), second = pi / 3 - inside;
    const double leaves = asin(n * sin(second)), slope = tan(inside - pi / 6);
    /* The right face is y = apex - sqrt(3) x. */
    const double x = (apex - middle[1] + slope * middle[0]) / (slope + sqrt(3));
    const double y = middle[1] + slope * (x - middle[0]);
    *through = passed(1, cos(first), n, cos(inside)) * passed(n, cos(second), 1, cos(leaves));
    return y + (5 - x) * tan(pi / 6 - leaves);
}

/* What a screen above the place where this wavelength arrives shows: longer ones. */
static void expected_above(double expected[3], double edge)
{
#define CHANNELS(red, green, blue) {red, green, blue},
    static const double rows[RT_KNOTS][3] = {RT_RESPONSES(CHANNELS)};
    double through;
    const double height = prism_height(sf11(edge), &through);
    expected[0] = expected[1] = expected[2] = 0;
    for (int i = 0; i < 33000; i++) {
        const double place = (i + 0.5) * 1e-3;
        const int knot = (int)place;
        if (prism_height(sf11(0.38 + place * 0.01), &through) < height)
            continue;
        for (int c = 0; c < 3; c++)
            expected[c] +=
                1e-7 * through *
                (rows[knot][c] * (knot + 1 - place) + rows[knot + 1][c] * (place - knot));
    }
}

static void a_prism_deviates_each_wavelength_by_its_angle(void **state)
{
    static const double edges[] = {0.4861327, 0.5875618, 0.6562725};
    const double x = cos(beam * pi / 180), y = sin(beam * pi / 180);
    (void)state;
    for (size_t i = 0; i < sizeof edges / sizeof *edges; i++) {
        double expected[3], through;
        char text[1000];
        expected_above(expected, edges[i]);
        snprintf(text, sizeof text,
                 "camera { projection orthographic  width 1e-5  eye %.9g %.9g 0\n"
                 "         look_at %.9g %.9g 0 }\n"
                 "material glass { glass sf11  dispersion true }\n"
                 "material screen { emission 1  two_sided true }\n"
                 "quad { corner -0.5 %.9g 9  edge1 0.5 %.9g 0  edge2 0 0 -18  material glass }\n"
                 "quad { corner 0.5 %.9g -9  edge1 -0.5 %.9g 0  edge2 0 0 18  material glass }\n"
                 "quad { corner -0.5 %.9g -9  edge1 1 0 0  edge2 0 0 18  material glass }\n"
                 "quad { corner 5 %.9g -9  edge1 0 4 0  edge2 0 0 18  material screen }\n",
                 middle[0] - x, middle[1] - y, middle[0], middle[1], base, apex - base, base,
                 apex - base, base, prism_height(sf11(edges[i]), &through));
        expect_means(expected, text, (rt_render_options){.spp = 64, .max_depth = 3}, "a prism");
        expect_means(
            expected, text,
            (rt_render_options){.mode = RT_MODE_VCM, .spp = 64, .max_depth = 3, .radius = 1e-3f},
            "a prism by vcm");
    }
}

/* ---- An even environment ------------------------------------------------------------ */

static void white_stays_white(void **state)
{
    static const char *const glasses[] = {
        "glass sf11  dispersion true", "kt 1  fresnel dielectric  ior 1.6  abbe 8",
        "kt 1  fresnel dielectric  cauchy 1.4 0.03",
        /* Facets scatter on what meets others, by the table of the nearest index. */
        "glass sf66  dispersion true  roughness 0.3"};
    static const double white[3] = {1, 1, 1};
    (void)state;
    for (size_t i = 0; i < sizeof glasses / sizeof *glasses; i++) {
        char text[400];
        snprintf(
            text, sizeof text,
            "camera { eye 0 0 4  look_at 0 0 0  fov 20 }\nmaterial m { %s }\n"
            "light environment { radiance 1 }\nsphere { centre 0 0 0  radius 1  material m }\n",
            glasses[i]);
        if (i < 3)
            expect_means(white, text, (rt_render_options){.spp = 16, .max_depth = 100}, glasses[i]);
        else {
            double means[3];
            render_means(means, text, (rt_render_options){.spp = 256, .max_depth = 100});
            for (int c = 0; c < 3; c++)
                assert_float_equal(means[c], 1, 0.02);
        }
    }
}

/* ---- Modes ------------------------------------------------------------------------ */

/* Smooth and rough glass, and a principled ball, in a room that their rainbows colour. */
static const char room[] =
    "camera { eye 0 0.1 1.9  look_at 0 -0.1 0  fov 50 }\n"
    "material wall { kd 0.7 0.6 0.4 }\n"
    "material ball { kt 1  fresnel dielectric  ior 1.5  abbe 6 }\n"
    "material frost { kt 0.8  kd 0.1  fresnel dielectric  ior 1.4  abbe 8  roughness 0.3 }\n"
    "material plum { base_color 0.8 0.6 0.9  spec_trans 0.6  ior 1.4  abbe 10  roughness 0.4 }\n"
    "material lamp { emission 5 4 3 }\nbox { centre 0 0 0  size 2 2 4  material wall }\n"
    "sphere { centre 0.4 -0.5 -0.2  radius 0.4  material ball }\n"
    "sphere { centre -0.4 -0.5 0.2  radius 0.3  material frost }\n"
    "sphere { centre 0 0.4 -0.6  radius 0.3  material plum }\n"
    "quad { corner -0.4 0.95 -0.4  edge1 0.8 0 0  edge2 0 0 0.8  material lamp }\n";

static void modes_agree_in_a_room(void **state)
{
    (void)state;
    expect_modes_agree(room);
}

/* In a scene with media that scatter, which has programs of its own. */
static void media_are_known(void **state)
{
    static const char text[] =
        "camera { eye 0 0 4  look_at 0 0 0  fov 20 }\n"
        "material m { kt 1  fresnel dielectric  ior 1.5  abbe 10  scattering 0.5 }\n"
        "light environment { radiance 1 }\nsphere { centre 0 0 0  radius 1  material m }\n";
    static const double white[3] = {1, 1, 1};
    (void)state;
    expect_means(white, text, (rt_render_options){.spp = 16, .max_depth = 400}, "in a medium");
}

/* The lines of Fraunhofer: (n_d - 1) / (n_F - n_C) is the Abbe number, and n_d the index. */
static void abbe_numbers_are_those_of_the_lines(void **state)
{
    rt_scene *scene = NULL;
    rt_error error;
    const rt_material glass = {.kt = {1, 1, 1}, .ior = 1.62f, .abbe = 36.4f};
    (void)state;
    expect_ok(rt_scene_create(&scene, &error), &error);
    expect_ok(rt_scene_add_material(scene, NULL, "m", &glass, &error), &error);
    const rt_material *m = scene->materials;
    const double spread = rt_material_ior_at(m, 0.4861327) - rt_material_ior_at(m, 0.6562725);
    assert_float_equal(rt_material_ior_at(m, 0.5875618), 1.62, 1e-5);
    assert_float_equal(0.62 / spread, 36.4, 0.01);
    rt_scene_destroy(scene);
}

/* ---- What cannot be --------------------------------------------------------------- */

static void expect_refused(const rt_material *material, const char *field)
{
    rt_scene *scene = NULL;
    rt_error error;
    expect_ok(rt_scene_create(&scene, &error), &error);
    assert_int_equal(rt_scene_add_material(scene, NULL, "m", material, &error), RT_ERROR_INPUT);
    assert_string_equal(error.field, field);
    rt_scene_destroy(scene);
}

static void wrong_dispersion_is_refused(void **state)
{
    (void)state;
    expect_refused(&(rt_material){.kt = {1, 1, 1}, .abbe = -3}, "abbe");
    expect_refused(&(rt_material){.kt = {1, 1, 1}, .abbe = NAN}, "abbe");
    expect_refused(&(rt_material){.kt = {1, 1, 1}, .ior = 1.5f, .cauchy = {1.5f, 0.004f}},
                   "cauchy");
    expect_refused(&(rt_material){.kt = {1, 1, 1}, .cauchy = {1.5f, NAN}}, "cauchy");
    expect_refused(&(rt_material){.kt = {1, 1, 1}, .cauchy = {0.5f, -0.2f}}, "cauchy");
    expect_refused(
        &(rt_material){.kt = {1, 1, 1}, .sellmeier_b = {1, 0, 0}, .sellmeier_c = {0.3f, 0, 0}},
        "sellmeier_b");
    expect_refused(&(rt_material){.kt = {1, 1, 1}, .cauchy = {1.5f, 0.004f}, .abbe = 30}, "cauchy");
    expect_refused(&(rt_material){.glass = RT_GLASS_BK7, .abbe = 30}, "abbe");
    expect_refused(&(rt_material){.kt = {1, 1, 1}, .dispersion = 1}, "dispersion");
    expect_refused(&(rt_material){.glass = RT_GLASS_ETHANOL, .dispersion = 1}, "dispersion");
    expect_refused(&(rt_material){.interface = 1, .abbe = 30}, "abbe");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(a_prism_deviates_each_wavelength_by_its_angle),
        statistical_test(white_stays_white),
        statistical_test(modes_agree_in_a_room),
        statistical_test(media_are_known),
        cmocka_unit_test(abbe_numbers_are_those_of_the_lines),
        cmocka_unit_test(wrong_dispersion_is_refused),
    };
    return cmocka_run_group_tests_name("lib/render/dispersion", tests, NULL, NULL);
}
