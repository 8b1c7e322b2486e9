/*
 * ply_ramp.c - gives the vertices or faces of a PLY file colours by a weight that they have, each
 * row as it is with three numbers behind it.
 */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dsl/import/ply.h"

enum { ELEMENTS_MAX = 16, FIELDS_MAX = 64, ROW_MAX = 64 /* of colours, as text */ };

typedef enum ply_format { ASCII, LITTLE, BIG } ply_format;

static const struct {
    const char *names[2];
    int size;
    char kind; /* signed, unsigned or floating */
} types[] = {{{"char", "int8"}, 1, 's'},     {{"uchar", "uint8"}, 1, 'u'},
             {{"short", "int16"}, 2, 's'},   {{"ushort", "uint16"}, 2, 'u'},
             {{"int", "int32"}, 4, 's'},     {{"uint", "uint32"}, 4, 'u'},
             {{"float", "float32"}, 4, 'f'}, {{"double", "float64"}, 8, 'f'}};

enum { TYPE_COUNT = sizeof types / sizeof *types };

/* A property: its type, and that of its count, or -1 where it is no list. */
typedef struct field {
    int type, count_type;
} field;

typedef struct element {
    size_t rows;
    field fields[FIELDS_MAX];
    int field_count;
    int weight; /* the number of the field; -1: none */
} element;

typedef struct ply {
    ply_format format;
    element elements[ELEMENTS_MAX];
    int element_count;
    int target;  /* the element that gets colours; -1: none */
    char *after; /* its properties in the header */
    char *body;  /* behind the header */
    char newline;
} ply;

/* ---- The header -------------------------------------------------------------- */

/* The type that the next word names, or -1. */
static int next_type(ply_lines *words)
{
    const size_t length = rt_import_ply_word(words);
    const char *const word = words->at - length;
    for (int i = 0; i < TYPE_COUNT; i++)
        for (int k = 0; k < 2; k++)
            if (strlen(types[i].names[k]) == length && memcmp(types[i].names[k], word, length) == 0)
                return i;
    return -1;
}

/* Whether a property holds a weight: its name and a channel, the first. */
static int is_weight(const char *word, size_t length, const char *weight)
{
    const size_t stem = strlen(weight);
    return length == stem + 2 && memcmp(word, weight, stem) == 0 && word[stem] == '_' &&
           strchr("0rx1", word[stem + 1]);
}

/* Adds the property of a line, behind its first word; returns 0 where it is none. */
static int add_property(element *to, ply_lines words, const char *weight)
{
    ply_lines list = words;
    field *const out = &to->fields[to->field_count];
    const int is_list = rt_import_ply_is(&list, "list");
    if (is_list)
        words = list;
    out->count_type = is_list ? next_type(&words) : -1;
    out->type = next_type(&words);
    if (out->type < 0 || (is_list && out->count_type < 0))
        return 0;
    const size_t length = rt_import_ply_word(&words);
    if (!is_list && is_weight(words.at - length, length, weight))
        to->weight = to->field_count;
    to->field_count++;
    return to->field_count < FIELDS_MAX;
}

/* Adds the element of a line, behind its first word. */
static int add_element(ply *out, ply_lines words, const char *target)
{
    element *const at = &out->elements[out->element_count];
    double rows = 0;
    ply_lines name = words;
    if (rt_import_ply_is(&name, target))
        out->target = out->element_count;
    rt_import_ply_word(&words);
    const char *text = words.at + strspn(words.at, " \t");
    if (!rt_import_number(&rows, &text) || !(rows >= 0 && rows <= INT32_MAX))
        return 0;
    at->rows = (size_t)rows;
    at->field_count = 0;
    at->weight = -1;
    return ++out->element_count < ELEMENTS_MAX;
}

/* The format that the next word names. */
static ply_format next_format(ply_lines words)
{
    ply_lines again = words;
    if (rt_import_ply_is(&words, "ascii"))
        return ASCII;
    return rt_import_ply_is(&again, "binary_little_endian") ? LITTLE : BIG;
}

/* Returns 0 where the header is damaged, or there is nothing to give colours. */
static int read_header(ply *out, char *bytes, size_t size, import_colours of, const char *weight)
{
    ply_lines lines = rt_import_ply_lines(bytes, size);
    int is_good = 1;
    out->element_count = 0;
    out->target = -1;
    out->after = NULL;
    out->newline = lines.newline;
    out->format = ASCII;
    while (is_good && rt_import_ply_next(&lines)) {
        ply_lines words = lines, property = lines, format = lines, end = lines;
        if (rt_import_ply_is(&end, "end_header")) {
            const int has_rows = rt_import_ply_next(&lines);
            out->body = lines.at;
            return has_rows && out->after;
        }
        if (rt_import_ply_is(&format, "format"))
            out->format = next_format(format);
        else if (rt_import_ply_is(&words, "element"))
            is_good = add_element(out, words, of == IMPORT_COLOURS_OF_VERTICES ? "vertex" : "face");
        else if (rt_import_ply_is(&property, "property") && out->element_count > 0) {
            is_good = add_property(&out->elements[out->element_count - 1], property, weight);
            if (out->target == out->element_count - 1) {
                ply_lines next = lines;
                rt_import_ply_next(&next);
                out->after = next.at;
            }
        }
    }
    return 0;
}

/* ---- The rows ---------------------------------------------------------------- */

/* A number of a row; returns 0 where the file ends before it. */
static int read_value(const char **at, const char *end, ply_format format, int type, double *out)
{
    const int size = types[type].size;
    uint64_t bits = 0;
    if (format == ASCII) {
        *at += strspn(*at, " \t\r\n\v\f");
        return rt_import_number(out, at);
    }
    if (end - *at < size)
        return 0;
    for (int i = 0; i < size; i++)
        bits |= (uint64_t)(unsigned char)(*at)[format == LITTLE ? i : size - 1 - i] << 8 * i;
    *at += size;
    if (types[type].kind == 'f' && size == 8) {
        memcpy(out, &bits, sizeof *out);
    } else if (types[type].kind == 'f') {
        const uint32_t low = (uint32_t)bits;
        float value;
        memcpy(&value, &low, sizeof value);
        *out = value;
    } else {
        const double range = (double)((uint64_t)1 << 8 * size);
        *out = (double)bits - (types[type].kind == 's' && bits >> (8 * size - 1) ? range : 0);
    }
    return 1;
}

/* Reads a row; *weight is the number of that field, if it has one. */
static int read_row(const char **at, const char *end, ply_format format, const element *of,
                    double *weight)
{
    for (int i = 0; i < of->field_count; i++) {
        double value = 1;
        if (of->fields[i].count_type >= 0 &&
            !read_value(at, end, format, of->fields[i].count_type, &value))
            return 0;
        for (double left = value; left > 0; left--)
            if (!read_value(at, end, format, of->fields[i].type, &value))
                return 0;
        if (i == of->weight)
            *weight = value;
    }
    return 1;
}

/* Writes the colour of a weight, and returns where it ends. */
static char *put_colour(char *to, ply_format format, const import_ramp *ramp, double weight)
{
    const double w = weight > 0 ? (weight < 1 ? weight : 1) : 0;
    for (int c = 0; c < 3; c++) {
        const float value = (float)((1 - w) * ramp->ends[0][c] + w * ramp->ends[1][c]);
        uint32_t bits;
        memcpy(&bits, &value, sizeof bits);
        if (format == ASCII)
            to += sprintf(to, " %.9g", (double)value);
        for (int i = 0; format != ASCII && i < 4; i++)
            *to++ = (char)(bits >> 8 * (format == LITTLE ? i : 3 - i) & 0xff);
    }
    return to;
}

/* Copies the rows with their colours; returns where they end, or NULL. */
static char *copy_rows(char *to, const ply *from, const char *end, const import_ramp *ramp)
{
    const char *at = from->body;
    for (int i = 0; i < from->element_count; i++)
        for (size_t row = 0; row < from->elements[i].rows && from->elements[i].field_count; row++) {
            const char *const start = at;
            double weight = 0;
            if (!read_row(&at, end, from->format, &from->elements[i], &weight) || at > end)
                return NULL;
            memcpy(to, start, (size_t)(at - start));
            to += at - start;
            if (i == from->target)
                to = put_colour(to, from->format, ramp, weight);
        }
    memcpy(to, at, (size_t)(end - at));
    return to + (end - at);
}

char *rt_import_ply_ramp(importer *import, int line, char *bytes, size_t size, import_colours of,
                         const import_ramp *ramp, size_t *out_size)
{
    static const char property[] =
        "property float red\nproperty float green\nproperty float blue\n";
    ply from;
    if (!read_header(&from, bytes, size, of, ramp->weight))
        return NULL;
    if (from.elements[from.target].weight < 0) {
        rt_import_note_at(import, line, "a mesh without the weight '%.40s' is white", ramp->weight);
        return NULL;
    }
    const size_t rows = from.elements[from.target].rows, head = (size_t)(from.after - bytes),
                 rest = (size_t)(from.body - from.after);
    char *const out = rows <= size ? malloc(size + sizeof property + rows * ROW_MAX) : NULL;
    if (rows <= size && !out)
        rt_import_fail_memory(import);
    if (!out)
        return NULL;
    memcpy(out, bytes, head);
    memcpy(out + head, property, sizeof property - 1);
    for (char *at = out + head; at < out + head + sizeof property - 1; at++)
        *at = *at == '\n' ? from.newline : *at;
    char *to = out + head + sizeof property - 1;
    memcpy(to, from.after, rest);
    to = copy_rows(to + rest, &from, bytes + size, ramp);
    if (!to)
        free(out);
    else
        *out_size = (size_t)(to - out);
    return to ? out : NULL;
}
