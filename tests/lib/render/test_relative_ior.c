/*
 * test_relative_ior.c - a boundary whose index is over that outside: nested as in other programs,
 * it is the one of two absolute indices; and in a solid of its own glass it is there, too.
 */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { width = 32, height = 24, values = 3 * width * height };

/* Glass around a core, of materials that stand at %s, on a floor with an edge of a shadow. */
static const char scene[] = "camera { eye 0 1 4  look_at 0 0.8 0  fov 40 }\n"
                            "texture tiles { pattern checker  a 0.2  b 0.8  scale 8 8 }\n"
                            "material floor { kd_texture tiles }\n%s\n"
                            "quad { corner -2 0 2  edge1 4 0 0  edge2 0 0 -4  material floor }\n"
                            "sphere { centre 0 0.8 0  radius 0.75  material glass }\n"
                            "sphere { centre 0 0.8 0  radius 0.5  material core }\n"
                            "light environment { radiance 1 0.9 0.8 }\n"
                            "light directional { direction 0.3 -1 -0.2  irradiance 2 }\n";

static const rt_render_options modes[] = {
    {.mode = RT_MODE_PATH, .spp = 64},
    {.mode = RT_MODE_VCM, .spp = 64, .radius = 0.1f},
    {.mode = RT_MODE_PHOTON, .passes = 16, .photons = 20000, .radius = 0.2f, .spp = 32}};

static void render(float out[values], const char *materials, rt_render_options options)
{
    char text[2048];
    snprintf(text, sizeof text, scene, materials);
    rt_renderer *renderer = test_renderer(text);
    rt_film *film = NULL;
    rt_error error;
    options.width = width;
    options.height = height;
    options.max_depth = 16;
    expect_ok(rt_render(&film, renderer, &options, &error), &error);
    memcpy(out, rt_film_rgb(film), values * sizeof *out);
    rt_film_destroy(film);
    rt_renderer_destroy(renderer);
}

static double mean_of(const float *rgb)
{
    double mean = 0;
    for (int i = 0; i < values; i++)
        mean += (double)rgb[i] / values;
    return mean;
}

/* The largest difference between two pictures over the mean, where they differ by rounding. */
static double difference(const char *a, const char *b, const rt_render_options *options)
{
    float first[values], second[values];
    int far = 0;
    render(first, a, *options);
    render(second, b, *options);
    for (int i = 0; i < values; i++)
        far += fabs((double)first[i] - (double)second[i]) > 0.02 * mean_of(first);
    return (double)far / values;
}

#define SMOOTH "kt 1  fresnel dielectric"
#define ROUGH "kt 1  fresnel dielectric  roughness 0.3  distribution beckmann"
#define GLASS "material glass { " SMOOTH "  ior 1.5 }\n"

static void nested_indices_are_over_each_other(void **state)
{
    static const char *const pairs[][2] = {
        {GLASS "material core { " SMOOTH "  ior 1.8 }",
         "material glass { " SMOOTH "  ior 1.5  relative_ior true }\n"
         "material core { " SMOOTH "  ior 1.2  relative_ior true }"},
        {GLASS "material core { " ROUGH "  ior 1.2 }",
         GLASS "material core { " ROUGH "  ior 0.8  relative_ior true }"},
        {GLASS "material core { kd 0.7 0.2 0.1  coat 1  coat_ior 1.8 }",
         GLASS "material core { kd 0.7 0.2 0.1  coat 1  coat_ior 1.2  relative_ior true }"},
        {GLASS "material core { ks 1  fresnel conductor  eta 1.5 0.6 0.75  k 3 2.4 1.5 }",
         GLASS "material core { ks 1  fresnel conductor  eta 1 0.4 0.5  k 2 1.6 1  "
               "relative_ior true }"}};
    (void)state;
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
        for (size_t m = 0; m < sizeof modes / sizeof *modes; m++) {
            const double far = difference(pairs[i][0], pairs[i][1], &modes[m]);
            if (far > 0.03)
                fail_msg("pair %d, mode %d: %g of the values differ", (int)i, (int)m, far);
        }
}

/* Two boundaries of glass to air, as of a shell: the same as with a core of air of its own. */
static void a_core_of_the_same_glass_has_a_boundary(void **state)
{
    float same[values], relative[values];
    (void)state;
    for (size_t m = 0; m < sizeof modes / sizeof *modes; m++) {
        render(same, GLASS "material core { " SMOOTH "  ior 1.5 }", modes[m]);
        render(relative, GLASS "material core { " SMOOTH "  ior 1.5  relative_ior true }",
               modes[m]);
        int differ = 0;
        for (int i = 0; i < values; i++)
            differ += same[i] != relative[i];
        assert_true(differ > values / 20);
    }
}

static void dispersion_of_a_relative_index(void **state)
{
    static const char absolute[] =
        GLASS "material core { kt 1  fresnel dielectric  cauchy 1.65 0.03 }",
                      relative[] = "material glass { " SMOOTH "  ior 1.5  relative_ior true }\n"
                                   "material core { kt 1  fresnel dielectric  cauchy 1.1 0.02  "
                                   "relative_ior true }";
    (void)state;
    for (size_t m = 0; m < sizeof modes / sizeof *modes; m++)
        assert_true(difference(absolute, relative, &modes[m]) < 0.03);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nested_indices_are_over_each_other),
        cmocka_unit_test(a_core_of_the_same_glass_has_a_boundary),
        cmocka_unit_test(dispersion_of_a_relative_index),
    };
    return cmocka_run_group_tests_name("relative_ior", tests, NULL, NULL);
}
