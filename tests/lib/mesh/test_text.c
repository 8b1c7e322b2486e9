/* Numbers in text: their values, whatever the locale, and what is no number. */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "mesh/text.h"

static int read_real(const char *text, double *out)
{
    return rt_token_real((rt_token){text, strlen(text)}, out);
}

static void usual_numbers_are_the_nearest_floats(void **state)
{
    (void)state;
    static const char *const words[] = {
        "0",    "-0",     "1",   "+2",        "-3.5", ".25",      "5.",           "1e3",
        "1E-3", "1.5e+2", "0.1", "123456789", "1e22", "0.000001", "3.4028235e38", "0001.5000"};
    double value;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        assert_true(read_real(words[i], &value));
        assert_true((float)value == strtof(words[i], NULL));
        assert_true(fabs(value - strtod(words[i], NULL)) <= 2 * DBL_EPSILON * fabs(value));
        assert_int_equal(signbit(value) != 0, words[i][0] == '-');
    }
}

static uint32_t next(uint32_t *state)
{
    /* Numerical Recipes' linear congruential generator. */
    return *state = *state * 1664525u + 1013904223u;
}

/* Floats of every size, in 9 and in 17 digits, come back to the bit. */
static void printed_floats_come_back(void **state)
{
    (void)state;
    uint32_t seed = 1;
    for (int i = 0; i < 200000; i++) {
        uint32_t bits = next(&seed);
        float x;
        char text[64];
        double value;
        memcpy(&x, &bits, sizeof x);
        if (!isfinite(x))
            continue;
        snprintf(text, sizeof text, i % 2 ? "%.9g" : "%.17g", (double)x);
        assert_true(read_real(text, &value));
        if ((float)value != x)
            fail_msg("%s came back as %.9g", text, (double)(float)value);
    }
}

static void long_and_extreme_numbers_keep_their_size(void **state)
{
    (void)state;
    double value;
    assert_true(read_real("0.00000000000000000000000000000000000000000000000001", &value));
    assert_true(fabs(value / 1e-50 - 1) < 1e-15);
    assert_true(read_real("100000000000000000000000000000000000000000000000000", &value));
    assert_true(fabs(value / 1e50 - 1) < 1e-15);
    assert_true(read_real("3.14159265358979323846264338327950288419716939937510", &value));
    assert_true(fabs(value - 3.14159265358979323846) < 1e-15);
    assert_true(read_real("1e-999999999999999999999", &value) && value == 0);
    assert_true(read_real("1e999999999999999999999", &value) && isinf(value));
    assert_true(read_real("0e999999999999999999999", &value) && value == 0);
    assert_true(read_real("-Inf", &value) && isinf(value) && value < 0);
    assert_true(read_real("infinity", &value) && isinf(value));
    assert_true(read_real("NaN", &value) && isnan(value));
}

static void what_is_no_number_is_refused(void **state)
{
    (void)state;
    static const char *const words[] = {"",    "+",    "-",   ".",  "e5", "1e",    "1e+", "1.2.3",
                                        "1,5", "0x10", "++1", "1 ", "1x", "infin", "na"};
    double value;
    int64_t integer;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        assert_false(read_real(words[i], &value));
        assert_false(rt_token_integer((rt_token){words[i], strlen(words[i])}, &integer));
    }
}

static void integers_fit_or_are_refused(void **state)
{
    (void)state;
    int64_t value;
    assert_true(rt_token_integer((rt_token){"9223372036854775807", 19}, &value) &&
                value == INT64_MAX);
    assert_true(rt_token_integer((rt_token){"-9223372036854775807", 20}, &value) &&
                value == -INT64_MAX);
    assert_true(rt_token_integer((rt_token){"+007", 4}, &value) && value == 7);
    assert_false(rt_token_integer((rt_token){"9223372036854775808", 19}, &value));
    assert_false(rt_token_integer((rt_token){"1.0", 3}, &value));
    assert_false(rt_token_integer((rt_token){"1e3", 3}, &value));
}

static void lines_are_counted_through_comments_and_continuations(void **state)
{
    (void)state;
    static const char data[] = "a b # c\n\n d\\ \n e\n\\f\\";
    static const struct {
        const char *word;
        size_t line;
    } expected[] = {{"a", 1}, {"b", 1}, {"d", 3}, {"e", 4}, {"\\f\\", 5}};
    rt_mesh_text text = rt_mesh_text_begin(data, sizeof data - 1);
    rt_token token;
    text.comments = 1;
    text.continued = 1;
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        assert_true(rt_mesh_text_any(&text, &token));
        assert_true(rt_token_is(token, expected[i].word));
        assert_int_equal(text.line, expected[i].line);
    }
    assert_false(rt_mesh_text_any(&text, &token));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(usual_numbers_are_the_nearest_floats),
        cmocka_unit_test(printed_floats_come_back),
        cmocka_unit_test(long_and_extreme_numbers_keep_their_size),
        cmocka_unit_test(what_is_no_number_is_refused),
        cmocka_unit_test(integers_fit_or_are_refused),
        cmocka_unit_test(lines_are_counted_through_comments_and_continuations),
    };
    return cmocka_run_group_tests_name("mesh/text", tests, NULL, NULL);
}
