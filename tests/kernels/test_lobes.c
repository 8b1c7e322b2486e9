/*
 * test_lobes.c - the contract that each lobe of a BSDF keeps: eval, sample, pdf_w and albedo belong
 * together.
 */
#include "support.h"

#include <math.h>
#include <stdio.h>

#include "bsdf_draw.h"
#include "statistics.h"
#include "types.h"

#define PI 3.14159265358979323846

enum { n = 1 << 16, rings = 16, sectors = 12, fine = 8 };

static lobe_draw draws[n];

#define NAME_OF(NAME, name, is_delta, is_diffuse, is_large) #name,
#define DELTA_OF(NAME, name, is_delta, is_diffuse, is_large) is_delta,
static const char *const names[] = {RT_LOBES(NAME_OF)};
static const int is_delta[] = {RT_LOBES(DELTA_OF)};

/* A material that has each of the lobes. */
static const rt_material_data materials[RT_LOBE_COUNT] = {
    [RT_LOBE_LAMBERT] = {.kd = {0.6f, 0.4f, 0.2f}},
    [RT_LOBE_OREN_NAYAR] = {.kd = {0.6f, 0.4f, 0.2f},
                            .roughness = 0.7f,
                            .diffuse_lobe = RT_LOBE_OREN_NAYAR},
    [RT_LOBE_COATED] = {.kd = {0.6f, 0.4f, 0.2f},
                        .coat = 0.8f,
                        .coat_ior = 1.5f,
                        .diffuse_lobe = RT_LOBE_COATED,
                        .flags = RT_MATERIAL_COAT},
    [RT_LOBE_TRANSLUCENT] = {.kd = {0.4f, 0.1f, 0.1f},
                             .diffuse_transmission = {0.3f, 0.7f, 0.5f},
                             .diffuse_lobe = RT_LOBE_TRANSLUCENT,
                             .flags = RT_MATERIAL_TRANSLUCENT},
    [RT_LOBE_FUZZ] = {.kd = {0.6f, 0.4f, 0.2f},
                      .fuzz = {0.5f, 0.7f, 0.9f},
                      .fuzz_roughness = 0.4f,
                      .diffuse_lobe = RT_LOBE_FUZZ},
    [RT_LOBE_PRINCIPLED_DIFFUSE] = {.kd = {0.6f, 0.4f, 0.2f},
                                    .roughness = 0.7f,
                                    .ior = 1.5f,
                                    .diffuse_lobe = RT_LOBE_PRINCIPLED_DIFFUSE,
                                    .flags = RT_MATERIAL_PRINCIPLED},
    [RT_LOBE_PRINCIPLED] = {.kd = {0.6f, 0.4f, 0.2f},
                            .ks = {0.3f, 0.3f, 0.3f},
                            .kt = {0.8f, 0.8f, 0.8f},
                            .roughness = 0.6f,
                            .ior = 1.5f,
                            .clearcoat = 0.6f,
                            .spec_tint = 0.4f,
                            .diffuse_lobe = RT_LOBE_PRINCIPLED_DIFFUSE,
                            .flags = RT_MATERIAL_PRINCIPLED | RT_MATERIAL_FRESNEL},
    [RT_LOBE_SPECULAR_REFLECTION] = {.ks = {0.4f, 0.3f, 0.2f}, .kt = {0.5f, 0.5f, 0.4f}},
    [RT_LOBE_SPECULAR_TRANSMISSION] = {.ks = {0.4f, 0.3f, 0.2f}, .kt = {0.5f, 0.5f, 0.4f}},
    [RT_LOBE_GGX] = {.ks = {0.4f, 0.3f, 0.2f}, .kt = {0.5f, 0.5f, 0.4f}, .roughness = 0.4f},
    [RT_LOBE_LACQUER] = {.kd = {0.2f, 0.1f, 0.3f},
                         .ks = {0.7f, 0.6f, 0.5f},
                         .roughness = 0.05f,
                         .coat = 0.8f,
                         .coat_roughness = 0.1f,
                         .coat_ior = 1.5f,
                         .diffuse_lobe = RT_LOBE_COATED,
                         .flags = RT_MATERIAL_COAT | RT_MATERIAL_LACQUER},
    [RT_LOBE_PHONG] = {.ks = {0.4f, 0.3f, 0.2f}, .exponent = 9, .flags = RT_MATERIAL_PHONG},
};

/* Seen at 50 degrees from above; the shading normal leans 10 degrees where it is bent. */
static situation seen(int is_bent)
{
    situation s = {{0, 0, 1, 0}, {0, 0, 1, 0}, {0.76604444f, 0, 0.64278761f},
                   1 / 1.5f,     {1, 1, 1},    1};
    if (is_bent) {
        s.shading[1] = 0.17364818f;
        s.shading[2] = 0.98480775f;
    }
    return s;
}

static void each_lobe_has_a_material_here(void **state)
{
    (void)state;
    for (uint32_t lobe = 0; lobe < RT_LOBE_COUNT; lobe++)
        if (!(materials[lobe].kd[0] + materials[lobe].ks[0] + materials[lobe].kt[0] > 0))
            fail_msg("no material has the lobe %s", names[lobe]);
}

static void delta_lobes_have_no_density(void **state)
{
    const situation at = seen(0);
    (void)state;
    for (uint32_t lobe = 0; lobe < RT_LOBE_COUNT; lobe++) {
        if (!is_delta[lobe])
            continue;
        draw_lobe(materials + lobe, &at, lobe, 1, n, draws);
        for (int i = 0; i < n; i++) {
            const lobe_draw *d = draws + i;
            assert_true(d->pdf_w == 0 && d->pdf_w_alone == 0 && d->eval_pdf_w == 0);
            for (int c = 0; c < 3; c++)
                assert_true(d->eval[c] == 0 && d->weight[c] == d->albedo[c] && d->weight[c] > 0);
        }
    }
}

/*
 * weight = fr |n.wi| / pdf_w of what is evaluated there; refracted radiance is scaled by eta^2,
 * what is scattered evenly to the other side is not.
 */
static void a_sample_weighs_what_is_evaluated(void **state)
{
    (void)state;
    for (uint32_t lobe = 0; lobe < RT_LOBE_COUNT; lobe++)
        for (int is_bent = 0; is_bent < 2 && !is_delta[lobe]; is_bent++) {
            const situation at = seen(is_bent);
            int compared = 0;
            draw_lobe(materials + lobe, &at, lobe, 2, n, draws);
            for (int i = 0; i < n; i++) {
                const lobe_draw *d = draws + i;
                const int is_refracted = d->through > 0 && lobe != RT_LOBE_TRANSLUCENT;
                const double eta_scale = is_refracted ? 1 / 2.25 : 1;
                assert_true(d->pdf_w_alone == d->eval_pdf_w);
                if (d->weight[0] == 0 || d->pdf_w < 1e-3)
                    continue;
                compared++;
                assert_float_equal(d->pdf_w, d->eval_pdf_w, 1e-2 * d->pdf_w);
                for (int c = 0; c < 3; c++)
                    assert_float_equal(d->weight[c] * d->pdf_w * eta_scale, d->eval[c],
                                       1e-2 * d->eval[c]);
            }
            if (compared < n / 2)
                fail_msg("%s: only %d samples have a weight", names[lobe], compared);
        }
}

/* What Phong's lobe of ks 1 reflects, by the midpoint rule over cosine and azimuth. */
static double phong_reflectance(const float wo[3], double n)
{
    enum { steps = 1000 };
    double sum = 0;
    for (int i = 0; i < steps; i++)
        for (int j = 0; j < steps; j++) {
            const double z = (i + 0.5) / steps,
                         x = sqrt(1 - z * z) * cos(2 * PI * (j + 0.5) / steps);
            const double cosine = wo[2] * z - wo[0] * x; /* to the mirror direction, wo.y = 0 */
            sum += cosine > 0 ? z * pow(cosine, n) : 0;
        }
    return sum * (n + 2) / ((double)steps * steps);
}

/*
 * GGX and principled facets, and those of a lacquer, lose the light that meets two of them, Phong's
 * lobe what would go down; others lose none.
 */
static void the_mean_weight_is_the_albedo(void **state)
{
    static double values[n];
    const situation at = seen(0);
    (void)state;
    for (uint32_t lobe = 0; lobe < RT_LOBE_COUNT; lobe++) {
        const double kept =
            lobe == RT_LOBE_PHONG ? phong_reflectance(at.wo, materials[lobe].exponent) : 1;
        draw_lobe(materials + lobe, &at, lobe, 3, n, draws);
        for (int c = 0; c < 3; c++) {
            double mean = 0;
            for (int i = 0; i < n; i++)
                mean += (values[i] = draws[i].weight[c]) / n;
            if (lobe == RT_LOBE_GGX || lobe == RT_LOBE_PRINCIPLED || lobe == RT_LOBE_LACQUER)
                assert_true(mean < draws[0].albedo[c] && mean > 0.8 * draws[0].albedo[c]);
            else
                expect_mean(values, n, draws[0].albedo[c] * kept, 1e-6, names[lobe]);
        }
    }
}

/* ---- Directions ---------------------------------------------------------------- */

static int cell_of(const float wi[3])
{
    const int ring = (int)((0.5 + 0.5 * wi[2]) * rings);
    const int sector = (int)((atan2(wi[1], wi[0]) / (2 * PI) + 0.5) * sectors);
    return (ring < rings ? ring : rings - 1) * sectors + (sector < sectors ? sector : sectors - 1);
}

/* Integrals of the density over the cells, by the midpoint rule on `fine` by `fine` points each. */
static void integrate_density(double *out, uint32_t lobe, const situation *at)
{
    enum { points = rings * sectors * fine * fine };
    static situation situations[points];
    static float wi[points][4], values[points][4];
    for (int i = 0; i < points; i++) {
        const int cell = i / (fine * fine), x = i % fine, y = i / fine % fine;
        situations[i] = *at;
        direction_at(wi[i], 2 * (cell / sectors + (x + 0.5) / fine) / rings - 1,
                     (cell % sectors + (y + 0.5) / fine) / sectors - 0.5);
    }
    evaluate_lobe(materials + lobe, situations, (const float(*)[4])wi, lobe, points, values);
    for (int cell = 0; cell < rings * sectors; cell++)
        out[cell] = 0;
    for (int i = 0; i < points; i++)
        out[i / (fine * fine)] += values[i][3] * 4 * PI / points;
}

/* Half a count per cell is allowed: the error of the midpoint rule is less. */
static void directions_come_as_their_density_says(void **state)
{
    static uint32_t counts[rings * sectors];
    static double expected[rings * sectors];
    const situation at = seen(0);
    (void)state;
    for (uint32_t lobe = 0; lobe < RT_LOBE_COUNT; lobe++) {
        if (is_delta[lobe])
            continue;
        integrate_density(expected, lobe, &at);
        draw_lobe(materials + lobe, &at, lobe, 4, n, draws);
        for (int cell = 0; cell < rings * sectors; cell++) {
            counts[cell] = 0;
            expected[cell] *= n;
        }
        for (int i = 0; i < n; i++)
            counts[cell_of(draws[i].wi)] += draws[i].pdf_w > 0;
        expect_counts(counts, expected, rings * sectors, names[lobe]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_lobe_has_a_material_here),
        cmocka_unit_test(delta_lobes_have_no_density),
        cmocka_unit_test(a_sample_weighs_what_is_evaluated),
        statistical_test(the_mean_weight_is_the_albedo),
        statistical_test(directions_come_as_their_density_says),
    };
    return cmocka_run_group_tests_name("kernels/lobes", tests, NULL, NULL);
}
