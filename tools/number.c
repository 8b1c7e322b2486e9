/* number.c - numbers of options that are no settings. */
#include "number.h"

#include <math.h>
#include <string.h>

#include "rt.h"

#define LARGEST_EXACT 9007199254740992.0 /* 2^53: every whole number up to it is a double */

int number_real(double *out, const char *text)
{
    return rt_number_read(out, text, strlen(text)) == RT_NUMBER_OK ? 0 : -1;
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
