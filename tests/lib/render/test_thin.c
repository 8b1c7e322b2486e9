/*
 * test_thin.c - thin sheets in whole renders: what they reflect and transmit is that of the sum
 * over all reflections between their sides, light goes straight through them, in every mode, and
 * what is behind them is in no solid, unless a medium fills them.
 */
#include "support.h"

#include <math.h>
#include <stdio.h>

#include "kernels/statistics.h"
#include "lib/render/means.h"

#define PI 3.14159265358979323846

/* Of one side of a sheet, by Fresnel's equations. */
static double of_one_side(double cosine, double index)
{
    const double beyond = sqrt(1 - (1 - cosine * cosine) / (index * index));
    const double s = (cosine - index * beyond) / (cosine + index * beyond),
                 p = (index * cosine - beyond) / (index * cosine + beyond);
    return (s * s + p * p) / 2;
}

/* Of a sheet: light that enters it is followed from side to side. */
static double reflectance(double cosine, double index)
{
    const double r = of_one_side(cosine, index);
    double sum = r, inside = 1 - r;
    for (int i = 0; i < 200; i++) {
        inside *= r;
        sum += i % 2 == 0 ? inside * (1 - r) : 0;
    }
    return sum;
}

/* ---- What a pane reflects and transmits -------------------------------------------- */

static const double tint[3] = {1, 0.5, 0.25};

/* A pane in a solid, seen at this angle; a wall that shines stands behind it, or before it. */
static void see_pane(double means[3], double degrees, double index, const char *solid, int before,
                     rt_render_options options)
{
    char text[600];
    snprintf(text, sizeof text,
             "camera { eye %.9g 0 %.9g  look_at 0 0 0  fov 0.5 }\n"
             "material wall { emission 1  two_sided true }\n"
             "material pane { kt 1 0.5 0.25  fresnel dielectric  ior %g  thin true }\n%s"
             "quad { corner -1 -1 0  edge1 2 0 0  edge2 0 2 0  material pane }\n"
             "quad { corner -90 -90 %d  edge1 180 0 0  edge2 0 180 0  material wall }\n",
             5 * sin(degrees * PI / 180), 5 * cos(degrees * PI / 180), index, solid,
             before ? 6 : -1);
    render_means(means, text, options);
}

static void expect_pane(double degrees, double index, const char *solid, double outside,
                        rt_render_options options)
{
    const double part = reflectance(cos(degrees * PI / 180), index / outside);
    double reflected[3], transmitted[3];
    see_pane(reflected, degrees, index, solid, 1, options);
    see_pane(transmitted, degrees, index, solid, 0, options);
    for (int c = 0; c < 3; c++) {
        expect_close(reflected[c], tint[c] * part, 3e-3, "reflected");
        expect_close(transmitted[c], tint[c] * (1 - part), 3e-3, "transmitted");
    }
}

static void a_pane_reflects_by_both_of_its_sides(void **state)
{
    static const double degrees[] = {0, 45, 80};
    (void)state;
    for (int i = 0; i < 3; i++) {
        expect_pane(degrees[i], 1.5, "", 1, (rt_render_options){.spp = 64});
        expect_pane(degrees[i], 1.5, "", 1, (rt_render_options){.mode = RT_MODE_VCM, .spp = 64});
        expect_pane(degrees[i], 2.2, "", 1,
                    (rt_render_options){.mode = RT_MODE_PHOTON, .spp = 64, .photons = 1000});
    }
}

static void a_pane_in_water_reflects_less(void **state)
{
    static const char water[] = "material water { kt 1  fresnel dielectric  ior 1.33 }\n"
                                "box { centre 0 0 0  size 400 400 400  material water }\n";
    (void)state;
    expect_pane(60, 1.5, water, 1.33, (rt_render_options){.spp = 64});
    expect_pane(60, 1.5, water, 1.33, (rt_render_options){.mode = RT_MODE_VCM, .spp = 64});
}

/* ---- Light behind a pane ------------------------------------------------------------- */

/* A spot over a pane over a floor, which the camera sees from below the pane. */
static const char floor_below[] =
    "camera { eye 0 0.5 2  look_at 0 0 0  fov 2 }\nmaterial m { kd 0.8 }\n"
    "material pane { kt 1  fresnel dielectric  thin true }\n"
    "quad { corner -9 0 -9  edge1 0 0 18  edge2 18 0 0  material m }\n"
    "quad { corner -9 0.9 -9  edge1 0 0 18  edge2 18 0 0  material pane }\n"
    "light spot { position 3 1.8 0  target 0 0 0  intensity 10  inner 20  outer 21 }\n";

static void light_goes_straight_through_a_pane(void **state)
{
    const double d2 = 3 * 3 + 1.8 * 1.8, cosine = 1.8 / sqrt(d2);
    const double exact = 0.8 / PI * 10 / d2 * cosine * (1 - reflectance(cosine, 1.5));
    double means[3];
    (void)state;
    render_means(means, floor_below,
                 (rt_render_options){.mode = RT_MODE_VCM, .spp = 64, .max_depth = 3});
    expect_close(means[1], exact, 0.02 * exact, "by vertex connection and merging");
    render_means(
        means, floor_below,
        (rt_render_options){
            .mode = RT_MODE_PHOTON, .spp = 4, .photons = 100000, .k = 200, .max_depth = 3});
    expect_close(means[1], exact, 0.04 * exact, "by photons");
}

/* ---- A globe ---------------------------------------------------------------------------- */

/* A white ball in a globe of thin glass disappears in a white furnace: no light is lost. */
static void a_globe_disappears_in_a_white_furnace(void **state)
{
    static const char globe[] =
        "camera { eye 0 0 -3  look_at 0 0 0  fov 30 }\nlight environment { radiance 1 }\n"
        "material m { kd 1 }\nmaterial g { kt 1  fresnel dielectric  thin true }\n"
        "sphere { centre 0 0 0  radius 0.8  material g }\n"
        "sphere { centre 0.1 0 0.1  radius 0.4  material m }\n";
    double means[3];
    (void)state;
    render_means(means, globe, (rt_render_options){.spp = 256});
    expect_close(means[0], 1, 3e-3, "by paths");
    render_means(means, globe, (rt_render_options){.mode = RT_MODE_VCM, .spp = 64});
    expect_close(means[0], 1, 1e-2, "by vertex connection and merging");
    render_means(
        means, globe,
        (rt_render_options){.mode = RT_MODE_PHOTON, .spp = 16, .photons = 400000, .k = 200});
    expect_close(means[0], 1, 0.03, "by photons");
}

/* ---- A sheet on a face --------------------------------------------------------------- */

#define ON_WATER(more)                                                                             \
    "camera { eye 0 0 -3  look_at 0 0 0  fov 30 }\nlight environment { radiance 1 }\n"             \
    "material w { kt 1  fresnel dielectric  ior 1.33  absorption 2 0.5 0.1 }\n"                    \
    "material g { kt 1  fresnel dielectric  thin true }\n" more

/* It has no effect there, whichever comes first; on a wall neither. */
static void a_sheet_on_a_face_leaves_the_face(void **state)
{
    static const char water[] = ON_WATER("sphere { centre 0 0 0  radius 0.8  material w }\n"),
                      before[] = ON_WATER("sphere { centre 0 0 0  radius 0.8  material g }\n"
                                          "sphere { centre 0 0 0  radius 0.8  material w }\n"),
                      after[] = ON_WATER("sphere { centre 0 0 0  radius 0.8  material w }\n"
                                         "sphere { centre 0 0 0  radius 0.8  material g }\n");
    double alone[3], means[3];
    (void)state;
    render_means(alone, water, (rt_render_options){.spp = 64});
    for (int i = 0; i < 2; i++) {
        render_means(means, i ? after : before, (rt_render_options){.spp = 64});
        for (int c = 0; c < 3; c++)
            expect_close(means[c], alone[c], 5e-3, "water below a sheet");
    }
    assert_true(alone[0] < alone[2] - 0.05);
}

/* Two sheets at one place are one. */
static void sheets_at_one_place_are_one(void **state)
{
    double one[3], two[3];
    (void)state;
    render_means(one,
                 ON_WATER("sphere { centre 0 0 0  radius 0.8  material g }\n"
                          "sphere { centre 0 0 0  radius 0.3  material w }\n"),
                 (rt_render_options){.spp = 64});
    render_means(two,
                 ON_WATER("sphere { centre 0 0 0  radius 0.8  material g }\n"
                          "sphere { centre 0 0 0  radius 0.8  material g }\n"
                          "sphere { centre 0 0 0  radius 0.3  material w }\n"),
                 (rt_render_options){.spp = 64});
    for (int c = 0; c < 3; c++)
        expect_close(two[c], one[c], 5e-3, "two sheets");
}

/* Sheets need no inside: nothing is told of open ones, or of a camera behind one. */
static void nothing_is_told_of_open_sheets(void **state)
{
    static const char open[] =
        "camera { eye 0 1 4  look_at 0 1 0  fov 50 }\nlight environment { radiance 1 }\n"
        "material g { kt 1  fresnel dielectric  thin true }\n"
        "quad { corner -1 0 0  edge1 2 0 0  edge2 0 2 0  material g }\n"
        "plane { point 0 0 5  normal 0 0 1  material g }\n";
    rt_scene *scene = NULL;
    rt_error error;
    (void)state;
    expect_ok(rt_scene_parse(&scene, open, "test", NULL, &error), &error);
    assert_int_equal(rt_scene_check(scene, NULL, NULL), 0);
    rt_scene_destroy(scene);
}

static void expect_open_glass(void *user, const rt_finding *finding)
{
    (void)user;
    assert_int_equal(finding->kind, RT_FINDING_OPEN_GLASS);
}

/* One that is filled is a solid, which must be closed. */
static void an_open_sheet_that_is_filled_is_told(void **state)
{
    static const char open[] =
        "camera { eye 0 1 4  look_at 0 1 0  fov 50 }\nlight environment { radiance 1 }\n"
        "material g { kt 1  fresnel dielectric  thin true  absorption 1 }\n"
        "quad { corner -1 0 0  edge1 2 0 0  edge2 0 2 0  material g }\n";
    rt_scene *scene = NULL;
    rt_error error;
    (void)state;
    expect_ok(rt_scene_parse(&scene, open, "test", NULL, &error), &error);
    assert_int_equal(rt_scene_check(scene, expect_open_glass, NULL), 1);
    rt_scene_destroy(scene);
}

/* ---- What fills a sheet ---------------------------------------------------------------- */

#define FILLED(more) "material g { kt 1  fresnel dielectric  thin true  " more " }\n"

/*
 * Seen through its centre, a globe absorbs along its diameter each time that light goes to and fro
 * between its walls, each of which is met along its normal. In water, too, light goes straight on.
 */
static void expect_diameter(const char *solid, double outside, rt_render_options options)
{
    static const double absorption[3] = {0.5, 1, 0};
    const double r = reflectance(1, 1.5 / outside);
    double means[3];
    char text[600];
    snprintf(text, sizeof text,
             "camera { eye 0 0 -3  look_at 0 0 0  fov 0.5 }\nmaterial wall { emission 1 }\n" FILLED(
                 "absorption 0.5 1 0") "%ssphere { centre 0 0 0  radius 0.8  material g }\n"
                                       "quad { corner -9 -9 5  edge1 0 18 0  edge2 18 0 0  "
                                       "material wall }\n",
             solid);
    render_means(means, text, options);
    for (int c = 0; c < 3; c++) {
        const double left = exp(-absorption[c] * 1.6);
        const double seen = (1 - r) * (1 - r) * left / (1 - r * r * left * left);
        expect_close(means[c], seen, 4e-3, "through a filled globe");
    }
}

static void a_filled_globe_absorbs_along_its_diameter(void **state)
{
    static const char water[] = "material water { kt 1  fresnel dielectric  ior 1.33 }\n"
                                "box { centre 0 0 0  size 400 400 400  material water }\n";
    (void)state;
    expect_diameter("", 1, (rt_render_options){.spp = 256});
    expect_diameter(water, 1.33, (rt_render_options){.spp = 256});
    expect_diameter("", 1, (rt_render_options){.mode = RT_MODE_VCM, .spp = 256});
    expect_diameter("", 1,
                    (rt_render_options){.mode = RT_MODE_PHOTON, .spp = 256, .photons = 1000});
}

/* Fog that absorbs nothing disappears in a white furnace, in glass and around a white ball. */
static void fog_in_a_globe_disappears_in_a_white_furnace(void **state)
{
    static const char globe[] =
        "camera { eye 0 0 -3  look_at 0 0 0  fov 30 }\nlight environment { radiance 1 }\n"
        "render { max_depth 200 }\nmaterial m { kd 1 }\n" FILLED(
            "scattering 2  g 0.3") "sphere { centre 0 0 0  radius 0.8  material g }\n"
                                   "sphere { centre 0.1 0 0.1  radius 0.3  material m }\n";
    double means[3];
    (void)state;
    render_means(means, globe, (rt_render_options){.spp = 128});
    expect_close(means[0], 1, 3e-3, "by paths");
}

/*
 * A lamp and a white wall in a globe of fog over a floor. In a hollow globe the picture is another.
 */
static void modes_agree_on_fog_in_a_globe(void **state)
{
#define LAMP(inside)                                                                               \
    "camera { eye 0 0.3 -3  look_at 0 -0.2 0  fov 50 }\nrender { max_depth 40 }\n"                 \
    "material m { kd 0.7 }\nmaterial l { emission 4 }\n" FILLED(                                   \
        inside) "sphere { centre 0 0 0  radius 0.8  material g }\n"                                \
                "sphere { centre 0 0.2 0  radius 0.2  material l }\n"                              \
                "quad { corner -0.4 -0.4 0.2  edge1 0 0.3 0  edge2 0.8 0 0  material m }\n"        \
                "quad { corner -3 -1 -3  edge1 0 0 6  edge2 6 0 0  material m }\n"
    static const char fog[] = LAMP("scattering 2 1 0.5  absorption 0.1 0.2 0.4");
    double exact[3], means[3];
    (void)state;
    render_means(exact, fog, (rt_render_options){.spp = 512, .max_depth = 12});
    render_means(
        means, fog,
        (rt_render_options){
            .mode = RT_MODE_PHOTON, .spp = 64, .photons = 400000, .k = 100, .max_depth = 12});
    for (int c = 0; c < 3; c++)
        expect_close(means[c], exact[c], 0.03 * exact[c], "by photons");
    render_means(means, LAMP(""), (rt_render_options){.spp = 256});
    assert_true(means[0] > 1.05 * exact[0] || means[0] < 0.95 * exact[0]);
}

/* ---- What a sheet cannot have ------------------------------------------------------------ */

static void a_sheet_is_smooth_and_clear(void **state)
{
    static const struct {
        const char *field;
        rt_material material;
    } wrong[] = {
        {"roughness", {.kt = {1, 1, 1}, .thin = 1, .roughness = 0.2f}},
        {"exponent", {.ks = {1, 1, 1}, .thin = 1, .exponent = 20}},
        {"coat", {.kd = {0.5f, 0.5f, 0.5f}, .thin = 1, .coat = 1}},
        {"interface", {.thin = 1, .interface = 1}},
        {"roughness", {.kt = {1, 1, 1}, .thin = 1, .roughness = 0.2f, .absorption = {1, 1, 1}}},
        {"diffuse_transmission",
         {.kt = {0.5f, 0.5f, 0.5f},
          .thin = 1,
          .diffuse_transmission = {0.5f, 0.5f, 0.5f},
          .scattering = {1, 1, 1}}},
        {"opacity", {.kt = {1, 1, 1}, .thin = 1, .opacity = 0.5f, .scattering = {1, 1, 1}}},
        {"priority", {.kt = {1, 1, 1}, .thin = 1, .priority = 1}},
        {"metal", {.thin = 1, .metal = RT_METAL_GOLD}},
        {"fresnel",
         {.ks = {1, 1, 1}, .thin = 1, .fresnel = RT_FRESNEL_CONDUCTOR, .eta = {1, 1, 1}}},
    };
    rt_scene *scene = NULL;
    rt_error error;
    (void)state;
    expect_ok(rt_scene_create(&scene, &error), &error);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_int_equal(rt_scene_add_material(scene, NULL, "m", &wrong[i].material, &error),
                         RT_ERROR_INPUT);
        assert_string_equal(error.field, wrong[i].field);
    }
    rt_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(a_pane_reflects_by_both_of_its_sides),
        statistical_test(a_pane_in_water_reflects_less),
        statistical_test(light_goes_straight_through_a_pane),
        statistical_test(a_globe_disappears_in_a_white_furnace),
        statistical_test(a_sheet_on_a_face_leaves_the_face),
        statistical_test(sheets_at_one_place_are_one),
        statistical_test(a_filled_globe_absorbs_along_its_diameter),
        statistical_test(fog_in_a_globe_disappears_in_a_white_furnace),
        statistical_test(modes_agree_on_fog_in_a_globe),
        cmocka_unit_test(nothing_is_told_of_open_sheets),
        cmocka_unit_test(an_open_sheet_that_is_filled_is_told),
        cmocka_unit_test(a_sheet_is_smooth_and_clear),
    };
    return cmocka_run_group_tests_name("lib/render/thin", tests, NULL, NULL);
}
