/*
 * test_principled.c - principled materials in whole renders: paths, photons, vertex connection and
 * merging agree in a room, photons are gathered with sheen, and specular is an index.
 */
#include "support.h"

#include <math.h>

#include "kernels/statistics.h"
#include "lib/render/means.h"

/* ---- A room ---------------------------------------------------------------------------- */

/* A metal with a clearcoat, a glass half opaque, and a sheet of both kinds of light. */
static const char room[] =
    "camera { eye 0 0.1 1.9  look_at 0 -0.1 0  fov 50 }\n"
    "material wall { base_color 0.7 0.6 0.4  roughness 0.8  sheen 0.6  sheen_tint 0.5 }\n"
    "material paint { base_color 0.8 0.3 0.1  metallic 0.6  roughness 0.6  clearcoat 1 }\n"
    "material glass { base_color 0.6 0.8 0.9  spec_trans 0.7  roughness 0.6 }\n"
    "material leaf { base_color 0.5 0.8 0.3  thin true  diff_trans 1  spec_trans 0.4\n"
    "    roughness 0.7 }\n"
    "material lamp { emission 5 }\n"
    "box { centre 0 0 0  size 2 2 4  material wall }\n"
    "sphere { centre 0.4 -0.6 -0.2  radius 0.39  material paint }\n"
    "sphere { centre -0.45 -0.6 0  radius 0.39  material glass }\n"
    "quad { corner -0.6 0.3 -0.3  edge1 1.2 0 0  edge2 0 0.1 0.8  material leaf }\n"
    "quad { corner -0.4 0.95 -0.4  edge1 0.8 0 0  edge2 0 0 0.8  material lamp }\n";

static void modes_agree_in_a_room(void **state)
{
    (void)state;
    expect_modes_agree(room);
}

/* ---- A floor ------------------------------------------------------------------------------ */

/* Lit by a spot from behind at a low angle, so that most of what is seen is sheen. */
#define FLOOR(fields)                                                                              \
    "camera { eye 0 0.5 2  look_at 0 0 0  fov 2 }\nmaterial m { roughness 0.9 " fields " }\n"      \
    "quad { corner -9 0 -9  edge1 0 0 18  edge2 18 0 0  material m }\n"                            \
    "light spot { position 0 0.8 -3  target 0 0 0  intensity 10  inner 9  outer 10 }\n"

static void expect_photons(const char *text)
{
    double by_paths[3], means[3];
    render_means(by_paths, text, (rt_render_options){.spp = 64, .max_depth = 2});
    render_means(means, text,
                 (rt_render_options){.mode = RT_MODE_PHOTON,
                                     .spp = 4,
                                     .photons = 400000,
                                     .k = 200,
                                     .direct = RT_DIRECT_PHOTONS,
                                     .max_depth = 8});
    for (int c = 0; c < 3; c++)
        expect_close(means[c], by_paths[c], 0.05 * by_paths[c], "by photons");
}

static void photons_are_gathered_with_sheen(void **state)
{
    (void)state;
    expect_photons(FLOOR("base_color 0.1 0.05 0.02  sheen 1  sheen_tint 0.5  ior 1"));
    expect_photons(FLOOR("base_color 0.6 0.3 0.9  flatness 1  ior 1"));
}

static void specular_stands_for_an_index(void **state)
{
    double by_number[3], by_index[3];
    (void)state;
    render_means(by_number, FLOOR("base_color 0.5  specular 0.2"), (rt_render_options){.spp = 4});
    render_means(by_index, FLOOR("base_color 0.5  ior 1.28961607"), (rt_render_options){.spp = 4});
    for (int c = 0; c < 3; c++)
        assert_float_equal(by_number[c], by_index[c], 1e-5 * by_index[c]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(modes_agree_in_a_room),
        statistical_test(photons_are_gathered_with_sheen),
        cmocka_unit_test(specular_stands_for_an_index),
    };
    return cmocka_run_group_tests_name("lib/render/principled", tests, NULL, NULL);
}
