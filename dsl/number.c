#include "dsl/number.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* significant digits kept; a nonzero tail beyond them counts as one more digit */
#define DIGITS_MAX 60
#define EXPONENT_MAX 1000000 /* clamp: far beyond any double, far below overflow */

static int is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* The significant digits of a number, and the power of ten of the last one. */
typedef struct rt_digits {
    char digits[DIGITS_MAX + 2];
    int count, seen;
    int tail; /* a nonzero digit was left out */
    long exponent;
} rt_digits;

static void add_digit(rt_digits *d, char c, int after_point)
{
    d->seen = 1;
    if (d->count == 0 && c == '0') { /* leading zero */
        if (d->exponent > -EXPONENT_MAX)
            d->exponent -= after_point;
    } else if (d->count < DIGITS_MAX) {
        d->digits[d->count++] = c;
        d->exponent -= after_point;
    } else {
        d->tail |= c != '0';
        if (d->exponent < EXPONENT_MAX)
            d->exponent += !after_point;
    }
}

rt_number_result rt_number_read(double *out, rt_text text)
{
    rt_digits d = {{0}, 0, 0, 0, 0};
    const char *c = text.at, *end = text.at + text.length;

    /* Mantissa. */
    for (; c < end && is_digit(*c); c++)
        add_digit(&d, *c, 0);
    if (c < end && *c == '.')
        for (c++; c < end && is_digit(*c); c++)
            add_digit(&d, *c, 1);
    if (!d.seen)
        return RT_NUMBER_MALFORMED;

    /* Exponent. */
    if (c < end && (*c == 'e' || *c == 'E')) {
        long exponent = 0;
        int negative = 0;
        c++;
        if (c < end && (*c == '+' || *c == '-'))
            negative = *c++ == '-';
        if (c == end || !is_digit(*c))
            return RT_NUMBER_MALFORMED;
        for (; c < end && is_digit(*c); c++)
            if (exponent < 10 * EXPONENT_MAX)
                exponent = 10 * exponent + (*c - '0');
        d.exponent += negative ? -exponent : exponent;
    }
    if (c != end)
        return RT_NUMBER_MALFORMED;

    /* As an integer with an exponent the number has no decimal point for a locale to change. */
    if (d.count == 0) {
        *out = 0.0;
        return RT_NUMBER_OK;
    }
    if (d.tail) {
        d.digits[d.count++] = '1';
        d.exponent--;
    }
    char spelling[DIGITS_MAX + 32];
    snprintf(spelling, sizeof spelling, "%.*se%ld", d.count, d.digits, d.exponent);
    *out = strtod(spelling, NULL);
    return isinf(*out) ? RT_NUMBER_TOO_LARGE : RT_NUMBER_OK;
}
