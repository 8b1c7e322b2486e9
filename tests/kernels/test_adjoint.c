/*
 * test_adjoint.c - flux is scattered by the adjoint of what scatters radiance, however far the
 * shading normal leans.
 *
 * With the directions c in which radiance leaves and l from which it arrives, both by the cosine to
 * the geometric normal, the mean of a(c) f(c, l) b(l) is that of camera paths, which draw l from c,
 * and that of light paths, which draw c from l. a and b are 1 in a cell of directions and 0 in the
 * others, for all pairs of cells.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bsdf_draw.h"
#include "statistics.h"
#include "support.h"

#define PI 3.14159265358979323846

enum { n = 1 << 16, cells = 8 };

static exchange_draw draws[n];

static const struct surface {
    const char *name;
    double least; /* of the light that it keeps where no normal leans: all lobes together */
    rt_material_data material;
} surfaces[] = {
    {"lambert", 0.69, {.kd = {0.7f}}},
    {"oren_nayar", 0.65, {.kd = {0.7f}, .roughness = 0.8f, .diffuse_lobe = RT_LOBE_OREN_NAYAR}},
    {"mirror", 0.79, {.ks = {0.8f}}},
    {"glass", 0.99, {.kt = {1}, .ior = 1.5f, .flags = RT_MATERIAL_FRESNEL}},
    {"half mirror, shadowed",
     0.88,
     {.ks = {0.4f}, .kt = {0.5f}, .ior = 1.5f, .flags = RT_MATERIAL_SHADOWED}},
    {"thin sheet", 0.99, {.kt = {1}, .ior = 1.5f, .flags = RT_MATERIAL_FRESNEL | RT_MATERIAL_THIN}},
    {"ggx", 0.6, {.ks = {0.8f}, .roughness = 0.4f}},
    {"glossy", 0.75, {.ks = {0.8f}, .roughness = 0.08f}},
    {"frosted", 0.85, {.kt = {1}, .roughness = 0.3f, .ior = 1.5f, .flags = RT_MATERIAL_FRESNEL}},
    {"brushed",
     0.6,
     {.ks = {0.8f},
      .roughness = 0.15f,
      .roughness_v = 0.5f,
      .facet_turn = {0.8f, 0.6f},
      .flags = RT_MATERIAL_ANISOTROPIC}},
    {"frosted, of Beckmann's facets by direction",
     0.85,
     {.kt = {1},
      .roughness = 0.4f,
      .roughness_v = 0.15f,
      .facet_turn = {0.8f, 0.6f},
      .ior = 1.5f,
      .flags = RT_MATERIAL_FRESNEL | RT_MATERIAL_BECKMANN | RT_MATERIAL_ANISOTROPIC}},
    {"frosted, masked and shadowed independently",
     0.8,
     {.kt = {1},
      .roughness = 0.35f,
      .ior = 1.5f,
      .flags = RT_MATERIAL_FRESNEL | RT_MATERIAL_SEPARABLE}},
    {"satin on paint",
     0.44,
     {.kd = {0.3f, 0.3f, 0.3f},
      .ks = {0.6f, 0.6f, 0.6f},
      .roughness = 0.3f,
      .eta = {1.5f, 1.5f, 1.5f},
      .k = {1.5f, 1.5f, 1.5f},
      .flags = RT_MATERIAL_CONDUCTOR}},
    {"frosted, of nearly the index outside",
     0.8,
     {.kt = {1}, .roughness = 0.3f, .ior = 1.005f, .flags = RT_MATERIAL_FRESNEL}},
    {"phong", 0.4, {.ks = {0.8f}, .exponent = 20, .flags = RT_MATERIAL_PHONG}},
    {"principled",
     0.5,
     {.kd = {0.7f, 0.7f, 0.7f},
      .ks = {0.4f, 0.4f, 0.4f},
      .roughness = 0.5f,
      .ior = 1.5f,
      .spec_tint = 0.5f,
      .sheen = 0.8f,
      .flatness = 0.4f,
      .clearcoat = 0.7f,
      .diffuse_lobe = RT_LOBE_PRINCIPLED_DIFFUSE,
      .flags = RT_MATERIAL_PRINCIPLED}},
    {"principled glass",
     0.6,
     {.kd = {0.9f, 0.9f, 0.9f},
      .ks = {0.2f, 0.2f, 0.2f},
      .kt = {0.8f, 0.8f, 0.8f},
      .roughness = 0.5f,
      .ior = 1.5f,
      .anisotropic = 0.6f,
      .clearcoat = 0.5f,
      .facet_turn = {0.8f, 0.6f},
      .diffuse_lobe = RT_LOBE_PRINCIPLED_DIFFUSE,
      .flags = RT_MATERIAL_PRINCIPLED | RT_MATERIAL_FRESNEL | RT_MATERIAL_ANISOTROPIC}},
    {"principled sheet",
     0.5,
     {.kd = {0.8f, 0.8f, 0.8f},
      .kt = {0.6f, 0.6f, 0.6f},
      .roughness = 0.6f,
      .ior = 1.5f,
      .diff_trans = 0.8f,
      .sheen = 0.5f,
      .diffuse_lobe = RT_LOBE_PRINCIPLED_DIFFUSE,
      .flags = RT_MATERIAL_PRINCIPLED | RT_MATERIAL_THIN}},
    {"lambert and mirror", 0.88, {.kd = {0.4f}, .ks = {0.5f}}},
    {"lambert and ggx, shadowed",
     0.7,
     {.kd = {0.4f}, .ks = {0.5f}, .roughness = 0.5f, .flags = RT_MATERIAL_SHADOWED}},
    {"fuzz",
     0.72,
     {.kd = {0.7f}, .fuzz = {0.8f}, .fuzz_roughness = 0.5f, .diffuse_lobe = RT_LOBE_FUZZ}},
    {"leaf",
     0.89,
     {.kd = {0.3f},
      .diffuse_transmission = {0.6f},
      .diffuse_lobe = RT_LOBE_TRANSLUCENT,
      .flags = RT_MATERIAL_TRANSLUCENT}},
    {"glossy leaf",
     0.75,
     {.kd = {0.2f},
      .diffuse_transmission = {0.3f},
      .ks = {0.4f},
      .roughness = 0.4f,
      .diffuse_lobe = RT_LOBE_TRANSLUCENT,
      .flags = RT_MATERIAL_TRANSLUCENT}},
    {"coated",
     0.55,
     {.kd = {0.7f},
      .coat = 0.8f,
      .coat_ior = 1.5f,
      .diffuse_lobe = RT_LOBE_COATED,
      .flags = RT_MATERIAL_COAT}},
    {"roughly coated",
     0.45,
     {.kd = {0.7f},
      .coat = 0.5f,
      .coat_roughness = 0.3f,
      .coat_ior = 1.5f,
      .diffuse_lobe = RT_LOBE_COATED,
      .flags = RT_MATERIAL_COAT}},
};

/* Sums of the weights of one pair of cells. */
typedef struct moments {
    double sum, squares;
} moments;

/* A side of the surface, and a quarter of it across the direction in which the normal leans. */
static int cell_of(const float w[3])
{
    const double x = w[0];
    return (w[2] < 0 ? 4 : 0) + (x < -0.5 ? 0 : x < 0 ? 1 : x < 0.5 ? 2 : 3);
}

static situation leaning(double degrees, double eta)
{
    situation at = {{0, 0, 1, 0}, {0, 0, 0, 0}, {0, 0, 0}, 0, {1, 1, 1}, 1};
    at.shading[0] = (float)sin(degrees * PI / 180);
    at.shading[2] = (float)cos(degrees * PI / 180);
    at.eta = (float)eta;
    return at;
}

/* Fills sums[c][l] with paths that carry this; the index below the surface is the material's. */
static void sum_pairs(const struct surface *surface, double degrees, uint32_t transport,
                      moments sums[cells][cells])
{
    const int has_inside =
        surface->material.ior > 0 && !(surface->material.flags & RT_MATERIAL_THIN);
    const float ior = has_inside ? surface->material.ior : 1;
    const situation at = leaning(degrees, 1 / ior);
    memset(sums, 0, sizeof(moments[cells][cells]));
    draw_exchange(&surface->material, &at, transport, 21 + transport, n, draws);
    for (int i = 0; i < n; i++) {
        const exchange_draw *d = draws + i;
        const int o = cell_of(d->wo), in = cell_of(d->wi);
        moments *pair = transport == carry_flux ? &sums[in][o] : &sums[o][in];
        assert_true(isfinite(d->weight) && d->weight >= 0);
        pair->sum += d->weight;
        pair->squares += (double)d->weight * d->weight;
        if (fabs(d->mismatch) > 2e-3)
            fail_msg("%s at %g degrees, transport %u: eval is off by %g", surface->name, degrees,
                     transport, d->mismatch);
    }
}

/* How far the means of two sums are apart, in standard errors. */
static double deviate(const moments *a, const moments *b)
{
    const double variance =
        (a->squares - a->sum * a->sum / n) / n / n + (b->squares - b->sum * b->sum / n) / n / n;
    /* What few samples find says little of its variance. */
    return (a->sum - b->sum) / n / sqrt(variance + 1e-8);
}

static void flux_is_the_adjoint_of_radiance(void **state)
{
    static const double leans[] = {0, 20, 55, 85};
    static moments radiance[cells][cells], flux[cells][cells];
    (void)state;
    for (size_t s = 0; s < sizeof surfaces / sizeof *surfaces; s++)
        for (size_t k = 0; k < sizeof leans / sizeof *leans; k++) {
            double total = 0;
            sum_pairs(surfaces + s, leans[k], carry_radiance, radiance);
            sum_pairs(surfaces + s, leans[k], carry_flux, flux);
            for (int c = 0; c < cells; c++)
                for (int l = 0; l < cells; l++) {
                    char what[96];
                    snprintf(what, sizeof what, "%s at %g degrees, to cell %d from cell %d",
                             surfaces[s].name, leans[k], c, l);
                    expect_deviate(deviate(&radiance[c][l], &flux[c][l]), what);
                    total += flux[c][l].sum / n;
                }
            if (!(total > (leans[k] == 0 ? surfaces[s].least : 0.2)))
                fail_msg("%s at %g degrees keeps %g", surfaces[s].name, leans[k], total);
        }
}

/*
 * Of light that is even above the surface, Lambert's lobe scatters kd (1 + cos lean) / 2: the
 * integral of the cosine to the shading normal over the directions above both planes, over pi.
 */
static void flux_of_lambert_is_that_of_the_closed_form(void **state)
{
    static const double leans[] = {0, 20, 55, 85};
    static double values[n];
    (void)state;
    for (size_t k = 0; k < sizeof leans / sizeof *leans; k++) {
        const situation at = leaning(leans[k], 1);
        draw_exchange(&surfaces[0].material, &at, carry_flux, 33, n, draws);
        for (int i = 0; i < n; i++)
            values[i] = draws[i].weight;
        expect_mean(values, n, 0.7 * (1 + cos(leans[k] * PI / 180)) / 2, 1e-6, "flux of lambert");
    }
}

/* Whether two numbers are the same but for rounding, which narrow lobes make large. */
static int alike(double a, double b)
{
    return fabs(a - b) <= 5e-4 * fmax(fabs(a), fabs(b)) + 1e-4;
}

/* At each pair of directions, value and densities are those of the other end. */
static void both_ends_of_a_path_agree_at_a_vertex(void **state)
{
    static const double leans[] = {0, 20, 55, 85};
    static both_ways ways[n];
    (void)state;
    for (size_t s = 0; s < sizeof surfaces / sizeof *surfaces; s++)
        for (size_t k = 0; k < sizeof leans / sizeof *leans; k++) {
            const situation at = leaning(leans[k], 1);
            int lit = 0;
            draw_both_ways(&surfaces[s].material, &at, 5, n, ways);
            for (int i = 0; i < n; i++) {
                const both_ways *w = ways + i;
                if (fabs(w->cosine_c) < 1e-2 || fabs(w->cosine_l) < 1e-2)
                    continue;
                lit += w->radiance[0] > 0;
                const int is_same = alike(w->radiance[0], w->flux[0]) &&
                                    (w->radiance[0] == 0 || (alike(w->pdf_l, w->back_pdf_l) &&
                                                             alike(w->pdf_c, w->back_pdf_c)));
                if (!is_same)
                    fail_msg("%s at %g degrees, cosines %g and %g: radiance %g, flux %g, densities "
                             "of l %g and %g, of c %g and %g",
                             surfaces[s].name, leans[k], w->cosine_c, w->cosine_l, w->radiance[0],
                             w->flux[0], w->pdf_l, w->back_pdf_l, w->pdf_c, w->back_pdf_c);
            }
            /* What is smooth and has no other lobe has no value. */
            const rt_material_data *m = &surfaces[s].material;
            assert_true(lit > n / 100 || (m->kd[0] == 0 && m->roughness == 0));
        }
}

/*
 * A mirror's camera path has one direction, which a light path finds again with the share of one
 * that has at most two, however little the normal leans: the densities are each other's inverse.
 */
static void delta_events_have_the_density_of_the_way_back(void **state)
{
    static const double leans[] = {0, 1e-4, 3e-3, 0.05, 20, 70};
    static delta_draw ways[n];
    (void)state;
    for (size_t k = 0; k < sizeof leans / sizeof *leans; k++) {
        const situation at = leaning(leans[k], 1);
        int found = 0, shared = 0;
        draw_delta_ratios(&surfaces[2].material, &at, 9, n, ways);
        for (int i = 0; i < n; i++) {
            const delta_draw *d = ways + i;
            if (d->ratio < 0)
                continue;
            found++;
            shared += d->ratio < 0.999f;
            if (!(d->ratio > 0 && d->ratio <= 1.0001f) ||
                fabs(d->ratio * d->light_ratio - 1) > 1e-3)
                fail_msg("a mirror at %g degrees: ratios %g and %g", leans[k], d->ratio,
                         d->light_ratio);
        }
        assert_true(found > n / 2);
        assert_true(leans[k] < 1 ? shared < n / 100 : shared > 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        statistical_test(flux_is_the_adjoint_of_radiance),
        cmocka_unit_test(both_ends_of_a_path_agree_at_a_vertex),
        cmocka_unit_test(delta_events_have_the_density_of_the_way_back),
        statistical_test(flux_of_lambert_is_that_of_the_closed_form),
    };
    return cmocka_run_group_tests_name("kernels/adjoint", tests, NULL, NULL);
}
