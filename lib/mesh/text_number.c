/* text_number.c - from the spelling of a number to its value. */
#include <math.h>

#include "mesh/text.h"

#define EXPONENT_LIMIT 100000 /* far beyond any double, far below overflow */

static int is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* Passes over a sign; returns whether it was a minus. */
static int take_sign(const char **c, const char *end)
{
    int negative = *c < end && **c == '-';
    if (*c < end && (**c == '-' || **c == '+'))
        ++*c;
    return negative;
}

int rt_token_integer(rt_token token, int64_t *out)
{
    const char *c = token.at, *end = token.at + token.length;
    int negative = take_sign(&c, end);
    int64_t value = 0;
    if (c == end)
        return 0;
    for (; c < end; c++) {
        if (!is_digit(*c) || value > (INT64_MAX - (*c - '0')) / 10)
            return 0;
        value = 10 * value + (*c - '0');
    }
    *out = negative ? -value : value;
    return 1;
}

/* Whether the bytes spell a word given in lower case, in any case. */
static int spells(const char *c, const char *end, const char *word)
{
    for (; c < end && *word; c++, word++)
        if ((*c | 0x20) != *word)
            return 0;
    return c == end && !*word;
}

/*
 * value * 10^exponent, by factors of at most 10^22, the last power of ten that a double holds
 * exactly.
 */
static double scale(double value, long exponent)
{
    static const double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                    1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                    1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    while (exponent > 0 && value != 0 && !isinf(value)) {
        long part = exponent > 22 ? 22 : exponent;
        value *= powers[part];
        exponent -= part;
    }
    while (exponent < 0 && value != 0) {
        long part = exponent < -22 ? 22 : -exponent;
        value /= powers[part];
        exponent += part;
    }
    return value;
}

/*
 * The digits as an integer, at most 19 of them, with the power of ten that it wants; 0 when there
 * is no digit.
 */
static int take_digits(const char **c, const char *end, uint64_t *digits, long *exponent)
{
    int seen = 0, point = 0;
    *digits = 0;
    *exponent = 0;
    for (; *c < end; ++*c) {
        if (**c == '.' && !point) {
            point = 1;
            continue;
        }
        if (!is_digit(**c))
            break;
        seen = 1;
        if (*digits < 1000000000000000000u) {
            *digits = 10 * *digits + (uint64_t)(**c - '0');
            *exponent -= point;
        } else if (*exponent < EXPONENT_LIMIT) {
            *exponent += !point;
        }
    }
    return seen;
}

static int take_exponent(const char **c, const char *end, long *exponent)
{
    long value = 0;
    if (*c == end || (**c | 0x20) != 'e')
        return 1;
    ++*c;
    int negative = take_sign(c, end);
    if (*c == end || !is_digit(**c))
        return 0;
    for (; *c < end && is_digit(**c); ++*c)
        if (value < EXPONENT_LIMIT)
            value = 10 * value + (**c - '0');
    *exponent += negative ? -value : value;
    return 1;
}

int rt_token_real(rt_token token, double *out)
{
    const char *c = token.at, *end = token.at + token.length;
    int negative = take_sign(&c, end);
    uint64_t digits;
    long exponent;
    double value;

    if (spells(c, end, "inf") || spells(c, end, "infinity")) {
        value = INFINITY;
    } else if (spells(c, end, "nan")) {
        value = NAN;
    } else {
        if (!take_digits(&c, end, &digits, &exponent) || !take_exponent(&c, end, &exponent) ||
            c != end)
            return 0;
        value = scale((double)digits, exponent);
    }
    *out = negative ? -value : value;
    return 1;
}
