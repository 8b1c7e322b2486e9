/* number.c - from the spelling of a number to its value, whatever the locale. */
#include "rt/field.h"

#include <float.h>
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

/* Reads the digits and the point; returns where they end. */
static const char *read_mantissa(rt_digits *d, const char *c, const char *end)
{
    for (; c < end && is_digit(*c); c++)
        add_digit(d, *c, 0);
    if (c < end && *c == '.')
        for (c++; c < end && is_digit(*c); c++)
            add_digit(d, *c, 1);
    return c;
}

/* Reads an exponent, if there is one; returns where it ends, or NULL where it has no digits. */
static const char *read_exponent(rt_digits *d, const char *c, const char *end)
{
    long exponent = 0;
    int negative = 0;
    if (c == end || (*c != 'e' && *c != 'E'))
        return c;
    c++;
    if (c < end && (*c == '+' || *c == '-'))
        negative = *c++ == '-';
    if (c == end || !is_digit(*c))
        return NULL;
    for (; c < end && is_digit(*c); c++)
        if (exponent < 10 * EXPONENT_MAX)
            exponent = 10 * exponent + (*c - '0');
    d->exponent += negative ? -exponent : exponent;
    return c;
}

static const double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/* Digits that are exact in double precision, and the power of ten of the table that is. */
enum { DIGITS_EXACT = 15, POWER_EXACT = 22 };

/*
 * Where the digits and the power of ten are both exact in double precision, their product or
 * quotient is rounded once, and so is the nearest double (Clinger, "How to Read Floating Point
 * Numbers Accurately", 1990). Returns whether they are.
 */
static int is_exact(double *size, const rt_digits *d)
{
    int64_t digits = 0;
    if (FLT_EVAL_METHOD != 0 || d->count > DIGITS_EXACT || d->exponent < -POWER_EXACT ||
        d->exponent > POWER_EXACT)
        return 0;
    for (int i = 0; i < d->count; i++)
        digits = 10 * digits + (d->digits[i] - '0');
    *size = d->exponent < 0 ? (double)digits / powers[-d->exponent]
                            : (double)digits * powers[d->exponent];
    return 1;
}

/* The same for the plainest spelling: a few digits, and perhaps a point among them. */
static int is_plain(double *out, const char *text, size_t length)
{
    int64_t digits = 0;
    size_t point = length;
    if (FLT_EVAL_METHOD != 0 || length > DIGITS_EXACT)
        return 0;
    for (size_t i = 0; i < length; i++) {
        if (is_digit(text[i]))
            digits = 10 * digits + (text[i] - '0');
        else if (text[i] == '.' && point == length && length > 1)
            point = i;
        else
            return 0;
    }
    *out = point == length ? (double)digits : (double)digits / powers[length - point - 1];
    return length > 0;
}

/*
 * The number nearest to the digits, by the library: as an integer with an exponent it has no
 * decimal point for a locale to change.
 */
static double nearest(rt_digits *d)
{
    char spelling[DIGITS_MAX + 32];
    if (d->tail) {
        d->digits[d->count++] = '1';
        d->exponent--;
    }
    snprintf(spelling, sizeof spelling, "%.*se%ld", d->count, d->digits, d->exponent);
    return strtod(spelling, NULL);
}

rt_number_result rt_number_read(double *out, const char *text, size_t length)
{
    rt_digits d;
    const char *c = text, *end = text + length;
    int negative = length > 0 && *c == '-';
    if (is_plain(out, text, length))
        return RT_NUMBER_OK;
    d.count = d.seen = d.tail = 0;
    d.exponent = 0;
    c = read_mantissa(&d, c + (length > 0 && (*c == '-' || *c == '+')), end);
    c = d.seen ? read_exponent(&d, c, end) : NULL;
    if (c != end)
        return RT_NUMBER_MALFORMED;
    if (d.count == 0) {
        *out = 0.0;
        return RT_NUMBER_OK;
    }
    double size;
    if (!is_exact(&size, &d))
        size = nearest(&d);
    *out = negative ? -size : size;
    return isinf(size) ? RT_NUMBER_TOO_LARGE : size < FLT_MIN ? RT_NUMBER_TOO_SMALL : RT_NUMBER_OK;
}
