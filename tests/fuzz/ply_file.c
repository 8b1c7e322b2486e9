/* ply_file.c - writes PLY files: a random header, and the rows that it announces. */
#include "fuzz/ply_file.h"

#include <stdio.h>
#include <string.h>

enum { rows_max = 5, properties_max = 16, elements_max = 4 };

static const struct {
    const char *name;
    int size, is_real;
} types[] = {{"char", 1, 0},  {"uchar", 1, 0},  {"short", 2, 0},   {"ushort", 2, 0},
             {"int", 4, 0},   {"uint", 4, 0},   {"float", 4, 1},   {"double", 8, 1},
             {"int8", 1, 0},  {"uint8", 1, 0},  {"int16", 2, 0},   {"uint16", 2, 0},
             {"int32", 4, 0}, {"uint32", 4, 0}, {"float32", 4, 1}, {"float64", 8, 1}};

enum { type_count = sizeof types / sizeof *types };

typedef struct property {
    const char *name;
    int type, count_type; /* count_type < 0: no list */
    int is_index;
} property;

typedef struct element {
    const char *name;
    unsigned rows;
    property properties[properties_max];
    int count;
} element;

typedef struct writer {
    rt_bytes *out;
    fuzz_random *random;
    int is_text, is_big;
    unsigned vertices;
} writer;

static uint32_t below(const writer *w, uint32_t limit)
{
    return fuzz_random_below(w->random, limit);
}

/* ---- The header ---------------------------------------------------------------------------- */

static int any_type(const writer *w)
{
    return (int)below(w, type_count);
}

static int whole_type(const writer *w)
{
    int type = any_type(w);
    return types[type].is_real ? 5 : type;
}

static void add(element *e, const char *name, int type, int count_type, int is_index)
{
    if (e->count < properties_max)
        e->properties[e->count++] = (property){name, type, count_type, is_index};
}

/* Groups of names that mean something together, mostly of one type. */
static void add_group(const writer *w, element *e, const char *const *names, int count, int type)
{
    for (int i = 0; i < count; i++)
        if (below(w, 32))
            add(e, names[i], below(w, 16) ? type : any_type(w), -1, 0);
}

static void make_vertex(const writer *w, element *e)
{
    static const char *const position[] = {"x", "y", "z"}, *const normal[] = {"nx", "ny", "nz"};
    static const char *const uv[4][2] = {
        {"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}};
    static const char *const colour[2][3] = {{"red", "green", "blue"}, {"r", "g", "b"}};
    int is_real = below(w, 4) != 0;
    add_group(w, e, position, 3, is_real ? 6 + (int)below(w, 2) : any_type(w));
    if (below(w, 4) == 0)
        add(e, "quality", any_type(w), below(w, 2) ? -1 : whole_type(w), 0);
    if (below(w, 2))
        add_group(w, e, normal, 3, 6);
    if (below(w, 2))
        add_group(w, e, uv[below(w, 4)], 2, below(w, 4) ? 6 : any_type(w));
    if (below(w, 2))
        add_group(w, e, colour[below(w, 2)], 3, below(w, 2) ? 1 : any_type(w));
}

static void make_face(const writer *w, element *e)
{
    if (below(w, 8) == 0)
        add(e, "flags", any_type(w), below(w, 2) ? -1 : whole_type(w), 0);
    if (below(w, 16))
        add(e, below(w, 2) ? "vertex_indices" : "vertex_index",
            below(w, 8) ? 4 + (int)below(w, 2) : any_type(w), below(w, 16) ? whole_type(w) : -1, 1);
    if (below(w, 4) == 0)
        add(e, "texcoord", below(w, 8) ? 6 : any_type(w), below(w, 16) ? 1 : -1, 0);
}

static void put_header(const writer *w, const element *elements, int count)
{
    char line[128];
    fuzz_put_text(w->out, "ply\nformat ");
    fuzz_put_text(w->out, w->is_text  ? "ascii 1.0\n"
                          : w->is_big ? "binary_big_endian 1.0\n"
                                      : "binary_little_endian 1.0\n");
    if (below(w, 8) == 0)
        fuzz_put_text(w->out, "comment TextureFile t.png\nobj_info any\n");
    for (int i = 0; i < count; i++) {
        snprintf(line, sizeof line, "element %s %u\n", elements[i].name, elements[i].rows);
        fuzz_put_text(w->out, line);
        for (int j = 0; j < elements[i].count; j++) {
            const property *p = &elements[i].properties[j];
            if (p->count_type < 0)
                snprintf(line, sizeof line, "property %s %s\n", types[p->type].name, p->name);
            else
                snprintf(line, sizeof line, "property list %s %s %s\n", types[p->count_type].name,
                         types[p->type].name, p->name);
            fuzz_put_text(w->out, line);
        }
    }
    fuzz_put_text(w->out, "end_header\n");
}

/* ---- The body ------------------------------------------------------------------------------ */

/* A number that every type holds, of which reals get a quarter. */
static void put_value(const writer *w, int type, int value)
{
    float narrow = (float)value * 0.25f;
    double wide = narrow;
    uint64_t bits;
    char text[32];
    if (w->is_text) {
        snprintf(text, sizeof text, types[type].is_real ? "%g " : "%.0f ",
                 types[type].is_real ? wide : (double)value);
        fuzz_put_text(w->out, text);
    } else if (!types[type].is_real) {
        fuzz_put_number(w->out, (uint64_t)(int64_t)value, types[type].size, w->is_big);
    } else if (types[type].size == 4) {
        fuzz_put_float(w->out, narrow, w->is_big);
    } else {
        memcpy(&bits, &wide, sizeof bits);
        fuzz_put_number(w->out, bits, 8, w->is_big);
    }
}

static int index_value(const writer *w)
{
    if (below(w, 64) == 0)
        return below(w, 2) ? -1 : (int)w->vertices;
    return w->vertices ? (int)below(w, w->vertices) : 0;
}

static void put_property(const writer *w, const property *p, int corners)
{
    int count = 1;
    if (p->count_type >= 0) {
        count = p->is_index ? corners : below(w, 2) ? 2 * corners : (int)below(w, 3);
        put_value(w, p->count_type, types[p->count_type].is_real ? 4 * count : count);
    }
    for (int i = 0; i < count; i++)
        put_value(w, p->type, p->is_index ? index_value(w) : (int)below(w, 32));
}

static void put_body(const writer *w, const element *elements, int count)
{
    for (int i = 0; i < count; i++)
        for (unsigned row = 0; row < elements[i].rows; row++) {
            int corners = below(w, 8) ? 3 + (int)below(w, 3) : (int)below(w, 8);
            for (int j = 0; j < elements[i].count; j++)
                put_property(w, &elements[i].properties[j], corners);
            if (w->is_text)
                fuzz_put_text(w->out, "\n");
        }
}

/* ---- The file ------------------------------------------------------------------------------ */

void fuzz_ply_file(rt_bytes *out, fuzz_random *random)
{
    static const char *const names[] = {"vertex", "face", "tristrips", "edge"};
    writer w = {out, random, 0, 0, 0};
    element elements[elements_max] = {{0}};
    int count = 2 + (int)below(&w, 3), is_turned = below(&w, 8) == 0;
    w.is_text = below(&w, 3) == 0;
    w.is_big = below(&w, 3) == 0;
    for (int i = 0; i < count; i++) {
        element *e = &elements[is_turned ? count - 1 - i : i];
        e->name = names[i];
        e->rows = below(&w, rows_max) + (i == 0 ? 2 : 0);
        if (i == 0) {
            w.vertices = e->rows;
            make_vertex(&w, e);
        } else {
            make_face(&w, e);
        }
    }
    put_header(&w, elements, count);
    put_body(&w, elements, count);
}
