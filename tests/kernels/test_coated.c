/*
 * test_coated.c - diffuse reflection below a coat: against its definition in double precision, with
 * the light thrown back by quadrature; both ways alike; and the white-furnace test. Coats that
 * absorb are among them.
 */
#include "support.h"

#include <math.h>
#include <string.h>

#include "bsdf_draw.h"
#include "types.h"

#define PI 3.14159265358979323846

enum { pairs = 256 };

/* Coats, the index of the medium before them, and their optical depth. */
static const struct coat {
    float coat, ior, outside;
    int is_linear;
    float depth;
} coats[] = {{1, 1.5f, 1, 0, 0},     {0.4f, 1.33f, 1, 0, 0},    {1, 2.4f, 1, 1, 0},
             {0.7f, 1.5f, 1, 1, 0},  {1, 1.005f, 1, 0, 0},      {1, 1, 1, 0, 0},
             {1, 1.33f, 1.5f, 0, 0}, {1, 1.5f, 1.495f, 0, 0},   {1, 1.5f, 1, 0, 0.1f},
             {0.8f, 2.2f, 1, 0, 1},  {1, 1.33f, 1.5f, 0, 0.3f}, {1, 1.05f, 1, 1, 3},
             {1, 1.5f, 1, 0, 1e20f}};
enum { coat_count = sizeof coats / sizeof *coats };

static rt_material_data varnished(const struct coat *c)
{
    return (rt_material_data){.kd = {1, 0.8f, 0.2f},
                              .coat = c->coat,
                              .coat_ior = c->ior,
                              .coat_absorption = {c->depth, c->depth, c->depth},
                              .diffuse_lobe = RT_LOBE_COATED,
                              .flags = RT_MATERIAL_COAT | (c->is_linear ? RT_MATERIAL_LINEAR : 0)};
}

/* The cosine beyond a boundary between an index and m times that; 0: light is reflected totally. */
static double inside_cosine(double cosine, double m)
{
    return sqrt(fmax(1 - (1 - cosine * cosine) / (m * m), 0));
}

/* Fresnel reflectance at the cosine. */
static double reflectance(double cosine, double m)
{
    const double beyond = inside_cosine(cosine, m);
    if (beyond == 0)
        return 1;
    const double s = (cosine - m * beyond) / (cosine + m * beyond),
                 p = (m * cosine - beyond) / (m * cosine + beyond);
    return (s * s + p * p) / 2;
}

/* What is thrown back below it: the mean over directions by the cosine. */
static double inner_reflectance(const struct coat *c)
{
    enum { steps = 1 << 16 };
    double sum = 0;
    for (int i = 0; i < steps; i++) {
        const double cosine = sqrt((i + 0.5) / steps);
        sum += reflectance(cosine, (double)c->outside / c->ior) * exp(-2 * c->depth / cosine);
    }
    return sum / steps;
}

/* What of light that comes with this cosine reaches what lies below. */
static double enters(const struct coat *c, double cosine)
{
    const double m = (double)c->ior / c->outside, inside = inside_cosine(cosine, m);
    return inside > 0 ? (1 - reflectance(cosine, m)) * exp(-c->depth / inside) : 0;
}

static double coated_fr(const struct coat *c, double inner, double kd, double cos_o, double cos_i)
{
    const double m = (double)c->ior / c->outside;
    const double thrown_back = inner * (c->is_linear ? 1 : kd);
    const double below = enters(c, cos_o) * enters(c, cos_i) / (m * m * (1 - thrown_back));
    return kd / PI * (1 - c->coat + c->coat * below);
}

static void light_is_that_of_the_definition(void **state)
{
    static situation at[pairs];
    static float wo[4], wi[pairs][4], found[pairs][4];
    (void)state;
    for (int k = 0; k < coat_count; k++) {
        const struct coat *c = coats + k;
        const rt_material_data material = varnished(c);
        const double inner = inner_reflectance(c);
        for (int i = 0; i < pairs; i++) {
            spread_pair(wo, wi[i], i);
            at[i] = situation_along(wo, c->outside);
        }
        evaluate_lobe(&material, at, (const float(*)[4])wi, RT_LOBE_COATED, pairs, found);
        for (int i = 0; i < pairs; i++)
            for (int channel = 0; channel < 3; channel++) {
                const double fr = coated_fr(c, inner, material.kd[channel], at[i].wo[2], wi[i][2]);
                /* Where the index is nearly that outside, Fi is a straight line, to 1e-4. */
                assert_float_equal(found[i][channel], fr * wi[i][2], 3e-4 * fr * wi[i][2] + 1e-6);
            }
    }
}

static void light_goes_both_ways_alike(void **state)
{
    static situation at[pairs], back_at[pairs];
    static float wo[pairs][4], wi[pairs][4], found[pairs][4], back[pairs][4];
    (void)state;
    for (int k = 0; k < coat_count; k++) {
        const rt_material_data material = varnished(coats + k);
        for (int i = 0; i < pairs; i++) {
            spread_pair(wo[i], wi[i], i);
            at[i] = situation_along(wo[i], coats[k].outside);
            back_at[i] = situation_along(wi[i], coats[k].outside);
        }
        evaluate_lobe(&material, at, (const float(*)[4])wi, RT_LOBE_COATED, pairs, found);
        evaluate_lobe(&material, back_at, (const float(*)[4])wo, RT_LOBE_COATED, pairs, back);
        for (int i = 0; i < pairs; i++)
            for (int c = 0; c < 3; c++)
                assert_float_equal(found[i][c] / wi[i][2], back[i][c] / wo[i][2],
                                   1e-5 * found[i][c] / wi[i][2]);
    }
}

/* The albedo is what leaves in all directions. */
static void albedo_is_the_integral(void **state)
{
    enum { steps = 1 << 12 };
    (void)state;
    for (int k = 0; k < coat_count; k++) {
        const struct coat *c = coats + k;
        const rt_material_data material = varnished(c);
        const double inner = inner_reflectance(c);
        float wo[4];
        lobe_draw drawn;
        direction_at(wo, 0.6, 0.3);
        const situation at = situation_along(wo, c->outside);
        draw_lobe(&material, &at, RT_LOBE_COATED, 1, 1, &drawn);
        for (int channel = 0; channel < 3; channel++) {
            double sum = 0;
            for (int i = 0; i < steps; i++)
                sum += PI / steps *
                       coated_fr(c, inner, material.kd[channel], wo[2], sqrt((i + 0.5) / steps));
            assert_float_equal(drawn.albedo[channel], sum, 2e-3 * sum);
        }
    }
}

/* What a clear coat does not reflect, a white surface below it does; others less. */
static void white_below_a_coat_reflects_the_rest(void **state)
{
    (void)state;
    for (int k = 0; k < coat_count; k++)
        for (int i = 1; i <= 20 && coats[k].depth == 0; i++) {
            const struct coat *c = coats + k;
            const rt_material_data material = varnished(c);
            float wo[4];
            lobe_draw drawn;
            direction_at(wo, i / 20.0, 0.3);
            const situation at = situation_along(wo, c->outside);
            draw_lobe(&material, &at, RT_LOBE_COATED, 1, 1, &drawn);
            const double rest = 1 - c->coat * reflectance(wo[2], (double)c->ior / c->outside);
            assert_float_equal(drawn.albedo[0], rest, 2e-4);
            assert_true(drawn.albedo[1] <= drawn.albedo[0] && drawn.albedo[2] <= drawn.albedo[1]);
        }
}

/* Colours below a coat are deeper than without, unless they are to stay. */
static void colours_are_deeper_below_a_coat(void **state)
{
    float wo[4];
    lobe_draw deep, linear;
    struct coat c = {1, 1.5f, 1, 0, 0};
    (void)state;
    direction_at(wo, 1, 0);
    const situation at = situation_along(wo, 1);
    rt_material_data material = varnished(&c);
    draw_lobe(&material, &at, RT_LOBE_COATED, 1, 1, &deep);
    c.is_linear = 1;
    material = varnished(&c);
    draw_lobe(&material, &at, RT_LOBE_COATED, 1, 1, &linear);
    assert_float_equal(linear.albedo[2] / linear.albedo[0], 0.2, 1e-4);
    assert_true(deep.albedo[2] / deep.albedo[0] < 0.12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_is_that_of_the_definition),
        cmocka_unit_test(light_goes_both_ways_alike),
        cmocka_unit_test(albedo_is_the_integral),
        cmocka_unit_test(white_below_a_coat_reflects_the_rest),
        cmocka_unit_test(colours_are_deeper_below_a_coat),
    };
    return cmocka_run_group_tests_name("kernels/coated", tests, NULL, NULL);
}
