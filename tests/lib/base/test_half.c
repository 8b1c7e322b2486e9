/* Half floats: every one of them, and the rounding between each two. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/half.h"

enum { greatest = 0x7bff }; /* bits of RT_HALF_MAX */

/* IEEE 754: (-1)^s 2^(e-15) (1 + m/1024), or 2^-14 m/1024 when e = 0. */
static float value_of(uint16_t bits)
{
    int e = bits >> 10 & 31, m = bits & 1023;
    double magnitude = e ? ldexp(1024 + m, e - 25) : ldexp(m, -24);
    return (float)(bits & 0x8000 ? -magnitude : magnitude);
}

static void every_half_comes_back(void **state)
{
    (void)state;
    assert_true(value_of(greatest) == RT_HALF_MAX);
    for (uint32_t bits = 0; bits <= greatest; bits++) {
        assert_int_equal(rt_half_from_float(value_of((uint16_t)bits)), bits);
        assert_int_equal(rt_half_from_float(value_of((uint16_t)(bits | 0x8000))), bits | 0x8000);
    }
}

static void between_two_the_nearer_is_taken_or_the_even_one(void **state)
{
    (void)state;
    for (uint32_t bits = 0; bits < greatest; bits++) {
        float low = value_of((uint16_t)bits), high = value_of((uint16_t)(bits + 1)),
              middle = 0.5f * (low + high);
        assert_int_equal(rt_half_from_float(middle), bits % 2 ? bits + 1 : bits);
        assert_int_equal(rt_half_from_float(nextafterf(middle, low)), bits);
        assert_int_equal(rt_half_from_float(nextafterf(middle, high)), bits + 1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_half_comes_back),
        cmocka_unit_test(between_two_the_nearer_is_taken_or_the_even_one),
    };
    return cmocka_run_group_tests_name("lib/base/half", tests, NULL, NULL);
}
