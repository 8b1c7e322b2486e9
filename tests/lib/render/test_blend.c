/*
 * test_blend.c - blends of materials and materials with a back in whole renders: the mean of a
 * blend is that of its parts, all modes have the same, each side is what it is said to be, and the
 * inside of a blend with glass depends on nothing.
 */
#include "support.h"

#include <stdio.h>

#include "kernels/statistics.h"
#include "lib/render/means.h"

static const rt_render_options by_path = {.spp = 512, .max_depth = 6},
                               by_bpt = {.mode = RT_MODE_VCM,
                                         .techniques = RT_TECHNIQUES_BPT,
                                         .spp = 128,
                                         .max_depth = 6},
                               by_merging = {.mode = RT_MODE_VCM,
                                             .techniques = RT_TECHNIQUES_BPM,
                                             .spp = 64,
                                             .max_depth = 6,
                                             .radius = 0.05f},
                               by_photons = {.mode = RT_MODE_PHOTON,
                                             .spp = 64,
                                             .photons = 100000,
                                             .k = 200,
                                             .max_depth = 6,
                                             .direct = RT_DIRECT_PHOTONS};

static const rt_render_options *const modes[] = {&by_path, &by_bpt, &by_merging, &by_photons};

/* ---- What is met -------------------------------------------------------------------------- */

/* A square below an even sky, seen from its front. */
static void render_square(double means[3], const char *materials, const char *name,
                          const rt_render_options *options)
{
    char text[900];
    snprintf(text, sizeof text,
             "camera { eye 0 0 4  look_at 0 0 0  fov 8 }\n"
             "texture fade { pattern gradient  a 0.1 0.1 0.1  b 0.5 0.5 0.5 }\n%s"
             "quad { corner -2 -2 0  edge1 4 0 0  edge2 0 4 0  material %s }\n"
             "light environment { radiance 1 }\n",
             materials, name);
    render_means(means, text, *options);
}

/* Weights are those of the second part, by numbers, by textures, and within each other. */
static void a_blend_is_the_mean_of_its_parts(void **state)
{
    static const struct {
        const char *blend;
        double albedo;
    } cases[] = {
        {"material m { blend light with dark  weight 0.25 }\n", 0.75 * 0.8 + 0.25 * 0.2},
        {"material m { blend light with dark }\n", 0.5},
        {"material m { blend light with black  weight 0.25 }\n", 0.6},
        {"material m { blend light with dark  weight_texture fade }\n", 0.8 - 0.6 * 0.3},
        {"material m { blend light with dark  weight 0.5  weight_texture fade }\n",
         0.8 - 0.6 * 0.15},
        {"material in { blend light with dark  weight 0.25 }\n"
         "material m { blend in with mirror  weight 0.4 }\n",
         0.6 * (0.75 * 0.8 + 0.25 * 0.2) + 0.4 * 0.9},
        {"material in { kd 0.1  back black }\nmaterial m { blend light with in  weight 0.4 }\n",
         0.6 * 0.8 + 0.4 * 0.1},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char materials[400];
        snprintf(materials, sizeof materials,
                 "material light { kd 0.8 }\nmaterial dark { kd 0.2 }\n"
                 "material mirror { ks 0.9 }\n%s",
                 cases[i].blend);
        for (size_t k = 0; k < sizeof modes / sizeof *modes; k++) {
            double means[3];
            if (i > 2 && k == 2)
                continue;
            render_square(means, materials, "m", modes[k]);
            expect_close(means[1], cases[i].albedo, k < 2 ? 0.008 : 0.02, cases[i].blend);
        }
    }
}

/* The parts of one ray and of its cutouts are chosen apart. */
static void opacity_and_blend_are_independent(void **state)
{
    double means[3];
    (void)state;
    render_square(means,
                  "material light { kd 1 }\n"
                  "material m { blend light with black  weight 0.5  opacity 0.5 }\n",
                  "m", &by_path);
    expect_close(means[1], 0.75, 0.008, "opacity");
}

/* ---- Sides ---------------------------------------------------------------------------------- */

static void each_side_is_its_own(void **state)
{
    static const struct {
        const char *material, *square;
        double albedo;
    } cases[] = {
        {"{ kd 0.8  back dark }", "edge1 4 0 0  edge2 0 4 0", 0.8},
        {"{ kd 0.8  back dark }", "edge1 0 4 0  edge2 4 0 0", 0.2},
        {"{ kd 0.8  back black }", "edge1 0 4 0  edge2 4 0 0", 0},
        {"{ blend dark with dark  back other }", "edge1 0 4 0  edge2 4 0 0", 0.5},
        {"{ blend dark with other  back black }", "edge1 4 0 0  edge2 0 4 0", 0.35},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (size_t k = 0; k < sizeof modes / sizeof *modes; k++) {
            char text[700];
            double means[3];
            snprintf(text, sizeof text,
                     "camera { eye 0 0 4  look_at 0 0 0  fov 8 }\nmaterial dark { kd 0.2 }\n"
                     "material other { kd 0.5  back black }\nmaterial m %s\n"
                     "quad { corner -2 -2 0  %s  material m }\nlight environment { radiance 1 }\n",
                     cases[i].material, cases[i].square);
            render_means(means, text, *modes[k]);
            expect_close(means[1], cases[i].albedo, k < 2 ? 0.008 : 0.02, cases[i].material);
        }
}

/* ---- Insides -------------------------------------------------------------------------------- */

/* White paint on glass that loses nothing is white in a furnace, whichever is met how often. */
static void paint_on_glass_is_white(void **state)
{
    (void)state;
    for (size_t k = 0; k < 2; k++) {
        double means[3];
        rt_render_options options = *modes[k];
        options.max_depth = 100;
        render_means(means,
                     "camera { eye 0 0 4  look_at 0 0 0  fov 20 }\n"
                     "material glass { kt 1  ior 1.5  fresnel dielectric }\n"
                     "material paint { kd 1 }\nmaterial m { blend glass with paint  weight 0.3 }\n"
                     "sphere { centre 0 0 0  radius 1  material m }\n"
                     "light environment { radiance 1 }\n",
                     options);
        expect_close(means[1], 1, 0.01, "paint on glass");
    }
}

/* Varnish that hides all of a glass is varnish in air; glass that shows all of it is that glass. */
static void a_blend_has_the_inside_of_its_glass(void **state)
{
    static const char *const materials[] = {"varnish", "all", "glass", "none"};
    double means[4][3];
    (void)state;
    for (int i = 0; i < 4; i++) {
        char text[700];
        snprintf(text, sizeof text,
                 "camera { eye 0 0 4  look_at 0 0 0  fov 20 }\n"
                 "material glass { kt 1  ior 1.5  fresnel dielectric  absorption 0.5 }\n"
                 "material varnish { kd 0.1  coat 1 }\n"
                 "material all { blend glass with varnish  weight 1 }\n"
                 "material none { blend glass with varnish  weight 1e-6 }\n"
                 "sphere { centre 0 0 0  radius 1  material %s }\n"
                 "light environment { radiance 1 }\n",
                 materials[i]);
        render_means(means[i], text, by_path);
    }
    expect_close(means[1][1], means[0][1], 0.005, "varnish on glass");
    expect_close(means[3][1], means[2][1], 0.005, "glass");
}

/* ---- All together -------------------------------------------------------------------------- */

static void modes_agree_in_a_room(void **state)
{
    (void)state;
    expect_modes_agree(
        "camera { eye 0 0 3.5  look_at 0 0 0  fov 45 }\n"
        "texture mask { pattern checker  a 0.9 0.9 0.9  b 0.1 0.1 0.1  scale 6 6 }\n"
        "material white { kd 0.7 }\nmaterial matt { kd 0.3 0.5 0.1 }\nmaterial mirror { ks 0.9 }\n"
        "material metal { ks 0.8 0.6 0.3  roughness 0.3 }\nmaterial red { kd 0.6 0.1 0.1 }\n"
        "material glass { kt 0.95  ior 1.5  fresnel dielectric }\n"
        "material a { blend matt with mirror  weight 0.4 }\n"
        "material b { blend matt with metal  weight_texture mask }\n"
        "material c { blend glass with red  weight 0.3 }\n"
        "material sheet { kd 0.1 0.2 0.7  back red }\nmaterial lamp { emission 2 }\n"
        "quad { corner -3 -3 -1  edge1 6 0 0  edge2 0 6 0  material white }\n"
        "quad { corner -3 -3 6  edge1 0 6 0  edge2 6 0 0  material lamp }\n"
        "sphere { centre 0.6 0.6 -0.3  radius 0.5  material a }\n"
        "sphere { centre -0.6 0.6 -0.3  radius 0.5  material b }\n"
        "sphere { centre -0.6 -0.6 -0.3  radius 0.5  material c }\n"
        "quad { corner 0.2 -1 -0.3  edge1 0.8 0 -0.5  edge2 0 0.8 0.2  material sheet }\n"
        "quad { corner 1.1 -1 -0.3  edge1 0 0.8 0.2  edge2 0.8 0 -0.5  material sheet }\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(a_blend_is_the_mean_of_its_parts),
        statistical_test(opacity_and_blend_are_independent),
        statistical_test(each_side_is_its_own),
        statistical_test(paint_on_glass_is_white),
        statistical_test(a_blend_has_the_inside_of_its_glass),
        statistical_test(modes_agree_in_a_room),
    };
    return cmocka_run_group_tests_name("lib/render/blend", tests, NULL, NULL);
}
