/* json.c - values as JSON on stdout. */
#include "json.h"

#include <math.h>
#include <stdio.h>

void json_string(const char *text)
{
    putchar('"');
    for (const unsigned char *c = (const unsigned char *)text; *c; c++) {
        if (*c == '"' || *c == '\\')
            printf("\\%c", *c);
        else if (*c < 0x20)
            printf("\\u%04x", (unsigned)*c);
        else
            putchar(*c);
    }
    putchar('"');
}

void json_number(double value)
{
    if (isfinite(value))
        printf("%.10g", value);
    else
        fputs("null", stdout);
}

void json_member(const char *name, double value)
{
    printf(",\"%s\":", name);
    json_number(value);
}

void json_triple(const char *name, const double values[3])
{
    printf(",\"%s\":[", name);
    for (int c = 0; c < 3; c++) {
        if (c)
            putchar(',');
        json_number(values[c]);
    }
    putchar(']');
}
