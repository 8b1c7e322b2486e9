/* pbrt_param.c - parameters, as "float radius" [ 1 ]. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "dsl/import/pbrt.h"
#include "dsl/import/spectrum.h"

enum { VALUES_MAX = 300000000 };

/* ---- Reading ----------------------------------------------------------------- */

static int add_number(pbrt_params *params, pbrt_param *param, double value)
{
    const size_t count = param->number_count;
    if (count >= VALUES_MAX)
        return rt_import_fail_memory(params->import);
    double *moved = rt_import_grow(params->import, param->numbers, count, sizeof *moved);
    if (!moved)
        return 0;
    param->numbers = moved;
    param->numbers[param->number_count++] = value;
    return 1;
}

static int add_string(pbrt_params *params, pbrt_param *param, const char *text)
{
    void *moved =
        rt_import_grow(params->import, param->strings, param->string_count, sizeof *param->strings);
    if (!moved)
        return 0;
    param->strings = moved;
    snprintf(param->strings[param->string_count++], PBRT_TEXT, "%s", text);
    return 1;
}

/* A wrong value is told, and a default stands in for it. */
static void note_wrong(pbrt_params *params, pbrt_param *param, const char *fault)
{
    param->is_wrong = 1;
    rt_import_note_at(params->import, param->line, "\"%s %s\" %s: it counts as not given",
                      param->type, param->name, fault);
}

static int is_not_finite(const char *word)
{
    static const char *const words[] = {"nan", "inf", "infinity"};
    word += *word == '-' || *word == '+';
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcasecmp(word, words[i]) == 0)
            return 1;
    return 0;
}

static int add_value(pbrt_params *params, pbrt_param *param, const pbrt_token *token)
{
    if (token->kind == PBRT_NUMBER)
        return add_number(params, param, token->number);
    if (token->kind == PBRT_STRING ||
        (token->kind == PBRT_WORD &&
         (strcmp(token->text, "true") == 0 || strcmp(token->text, "false") == 0)))
        return add_string(params, param, token->text);
    if (token->kind == PBRT_WORD && is_not_finite(token->text)) {
        note_wrong(params, param, "has a number that is not finite");
        return 1;
    }
    if (token->kind == PBRT_WORD)
        return rt_import_fail(params->import, token->line,
                              "\"%s %s\": '%.40s' is not a finite number", param->type, param->name,
                              token->text);
    return rt_import_fail(params->import, param->line, "\"%s %s\" has no value, or is not closed",
                          param->type, param->name);
}

static void read_values(pbrt_params *params, pbrt_param *param, pbrt_tokens *tokens)
{
    pbrt_token token = rt_pbrt_take(tokens);
    if (token.kind != PBRT_OPEN) {
        add_value(params, param, &token);
        return;
    }
    while (!params->import->failed) {
        token = rt_pbrt_take(tokens);
        if (token.kind == PBRT_CLOSE)
            return;
        add_value(params, param, &token);
    }
}

void rt_pbrt_read_params(pbrt_params *params, pbrt_tokens *tokens)
{
    memset(params, 0, sizeof *params);
    params->import = tokens->import;
    params->line = rt_pbrt_line(tokens);
    params->is_v3 = tokens->is_v3;
    while (!params->import->failed && rt_pbrt_peek(tokens)->kind == PBRT_STRING) {
        pbrt_token token = rt_pbrt_take(tokens);
        pbrt_param *param = &params->items[params->count];
        if (params->count == PBRT_PARAMS_MAX) {
            rt_import_fail(params->import, token.line, "more than %d parameters", PBRT_PARAMS_MAX);
            return;
        }
        if (sscanf(token.text, " %31s %63s", param->type, param->name) != 2) {
            rt_import_fail(params->import, token.line,
                           "'%.60s' is no parameter: a type and a name are expected", token.text);
            return;
        }
        param->line = token.line;
        params->count++;
        read_values(params, param, tokens);
    }
}

void rt_pbrt_free_params(pbrt_params *params)
{
    for (int i = 0; i < params->count; i++)
        if (!params->items[i].of) {
            free(params->items[i].numbers);
            free(params->items[i].strings);
        }
}

/* ---- Values ------------------------------------------------------------------ */

int rt_pbrt_is_among(const char *word, const char *list)
{
    size_t length = strlen(word);
    for (const char *at = list; length > 0 && (at = strstr(at, word)) != NULL; at++)
        if ((at == list || at[-1] == ' ') && (at[length] == ' ' || at[length] == '\0'))
            return 1;
    return 0;
}

pbrt_param *rt_pbrt_find(pbrt_params *params, const char *types, const char *name)
{
    for (int i = 0; i < params->count; i++)
        if (strcmp(params->items[i].name, name) == 0 &&
            rt_pbrt_is_among(params->items[i].type, types)) {
            params->items[i].is_used = 1;
            if (params->items[i].of)
                params->items[i].of->is_used = 1;
            return params->items[i].is_wrong ? NULL : &params->items[i];
        }
    if (params->asked_count < PBRT_ASKED_MAX) {
        params->asked[params->asked_count].types = types;
        snprintf(params->asked[params->asked_count++].name, sizeof params->asked[0].name, "%s",
                 name);
    }
    return NULL;
}

/* Such a parameter, of so many numbers and strings; NULL where it is not there or has others. */
static pbrt_param *find_values(pbrt_params *params, const char *types, const char *name,
                               size_t numbers, size_t strings, const char *what)
{
    pbrt_param *param = rt_pbrt_find(params, types, name);
    if (!param || (param->number_count == numbers && param->string_count == strings))
        return param;
    char fault[80];
    snprintf(fault, sizeof fault, "takes %s", what);
    note_wrong(params, param, fault);
    return NULL;
}

double rt_pbrt_number(pbrt_params *params, const char *name, double fallback)
{
    pbrt_param *param = find_values(params, "float integer", name, 1, 0, "one number");
    if (!param)
        return fallback;
    if (strcmp(param->type, "float") == 0 || param->numbers[0] == floor(param->numbers[0]))
        return param->numbers[0];
    note_wrong(params, param, "takes a whole number");
    return fallback;
}

int rt_pbrt_flag(pbrt_params *params, const char *name, int fallback)
{
    pbrt_param *param = find_values(params, "bool", name, 0, 1, "true or false");
    const int is_true = param && strcmp(param->strings[0], "true") == 0;
    if (!param || is_true || strcmp(param->strings[0], "false") == 0)
        return param ? is_true : fallback;
    note_wrong(params, param, "takes true or false");
    return fallback;
}

const char *rt_pbrt_string(pbrt_params *params, const char *name, const char *fallback)
{
    const pbrt_param *param = find_values(params, "string", name, 0, 1, "one string");
    return param ? param->strings[0] : fallback;
}

const char *rt_pbrt_word(pbrt_params *params, const char *name, const char *words,
                         const char *fallback)
{
    const char *const word = rt_pbrt_string(params, name, fallback);
    if (rt_pbrt_is_among(word, words))
        return word;
    rt_import_note_at(params->import, params->line, "there is no %s '%.40s': it became %s", name,
                      word, fallback);
    return fallback;
}

void rt_pbrt_point(pbrt_params *params, const char *name, double out[3])
{
    const pbrt_param *param =
        find_values(params, "point point3 vector vector3", name, 3, 0, "three numbers");
    if (param)
        memcpy(out, param->numbers, 3 * sizeof *out);
}

/* ---- Colours ----------------------------------------------------------------- */

/*
 * The colour of a black body in linear sRGB, of luminance 1; with a second number, which is of
 * pbrt-v3, that times one whose largest radiance at any wavelength (Wien's law) is 1.
 */
static void black_body(const pbrt_param *param, double out[3])
{
    const double kelvin = param->numbers[0], wavelength = 2.897771955e6 / kelvin,
                 largest = 1.1910429724e20 / pow(wavelength, 5) /
                           expm1(1.438776877e7 / (wavelength * kelvin)),
                 scale = param->number_count > 1 ? param->numbers[1] : 0;
    double rgb[3];
    rt_spectrum_black_body(kelvin, rgb);
    for (int c = 0; c < 3; c++)
        out[c] = scale > 0 ? scale * rgb[c] / largest : rgb[c] / rt_spectrum_luminance(rgb);
}

/* Lights have the colour of a spectrum, in v4 of luminance 1; it is no reflectance. */
static int is_of_light(const char *name)
{
    return strcmp(name, "L") == 0 || strcmp(name, "I") == 0;
}

/* A spectrum by wavelengths, of a file, or by a name. */
static void read_spectrum(pbrt_params *params, const pbrt_param *param, double out[3])
{
    spectrum s = {NULL, NULL, 0};
    const int is_index = strcmp(param->name, "eta") == 0 || strcmp(param->name, "k") == 0;
    const spectrum_use use = is_of_light(param->name) ? SPECTRUM_EMISSION
                             : is_index               ? SPECTRUM_INDEX
                                                      : SPECTRUM_REFLECTANCE;
    const char *const name = param->string_count ? param->strings[0] : NULL;
    int is_read = 1;
    out[0] = out[1] = out[2] = 1;
    if (param->number_count == 1) {
        out[0] = out[1] = out[2] = param->numbers[0];
        return;
    }
    if (param->number_count % 2) {
        rt_import_note_at(
            params->import, param->line,
            "a spectrum of %lu numbers became white: wavelengths and values are pairs",
            (unsigned long)param->number_count);
        return;
    }
    for (size_t i = 1; i < param->number_count && is_read; i += 2)
        is_read = rt_spectrum_add(params->import, param->line, &s, param->numbers[i - 1],
                                  param->numbers[i]);
    if (name && rt_import_has_file(params->import, name))
        is_read = rt_spectrum_read_file(params->import, param->line, &s, name);
    if (is_read && s.count > 0) {
        rt_spectrum_colour(params->import, param->line, &s, use, out);
        const double y = rt_spectrum_luminance(out);
        for (int c = 0; c < 3 && use == SPECTRUM_EMISSION && !params->is_v3 && y > 0; c++)
            out[c] /= y;
    } else if (!name || strcmp(name, "stdillum-D65") != 0) {
        rt_import_note_at(params->import, param->line, "the spectrum %.40s became white",
                          name ? name : "without values");
    }
    rt_spectrum_free(&s);
}

int rt_pbrt_colour(pbrt_params *params, const char *name, double out[3])
{
    pbrt_param *const param = rt_pbrt_find(params, "rgb color spectrum blackbody float", name);
    if (!param)
        return 0;
    const size_t count = param->number_count;
    const int is_body = strcmp(param->type, "blackbody") == 0;
    if (is_body && count > 0 && param->numbers[0] >= 100)
        black_body(param, out);
    else if (strcmp(param->type, "spectrum") == 0)
        read_spectrum(params, param, out);
    else if (is_body || count != (strcmp(param->type, "float") == 0 ? 1 : 3)) {
        note_wrong(params, param,
                   is_body                             ? "takes a temperature from 100 on"
                   : strcmp(param->type, "float") == 0 ? "takes one number"
                                                       : "takes three numbers");
        return 0;
    } else {
        for (size_t c = 0; c < 3; c++)
            out[c] = param->numbers[count == 3 ? c : 0];
    }
    return 1;
}

/* Whether a parameter before this one has its name, and was read. */
static int is_again(const pbrt_params *params, int index)
{
    for (int i = 0; i < index; i++)
        if (params->items[i].is_used &&
            strcmp(params->items[i].name, params->items[index].name) == 0)
            return 1;
    return 0;
}

/* Tells that a parameter is left out, and what it may have meant. */
static void note_unused(pbrt_params *params, int index, const char *what)
{
    const pbrt_param *const param = &params->items[index];
    rt_nearest meant;
    const char *types = NULL;
    rt_nearest_begin(&meant, param->name, strlen(param->name));
    for (int i = 0; i < params->asked_count; i++) {
        rt_nearest_offer(&meant, params->asked[i].name, strlen(params->asked[i].name));
        if (strcmp(params->asked[i].name, param->name) == 0)
            types = params->asked[i].types;
    }
    char text[160];
    snprintf(text, sizeof text, "\"%s %s\" of %.40s", param->type, param->name, what);
    if (is_again(params, index))
        rt_import_note_at(params->import, param->line, "%s is given again: the first counts", text);
    else if (types)
        rt_import_note_at(params->import, param->line, "%s is left out: expected \"%.*s %s\"", text,
                          (int)strcspn(types, " "), types, param->name);
    else if (meant.best)
        rt_import_note_at(params->import, param->line, "%s is left out: did you mean '%.*s'?", text,
                          (int)meant.best_length, meant.best);
    else
        rt_import_note_at(params->import, param->line, "%s is left out", text);
}

void rt_pbrt_note_unused(pbrt_params *params, const char *what)
{
    for (int i = 0; i < params->count; i++)
        if (!params->items[i].is_used && !params->items[i].of)
            note_unused(params, i, what);
}

void *rt_pbrt_grow(importer *import, void *items, size_t *count, size_t size)
{
    char *moved = rt_import_grow(import, items, *count, size);
    if (!moved)
        return NULL;
    memset(moved + *count * size, 0, size);
    ++*count;
    return moved;
}

void *rt_pbrt_define(importer *import, name_table *names, const char *name, void *items,
                     size_t size, size_t *at)
{
    const int number = rt_name_table_find(names, name);
    size_t count = names->count;
    *at = number >= 0 ? (size_t)number : count;
    if (number >= 0)
        return items;
    void *moved = rt_pbrt_grow(import, items, &count, size);
    if (moved && rt_name_table_add(names, name) < 0)
        rt_import_fail_memory(import);
    return moved;
}
