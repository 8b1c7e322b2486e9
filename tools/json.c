/* json.c - values as JSON on stdout. */
#include "json.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "utf8.h"

void json_string(const char *text)
{
    size_t left = strlen(text);
    putchar('"');
    for (size_t size; left > 0; text += size, left -= size) {
        const unsigned char c = (unsigned char)*text;
        size = utf8_size(text, left);
        if (size == 0)
            fputs("\\ufffd", stdout);
        else if (c == '"' || c == '\\')
            printf("\\%c", c);
        else if (c < 0x20 || c == 0x7f)
            printf("\\u%04x", (unsigned)c);
        else if (c == 0xc2 && (unsigned char)text[1] < 0xa0)
            printf("\\u%04x", (unsigned)(unsigned char)text[1]);
        else
            fwrite(text, 1, size, stdout);
        size += size == 0;
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
