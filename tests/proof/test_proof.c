/*
 * test_proof.c - the references of the other proofs: Student's t distribution, and closed forms of
 * reflectance.
 */
#include <math.h>

#include "chance.h"
#include "proof/optics.h"
#include "proof/proof.h"

/* Quantiles from tables; the last by integration of the density. */
static void students_distribution(void **state)
{
    (void)state;
    assert_float_equal(chance_of_student(0, 31), 1, 1e-12);
    assert_float_equal(chance_of_student(12.7062, 1), 0.05, 1e-6);
    assert_float_equal(chance_of_student(2.0395134, 31), 0.05, 1e-7);
    assert_float_equal(chance_of_student(-2.0395134, 31), 0.05, 1e-7);
    assert_float_equal(chance_of_student(6.9, 31), 9.764e-8, 1e-11);
    assert_float_equal(chance_of_student(4.302653, 2), 0.05, 1e-7);
    assert_float_equal(chance_of_student(2.228139, 10), 0.05, 1e-7);
    assert_float_equal(chance_of_student(3.290527, 10001), 0.001, 1e-8);
}

static void boundaries(void **state)
{
    (void)state;
    assert_float_equal(optics_fresnel(1, 1.5), 0.04, 1e-12);
    assert_float_equal(optics_fresnel(cos(atan(1.5)), 1.5), 0.5 * pow(5 / 13.0, 2),
                       1e-12); /* Brewster's angle: p vanishes */
    assert_float_equal(optics_fresnel(0.5, 1 / 1.5), 1, 1e-12);
    assert_float_equal(optics_fresnel(1, 0.42 + 2.35 * I),
                       (0.58 * 0.58 + 2.35 * 2.35) / (1.42 * 1.42 + 2.35 * 2.35), 1e-12);
    assert_float_equal(optics_rough(0.7, 1e-3, 1.5), optics_fresnel(0.7, 1.5), 1e-5);
}

/* 0.0918: the diffuse reflectance of n = 1.5, as tables of the field have it. */
static double glass(double cos_i)
{
    return optics_fresnel(cos_i, 1.5);
}

static double square(double cos_i)
{
    return cos_i * cos_i;
}

static void diffuse_light(void **state)
{
    (void)state;
    assert_float_equal(optics_diffuse_mean(square), 0.5, 1e-8);
    assert_float_equal(optics_diffuse_mean(glass), 0.09178, 1e-5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(students_distribution),
        cmocka_unit_test(boundaries),
        cmocka_unit_test(diffuse_light),
    };
    return cmocka_run_group_tests_name("proof/proof", tests, NULL, NULL);
}
