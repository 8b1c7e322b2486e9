/*
 * test_facet_scattering.c - light that meets more than one facet, in whole renders: a white furnace
 * stays white, photons are gathered by it, modes agree, and a word turns it off.
 */
#include "support.h"

#include <math.h>
#include <stdio.h>

#include "kernels/statistics.h"
#include "lib/render/means.h"
#include "pack/facet_loss.h"

/* ---- A white furnace --------------------------------------------------------------- */

#define FURNACE(material)                                                                          \
    "camera { eye 0 0 -3  look_at 0 0 0  fov 20 }\nlight environment { radiance 1 }\n"             \
    "material m { " material " }\nsphere { centre 0 0 0  radius 0.8  material m }\n"

static void white_disappears_in_a_white_furnace(void **state)
{
    static const char *const balls[] = {
        FURNACE("ks 1  roughness 0.7"),
        FURNACE("ks 1  roughness 0.2  roughness_v 0.6"),
        FURNACE("kt 1  fresnel dielectric  roughness 0.5"),
    };
    double means[3];
    (void)state;
    for (int i = 0; i < 3; i++) {
        render_means(means, balls[i], (rt_render_options){.spp = 128, .max_depth = 100});
        expect_close(means[0], 1, 5e-3, "by paths");
        render_means(means, balls[i],
                     (rt_render_options){.mode = RT_MODE_VCM, .spp = 64, .max_depth = 100});
        expect_close(means[0], 1, 1e-2, "by vertex connection and merging");
    }
}

/* ---- A word ------------------------------------------------------------------------ */

static void single_loses_what_meets_two_facets(void **state)
{
    double means[3];
    (void)state;
    render_means(means, FURNACE("ks 1  roughness 1  facet_scattering single"),
                 (rt_render_options){.spp = 64});
    /* 1 - ln 2 at its middle, 0.41 on average over all views. */
    expect_close(means[0], 0.36, 0.05, "a ball of which two thirds are lost");
}

/* A plate that is met at these cosines loses more, as the host's integral has it. */
static void separable_loses_more_at_grazing_angles(void **state)
{
    static const double cosines[] = {0.8, 0.1};
    (void)state;
    for (int i = 0; i < 2; i++) {
        const rt_facets same = {0.5, 0.5, 0, 0, 0}, separable = {0.5, 0.5, 0, 0, 1};
        const double kept = rt_facet_reflected(&separable, cosines[i]);
        double means[3];
        char text[512];
        snprintf(text, sizeof text,
                 "camera { eye 0 %.9g %.9g  look_at 0 0 0  fov 0.5 }\n"
                 "light environment { radiance 1 }\n"
                 "material m { ks 1  roughness 0.5  facet_scattering separable }\n"
                 "quad { corner -9 0 -9  edge1 0 0 18  edge2 18 0 0  material m }\n",
                 cosines[i], sqrt(1 - cosines[i] * cosines[i]));
        assert_true(kept < rt_facet_reflected(&same, cosines[i]) - (i ? 0.03 : 0.001));
        render_means(means, text, (rt_render_options){.spp = 256});
        expect_close(means[0], kept, 5e-3, "by paths");
        render_means(means, text, (rt_render_options){.mode = RT_MODE_VCM, .spp = 256});
        expect_close(means[0], kept, 5e-3, "by vertex connection and merging");
    }
}

static void words_and_numbers_are_checked(void **state)
{
    rt_scene *scene;
    rt_error error;
    (void)state;
    expect_ok(rt_scene_create(&scene, &error), &error);
    const rt_material m = {.ks = {1, 1, 1}, .facet_scattering = (rt_facet_scattering)3};
    assert_int_equal(rt_scene_add_material(scene, NULL, NULL, &m, &error), RT_ERROR_INPUT);
    assert_string_equal(error.field, "facet_scattering");
    rt_scene_destroy(scene);
}

/* ---- A room -------------------------------------------------------------------------- */

/* A white rough metal, a coloured one, and rough glass, around a small light. */
static const char room[] =
    "camera { eye 0 0.1 1.9  look_at 0 -0.1 0  fov 50 }\n"
    "material wall { kd 0.7 0.6 0.4 }\nmaterial metal { ks 1  roughness 0.6 }\n"
    "material gold { metal gold  roughness 0.5  distribution beckmann }\n"
    "material frost { kt 1  fresnel dielectric  ior 1.5  roughness 0.6 }\n"
    "material lamp { emission 5 }\nbox { centre 0 0 0  size 2 2 4  material wall }\n"
    "sphere { centre 0.4 -0.5 -0.2  radius 0.4  material metal }\n"
    "sphere { centre -0.4 -0.5 0.2  radius 0.3  material frost }\n"
    "quad { corner -0.9 -0.7 -0.9  edge1 1.8 0 0  edge2 0 1.2 0  material gold }\n"
    "quad { corner -0.4 0.95 -0.4  edge1 0.8 0 0  edge2 0 0 0.8  material lamp }\n";

static void modes_agree_in_a_room(void **state)
{
    (void)state;
    expect_modes_agree(room);
}

/* A plate, seen where it is lit by a lamp aside. */
static const char plate[] =
    "camera { eye 0 2 2  look_at 0 0 0  fov 16 }\n"
    "material rough { ks 1  roughness 0.8 }\nmaterial lamp { emission 5 }\n"
    "quad { corner -1 0 -1  edge1 0 0 2  edge2 2 0 0  material rough }\n"
    "quad { corner 0.2 1 -1.6  edge1 0.8 0 0  edge2 0 0 0.8  material lamp }\n";

static void photons_are_gathered_by_it(void **state)
{
    (void)state;
    expect_gathered_means(plate);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(white_disappears_in_a_white_furnace),
        statistical_test(single_loses_what_meets_two_facets),
        statistical_test(separable_loses_more_at_grazing_angles),
        cmocka_unit_test(words_and_numbers_are_checked),
        statistical_test(modes_agree_in_a_room),
        statistical_test(photons_are_gathered_by_it),
    };
    return cmocka_run_group_tests_name("lib/render/facet_scattering", tests, NULL, NULL);
}
