/* number.c - numbers of options that are no settings. */
#include "number.h"

#include <ctype.h>
#include <math.h>
#include <string.h>
#include <strings.h>

#include "rt.h"

#define LARGEST_EXACT 9007199254740992.0 /* 2^53: every whole number up to it is a double */

int number_real(double *out, const char *text)
{
    return rt_number_read(out, text, strlen(text)) == RT_NUMBER_OK ? 0 : -1;
}

int number_size(uint64_t *out, const char *text)
{
    static const char units[] = "KMGT";
    const size_t length = strcspn(text, "kKmMgGtTbB");
    const char *unit = text + length;
    const char *power = *unit ? strchr(units, toupper((unsigned char)*unit)) : NULL;
    double value;
    if (rt_number_read(&value, text, length) != RT_NUMBER_OK)
        return -1;
    if (power)
        unit += strncasecmp(unit + 1, "ib", 2) == 0 ? 2 : 1;
    if (*unit && strcasecmp(unit, "b") != 0)
        return -1;
    value = ldexp(value, power ? 10 * (int)(power - units + 1) : 0);
    if (!(value >= 1 && value <= 0x1p60))
        return -1;
    *out = (uint64_t)value;
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
