/* test_fuzz.c - cloth: against double precision, reciprocity, and the white-furnace test. */
#include "support.h"

#include <math.h>
#include <string.h>

#include "bsdf_draw.h"
#include "statistics/fuzz_reference.h"
#include "types.h"

#define PI 3.14159265358979323846

static const float roughnesses[] = {0.1f, 0.17f, 0.26f, 0.45f, 0.7f, 1};
enum { roughness_count = sizeof roughnesses / sizeof *roughnesses };

static rt_material_data cloth(float roughness)
{
    return (rt_material_data){.kd = {1, 0.8f, 0.2f},
                              .fuzz = {1, 0.5f, 0.1f},
                              .fuzz_roughness = roughness,
                              .diffuse_lobe = RT_LOBE_FUZZ};
}

/* But for what the polynomial of the albedo is off by. */
static void light_is_that_of_the_definition(void **state)
{
    enum { pairs = 100 };
    static situation at[pairs];
    static float wo[pairs][4], wi[pairs][4], found[pairs][4];
    (void)state;
    for (int r = 0; r < roughness_count; r++) {
        const rt_material_data material = cloth(roughnesses[r]);
        for (int i = 0; i < pairs; i++) {
            spread_pair(wo[i], wi[i], i);
            at[i] = situation_along(wo[i], 1);
        }
        evaluate_lobe(&material, at, (const float(*)[4])wi, RT_LOBE_FUZZ, pairs, found);
        for (int i = 0; i < pairs; i++)
            for (int c = 0; c < 3; c++) {
                const double between = (double)wo[i][0] * wi[i][0] + (double)wo[i][1] * wi[i][1] +
                                       (double)wo[i][2] * wi[i][2];
                const double exact = fuzz_fr(material.kd[c], material.fuzz[c], 1, roughnesses[r],
                                             wo[i][2], wi[i][2], between);
                assert_float_equal(found[i][c], exact * wi[i][2], 1.5e-3 + 1e-4 * exact * wi[i][2]);
            }
    }
}

static void light_goes_both_ways_alike(void **state)
{
    enum { pairs = 1 << 14 };
    static situation there[pairs], back[pairs];
    static float wo[pairs][4], wi[pairs][4], forth[pairs][4], again[pairs][4];
    (void)state;
    for (int r = 0; r < roughness_count; r++) {
        const rt_material_data material = cloth(roughnesses[r]);
        for (int i = 0; i < pairs; i++) {
            spread_pair(wo[i], wi[i], i);
            there[i] = situation_along(wo[i], 1);
            back[i] = situation_along(wi[i], 1);
        }
        evaluate_lobe(&material, there, (const float(*)[4])wi, RT_LOBE_FUZZ, pairs, forth);
        evaluate_lobe(&material, back, (const float(*)[4])wo, RT_LOBE_FUZZ, pairs, again);
        for (int i = 0; i < pairs; i++)
            for (int c = 0; c < 3; c++)
                assert_float_equal(forth[i][c] / wi[i][2], again[i][c] / wo[i][2],
                                   1e-4 * forth[i][c] / wi[i][2] + 1e-6);
    }
}

/* White stays white from every direction, and other colours scatter their albedo. */
static void a_white_furnace_loses_nothing(void **state)
{
    enum { rings = 256, sectors = 128, points = rings * sectors };
    static const double cosines[] = {0.02, 0.05, 0.15, 0.3, 0.7, 1};
    static situation at[points];
    static float wi[points][4], found[points][4];
    (void)state;
    for (int r = 0; r < roughness_count; r++)
        for (int k = 0; k < 6; k++) {
            const rt_material_data material = cloth(roughnesses[r]);
            double sum[3] = {0}, weights = 0;
            lobe_draw drawn;
            float wo[4];
            direction_at(wo, cosines[k], 0);
            /* More points at grazing angles, and about forward directions. */
            for (int i = 0; i < points; i++) {
                const double t = (i / sectors + 0.5) / rings, s = (i % sectors + 0.5) / sectors;
                at[i] = situation_along(wo, 1);
                direction_at(wi[i], t * t * t, 0.5 - 0.5 * s * s * s);
            }
            evaluate_lobe(&material, at, (const float(*)[4])wi, RT_LOBE_FUZZ, points, found);
            for (int i = 0; i < points; i++) {
                const double t = (i / sectors + 0.5) / rings, s = (i % sectors + 0.5) / sectors;
                const double element = 2 * PI * 9 * t * t * s * s / points;
                weights += element;
                for (int c = 0; c < 3; c++)
                    sum[c] += found[i][c] * element;
            }
            draw_lobe(&material, at, RT_LOBE_FUZZ, 1, 1, &drawn);
            assert_float_equal(weights, 2 * PI, 1e-2);
            assert_float_equal(sum[0], 1, 3.5e-3);
            assert_float_equal(drawn.albedo[0], 1, 1e-6);
            for (int c = 1; c < 3; c++)
                assert_float_equal(drawn.albedo[c], sum[c], 3.5e-3);
        }
}

/* Without fuzz the lobe would be Lambert's; at its rim fuzz is brighter than what lies below. */
static void cloth_is_brightest_where_light_grazes_it(void **state)
{
    rt_material_data material = cloth(0.4f);
    float w[2][4], found[2][4];
    situation at[2];
    (void)state;
    for (int c = 0; c < 3; c++)
        material.kd[c] = 0;
    direction_at(w[0], 0.1, 0);
    direction_at(w[1], 0.9, 0);
    at[0] = situation_along(w[0], 1);
    at[1] = situation_along(w[1], 1);
    evaluate_lobe(&material, at, (const float(*)[4])w, RT_LOBE_FUZZ, 2, found);
    assert_true(found[0][0] / 0.1 > 20 * found[1][0] / 0.9);
    assert_true(found[0][0] > 0 && found[0][2] < 0.11f * found[0][0]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_is_that_of_the_definition),
        cmocka_unit_test(light_goes_both_ways_alike),
        cmocka_unit_test(a_white_furnace_loses_nothing),
        cmocka_unit_test(cloth_is_brightest_where_light_grazes_it),
    };
    return cmocka_run_group_tests_name("kernels/fuzz", tests, NULL, NULL);
}
