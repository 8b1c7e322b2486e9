/*
 * test_principled.c - principled materials scatter what Mitsuba 3.9.1 evaluates for `principled`
 * and `principledthin` of the same numbers; their directions come as the density says, for sheets
 * and solids, from outside and inside.
 */
#include <math.h>
#include <string.h>

#include "bsdf_draw.h"
#include "statistics.h"
#include "support.h"

#define PI 3.14159265358979323846
#define ALL(v)                                                                                     \
    {                                                                                              \
        v, v, v                                                                                    \
    }
#define PRINCIPLED .diffuse_lobe = RT_LOBE_PRINCIPLED_DIFFUSE, .facet_turn = {1, 0}
#define FLAGS(more) .flags = RT_MATERIAL_PRINCIPLED | (more)

/* kd is base_color, ks metallic and kt spec_trans. */
static const rt_material_data materials[] = {
    {PRINCIPLED, FLAGS(0), .kd = {0.8f, 0.1f, 0.1f}, .roughness = 0.5f, .ior = 1.5f},
    {PRINCIPLED, FLAGS(0), .kd = {0.2f, 0.4f, 0.8f}, .ks = ALL(0.5f), .roughness = 0.2f,
     .spec_tint = 0.7f, .ior = 1.5f},
    {PRINCIPLED, FLAGS(RT_MATERIAL_ANISOTROPIC), .kd = {0.9f, 0.65f, 0.2f}, .ks = ALL(1),
     .roughness = 0.8f, .anisotropic = 0.8f, .ior = 1.5f},
    {PRINCIPLED, FLAGS(0), .kd = {0.1f, 0.3f, 0.15f}, .roughness = 0.8f, .clearcoat = 1,
     .clearcoat_gloss = 0.2f, .ior = 1.5f},
    {PRINCIPLED, FLAGS(0), .kd = {0.4f, 0.1f, 0.3f}, .roughness = 0.9f, .sheen = 1,
     .sheen_tint = 0.6f, .ior = 1.3f},
    {PRINCIPLED, FLAGS(0), .kd = {0.7f, 0.6f, 0.4f}, .flatness = 0.7f, .roughness = 0.6f,
     .ior = 1.8f},
    {PRINCIPLED, FLAGS(RT_MATERIAL_FRESNEL), .kd = {0.9f, 0.5f, 0.2f}, .ks = ALL(0.2f),
     .kt = ALL(0.7f), .roughness = 0.7f, .ior = 1.33f},
    {PRINCIPLED, FLAGS(RT_MATERIAL_THIN | RT_MATERIAL_ANISOTROPIC), .kd = {0.3f, 0.5f, 0.9f},
     .kt = ALL(0.6f), .roughness = 0.7f, .anisotropic = 0.6f, .spec_tint = 0.8f, .diff_trans = 0.5f,
     .sheen = 0.5f, .flatness = 0.3f, .ior = 1.8f},
};
enum { glass = 6, sheet = 7, material_count = 8 };

/* fr |n.wi| as Mitsuba's eval gives it, for what it calls wi, our wo, and wo, our wi. */
static const struct peer {
    int material;
    float wo[3], wi[3], value[3];
} peers[] = {
    {0,
     {0.120386, 0.240772, 0.963087},
     {-0.390567, 0.130189, 0.911322},
     {0.247512, 0.044453, 0.044453}},
    {0,
     {0.824163, 0.137361, 0.549442},
     {-0.680414, -0.272166, 0.680414},
     {0.243366, 0.0921307, 0.0921307}},
    {0,
     {0.884652, -0.147442, 0.442326},
     {0.811107, 0.486664, 0.324443},
     {0.0895953, 0.0116653, 0.0116653}},
    {1,
     {0.120386, 0.240772, 0.963087},
     {-0.390567, 0.130189, 0.911322},
     {0.0334491, 0.0666624, 0.133089}},
    {1,
     {0.824163, 0.137361, 0.549442},
     {-0.680414, -0.272166, 0.680414},
     {0.061422, 0.117742, 0.230383}},
    {1,
     {0.884652, -0.147442, 0.442326},
     {0.811107, 0.486664, 0.324443},
     {0.0100896, 0.0201768, 0.0403511}},
    {2,
     {0.120386, 0.240772, 0.963087},
     {-0.390567, 0.130189, 0.911322},
     {0.10356, 0.0747934, 0.0230134}},
    {2,
     {0.824163, 0.137361, 0.549442},
     {-0.680414, -0.272166, 0.680414},
     {0.136439, 0.0988609, 0.0312198}},
    {2,
     {0.884652, -0.147442, 0.442326},
     {0.811107, 0.486664, 0.324443},
     {0.104643, 0.0755755, 0.023254}},
    {3,
     {0.120386, 0.240772, 0.963087},
     {-0.390567, 0.130189, 0.911322},
     {0.0448099, 0.102827, 0.0593141}},
    {3,
     {0.824163, 0.137361, 0.549442},
     {-0.680414, -0.272166, 0.680414},
     {0.0520827, 0.0955136, 0.0629404}},
    {3,
     {0.884652, -0.147442, 0.442326},
     {0.811107, 0.486664, 0.324443},
     {0.0142401, 0.0387755, 0.020374}},
    {4,
     {0.120386, 0.240772, 0.963087},
     {-0.390567, 0.130189, 0.911322},
     {0.117973, 0.0309475, 0.0889645}},
    {4,
     {0.824163, 0.137361, 0.549442},
     {-0.680414, -0.272166, 0.680414},
     {0.10056, 0.0300544, 0.0770583}},
    {4,
     {0.884652, -0.147442, 0.442326},
     {0.811107, 0.486664, 0.324443},
     {0.0514969, 0.0135288, 0.0388408}},
    {5,
     {0.120386, 0.240772, 0.963087},
     {-0.390567, 0.130189, 0.911322},
     {0.182833, 0.160589, 0.116101}},
    {5,
     {0.824163, 0.137361, 0.549442},
     {-0.680414, -0.272166, 0.680414},
     {0.230105, 0.208303, 0.164699}},
    {5,
     {0.884652, -0.147442, 0.442326},
     {0.811107, 0.486664, 0.324443},
     {0.104052, 0.0894582, 0.0602711}},
    {6,
     {0.120386, 0.240772, 0.963087},
     {-0.390567, 0.130189, 0.911322},
     {0.110403, 0.0630767, 0.0275818}},
    {6,
     {0.824163, 0.137361, 0.549442},
     {-0.680414, -0.272166, 0.680414},
     {0.137099, 0.0819376, 0.0405667}},
    {6,
     {0.884652, -0.147442, 0.442326},
     {0.811107, 0.486664, 0.324443},
     {0.0323636, 0.0182249, 0.00762083}},
    {6,
     {0.120386, 0.240772, 0.963087},
     {-0.272166, -0.136083, -0.952579},
     {0.614089, 0.457715, 0.289484}},
    {6,
     {0.390567, 0.130189, -0.911322},
     {-0.240772, 0.120386, 0.963087},
     {0.235762, 0.175727, 0.111139}},
    {6,
     {-0.267261, 0.534522, -0.801784},
     {0.341882, -0.227921, -0.911685},
     {0.00446675, 0.00446675, 0.00446675}},
    {7,
     {0.120386, 0.240772, 0.963087},
     {-0.390567, 0.130189, 0.911322},
     {0.0300722, 0.0488553, 0.0864213}},
    {7,
     {0.824163, 0.137361, 0.549442},
     {-0.680414, -0.272166, 0.680414},
     {0.0346319, 0.0533524, 0.0907934}},
    {7,
     {0.884652, -0.147442, 0.442326},
     {0.811107, 0.486664, 0.324443},
     {0.0148009, 0.024096, 0.0426862}},
    {7,
     {0.120386, 0.240772, 0.963087},
     {-0.272166, -0.136083, -0.952579},
     {0.116943, 0.194905, 0.350829}},
    {7,
     {0.390567, 0.130189, -0.911322},
     {-0.240772, 0.120386, 0.963087},
     {0.0808416, 0.134736, 0.242525}},
    {7,
     {-0.267261, 0.534522, -0.801784},
     {0.341882, -0.227921, -0.911685},
     {0.0326357, 0.0527039, 0.0928403}},
};

/* Of a solid that transmits eta is that of its boundary, else that on the side of wo. */
static situation seen_along(int material, const float wo[3])
{
    situation s = {{0, 0, 1, 0}, {0, 0, 1, 0}, {0, 0, 0}, 1, {1, 1, 1}, 1};
    memcpy(s.wo, wo, sizeof s.wo);
    if (material == glass)
        s.eta = wo[2] > 0 ? 1 / materials[material].ior : materials[material].ior;
    return s;
}

static void light_is_that_of_mitsuba(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof peers / sizeof *peers; i++) {
        const struct peer *p = peers + i;
        const situation at = seen_along(p->material, p->wo);
        const float wi[1][4] = {{p->wi[0], p->wi[1], p->wi[2], 0}};
        bsdf_value value;
        evaluate_scatter(materials + p->material, &at, wi, 1, &value);
        for (int c = 0; c < 3; c++)
            if (!(fabs(value.diffuse[c] + value.rough[c] - p->value[c]) <
                  1e-4 * p->value[c] + 1e-6))
                fail_msg("row %zu, channel %d: %g, and not %g", i, c,
                         value.diffuse[c] + value.rough[c], p->value[c]);
    }
}

/* ---- Directions ------------------------------------------------------------------------- */

enum { n = 1 << 16, rings = 16, sectors = 12, fine = 8, points = rings * sectors * fine * fine };

static int cell_of(const float wi[3])
{
    const int ring = (int)((0.5 + 0.5 * wi[2]) * rings);
    const int sector = (int)((atan2(wi[1], wi[0]) / (2 * PI) + 0.5) * sectors);
    return (ring < rings ? ring : rings - 1) * sectors + (sector < sectors ? sector : sectors - 1);
}

/* Integrals over the cells, by the midpoint rule, which misses corners of lobes, times n. */
static void expect_of_density(double expected[rings * sectors], int material, const situation *at)
{
    static situation situations[points];
    static float wi[points][4], values[points][4];
    for (int i = 0; i < points; i++) {
        const int cell = i / (fine * fine), x = i % fine, y = i / fine % fine;
        situations[i] = *at;
        direction_at(wi[i], 2 * (cell / sectors + (x + 0.5) / fine) / rings - 1,
                     (cell % sectors + (y + 0.5) / fine) / sectors - 0.5);
    }
    evaluate_lobe(materials + material, situations, (const float(*)[4])wi, RT_LOBE_PRINCIPLED,
                  points, values);
    for (int cell = 0; cell < rings * sectors; cell++)
        expected[cell] = 1e-3;
    for (int i = 0; i < points; i++)
        expected[i / (fine * fine)] += values[i][3] * 4 * PI / points * n;
}

static void directions_come_as_their_density_says(void **state)
{
    static const float wo[][3] = {{0.48f, 0.36f, 0.8f}, {0.64f, -0.48f, 0.6f}, {0.6f, 0, -0.8f}};
    static lobe_draw draws[n];
    static uint32_t counts[rings * sectors];
    static double expected[rings * sectors];
    (void)state;
    for (int m = 2; m < material_count; m++)
        for (int view = 0; view < (m >= glass ? 3 : 2); view++) {
            const situation at = seen_along(m, wo[view]);
            expect_of_density(expected, m, &at);
            for (uint32_t seed = 1; seed <= 3; seed++) {
                draw_lobe(materials + m, &at, RT_LOBE_PRINCIPLED, seed, n, draws);
                memset(counts, 0, sizeof counts);
                for (int i = 0; i < n; i++)
                    counts[cell_of(draws[i].wi)] += draws[i].pdf_w > 0;
                expect_counts(counts, expected, rings * sectors, "a principled lobe");
            }
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_is_that_of_mitsuba),
        statistical_test(directions_come_as_their_density_says),
    };
    return cmocka_run_group_tests_name("kernels/principled", tests, NULL, NULL);
}
