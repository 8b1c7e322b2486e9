/* The sRGB transfer function and its inverse. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "image/srgb.h"

static void decode_is_the_inverse_of_encode(void **state)
{
    (void)state;
    for (int i = 0; i <= 10000; i++)
        assert_float_equal(rt_srgb_decode(rt_srgb_encode(i / 10000.0)), i / 10000.0, 1e-7);
    for (int code = 0; code < 256; code++)
        assert_int_equal(rt_srgb_quantise(rt_srgb_decode(code / 255.0)), code);
}

/* Values of the standard's formula, computed apart. */
static void known_values_are_exact(void **state)
{
    (void)state;
    assert_float_equal(rt_srgb_decode(0.5), 0.21404114048, 1e-11);
    assert_float_equal(rt_srgb_decode(0.04), 0.04 / 12.92, 1e-15);
    assert_float_equal(rt_srgb_encode(0.18), 0.46135612950, 1e-11);
}

static void what_is_outside_is_clamped(void **state)
{
    (void)state;
    assert_true(rt_srgb_decode(0.0) == 0.0);
    assert_true(rt_srgb_decode(1.0) == 1.0);
    assert_true(rt_srgb_decode(-0.5) == 0.0);
    assert_true(rt_srgb_decode(1.5) == 1.0);
    assert_true(rt_srgb_decode(NAN) == 0.0);
    assert_true(rt_srgb_decode(INFINITY) == 1.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(decode_is_the_inverse_of_encode),
        cmocka_unit_test(known_values_are_exact),
        cmocka_unit_test(what_is_outside_is_clamped),
    };
    return cmocka_run_group_tests_name("image/srgb", tests, NULL, NULL);
}
