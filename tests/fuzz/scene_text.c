/* scene_text.c - writes blocks of the language, field by field. */
#include "fuzz/scene_text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const char fuzz_scene_names[] = "let n = 2\n"
                                "material m { kd 0.5 }\n"
                                "material g { kt 1  ior 1.5  fresnel dielectric }\n"
                                "material h { kt 0.9  ior 1.3  fresnel dielectric }\n"
                                "material c { ks 1  fresnel conductor  eta 1  k 3 }\n"
                                "material e { emission 3 }\n"
                                "texture t { file \"t.png\" }\n"
                                "grid puff { file \"d.grid\" }\n"
                                "mesh thing { file \"m.ply\" }\n";

/* A block under construction. */
typedef struct writer {
    rt_bytes *out;
    fuzz_random *random;
    int is_wild; /* values may be wrong */
} writer;

static uint32_t below(const writer *w, uint32_t limit)
{
    return fuzz_random_below(w->random, limit);
}

static void put_choice(const writer *w, const char *const *words, uint32_t count)
{
    fuzz_put_text(w->out, words[below(w, count)]);
}

/* ---- Values -------------------------------------------------------------------------------- */

/* What is hard on arithmetic, as numbers and as expressions. */
static void put_wild_number(const writer *w)
{
    static const char *const numbers[] = {
        "-1",         "0",          "1e15",     "1e-15",       "1e28",      "-1e15",
        "1e-30",      "3e38",       "1e-45",    "1e308",       "n",         "(0.1 + 0.2)",
        "(1 - 3)",    "(-n * 2)",   "sin(30)",  "(1 / 0)",     "sqrt(2)",   "(max(n, 3) / 7)",
        "pow(n, 9)",  "random(n)",  "floor(n)", "mod(n, 1.5)", "1.0000001", "0.99999994",
        "2147483647", "4294967295", "16777217", "1e7"};
    put_choice(w, numbers, sizeof numbers / sizeof *numbers);
}

static void put_number(const writer *w, rt_range range, int is_whole)
{
    int is_bounded = range.kind == RT_RANGE_CLOSED || range.kind == RT_RANGE_ABOVE ||
                     range.kind == RT_RANGE_BETWEEN || range.kind == RT_RANGE_ZERO_OR;
    double low = is_bounded ? range.low : -4.0, high = is_bounded ? range.high : 4.0, value;
    char text[40];
    if (w->is_wild && below(w, 4) == 0) {
        put_wild_number(w);
        return;
    }
    if (w->is_wild && below(w, 4) == 0)
        value = below(w, 2) ? low : high;
    else if (high - low > 1.0)
        value = fmin(low + 0.25 * (1.0 + below(w, 16)), high);
    else
        value = low + (high - low) * 0.25;
    snprintf(text, sizeof text, "%.9g", is_whole ? fmin(ceil(value), high) : value);
    fuzz_put_text(w->out, text);
}

static void put_numbers(const writer *w, rt_range range, int count)
{
    for (int i = 0; i < count; i++) {
        fuzz_put_text(w->out, " ");
        put_number(w, range, 0);
    }
}

/* One that is no multiple of the others, so that no cross product vanishes. */
static void put_vector(const writer *w, rt_range range)
{
    static const char *const vectors[] = {" 0 1 0", " 1 0 0", " 0 0 1", " 1 2 3", " [n 0 1]"};
    if (range.kind == RT_RANGE_DIRECTION || (range.kind == RT_RANGE_ANY && below(w, 2)))
        put_choice(w, vectors, sizeof vectors / sizeof *vectors);
    else
        put_numbers(w, range, 3);
}

static void put_word(const writer *w, const rt_word *words)
{
    uint32_t count = 0;
    while (words[count].name)
        count++;
    fuzz_put_text(w->out, words[below(w, count)].name);
}

/* A file, or a layer of an image: that of its red channel. */
static void put_quoted(const writer *w, rt_block_id block, rt_field_type type)
{
    static const char *const meshes[] = {"\"m.ply\"", "\"m.obj\"", "\"m.off\"", "\"m.stl\""};
    static const char *const images[] = {"\"t.png\"", "\"t.ppm\"", "\"t.pfm\"", "\"t.exr\""};
    if (block == RT_BLOCK_GRID || type == RT_FIELD_STRING) {
        fuzz_put_text(w->out, type == RT_FIELD_STRING ? "\"R\"" : "\"d.grid\"");
        return;
    }
    if (block == RT_BLOCK_GONIOMETRIC_LIGHT && below(w, 2)) {
        fuzz_put_text(w->out, "\"l.ies\"");
        return;
    }
    int is_image = block == RT_BLOCK_TEXTURE || block == RT_BLOCK_ENVIRONMENT_LIGHT ||
                   block == RT_BLOCK_SPOT_LIGHT || block == RT_BLOCK_PROJECTOR_LIGHT ||
                   block == RT_BLOCK_GONIOMETRIC_LIGHT;
    if (w->is_wild && below(w, 16) == 0)
        is_image = !is_image;
    put_choice(w, is_image ? images : meshes, 4);
}

/* One of these names, or any where values are wild. */
static void put_value(const writer *w, const rt_field *field, rt_block_id block)
{
    static const char *const materials[] = {"m", "g", "h", "c", "e", "x1"};
    static const char *const axes[] = {"0 1 0 ", "1 1 0 ", "0 0 1 "};
    switch (field->type) {
    case RT_FIELD_NUMBER:
        put_number(w, field->range, 0);
        break;
    case RT_FIELD_INTEGER:
    case RT_FIELD_COUNT:
        put_number(w, field->range, 1);
        break;
    case RT_FIELD_PAIR:
        put_numbers(w, field->range, 2);
        break;
    case RT_FIELD_VECTOR:
        put_vector(w, field->range);
        break;
    case RT_FIELD_BOOLEAN:
    case RT_FIELD_CHOICE:
        put_word(w, rt_field_words(field));
        break;
    case RT_FIELD_MATERIAL:
    case RT_FIELD_PART:
        put_choice(w, materials, w->is_wild ? 6 : 4);
        break;
    case RT_FIELD_TEXTURE:
    case RT_FIELD_GRID:
        fuzz_put_text(w->out, field->type == RT_FIELD_GRID ? "puff" : "t");
        break;
    case RT_FIELD_FILE:
    case RT_FIELD_STRING:
        put_quoted(w, block, field->type);
        break;
    case RT_FIELD_ROTATE:
        put_choice(w, axes, 3);
        put_number(w, field->range, 0);
        break;
    case RT_FIELD_TRANSLATE:
        put_numbers(w, field->range, 3);
        break;
    case RT_FIELD_COLOUR:
    case RT_FIELD_SCALE:
        put_numbers(w, field->range, below(w, 2) ? 1 : 3);
        break;
    case RT_FIELD_MATRIX:
        put_numbers(w, field->range, 12);
        break;
    }
}

/* ---- Blocks -------------------------------------------------------------------------------- */

/* Whether a block gets a field; `grouped` counts those that exclude each other. */
static int has_field(const writer *w, const rt_field *field, fuzz_fields fields, int *grouped)
{
    if (fields == FUZZ_FIELDS_ANY && field->need == RT_NEED_OPTIONAL)
        return below(w, 4) == 0;
    if (w->is_wild)
        return below(w, 16) != 0;
    switch (field->need) {
    case RT_NEED_REQUIRED:
        return 1;
    case RT_NEED_ONE_OF:
        return (*grouped)++ == 0;
    case RT_NEED_AT_MOST_ONE:
        return fields == FUZZ_FIELDS_ALL && (*grouped)++ == 0;
    case RT_NEED_OPTIONAL:
    case RT_NEED_ALL_OR_NONE:
    case RT_NEED_ALL_OR_NONE_TOO:
        break;
    }
    return fields == FUZZ_FIELDS_ALL;
}

void fuzz_scene_block(rt_bytes *out, const rt_block *block, fuzz_fields fields, fuzz_random *random)
{
    const int is_wild = fields == FUZZ_FIELDS_ANY && fuzz_random_below(random, 2);
    const writer w = {out, random, is_wild};
    const rt_field *field;
    char title[RT_BLOCK_TITLE_SIZE], name[16];
    int grouped = 0;
    fuzz_put_text(out, rt_block_title(title, block));
    snprintf(name, sizeof name, " x%u", below(&w, 1000));
    if (block->flags & RT_BLOCK_NAMED)
        fuzz_put_text(out, name);
    if (block->flags & RT_BLOCK_REFERS)
        fuzz_put_text(out, " thing");
    fuzz_put_text(out, " {");
    for (size_t i = 0; (field = rt_block_field(block, i)) != NULL; i++)
        if (has_field(&w, field, fields, &grouped)) {
            fuzz_put_text(out, " ");
            fuzz_put_text(out, field->name);
            fuzz_put_text(out, " ");
            put_value(&w, field, block->id);
        }
    fuzz_put_text(out, " }\n");
}

static size_t count_blocks(void)
{
    size_t count = 0;
    while (rt_block_at(count))
        count++;
    return count;
}

static const rt_block *choose_block(fuzz_random *random)
{
    return rt_block_at(fuzz_random_below(random, (uint32_t)count_blocks()));
}

void fuzz_scene_any_block(rt_bytes *out, fuzz_random *random)
{
    fuzz_scene_block(out, choose_block(random), FUZZ_FIELDS_ANY, random);
}

void fuzz_scene_any_value(rt_bytes *out, fuzz_random *random)
{
    const writer w = {out, random, 1};
    const rt_block *block = choose_block(random);
    size_t count = 0;
    while (rt_block_field(block, count))
        count++;
    put_value(&w, rt_block_field(block, fuzz_random_below(random, (uint32_t)count)), block->id);
}
