/*
 * test_inputs.c - inputs of materials that textures give: each by an even texture is the same as by
 * its value, in all modes, and a texture of two values is two materials side by side.
 */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { width = 24, height = 16, values = 3 * width * height };

/*
 * A ball and a floor of one material under an area light. What gives the input stands at %s; the
 * textures are even.
 */
static const char scene[] =
    "camera { eye 0 1 4  look_at 0 0.5 0  fov 45 }\n"
    "texture even { pattern checker  a 0.6  b 0.6 }\n"
    "texture tinted { pattern checker  a 0.2 0.3 0.4  b 0.2 0.3 0.4 }\n"
    "texture grey { pattern constant  a 0.6 }\n"
    "texture half { pattern multiply  a_texture grey  b 0.2 0.5 1 }\n"
    "texture two { pattern mix  a_texture half  b 0.6  weight_texture grey  weight 0.5 }\n"
    "texture all { pattern checker  a_texture two  b_texture two  scale 5 5 }\n"
    "material m { %s }\n"
    "material wall { kd 0.5 }\nmaterial lamp { emission 8 }\n"
    "quad { corner -2 0 2  edge1 4 0 0  edge2 0 0 -4  material m }\n"
    "quad { corner -2 0 -2  edge1 4 0 0  edge2 0 3 0  material wall }\n"
    "sphere { centre 0 0.5 0  radius 0.5  material m }\n"
    "quad { corner -0.5 2.5 -0.5  edge1 1 0 0  edge2 0 0 1  material lamp }\n";

static const rt_render_options modes[] = {
    {.mode = RT_MODE_PATH, .spp = 4},
    {.mode = RT_MODE_VCM, .spp = 4, .radius = 0.1f},
    {.mode = RT_MODE_PHOTON,
     .passes = 2,
     .photons = 4000,
     .radius = 0.2f,
     .gather_roughness = 0.2f},
    {.mode = RT_MODE_PHOTON, .photons = 4000, .k = 20, .gather_roughness = 0.2f}};
enum { mode_count = sizeof modes / sizeof *modes };

static double render(float out[values], const char *text, rt_render_options options)
{
    rt_renderer *renderer = test_renderer(text);
    rt_film *film = NULL;
    rt_error error;
    options.width = width;
    options.height = height;
    options.max_depth = 6;
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    memcpy(out, rt_film_rgb(film), values * sizeof *out);
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
    double mean = 0;
    for (int i = 0; i < values; i++)
        mean += (double)out[i] / values;
    return mean;
}

/* The root mean square of the differences of two pictures over the mean of one. */
static double difference(const float a[values], const float b[values], double mean)
{
    double sum = 0;
    for (int i = 0; i < values; i++)
        sum += ((double)a[i] - b[i]) * ((double)a[i] - b[i]);
    return sqrt(sum / values) / mean;
}

/* To what tables of facets have between their rows. */
static void expect_same(const char *one, const char *other, int is_same)
{
    char text[2][2000];
    float pictures[2][values];
    snprintf(text[0], sizeof text[0], scene, one);
    snprintf(text[1], sizeof text[1], scene, other);
    for (int m = 0; m < mode_count; m++) {
        double mean = 0;
        for (int i = 0; i < 2; i++)
            mean = render(pictures[i], text[i], modes[m]);
        const double off = difference(pictures[0], pictures[1], mean);
        if (is_same ? off > 2e-4 : off < 1e-2)
            fail_msg("%s and %s, mode %d: %g", one, other, (int)modes[m].mode, off);
    }
}

/* Of a glossy floor and ball, a metal, rough diffuse surfaces and frosted glass. */
static void an_even_texture_is_its_value(void **state)
{
    (void)state;
    expect_same("kd 0.3  ks 0.5  roughness_texture even  roughness 0.5  facet_scattering single",
                "kd 0.3  ks 0.5  roughness 0.3  facet_scattering single", 1);
    expect_same(
        "ks 1  fresnel conductor  eta 0.2  k 3  roughness_texture even  facet_scattering single",
        "ks 1  fresnel conductor  eta 0.2  k 3  roughness 0.6  facet_scattering single", 1);
    expect_same("kd 0.6  roughness_texture even", "kd 0.6  roughness 0.6", 1);
    expect_same("kd 0.2  ks 0.7  roughness 1", "kd 0.2  ks 0.7  roughness 0.99999", 1);
    expect_same("kd 0.7 0.4 0.2  coat_texture even", "kd 0.7 0.4 0.2  coat 0.6", 1);
    expect_same("kd 0.7  coat 1  coat_roughness_texture even  coat_roughness 0.5",
                "kd 0.7  coat 1  coat_roughness 0.3", 1);
    expect_same("kd 0.7  coat 1  coat_absorption_texture tinted  coat_absorption 2",
                "kd 0.7  coat 1  coat_absorption 0.4 0.6 0.8", 1);
    expect_same("ks 0.7  roughness 0.4  coat 1  coat_absorption_texture tinted",
                "ks 0.7  roughness 0.4  coat 1  coat_absorption 0.2 0.3 0.4", 1);
    expect_same("kd 0.7  fuzz_texture tinted  fuzz_roughness 0.4",
                "kd 0.7  fuzz 0.2 0.3 0.4  fuzz_roughness 0.4", 1);
    expect_same("fuzz 0.7  fuzz_roughness_texture even  fuzz_roughness 0.5",
                "fuzz 0.7  fuzz_roughness 0.3", 1);
    expect_same(
        "kt 1  fresnel dielectric  roughness_texture even  roughness 0.5  facet_scattering single",
        "kt 1  fresnel dielectric  roughness 0.3  facet_scattering single", 1);
}

/* Each number of principled materials, solids and a sheet, in all modes. */
static void an_even_texture_is_its_principled_number(void **state)
{
    static const struct {
        const char *name, *of;
        double number;
    } numbers[] = {
        {"spec_tint", "base_color 0.8 0.3 0.1  roughness 0.4", 0.6},
        {"anisotropic", "base_color 0.8 0.6 0.2  metallic 1  roughness 0.6", 0.6},
        {"sheen", "base_color 0.2 0.1 0.3  roughness 0.8", 0.6},
        {"sheen_tint", "base_color 0.3 0.05 0.1  sheen 1", 0.6},
        {"flatness", "base_color 0.8  roughness 1", 0.6},
        {"clearcoat", "base_color 0.1 0.2 0.1  roughness 0.9", 0.6},
        {"clearcoat_gloss", "base_color 0.1  roughness 0.9  clearcoat 1", 0.6},
        {"diff_trans", "base_color 0.6 0.8 0.3  roughness 0.6  thin true", 1.2},
    };
    (void)state;
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        const double number = numbers[i].number;
        char textured[200], plain[200], other[200];
        snprintf(textured, sizeof textured, "%s  %s_texture even  %s %g", numbers[i].of,
                 numbers[i].name, numbers[i].name, number / 0.6);
        snprintf(plain, sizeof plain, "%s  %s %g", numbers[i].of, numbers[i].name, number);
        snprintf(other, sizeof other, "%s  %s 0.1", numbers[i].of, numbers[i].name);
        expect_same(textured, plain, 1);
        expect_same(textured, other, 0);
    }
}

/* 0.7 of (0.12, 0.3, 0.6) and 0.3 of 0.6 in each square; the mean of the channels is 0.418. */
static void nested_textures_are_their_value(void **state)
{
    (void)state;
    expect_same("kd_texture all", "kd 0.264 0.39 0.6", 1);
    expect_same("kd 0.3  ks 0.5  roughness_texture all  roughness 0.5  facet_scattering single",
                "kd 0.3  ks 0.5  roughness 0.209  facet_scattering single", 1);
    expect_same("kd 0.7  opacity_texture all", "kd 0.7  opacity 0.418", 1);
    expect_same("kd 0.2  emission_texture all  emission 3", "kd 0.2  emission 0.792 1.17 1.8", 1);
    expect_same("kd 0.2  emission_texture all  emission 3", "kd 0.2  emission_texture all", 0);
    expect_same("kd_texture all", "kd 0.264 0.5 0.6", 0);
}

/* What is not the same is told apart. */
static void another_value_is_another_picture(void **state)
{
    (void)state;
    expect_same("kd 0.3  ks 0.5  roughness_texture even", "kd 0.3  ks 0.5  roughness 0.2", 0);
    expect_same("kd 0.7  coat_texture even", "kd 0.7  coat 0.2", 0);
    expect_same("kd 0.7 0.4 0.2  coat 1", "kd 0.7 0.4 0.2  coat 1  coat_linear true", 0);
    expect_same("kd 0.7  coat 1", "kd 0.7  coat 1  coat_ior 2", 0);
}

/* A number takes the mean of the channels, a colour each of them. */
static void numbers_take_the_mean_of_the_channels(void **state)
{
    (void)state;
    expect_same("ks 0.8  roughness_texture tinted  facet_scattering single",
                "ks 0.8  roughness 0.3  facet_scattering single", 1);
    expect_same("ks_texture tinted  roughness 0.3", "ks 0.2 0.3 0.4  roughness 0.3", 1);
    expect_same("kd_texture tinted", "kd 0.2 0.3 0.4", 1);
}

/* A colour that is too bright is an error, and so is a number. */
static void numbers_do_not_exceed_one(void **state)
{
    rt_texture texture = {.kind = RT_TEXTURE_CHECKER, .a = {2, 1, 1}, .b = {0.1f, 0.1f, 0.1f}};
    rt_material material = {.ks = {0.5f, 0.5f, 0.5f}, .roughness = 0.7f};
    rt_scene *scene = NULL;
    rt_error error;
    (void)state;
    expect_ok(rt_scene_create(&scene, &error), &error);
    expect_ok(rt_scene_add_texture(scene, &material.roughness_texture, &texture, &error), &error);
    expect_ok(rt_scene_add_material(scene, NULL, "m", &material, &error), &error);
    material.roughness = 0.8f;
    assert_int_equal(rt_scene_add_material(scene, NULL, "m", &material, &error), RT_ERROR_INPUT);
    assert_string_equal(error.field, "roughness_texture");
    rt_scene_destroy(scene);
}

/* Two quads, whose texture has one value on each, and two of one value. */
static void a_texture_of_two_values_is_two_materials(void **state)
{
    static const char both[] =
        "camera { eye 0 1 3  look_at 0 0 0  fov 45 }\n"
        "texture steps { pattern checker  a 0.1  b 0.5 }\n"
        "material first { ks 0.8  %s  facet_scattering single }\n"
        "material second { ks 0.8  %s  facet_scattering single }\n"
        "material lamp { emission 8 }\n"
        "triangle { a -1 0 1  b 0 0 1  c 0 0 -1  uva 0.1 0.1  uvb 0.2 0.1  uvc 0.2 0.2  "
        "material first }\n"
        "triangle { a 0 0 1  b 1 0 1  c 0 0 -1  uva 1.1 0.1  uvb 1.2 0.1  uvc 1.2 0.2  "
        "material second }\n"
        "sphere { centre 0 1.2 -1  radius 0.3  material lamp }\n";
    char text[2][2000];
    float pictures[2][values];
    (void)state;
    snprintf(text[0], sizeof text[0], both, "roughness_texture steps", "roughness_texture steps");
    snprintf(text[1], sizeof text[1], both, "roughness 0.1", "roughness 0.5");
    double mean = 0;
    for (int i = 0; i < 2; i++)
        mean = render(pictures[i], text[i], modes[0]);
    assert_true(difference(pictures[0], pictures[1], mean) < 1e-4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_even_texture_is_its_value),
        cmocka_unit_test(an_even_texture_is_its_principled_number),
        cmocka_unit_test(nested_textures_are_their_value),
        cmocka_unit_test(another_value_is_another_picture),
        cmocka_unit_test(numbers_take_the_mean_of_the_channels),
        cmocka_unit_test(numbers_do_not_exceed_one),
        cmocka_unit_test(a_texture_of_two_values_is_two_materials),
    };
    return cmocka_run_group_tests_name("lib/render/inputs", tests, NULL, NULL);
}
