/* test_number.c - the reader of numbers. */
#include <float.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "rt.h"

static rt_number_result read_number(double *out, const char *text)
{
    return rt_number_read(out, text, strlen(text));
}

static const char *const texts[] = {
    "0",
    "0.0",
    "000",
    "1",
    "0.1",
    ".5",
    "5.",
    "1e0",
    "1E-3",
    "1e+3",
    "123456789012345678901234567890",
    "0.000000000000000000000000000123",
    "2.2250738585072014e-308",
    "4.9e-324",
    "1e-400",
    "1.7976931348623157e308",
    "0.30000000000000004",
    "9007199254740993",
    "100000000000000000000000",
    "0e999999999999",
    "179769313486231570000000000000000000000000000000000000000000000000000000000000000000001e22"
    "0",
    "8.5000000000000000000000000000000000000000000000000000000000000000000000000000000000001",
    "0."
    "000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000"
    "00001",
};

static void decimal_numbers_round_as_strtod(void **state)
{
    uint64_t bits = 42;
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        double value = -1, expected = strtod(texts[i], NULL);
        rt_number_result result = read_number(&value, texts[i]);
        int is_small = expected < FLT_MIN && strpbrk(texts[i], "123456789") &&
                       strcspn(texts[i], "123456789") < strcspn(texts[i], "eE");
        assert_int_equal(result, is_small ? RT_NUMBER_TOO_SMALL : RT_NUMBER_OK);
        assert_true(value == expected);
    }
    for (int i = 0; i < 100000; i++) {
        double number, value;
        char text[64];
        bits = bits * 6364136223846793005u + 1442695040888963407u;
        uint64_t pattern = bits & 0x7fffffffffffffffu;
        if (pattern >= 0x7ff0000000000000u)
            continue;
        memcpy(&number, &pattern, sizeof number);
        snprintf(text, sizeof text, "%.17g", number);
        rt_number_result result = read_number(&value, text);
        assert_true(result == RT_NUMBER_OK || result == RT_NUMBER_TOO_SMALL);
        assert_true(value == number);
    }
}

/* Among them those that a scene has most: few digits and small exponents. */
static void short_decimal_numbers_round_as_strtod(void **state)
{
    uint64_t bits = 1;
    (void)state;
    for (int i = 0; i < 300000; i++) {
        char text[64];
        double value;
        bits = bits * 6364136223846793005u + 1442695040888963407u;
        const int digits = 1 + (int)(bits >> 60), exponent = (int)(bits >> 50 & 63) - 31;
        const unsigned long long number = (bits & 0xffffffffffffu) * 37;
        snprintf(text, sizeof text, i % 2 ? "%.*llue%d" : "0.%.*llue%d", digits, number, exponent);
        assert_int_not_equal(read_number(&value, text), RT_NUMBER_MALFORMED);
        assert_true(value == strtod(text, NULL));
    }
}

static void what_is_no_number_is_refused(void **state)
{
    static const char *const texts[] = {"",    ".",   "e5",  ".e5", "1e", "1e-", "1.2.3", "1 ",
                                        "0x1", "inf", "nan", "1,5", "+",  "--1", "- 1"};
    double value;
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        assert_int_equal(read_number(&value, texts[i]), RT_NUMBER_MALFORMED);
    assert_int_equal(read_number(&value, "1e309"), RT_NUMBER_TOO_LARGE);
    assert_int_equal(read_number(&value, "1e99999999999999999999"), RT_NUMBER_TOO_LARGE);
}

static void a_sign_may_stand_before(void **state)
{
    double value;
    (void)state;
    assert_int_equal(read_number(&value, "-1.5e1"), RT_NUMBER_OK);
    assert_true(value == -15);
    assert_int_equal(read_number(&value, "+2"), RT_NUMBER_OK);
    assert_true(value == 2);
    assert_int_equal(read_number(&value, "-0.1e-60"), RT_NUMBER_TOO_SMALL);
    assert_int_equal(read_number(&value, "-1e400"), RT_NUMBER_TOO_LARGE);
}

/* The point is a point even where the program's locale writes a comma. */
static void the_locale_does_not_matter(void **state)
{
    static const char *const locales[] = {"de_DE.UTF-8", "fr_FR.UTF-8", "C"};
    double value = 0;
    size_t i = 0;
    (void)state;
    while (!setlocale(LC_NUMERIC, locales[i]))
        i++;
    assert_int_equal(read_number(&value, "1.5"), RT_NUMBER_OK);
    setlocale(LC_NUMERIC, "C");
    assert_true(value == 1.5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(decimal_numbers_round_as_strtod),
        cmocka_unit_test(short_decimal_numbers_round_as_strtod),
        cmocka_unit_test(what_is_no_number_is_refused),
        cmocka_unit_test(a_sign_may_stand_before),
        cmocka_unit_test(the_locale_does_not_matter),
    };
    return cmocka_run_group_tests_name("number", tests, NULL, NULL);
}
