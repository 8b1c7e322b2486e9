/*
 * test_facet_scattering.c - light that meets more than one facet, in whole renders: a white furnace
 * stays white, photons are gathered by it, modes agree, and a word turns it off.
 */
#include "support.h"

#include "kernels/statistics.h"
#include "lib/render/means.h"

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

static void words_and_numbers_are_checked(void **state)
{
    rt_scene *scene;
    rt_error error;
    (void)state;
    expect_ok(rt_scene_create(&scene, &error), &error);
    const rt_material m = {.ks = {1, 1, 1}, .facet_scattering = (rt_facet_scattering)2};
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
        cmocka_unit_test(words_and_numbers_are_checked),
        statistical_test(modes_agree_in_a_room),
        statistical_test(photons_are_gathered_by_it),
    };
    return cmocka_run_group_tests_name("lib/render/facet_scattering", tests, NULL, NULL);
}
