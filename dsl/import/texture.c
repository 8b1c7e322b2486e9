/* texture.c - textures of the new scene, and textures in each other. */
#include <math.h>
#include <string.h>

#include "dsl/import/import.h"

/* ---- Blocks ------------------------------------------------------------------ */

static void put_field(importer *import, const char *field, const double *values, int count)
{
    rt_import_put_field(import, &import->definitions, field, values, count);
}

static void put_image(importer *import, const import_texture *texture)
{
    static const char *const wraps[] = {"repeat", "mirror", "clamp"};
    import_text *out = &import->definitions;
    rt_import_put(import, out, " file \"%s\"", texture->file);
    if (texture->is_linear)
        rt_import_put(import, out, " linear true");
    if (texture->wrap)
        rt_import_put(import, out, " wrap %s", wraps[texture->wrap]);
    if (texture->is_nearest)
        rt_import_put(import, out, " filter nearest");
    if (texture->channel)
        rt_import_put(import, out, " channel %c", texture->channel);
    if (texture->power != 0 && texture->power != 1)
        rt_import_put(import, out, " power %.9g", texture->power);
}

static int is_all(const double colour[3], double value)
{
    return colour[0] == value && colour[1] == value && colour[2] == value;
}

/* A colour, the name of a texture, or both, whose product it is. */
static void put_factor(importer *import, const char *field, const import_factor *factor)
{
    if (factor->handle != IMPORT_NONE)
        rt_import_put(import, &import->definitions, " %s_texture %s", field,
                      rt_import_label(import, factor->handle));
    if (factor->handle == IMPORT_NONE || !is_all(factor->colour, 1))
        put_field(import, field, factor->colour, 3);
}

static double mean(const double colour[3])
{
    return (colour[0] + colour[1] + colour[2]) / 3;
}

static void put_pattern(importer *import, const import_texture *texture)
{
    static const char *const patterns[] = {"checker", "multiply", "mix", "attribute"};
    const double weight = mean(texture->weight.colour);
    rt_import_put(import, &import->definitions, " pattern %s", patterns[texture->pattern]);
    if (texture->pattern == IMPORT_ATTRIBUTE)
        return;
    put_factor(import, "a", &texture->a);
    put_factor(import, "b", &texture->b);
    if (texture->pattern != IMPORT_MIX)
        return;
    if (texture->weight.handle != IMPORT_NONE)
        rt_import_put(import, &import->definitions, " weight_texture %s",
                      rt_import_label(import, texture->weight.handle));
    put_field(import, "weight", &weight, 1);
}

/* Two numbers that move an image. */
static void put_move(importer *import, const char *field, const double values[2], double none)
{
    double within[2];
    int is_out = 0;
    for (int i = 0; i < 2; i++) {
        within[i] = fmin(fmax(values[i], -IMPORT_UV_MAX), IMPORT_UV_MAX);
        is_out |= within[i] != values[i];
    }
    if (is_out)
        rt_import_note_at(import, 0, "the %s of a texture, beyond %g, became that", field,
                          IMPORT_UV_MAX);
    if (within[0] != none || within[1] != none)
        put_field(import, field, within, 2);
}

double rt_import_texture_most(const importer *import, int handle)
{
    const double most = handle >= 0 ? import->labels[handle].most : 0;
    return most > 0 ? most : 1;
}

static double factor_most(const importer *import, const import_factor *factor)
{
    return fmax(factor->colour[0], fmax(factor->colour[1], factor->colour[2])) *
           rt_import_texture_most(import, factor->handle);
}

/* Of a pattern. */
static double pattern_most(const importer *import, const import_texture *texture)
{
    const double a = factor_most(import, &texture->a), b = factor_most(import, &texture->b);
    return texture->pattern == IMPORT_ATTRIBUTE  ? 1
           : texture->pattern == IMPORT_MULTIPLY ? a * b
                                                 : fmax(a, b);
}

int rt_import_add_texture(importer *import, const char *base, const import_texture *texture)
{
    import_text *out = &import->definitions;
    int handle = rt_import_name(import, base);
    rt_import_put(import, out, "texture %s {", rt_import_label(import, handle));
    if (texture->file)
        put_image(import, texture);
    else
        put_pattern(import, texture);
    put_move(import, "scale", texture->scale, 1);
    put_move(import, "offset", texture->offset, 0);
    if (texture->rotate != 0)
        put_field(import, "rotate", &texture->rotate, 1);
    if (texture->shear != 0)
        put_field(import, "shear", &texture->shear, 1);
    if (texture->attribute)
        rt_import_put(import, out, " attribute \"%s\"", texture->attribute);
    rt_import_put(import, out, " }\n");
    if (handle >= 0 && !texture->file && !import->failed)
        import->labels[handle].most = pattern_most(import, texture);
    return handle;
}

/* ---- Textures in each other -------------------------------------------------- */

import_factor rt_import_colour(const double colour[3])
{
    import_factor factor = {.handle = IMPORT_NONE};
    memcpy(factor.colour, colour, sizeof factor.colour);
    return factor;
}

/* Without light that there is not; a black texture is black. */
static import_factor positive(importer *import, int line, const import_factor *factor)
{
    import_factor out = *factor;
    for (int c = 0; c < 3; c++) {
        if (out.colour[c] < 0)
            rt_import_note_at(import, line, "a negative colour of a texture became 0");
        out.colour[c] = out.colour[c] > 0 ? out.colour[c] : 0;
    }
    if (is_all(out.colour, 0))
        out.handle = IMPORT_NONE;
    return out;
}

/* The levels and rows of a texture that has these inside, as the library counts them. */
static void measure(const importer *import, const import_texture *texture, int *levels, int *rows)
{
    const import_factor *const factors[] = {&texture->a, &texture->b, &texture->weight};
    *levels = 1;
    *rows = 2;
    for (int i = 0; i < (texture->pattern == IMPORT_MIX ? 3 : 2); i++) {
        const import_label_entry *label =
            factors[i]->handle == IMPORT_NONE ? NULL : &import->labels[factors[i]->handle];
        const int inner = label && label->levels ? label->levels : label != NULL;
        *levels = inner + 1 > *levels ? inner + 1 : *levels;
        *rows += label && label->rows ? label->rows + 1 : 2;
    }
}

/* Adds a pattern, with colours in place of what lies too deep inside. */
static import_factor add(importer *import, int line, const char *base, import_texture *texture)
{
    import_factor out = {.colour = {1, 1, 1}};
    int levels, rows;
    measure(import, texture, &levels, &rows);
    if (levels > RT_TEXTURE_LEVELS || rows > IMPORT_ROWS_MAX) {
        rt_import_note_at(import, line, "textures lie too deep in each other: some became colours");
        texture->a.handle = texture->b.handle = texture->weight.handle = IMPORT_NONE;
        measure(import, texture, &levels, &rows);
    }
    out.handle = rt_import_add_texture(import, base, texture);
    if (out.handle != IMPORT_NONE && !import->failed) {
        import->labels[out.handle].levels = levels;
        import->labels[out.handle].rows = rows;
    }
    return out;
}

import_factor rt_import_product(importer *import, int line, const char *base,
                                const import_factor *a, const import_factor *b)
{
    import_texture texture = {.pattern = IMPORT_MULTIPLY, .scale = {1, 1}};
    import_factor out = positive(import, line, a);
    const import_factor by = positive(import, line, b);
    double colour[3];
    for (int c = 0; c < 3; c++)
        colour[c] = out.colour[c] * by.colour[c];
    if (out.handle != IMPORT_NONE && by.handle != IMPORT_NONE && !is_all(colour, 0)) {
        texture.a = (import_factor){out.handle, {1, 1, 1}};
        texture.b = (import_factor){by.handle, {1, 1, 1}};
        out = add(import, line, base, &texture);
    } else {
        out.handle = out.handle != IMPORT_NONE ? out.handle : by.handle;
    }
    memcpy(out.colour, colour, sizeof colour);
    return positive(import, line, &out);
}

import_factor rt_import_mixture(importer *import, int line, const char *base,
                                const import_factor *a, const import_factor *b,
                                const import_factor *weight)
{
    import_texture texture = {.pattern = IMPORT_MIX,
                              .a = positive(import, line, a),
                              .b = positive(import, line, b),
                              .weight = positive(import, line, weight),
                              .scale = {1, 1}};
    const double w = fmin(mean(texture.weight.colour), 1);
    const int is_number = texture.weight.handle == IMPORT_NONE;
    if (w <= 0)
        return texture.a;
    if (w == 1 && is_number)
        return texture.b;
    for (int c = 0; c < 3; c++)
        texture.weight.colour[c] = w;
    if (is_number && texture.a.handle == IMPORT_NONE && texture.b.handle == IMPORT_NONE) {
        for (int c = 0; c < 3; c++)
            texture.a.colour[c] += w * (texture.b.colour[c] - texture.a.colour[c]);
        return texture.a;
    }
    return add(import, line, base, &texture);
}

import_factor rt_import_checker(importer *import, int line, const char *base,
                                const import_texture *place, const import_factor *a,
                                const import_factor *b)
{
    import_texture texture = *place;
    texture.pattern = IMPORT_CHECKER;
    texture.a = positive(import, line, a);
    texture.b = positive(import, line, b);
    return add(import, line, base, &texture);
}
