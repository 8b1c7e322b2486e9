/*
 * test_hide_emitters.c - a camera that hides emitters: its picture is that of a camera which stands
 * behind them, by every technique; mirrors, glass and surfaces meet their light as ever.
 */
#include "support.h"

#include <stdio.h>

#include "kernels/statistics.h"
#include "lib/render/means.h"

static const rt_render_options modes[] = {
    {.spp = 512, .max_depth = 4},
    {.mode = RT_MODE_DIRECT, .spp = 512},
    {.mode = RT_MODE_VCM, .spp = 256, .max_depth = 4},
    {.mode = RT_MODE_VCM, .techniques = RT_TECHNIQUES_BPT, .spp = 256, .max_depth = 4},
    {.mode = RT_MODE_VCM, .techniques = RT_TECHNIQUES_CAMERA, .spp = 256, .max_depth = 4},
    {.mode = RT_MODE_PHOTON, .passes = 8, .photons = 20000, .max_depth = 4},
    {.mode = RT_MODE_PHOTON, .passes = 8, .photons = 20000, .final_gather = 1, .max_depth = 4}};

enum { MODES = sizeof modes / sizeof *modes };

/*
 * Before a wall, in a row, a lamp of one side, another, and a sphere that emits, so that rays meet
 * several; all of the picture shows the wall, by parallel rays.
 */
static const char lamps[] =
    "film { width 16  height 16 }\nmaterial wall { kd 0.6 0.4 0.2 }\nmaterial glow { kd 0.5 }\n"
    "quad { corner -3 -3 0  edge1 6 0 0  edge2 0 6 0  material wall }\n"
    "quad { corner -0.4 -0.4 1  edge1 0 0.8 0  edge2 0.8 0 0  material glow  radiance 6 }\n"
    "quad { corner -0.4 -0.4 1.4  edge1 0.8 0 0  edge2 0 0.8 0  material glow  radiance 2 }\n"
    "sphere { centre 0.1 0 2  radius 0.3  material glow  radiance 4 }\n";

static void the_picture_is_that_from_behind_them(void **state)
{
    static const char *const around[] = {"", "light environment { radiance 0.2 }\n"};
    (void)state;
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < MODES; i++) {
            char text[1200], what[40];
            double behind[3], hidden[3];
            snprintf(text, sizeof text,
                     "camera { projection orthographic  width 1  eye 0 0 0.9  look_at 0 0 0 }\n"
                     "%s%s",
                     lamps, around[k]);
            render_means(behind, text, modes[i]);
            snprintf(text, sizeof text,
                     "camera { projection orthographic  width 1  eye 0 0 4  look_at 0 0 0  "
                     "hide_emitters true }\n%s%s",
                     lamps, around[k]);
            render_means(hidden, text, modes[i]);
            snprintf(what, sizeof what, "mode %d, sky %d", i, k);
            for (int c = 0; c < 3; c++)
                expect_close(hidden[c], behind[c], 0.015 * behind[c], what);
        }
}

/* In fog, a small ball that is hidden is a point light: what it lights before itself is seen. */
static void a_ball_in_fog_is_a_point(void **state)
{
    static const char scene[] =
        "camera { projection orthographic  width 1  eye 0 0 4  look_at 0 0 0  "
        "hide_emitters true }\nmedium { scattering 0.2  absorption 0.05 }\n"
        "material wall { kd 0.6 }\nmaterial glow { emission 795.77 }\n"
        "quad { corner -3 -3 0  edge1 6 0 0  edge2 0 6 0  material wall }\n%s";
    static const rt_render_options in_fog[] = {
        {.spp = 1024, .max_depth = 4},
        {.mode = RT_MODE_PHOTON, .passes = 32, .photons = 20000, .max_depth = 4}};
    char text[700];
    double point[3], ball[3];
    (void)state;
    snprintf(text, sizeof text, scene, "light point { position 0.1 0 1.5  intensity 1 }\n");
    render_means(point, text, in_fog[0]);
    snprintf(text, sizeof text, scene, "sphere { centre 0.1 0 1.5  radius 0.02  material glow }\n");
    for (int i = 0; i < 2; i++) {
        render_means(ball, text, in_fog[i]);
        expect_close(ball[1], point[1], 0.02 * point[1], i ? "photons" : "paths");
    }
}

/* The sky is black where a ray meets nothing, whatever lies before it, and lights as ever. */
static void the_environment_is_black(void **state)
{
    static const char *const shapes[] = {"", "sphere { centre 0 0 0  radius 1  material glow }\n",
                                         "sphere { centre 0 0 0  radius 1  material glass }\n",
                                         "sphere { centre 0 0 0  radius 1  material mirror }\n"};
    static const double expected[] = {0, 0, 1, 1};
    (void)state;
    for (int k = 0; k < 4; k++)
        for (int i = 0; i < MODES; i++) {
            char text[800], what[40];
            double means[3];
            if (modes[i].techniques == RT_TECHNIQUES_CAMERA)
                continue; /* finds no light by mirrors */
            snprintf(text, sizeof text,
                     "camera { eye 0 0 9  look_at 0 0 0  fov 2  hide_emitters true }\n"
                     "material glow { emission 3 }\nmaterial mirror { ks 1 }\n"
                     "material glass { kt 1  ior 1.5  fresnel dielectric }\n"
                     "%slight environment { radiance 1 }\n",
                     shapes[k]);
            rt_render_options options = modes[i];
            options.max_depth = 32;
            render_means(means, text, options);
            snprintf(what, sizeof what, "mode %d, shape %d", i, k);
            for (int c = 0; c < 3; c++)
                expect_close(means[c], expected[k], 0.01, what);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(the_picture_is_that_from_behind_them),
        statistical_test(a_ball_in_fog_is_a_point),
        statistical_test(the_environment_is_black),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
