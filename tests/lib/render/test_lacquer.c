/*
 * test_lacquer.c - coats over ks in whole renders: a mirror and facets below one by the closed
 * form, a white furnace that stays white, and modes that agree in a room.
 */
#include "support.h"

#include <math.h>

#include "kernels/statistics.h"
#include "lib/render/means.h"

#define PI 3.14159265358979323846

static const double m = 1.6, amount = 0.8; /* of the coat: index, and part that it covers */

static double reflectance(double cosine, double *below)
{
    *below = sqrt(1 - (1 - cosine * cosine) / (m * m));
    const double s = (cosine - m * *below) / (cosine + m * *below),
                 p = (m * cosine - *below) / (m * cosine + *below);
    return (s * s + p * p) / 2;
}

/* ---- A mirror below a coat --------------------------------------------------------- */

static const char mirror[] = "camera { eye 0 1.2 2  look_at 0 0 0  fov 1 }\n"
                             "material m { kd 0.1  ks 0.7 0.4 0.2  coat 0.8  coat_ior 1.6\n"
                             "    coat_absorption 0 0.2 0.5 }\n"
                             "quad { corner -9 0 -9  edge1 0 0 18  edge2 18 0 0  material m }\n"
                             "light environment { radiance 1 }\n";

static void a_mirror_reflects_by_the_sum_over_what_goes_to_and_fro(void **state)
{
    static const double ks[3] = {0.7, 0.4, 0.2}, depths[3] = {0, 0.2, 0.5};
    const double cosine = 1.2 / sqrt(1.2 * 1.2 + 2 * 2);
    double means[3], below;
    const double f = reflectance(cosine, &below);
    enum { steps = 1 << 14 };
    (void)state;
    render_means(means, mirror, (rt_render_options){.spp = 256});
    for (int c = 0; c < 3; c++) {
        double inner = 0, leaves = 0, unused;
        for (int i = 0; i < steps; i++) {
            /* From below: what is refracted by no angle, or as much as from above. */
            const double z2 = (i + 0.5) / steps, out2 = 1 - m * m * (1 - z2);
            const double thrown_back = out2 > 0 ? reflectance(sqrt(out2), &unused) : 1;
            inner += thrown_back * exp(-2 * depths[c] / sqrt(z2)) / steps;
            leaves += (1 - thrown_back) * exp(-depths[c] / sqrt(z2)) / steps;
        }
        const double base = ks[c] + 0.1, left = exp(-depths[c] / below);
        const double seen =
            f + (1 - f) * (1 - f) * left * left * ks[c] / (1 - f * left * left * base);
        const double diffuse = 0.1 * (1 - f) * left * leaves / (1 - inner * base);
        const double expected = amount * (seen + diffuse) + (1 - amount) * base;
        expect_close(means[c], expected, 2e-3 * expected, "by paths");
    }
}

/* ---- Facets below a coat ------------------------------------------------------------ */

/* Lit by a spot at 59 degrees, and seen from 62 degrees, so that they almost mirror it. */
static const char facets[] =
    "camera { eye -3 1.6 0  look_at 0 0 0  fov 0.5 }\n"
    "material m { ks 0.9 0.6 0.2  roughness 0.3  coat 0.8  coat_ior 1.6  facet_scattering single\n"
    "    coat_absorption 0.3 0.1 0 }\n"
    "quad { corner -9 0 -9  edge1 0 0 18  edge2 18 0 0  material m }\n"
    "light spot { position 3 1.8 0  target 0 0 0  intensity 10  inner 6  outer 7 }\n";

/* What facets of GGX of alpha 0.3 reflect in the plane of both, per unit of cosine (Heitz 2014). */
static double facets_fr(double cos_o, double cos_i)
{
    const double alpha2 = 0.3 * 0.3, o = acos(cos_o), i = acos(cos_i), h = fabs(o - i) / 2;
    const double t2 = tan(h) * tan(h) / alpha2,
                 d = 1 / (PI * alpha2 * pow(cos(h), 4) * (1 + t2) * (1 + t2));
    const double lo = (sqrt(1 + alpha2 * tan(o) * tan(o)) - 1) / 2,
                 li = (sqrt(1 + alpha2 * tan(i) * tan(i)) - 1) / 2;
    return d / ((1 + lo + li) * 4 * cos_o * cos_i);
}

static void light_goes_through_a_coat_to_facets_by_the_definition(void **state)
{
    static const double ks[3] = {0.9, 0.6, 0.2}, depths[3] = {0.3, 0.1, 0};
    const double d2 = 3 * 3 + 1.8 * 1.8, cos_i = 1.8 / sqrt(d2),
                 cos_o = 1.6 / sqrt(1.6 * 1.6 + 3 * 3);
    double means[3], vcm[3], below_o, below_i;
    const double fo = reflectance(cos_o, &below_o), fi = reflectance(cos_i, &below_i);
    (void)state;
    render_means(means, facets, (rt_render_options){.spp = 64, .max_depth = 2});
    render_means(vcm, facets, (rt_render_options){.mode = RT_MODE_VCM, .spp = 16, .max_depth = 2});
    for (int c = 0; c < 3; c++) {
        const double left = exp(-depths[c] * (1 / below_o + 1 / below_i));
        const double passes =
            (1 - fo) * (1 - fi) * left / (m * m * (1 - fmin(fo, fi) * left * ks[c]));
        const double fr = ks[c] * (amount * passes * facets_fr(below_o, below_i) +
                                   (1 - amount) * facets_fr(cos_o, cos_i));
        const double expected = fr * cos_i * 10 / d2;
        expect_close(means[c], expected, 3e-3 * expected, "by paths");
        expect_close(vcm[c], expected, 1e-2 * expected, "by vertex connection and merging");
    }
}

/* ---- A white furnace --------------------------------------------------------------- */

#define FURNACE(more)                                                                              \
    "camera { eye 0 0 -3  look_at 0 0 0  fov 20 }\nlight environment { radiance 1 }\n"             \
    "material m { " more " }\nsphere { centre 0 0 0  radius 0.8  material m }\n"

static void white_disappears_in_a_white_furnace(void **state)
{
    static const char *const coats[] = {
        FURNACE("ks 1  roughness 0.05  coat 1"),
        FURNACE("ks 1  roughness 0.5  coat 0.6  coat_ior 1.3"),
        FURNACE("ks 1  roughness 1  coat 1  coat_roughness 0.1  coat_ior 2"),
        FURNACE("ks 1  coat 1  coat_roughness 0.6"),
        FURNACE("kd 0.5  ks 0.5  roughness 0.3  coat 1  coat_roughness 0.3"),
        FURNACE("ks 1  roughness 0.6  roughness_v 0.1  coat 1"),
        FURNACE("ks 1  roughness 0.4  distribution beckmann  coat 1  coat_roughness 0.2"),
        FURNACE("ks 1  roughness 0.6  coat 1  coat_roughness 0.6  coat_ior 2.5"),
        "texture t { pattern gradient  a 0.2  b 1 }\n" FURNACE(
            "ks 1  roughness 0.9  roughness_texture t  coat 1"),
        "texture t { pattern gradient  a 0.2  b 1 }\n" FURNACE(
            "ks 1  roughness 0.2  coat 1  coat_roughness 0.9  coat_roughness_texture t")};
    double means[3];
    (void)state;
    for (size_t i = 0; i < sizeof coats / sizeof *coats; i++) {
        render_means(means, coats[i], (rt_render_options){.spp = 256, .max_depth = 32});
        expect_close(means[0], 1, 2e-3, "by paths");
        render_means(means, coats[i],
                     (rt_render_options){.mode = RT_MODE_VCM, .spp = 64, .max_depth = 32});
        expect_close(means[0], 1, 4e-3, "by vertex connection and merging");
    }
}

/* Facets of alpha 1 are almost as a diffuse base, whose light meets them less often. */
static void the_roughest_facets_are_as_a_diffuse_base(void **state)
{
    double facets[3], diffuse[3];
    (void)state;
    render_means(facets, FURNACE("ks 0.9  roughness 1  coat 1  coat_roughness 1  coat_ior 3"),
                 (rt_render_options){.spp = 64, .max_depth = 32});
    render_means(diffuse, FURNACE("kd 0.9  coat 1  coat_roughness 1  coat_ior 3"),
                 (rt_render_options){.spp = 64, .max_depth = 32});
    if (!(facets[0] < diffuse[0] && facets[0] > 0.9 * diffuse[0]))
        fail_msg("%g of facets, %g of a diffuse base", facets[0], diffuse[0]);
}

/* ---- A room -------------------------------------------------------------------------- */

/* A ball of lacquered gold, and a wall of paint and flakes below a rough coat, around a lamp. */
static const char room[] =
    "camera { eye 0 0.1 1.9  look_at 0 -0.1 0  fov 50 }\n"
    "material wall { kd 0.3 0.3 0.2  ks 0.4 0.3 0.2  roughness 0.4  coat 0.7  coat_roughness 0.3 "
    "}\n"
    "material ball { metal gold  roughness 0.3  coat 1  coat_ior 1.7  coat_absorption 0 0.2 0.4 }\n"
    "material lamp { emission 5 }\n"
    "box { centre 0 0 0  size 2 2 4  material wall }\n"
    "sphere { centre 0.2 -0.5 -0.2  radius 0.5  material ball }\n"
    "quad { corner -0.4 0.95 -0.4  edge1 0.8 0 0  edge2 0 0 0.8  material lamp }\n";

static void modes_agree_in_a_room(void **state)
{
    (void)state;
    expect_modes_agree(room);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(a_mirror_reflects_by_the_sum_over_what_goes_to_and_fro),
        statistical_test(light_goes_through_a_coat_to_facets_by_the_definition),
        statistical_test(white_disappears_in_a_white_furnace),
        cmocka_unit_test(the_roughest_facets_are_as_a_diffuse_base),
        statistical_test(modes_agree_in_a_room),
    };
    return cmocka_run_group_tests_name("lib/render/lacquer", tests, NULL, NULL);
}
