/*
 * test_beam_light.c - beams of parallel light: what a wall gets of them by irradiance, power and
 * cross section, in all modes; the edges and the turn of the cross section.
 */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "kernels/statistics.h"
#include "lib/render/means.h"

#define PI 3.14159265358979323846

static const rt_render_options modes[] = {
    {.spp = 256, .max_depth = 2},
    {.mode = RT_MODE_DIRECT, .spp = 256},
    {.mode = RT_MODE_VCM, .spp = 256, .max_depth = 2},
    {.mode = RT_MODE_VCM, .techniques = RT_TECHNIQUES_BPT, .spp = 256, .max_depth = 2},
    {.mode = RT_MODE_VCM, .techniques = RT_TECHNIQUES_CAMERA, .spp = 256, .max_depth = 2},
    {.mode = RT_MODE_PHOTON, .passes = 256, .photons = 1000, .max_depth = 2},
    {.mode = RT_MODE_PHOTON,
     .direct = RT_DIRECT_PHOTONS,
     .passes = 8,
     .photons = 20000,
     .max_depth = 2}};

/* Gathered photons of direct light, the last, blur an edge and add light about it. */
enum { MODES = sizeof modes / sizeof *modes, SHARP = MODES - 1 };

/* A wall of 2 m across that fills the picture, seen along -z. */
#define WALL                                                                                       \
    "film { width 16  height 16 }\nmaterial wall { kd 0.5 }\n"                                     \
    "quad { corner -4 -4 0  edge1 8 0 0  edge2 0 8 0  material wall }\n"
static const char wall[] =
    "camera { projection orthographic  width 2  eye 0 0 5  look_at 0 0 0 }\n" WALL;

/* The flux of a beam over the 4 m^2 of the picture, however it falls on them. */
static void a_wall_gets_the_flux_of_a_beam(void **state)
{
    static const struct {
        const char *light;
        double flux; /* over pi */
    } beams[] = {
        {"light beam { position 0 0 2  target 0 0 0  width 1  irradiance 3 }\n", 0.25 * 3},
        {"light beam { position -1 0.5 1.5  target 0 0 0  width 0.8  height 0.5  irradiance 3 }\n",
         0.1 * 3},
        {"light beam { position 0 1 2  target 0 0 0  width 0.8  height 0.5  irradiance 3  "
         "cross_section rectangular }\n",
         0.4 * 3 / PI},
        {"light beam { position 0.4 0 1  target 0 0 0  width 0.3  power 2 }\n", 2 / PI}};
    (void)state;
    for (size_t k = 0; k < sizeof beams / sizeof *beams; k++)
        for (int i = 0; i < SHARP; i++) {
            char text[600], what[40];
            double found[3];
            const double expected = 0.5 * beams[k].flux / 4;
            snprintf(text, sizeof text, "%s%s", wall, beams[k].light);
            render_means(found, text, modes[i]);
            snprintf(what, sizeof what, "beam %d, mode %d", (int)k, i);
            expect_close(found[0], expected, 0.02 * expected, what);
        }
}

/* What the wall shows at a point, by its irradiance. */
static void expect_lit(const char *light, double x, double y, double irradiance)
{
    char text[800];
    double found[3];
    snprintf(
        text, sizeof text,
        "camera { projection orthographic  width 0.002  eye %g %g 0.5  look_at %g %g 0 }\n" WALL
        "%s",
        x, y, x, y, light);
    render_means(found, text, (rt_render_options){.spp = 16, .max_depth = 2});
    if (!(fabs(found[0] - 0.5 / PI * irradiance) <= 1e-5 * irradiance))
        fail_msg("%g at %g, %g, not %g", found[0], x, y, 0.5 / PI * irradiance);
}

/* Its height is along up; the corners of a rectangle are none of the ellipse within. */
static void its_cross_section_has_edges(void **state)
{
    static const char round[] =
        "light beam { position 0 0 2  target 0 0 0  width 1.2  height 0.4  irradiance 2 }\n",
                      turned[] =
                          "light beam { position 0 0 2  target 0 0 0  width 1.2  height 0.4  "
                          "up 1 0 0  cross_section rectangular  irradiance 2 }\n",
                      slanted[] = "light beam { position 1 0 1  target 0 0 0  width 0.4  "
                                  "cross_section rectangular  irradiance 2 }\n",
                      behind[] =
                          "medium { scattering 1 }\nlight beam { position 0 0 0.6  target 0 0 2  "
                          "width 1  irradiance 2 }\n";
    (void)state;
    expect_lit(round, 0.59, 0, 2);
    expect_lit(round, 0.61, 0, 0);
    expect_lit(round, 0, 0.19, 2);
    expect_lit(round, 0.5, 0.15, 0);
    expect_lit(turned, 0.19, 0.59, 2);
    expect_lit(turned, 0.21, 0.59, 0);
    expect_lit(turned, 0.19, 0.61, 0);
    expect_lit(slanted, 0.28, 0.19, sqrt(2));
    expect_lit(slanted, 0.29, 0.19, 0);
    expect_lit(behind, 0, 0, 0);
}

/* A beam that starts in a wall of its own lights what is before it. */
static void it_may_start_in_a_surface(void **state)
{
    static const char text[] =
        "camera { projection orthographic  width 0.5  eye 0 0 0.4  look_at 0 0 0 }\n" WALL
        "quad { corner -2 -2 1000  edge1 4 0 0  edge2 0 4 0  material wall }\n"
        "light beam { position 0 0 1000  target 0 0 0  width 1  irradiance 2 }\n";
    (void)state;
    for (int i = 0; i < MODES; i++) {
        double found[3];
        render_means(found, text, modes[i]);
        expect_close(found[0], 1 / PI, 0.02 / PI, "a beam from a surface");
    }
}

static void sizes_and_powers_have_bounds(void **state)
{
    static const struct {
        rt_beam_light light;
        const char *message;
    } wrong[] = {
        {{.target = {1, 0, 0}, .irradiance = {1, 1, 1}}, "width is 0 m"},
        {{.target = {1, 0, 0}, .width = 1, .height = -1}, "height is -1 m"},
        {{.target = {1, 0, 0}, .width = 1, .irradiance = {1, 1, 1}, .power = {1, 1, 1}},
         "give irradiance or power, not both"},
        {{.target = {1, 0, 0}, .width = 1e-14f, .power = {1e9f, 1, 1}}, "is an irradiance of"},
        {{.target = {1, 0, 0}, .width = 1, .cross_section = 2}, "there is no cross section 2"},
        {{.target = {1, 0, 0}, .width = 1, .up = {2, 0, 0}}, "up is parallel to its axis"},
        {{.position = {3e5f, 2e5f, 6e5f}, .width = 0.6f, .irradiance = {1, 1, 1}},
         "single precision moves its light"},
        {{.width = 1}, "position and target are the same point"}};
    rt_scene *scene = NULL;
    rt_error error;
    (void)state;
    expect_ok(rt_scene_create(&scene, &error), &error);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_int_equal(rt_scene_add_beam_light(scene, &wrong[i].light, &error), RT_ERROR_INPUT);
        assert_non_null(strstr(error.message, wrong[i].message));
    }
    rt_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(a_wall_gets_the_flux_of_a_beam),
        cmocka_unit_test(its_cross_section_has_edges),
        statistical_test(it_may_start_in_a_surface),
        cmocka_unit_test(sizes_and_powers_have_bounds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
