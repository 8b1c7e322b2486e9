/*
 * test_translucent.c - surfaces that scatter light evenly to both sides, in whole renders: behind a
 * sheet it is that of the closed form for every kind of light, a white furnace stays white, and
 * paths, photons, vertex connection and merging agree.
 */
#include "support.h"

#include <math.h>
#include <stdio.h>

#include "kernels/statistics.h"
#include "lib/render/means.h"

#define PI 3.14159265358979323846

static const rt_render_options by_path = {.spp = 64, .max_depth = 2},
                               by_vcm = {.mode = RT_MODE_VCM, .spp = 64, .max_depth = 2},
                               by_photons = {.mode = RT_MODE_PHOTON,
                                             .spp = 4,
                                             .photons = 100000,
                                             .k = 1000,
                                             .max_depth = 2,
                                             .direct = RT_DIRECT_PHOTONS};

/* ---- A sheet between a light and the camera --------------------------------------------- */

/* Seen from above at the origin; the lights are below, so that what is seen has crossed it. */
#define SHEET(more)                                                                                \
    "camera { eye 0.4 0 2  look_at 0 0 0  fov 2 }\n"                                               \
    "material m { kd 0.1 0.2 0.5  diffuse_transmission 0.7 0.4 0.1" more " }\n"                    \
    "quad { corner -2 -2 0  edge1 4 0 0  edge2 0 4 0  material m }\n"

static const double transmitted[3] = {0.7, 0.4, 0.1};

/* The irradiance of the far side, and the light that makes it. */
static const struct {
    const char *light;
    double irradiance;
} lights[] = {
    {"light point { position 1 0 -1  intensity 8 }\n", 8 * 0.70710678118654752 / 2},
    {"light spot { position 0 1 -1  target 0 0 0  intensity 8  inner 20  outer 25 }\n",
     8 * 0.70710678118654752 / 2},
    {"light directional { direction 0.6 0 0.8  irradiance 3 }\n", 3 * 0.8},
    /* A square seen from the middle at its height: Lambert's contour integral. */
    {"material lamp { emission 2 }\n"
     "quad { corner -1 -1 -1  edge1 2 0 0  edge2 0 2 0  material lamp }\n",
     2 * 4 * 0.70710678118654752 * 0.61547970867038734},
    /* A sphere: that of a point light of the same intensity. */
    {"material lamp { emission 5 }\nsphere { centre 0 0 -2  radius 0.5  material lamp }\n",
     5 * PI * 0.25 / 4},
};

static void expect_sheet(const char *light, double irradiance, rt_render_options options,
                         double tolerance, const char *what)
{
    char text[700];
    double means[3];
    snprintf(text, sizeof text, "%s%s", SHEET(""), light);
    render_means(means, text, options);
    for (int c = 0; c < 3; c++) {
        const double exact = transmitted[c] / PI * irradiance;
        expect_close(means[c], exact, tolerance * exact, what);
    }
}

static void light_behind_a_sheet_is_that_of_the_closed_form(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof lights / sizeof *lights; i++) {
        expect_sheet(lights[i].light, lights[i].irradiance, by_path, 0.01, "by paths");
        expect_sheet(lights[i].light, lights[i].irradiance, by_vcm, 0.01,
                     "by vertex connection and merging");
    }
}

/* Of a directional light, which is even, so that large discs have no bias. */
static void photons_of_the_far_side_are_gathered(void **state)
{
    const char *light = lights[2].light;
    rt_render_options map = by_photons;
    (void)state;
    map.gather = RT_GATHER_DEVICE;
    expect_sheet(light, lights[2].irradiance, map, 0.1, "by photons of the tree");
    map.gather = RT_GATHER_FLANN;
    expect_sheet(light, lights[2].irradiance, map, 0.1, "by photons of neighbour lists");
    map.area = RT_AREA_HULL;
    expect_sheet(light, lights[2].irradiance, map, 0.1, "by photons of the hull");
}

/*
 * Techniques by themselves find what crosses, each by its own rule of sides; in water, whose index
 * does not scale what crosses a sheet in it, as in air.
 */
static void each_technique_finds_what_crosses(void **state)
{
    static const rt_techniques techniques[] = {RT_TECHNIQUES_EMISSION, RT_TECHNIQUES_CAMERA,
                                               RT_TECHNIQUES_MERGING};
    static const char sheet[] =
        "camera { eye 0 0 3  look_at 0 0 0  fov 60 }\n"
        "material m { diffuse_transmission 1 }\nmaterial lamp { emission 2 }\n"
        "quad { corner -2 -2 0  edge1 4 0 0  edge2 0 4 0  material m }\n"
        "quad { corner -1 -1 -1  edge1 2 0 0  edge2 0 2 0  material lamp }\n";
    static const char *const waters[] = {"", "material water { kt 1  ior 1.33 }\n"
                                             "sphere { centre 0 0 0  radius 9  material water }\n"};
    double expected[3], means[3];
    (void)state;
    render_means(expected, sheet, by_path);
    for (int w = 0; w < 2; w++) {
        char text[700];
        snprintf(text, sizeof text, "%s%s", sheet, waters[w]);
        for (int i = 0; i < 3; i++) {
            rt_render_options options = by_vcm;
            options.techniques = techniques[i];
            options.radius = 0.1f;
            render_means(means, text, options);
            expect_close(means[0], expected[0], 0.03 * expected[0], "by one technique");
        }
        for (int e = RT_ESTIMATOR_LIGHT; e <= RT_ESTIMATOR_BSDF; e++) {
            rt_render_options options = by_path;
            options.estimator = (rt_estimator)e;
            render_means(means, text, options);
            expect_close(means[0], expected[0], 0.03 * expected[0], "by one estimator");
        }
    }
}

/* Behind a shade of the environment's light alone: half of it lit by radiance 1. */
static void a_sheet_is_lit_by_the_environment(void **state)
{
    double means[3];
    (void)state;
    render_means(means, SHEET("") "light environment { radiance 1 }\n", by_path);
    expect_close(means[0], 0.8, 2e-3, "red of both sides");
    expect_close(means[2], 0.6, 2e-3, "blue of both sides");
}

/* A black wall behind hides the light of one side. */
static void a_wall_behind_hides_its_side(void **state)
{
    double means[3];
    (void)state;
    render_means(means,
                 SHEET("") "material black { }\nplane { point 0 0 -1e-3  normal 0 0 1  "
                           "material black }\nlight environment { radiance 1 }\n",
                 by_path);
    expect_close(means[0], 0.1, 5e-3, "what is reflected");
}

/* ---- A white furnace --------------------------------------------------------------------- */

static void expect_white(const char *material, const char *shape)
{
    char text[600];
    double means[3];
    snprintf(text, sizeof text,
             "camera { eye 0 0 4  look_at 0 0 0  fov 8 }\nlight environment { radiance 1 }\n"
             "material m { %s }\n%s\n",
             material, shape);
    render_means(means, text, (rt_render_options){.spp = 128});
    expect_close(means[0], 1, 2e-3, "by paths");
    render_means(means, text, (rt_render_options){.mode = RT_MODE_VCM, .spp = 64});
    expect_close(means[0], 1, 5e-3, "by vertex connection and merging");
    render_means(means, text,
                 (rt_render_options){.mode = RT_MODE_PHOTON,
                                     .spp = 4,
                                     .photons = 100000,
                                     .k = 400,
                                     .direct = RT_DIRECT_PHOTONS});
    expect_close(means[0], 1, 0.03, "by photons");
}

static void white_disappears_in_a_white_furnace(void **state)
{
    (void)state;
    expect_white("kd 0.3  diffuse_transmission 0.7",
                 "sphere { centre 0 0 0  radius 1  material m }");
    expect_white("diffuse_transmission 1",
                 "quad { corner -2 -2 0  edge1 4 0 0  edge2 0 4 0  material m }");
}

/* A hollow ball that emits to both sides: L = Le + kd L inside, what crosses leaves outside. */
static void light_within_a_ball_gets_out(void **state)
{
    static const char ball[] =
        "camera { eye 0 0 4  look_at 0 0 0  fov 4 }\n"
        "material m { kd 0.25  diffuse_transmission 0.5  emission 1  two_sided true }\n"
        "sphere { centre 0 0 0  radius 1  material m }\n";
    const double inside = 1 / (1 - 0.25);
    double means[3];
    (void)state;
    render_means(means, ball, (rt_render_options){.spp = 256});
    expect_close(means[0], 1 + 0.5 * inside, 5e-3, "by paths");
    render_means(means, ball, (rt_render_options){.mode = RT_MODE_VCM, .spp = 64});
    expect_close(means[0], 1 + 0.5 * inside, 1e-2, "by vertex connection and merging");
}

/* ---- Media ------------------------------------------------------------------------------- */

/* Paper glued to a face of glass: the path that crosses it is in the glass. */
static void paper_on_glass_leads_into_the_glass(void **state)
{
    static const char pane[] =
        "camera { eye 0 0 5  look_at 0 0 0  fov 2 }\n"
        "material glass { kt 1  ior 1  absorption 0.69314718 }\n"
        "material paper { diffuse_transmission 1 }\nmaterial lamp { emission 1 }\n"
        "box { centre 0 0 -0.5  size 20 20 1  material glass }\n"
        "quad { corner -8 -8 0  edge1 16 0 0  edge2 0 16 0  material paper }\n"
        "quad { corner -0.1 -0.1 -0.9  edge1 0.2 0 0  edge2 0 0.2 0  material lamp }\n";
    double means[3];
    (void)state;
    /* A small lamp below, at 0.9 m in the glass: E = L A / d^2, attenuated by 2^-d. */
    render_means(means, pane, by_path);
    expect_close(means[0], 0.04 / 0.81 * pow(2, -0.9) / PI, 3e-4, "through paper and glass");
}

/* ---- A room ------------------------------------------------------------------------------ */

/* A shade around a bulb, a leaf with bumps and a glossy upper side, and a screen of normals. */
static const char room[] =
    "camera { eye 0 0.1 1.9  look_at 0 -0.1 0  fov 50 }\n"
    "texture waves { pattern checker  a 0 0 0  b 1 1 1  scale 4 4 }\n"
    "texture blue { pattern gradient  a 0.3 0.2 0.9  b 0.8 0.7 0.3 }\n"
    "material wall { kd 0.6 0.5 0.4 }\nmaterial lamp { emission 30 }\n"
    "material shade { kd 0.3 0.3 0.2  diffuse_transmission 0.5 0.4 0.2 }\n"
    "material leaf { kd 0.1 0.3 0.1  diffuse_transmission 0.2 0.5 0.1\n"
    "  bump_texture waves  bump_scale 0.02 }\n"
    "material waxy { kd 0.1  diffuse_transmission_texture blue  diffuse_transmission 0.6\n"
    "  ks 0.2  roughness 0.4 }\n"
    "box { centre 0 0 0  size 2 2 4  material wall }\n"
    "cylinder { a -0.4 -0.2 -0.4  b -0.4 0.4 -0.4  radius 0.3  material shade }\n"
    "sphere { centre -0.4 0.1 -0.4  radius 0.12  material lamp }\n"
    "quad { corner 0 -0.8 -0.2  edge1 0.9 0.2 0  edge2 0 0.5 -0.6  material leaf }\n"
    "quad { corner 0.2 0.1 -0.6  edge1 0.5 0 0.2  edge2 0 0.6 0.1  material waxy }\n";

static void modes_agree_in_a_room(void **state)
{
    (void)state;
    expect_modes_agree(room);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(light_behind_a_sheet_is_that_of_the_closed_form),
        statistical_test(photons_of_the_far_side_are_gathered),
        statistical_test(each_technique_finds_what_crosses),
        statistical_test(a_sheet_is_lit_by_the_environment),
        statistical_test(a_wall_behind_hides_its_side),
        statistical_test(white_disappears_in_a_white_furnace),
        statistical_test(light_within_a_ball_gets_out),
        statistical_test(paper_on_glass_leads_into_the_glass),
        statistical_test(modes_agree_in_a_room),
    };
    return cmocka_run_group_tests_name("lib/render/translucent", tests, NULL, NULL);
}
