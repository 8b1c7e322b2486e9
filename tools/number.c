#include "number.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define LARGEST_EXACT 9007199254740992.0 /* 2^53: every whole number up to it is a double */

/* Whether the digits before the exponent say anything but 0. */
static int has_digit_but_0(const char *text)
{
    return strcspn(text, "123456789") < strcspn(text, "eE");
}

int number_real(double *out, const char *text)
{
    /* strtod takes more than a decimal number: spaces, 0x1p3, inf, nan. */
    if (text[0] == '\0' || text[strspn(text, "0123456789.eE+-")] != '\0')
        return -1;
    char *end;
    double value = strtod(text, &end);
    /* One that single precision takes for 0 would mean what 0 means: often, no limit. */
    if (fabs(value) < FLT_MIN && has_digit_but_0(text))
        return -1;
    if (*end != '\0' || !isfinite(value))
        return -1;
    *out = value;
    return 0;
}

int number_count(uint64_t *out, const char *text)
{
    double value;
    if (number_real(&value, text) != 0 || value < 0.0 || value > LARGEST_EXACT ||
        floor(value) != value)
        return -1;
    *out = (uint64_t)value;
    return 0;
}
