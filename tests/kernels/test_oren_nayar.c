/*
 * test_oren_nayar.c - rough diffuse reflection: against double precision, reciprocity, and the
 * white-furnace test.
 */
#include "support.h"

#include <math.h>
#include <string.h>

#include "bsdf_draw.h"
#include "statistics/oren_nayar_reference.h"
#include "types.h"

#define PI 3.14159265358979323846

static const float roughnesses[] = {0.01f, 0.3f, 1};
enum { roughness_count = sizeof roughnesses / sizeof *roughnesses };

static rt_material_data clay(float roughness)
{
    return (rt_material_data){
        .kd = {1, 0.8f, 0.2f}, .roughness = roughness, .diffuse_lobe = RT_LOBE_OREN_NAYAR};
}

static void light_is_that_of_the_definition(void **state)
{
    enum { pairs = 256 };
    static situation at[pairs];
    static float wo[pairs][4], wi[pairs][4], found[pairs][4];
    (void)state;
    for (int r = 0; r < roughness_count; r++) {
        const rt_material_data material = clay(roughnesses[r]);
        for (int i = 0; i < pairs; i++) {
            spread_pair(wo[i], wi[i], i);
            at[i] = situation_along(wo[i], 1);
        }
        evaluate_lobe(&material, at, (const float(*)[4])wi, RT_LOBE_OREN_NAYAR, pairs, found);
        for (int i = 0; i < pairs; i++)
            for (int c = 0; c < 3; c++) {
                const double between = (double)wo[i][0] * wi[i][0] + (double)wo[i][1] * wi[i][1] +
                                       (double)wo[i][2] * wi[i][2];
                const double exact =
                    oren_nayar_fr(material.kd[c], roughnesses[r], wo[i][2], wi[i][2], between);
                assert_float_equal(found[i][c], exact * wi[i][2], 5e-5);
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
        const rt_material_data material = clay(roughnesses[r]);
        for (int i = 0; i < pairs; i++) {
            spread_pair(wo[i], wi[i], i);
            there[i] = situation_along(wo[i], 1);
            back[i] = situation_along(wi[i], 1);
        }
        evaluate_lobe(&material, there, (const float(*)[4])wi, RT_LOBE_OREN_NAYAR, pairs, forth);
        evaluate_lobe(&material, back, (const float(*)[4])wo, RT_LOBE_OREN_NAYAR, pairs, again);
        for (int i = 0; i < pairs; i++)
            for (int c = 0; c < 3; c++)
                assert_float_equal(forth[i][c] / wi[i][2], again[i][c] / wo[i][2],
                                   1e-5 * forth[i][c] / wi[i][2]);
    }
}

/* White stays white from every direction, and other colours scatter their albedo. */
static void a_white_furnace_loses_nothing(void **state)
{
    enum { rings = 128, sectors = 128, points = rings * sectors };
    static const double cosines[] = {0.05, 0.3, 0.7, 1};
    static situation at[points];
    static float wi[points][4], found[points][4];
    (void)state;
    for (int r = 0; r < roughness_count; r++)
        for (int k = 0; k < 4; k++) {
            const rt_material_data material = clay(roughnesses[r]);
            double sum[3] = {0};
            lobe_draw drawn;
            float wo[4];
            direction_at(wo, cosines[k], 0.3);
            for (int i = 0; i < points; i++) {
                at[i] = situation_along(wo, 1);
                direction_at(wi[i], (i / sectors + 0.5) / rings, (i % sectors + 0.5) / sectors);
            }
            evaluate_lobe(&material, at, (const float(*)[4])wi, RT_LOBE_OREN_NAYAR, points, found);
            for (int i = 0; i < points; i++)
                for (int c = 0; c < 3; c++)
                    sum[c] += found[i][c] * 2 * PI / points;
            draw_lobe(&material, at, RT_LOBE_OREN_NAYAR, 1, 1, &drawn);
            assert_float_equal(sum[0], 1, 1e-3);
            assert_float_equal(drawn.albedo[0], 1, 1e-6);
            for (int c = 1; c < 3; c++) {
                assert_float_equal(drawn.albedo[c], sum[c], 1e-3);
                assert_true(drawn.albedo[c] <= material.kd[c]);
            }
        }
}

static void light_coming_back_the_way_it_came_is_brighter(void **state)
{
    const rt_material_data material = clay(1);
    float w[2][4], found[2][4];
    situation at[2];
    (void)state;
    direction_at(w[0], 0.5, 0);
    direction_at(w[1], 0.5, 0.5);
    at[0] = at[1] = situation_along(w[0], 1);
    evaluate_lobe(&material, at, (const float(*)[4])w, RT_LOBE_OREN_NAYAR, 2, found);
    /* (1 + s/t) / (1 - s) at s = 3/4 and t = 1/2 is 10, were it not for what is given back. */
    assert_true(found[0][2] > 5 * found[1][2]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_is_that_of_the_definition),
        cmocka_unit_test(light_goes_both_ways_alike),
        cmocka_unit_test(a_white_furnace_loses_nothing),
        cmocka_unit_test(light_coming_back_the_way_it_came_is_brighter),
    };
    return cmocka_run_group_tests_name("kernels/oren_nayar", tests, NULL, NULL);
}
