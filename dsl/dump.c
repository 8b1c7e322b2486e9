/* dump.c - blocks written back as they were understood. */
#define _XOPEN_SOURCE 700 /* realpath */
#include "dsl/dump.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dsl/no_effect.h"
#include "dsl/rivals.h"

/* ---- The line ---------------------------------------------------------------- */

static void put(rt_dump *dump, const char *text)
{
    size_t length = strlen(text);
    if (dump->size + length + 1 > dump->capacity) {
        size_t grown = 2 * (dump->size + length + 1);
        char *moved = dump->out_of_memory ? NULL : realloc(dump->line, grown);
        if (!moved) {
            dump->out_of_memory = 1;
            return;
        }
        dump->line = moved;
        dump->capacity = grown;
    }
    memcpy(dump->line + dump->size, text, length + 1);
    dump->size += length;
}

static void put_words(rt_dump *dump, const char *a, const char *b)
{
    put(dump, " ");
    put(dump, a);
    put(dump, " ");
    put(dump, b);
}

void rt_dump_number(char out[RT_DUMP_NUMBER], float value)
{
    for (int digits = 1; digits <= 9; digits++) {
        snprintf(out, RT_DUMP_NUMBER, "%.*g", digits, (double)value);
        if (strtof(out, NULL) == value)
            break;
    }
    if (strchr(out, 'e') && fabsf(value) >= 1 && fabsf(value) < 1e9f)
        snprintf(out, RT_DUMP_NUMBER, "%.0f", (double)value); /* 40, not 4e+01 */
    else if (value == 0)
        strcpy(out, "0");
}

static void put_number(rt_dump *dump, float value)
{
    char text[RT_DUMP_NUMBER];
    rt_dump_number(text, value);
    put(dump, " ");
    put(dump, text);
}

/* The map of a transform: with the digits of double precision where single does not hold it. */
static void put_transform(rt_dump *dump, const rt_transform *transform)
{
    char text[32];
    for (int i = 0; i < 12; i++) {
        const double value = transform->m[i / 4][i % 4];
        if ((float)value == value) {
            put_number(dump, (float)value);
            continue;
        }
        for (int digits = 9; digits <= 17; digits++) {
            snprintf(text, sizeof text, "%.*g", digits, value);
            if (strtod(text, NULL) == value)
                break;
        }
        put(dump, " ");
        put(dump, text);
    }
}

static void put_numbers(rt_dump *dump, const float *values, int count)
{
    for (int i = 0; i < count; i++)
        put_number(dump, values[i]);
}

static void finish(rt_dump *dump, const rt_load_options *options)
{
    put(dump, " }\n");
    if (!dump->out_of_memory)
        options->block(options->user, dump->line);
    dump->size = 0;
}

/* ---- Names ------------------------------------------------------------------- */

/* Whether a name ends like those that get a number, by `_` and digits, and not by this index. */
static int is_numbered(const char *name, uint32_t index)
{
    char own[16];
    const char *end = strrchr(name, '_');
    snprintf(own, sizeof own, "_%lu", (unsigned long)index);
    return end && end[1] && end[1 + strspn(end + 1, "0123456789")] == '\0' && strcmp(end, own) != 0;
}

/* Keeps the name of what has this index, made unique by it where others may have the same. */
static const char *keep_name(rt_dump *dump, rt_dump_names *names, const rt_build_name *name,
                             int is_local)
{
    if (name->index >= names->count) {
        size_t count = 2 * ((size_t)name->index + 1);
        char **moved = realloc(names->items, count * sizeof *moved);
        if (!moved) {
            dump->out_of_memory = 1;
            return "";
        }
        memset(moved + names->count, 0, (count - names->count) * sizeof *moved);
        names->items = moved;
        names->count = count;
    }
    size_t size = strlen(name->text) + 16;
    char *copy = malloc(size);
    if (!copy) {
        dump->out_of_memory = 1;
        return "";
    }
    if (is_local || is_numbered(name->text, name->index))
        snprintf(copy, size, "%s_%lu", name->text, (unsigned long)name->index);
    else
        snprintf(copy, size, "%s", name->text);
    free(names->items[name->index]);
    names->items[name->index] = copy;
    return copy;
}

static const char *name_at(const rt_dump_names *names, uint32_t index)
{
    return index < names->count && names->items[index] ? names->items[index] : "";
}

/* ---- Values ------------------------------------------------------------------ */

static const void *member_of(const rt_block_fields *fields, const rt_field *field)
{
    return (const unsigned char *)fields + field->offset;
}

/* Whether a member is all zero, which stands for the default. */
static int is_zero(const rt_block_fields *fields, const rt_field *field)
{
    const unsigned char *bytes = member_of(fields, field);
    float values[12] = {0};
    if (field->type == RT_FIELD_VECTOR || field->type == RT_FIELD_COLOUR ||
        field->type == RT_FIELD_PAIR || field->type == RT_FIELD_NUMBER) {
        memcpy(values, bytes, field->size); /* -0 is zero too */
        for (size_t i = 0; i < field->size / sizeof *values; i++)
            if (values[i] != 0)
                return 0;
        return 1;
    }
    for (size_t i = 0; i < field->size; i++)
        if (bytes[i])
            return 0;
    return 1;
}

/* Whether a default is written as a value of the field is, and not in words. */
static int is_value(const rt_field *field)
{
    const char *text = field->fallback;
    if (field->type == RT_FIELD_CHOICE)
        return rt_word_find(field->words, text, strlen(text)) != NULL;
    return text[0] && strcmp(text, "0") != 0 && text[strspn(text, "0123456789.- ")] == '\0';
}

static void put_path(rt_dump *dump, const char *path)
{
    char *whole = realpath(path, NULL);
    const char *shown = whole && !strpbrk(whole, "\"\n\r") ? whole : path;
    put(dump, " \"");
    put(dump, shown);
    put(dump, "\"");
    free(whole);
}

static void put_integer(rt_dump *dump, const void *member)
{
    char text[32];
    uint32_t value;
    memcpy(&value, member, sizeof value);
    snprintf(text, sizeof text, " %lu", (unsigned long)value);
    put(dump, text);
}

static void put_choice(rt_dump *dump, const rt_field *field, const void *member)
{
    int value;
    memcpy(&value, member, sizeof value);
    put(dump, " ");
    for (const rt_word *word = rt_field_words(field); word->name; word++)
        if (word->value == value) {
            put(dump, word->name);
            return;
        }
}

static void put_part(rt_dump *dump, const void *member)
{
    uint32_t part;
    memcpy(&part, member, sizeof part);
    put(dump, " ");
    put(dump, part == RT_MATERIAL_BLACK ? RT_BLACK_WORD : name_at(&dump->materials, part - 1));
}

/* The value of a field that is not left out. */
static void put_value(rt_dump *dump, const rt_field *field, const void *member)
{
    uint32_t index;
    const char *path;
    switch (field->type) {
    case RT_FIELD_NUMBER:
    case RT_FIELD_PAIR:
    case RT_FIELD_VECTOR:
    case RT_FIELD_COLOUR:
        put_numbers(dump, member, (int)(field->size / sizeof(float)));
        break;
    case RT_FIELD_INTEGER:
    case RT_FIELD_COUNT:
        put_integer(dump, member);
        break;
    case RT_FIELD_BOOLEAN:
    case RT_FIELD_CHOICE:
        put_choice(dump, field, member);
        break;
    case RT_FIELD_MATERIAL:
    case RT_FIELD_TEXTURE:
    case RT_FIELD_GRID:
        memcpy(&index, member, sizeof index);
        put(dump, " ");
        put(dump, name_at(field->type == RT_FIELD_MATERIAL  ? &dump->materials
                          : field->type == RT_FIELD_TEXTURE ? &dump->textures
                                                            : &dump->grids,
                          index));
        break;
    case RT_FIELD_PART:
        put_part(dump, member);
        break;
    case RT_FIELD_FILE:
        memcpy(&path, member, sizeof path);
        put_path(dump, path);
        break;
    case RT_FIELD_STRING:
        memcpy(&path, member, sizeof path);
        put(dump, " \"");
        put(dump, path);
        put(dump, "\"");
        break;
    case RT_FIELD_TRANSLATE:
    case RT_FIELD_ROTATE:
    case RT_FIELD_SCALE:
    case RT_FIELD_MATRIX:
        put_transform(dump, member);
        break;
    }
}

/* ---- Fields ------------------------------------------------------------------ */

/* Whether any field of the same need holds a value; *first: whether this one stands first. */
static int has_group(const rt_block *block, const rt_block_fields *fields, const rt_field *field,
                     int *first)
{
    const rt_field *other;
    int found = 0;
    *first = 1;
    for (size_t i = 0; (other = rt_block_field(block, i)) != NULL; i++) {
        if (other->need != field->need)
            continue;
        *first &= other >= field;
        found |= !is_zero(fields, other);
    }
    return found;
}

/* Whether a field is written with the value that it has. */
static int is_written(const rt_block *block, const rt_block_fields *fields, const rt_field *field)
{
    int is_first = 0, value = !is_zero(fields, field);
    switch (field->need) {
    case RT_NEED_REQUIRED:
        return 1;
    case RT_NEED_ONE_OF:
        return value || (!has_group(block, fields, field, &is_first) && is_first);
    case RT_NEED_ALL_OR_NONE:
    case RT_NEED_ALL_OR_NONE_TOO:
        return has_group(block, fields, field, &is_first);
    case RT_NEED_AT_MOST_ONE:
    case RT_NEED_OPTIONAL:
        break;
    }
    if (field->type == RT_FIELD_BOOLEAN)
        return value || strcmp(field->fallback, "true") == 0;
    return value && rt_field_has_effect(block, field, fields);
}

static void put_fields(rt_dump *dump, const rt_block *block, const rt_block_fields *fields)
{
    const rt_field *field;
    for (size_t i = 0; (field = rt_block_field(block, i)) != NULL; i++) {
        if (rt_field_is_transform(field)) {
            if (field->type == RT_FIELD_MATRIX && !is_zero(fields, field) &&
                rt_field_has_effect(block, field, fields)) {
                put_words(dump, "", field->name);
                put_value(dump, field, member_of(fields, field));
            }
        } else if (is_written(block, fields, field)) {
            put_words(dump, "", field->name);
            put_value(dump, field, member_of(fields, field));
        } else if (field->need == RT_NEED_OPTIONAL && is_zero(fields, field) && is_value(field) &&
                   rt_field_has_effect(block, field, fields) &&
                   !rt_rivals_set(block, field, fields)) {
            put(dump, " ");
            put_words(dump, field->name, field->fallback);
        }
    }
}

void rt_dump_block(rt_dump *dump, const rt_load_options *options, const rt_block *block,
                   const rt_block_fields *fields, const rt_build_name *name, int is_local)
{
    char title[RT_BLOCK_TITLE_SIZE];
    if (block->id == RT_BLOCK_FILM || block->id == RT_BLOCK_RENDER)
        return;
    rt_dump_names *names = block->id == RT_BLOCK_MATERIAL  ? &dump->materials
                           : block->id == RT_BLOCK_TEXTURE ? &dump->textures
                           : block->id == RT_BLOCK_GRID    ? &dump->grids
                                                           : &dump->meshes;
    put(dump, rt_block_title(title, block));
    if (block->flags & (RT_BLOCK_REFERS | RT_BLOCK_NAMED))
        put(dump, " ");
    if (block->flags & RT_BLOCK_REFERS)
        put(dump, name_at(names, name->index));
    else if (block->flags & RT_BLOCK_NAMED)
        put(dump, keep_name(dump, names, name, is_local));
    put(dump, " {");
    put_fields(dump, block, fields);
    finish(dump, options);
}

/* ---- Settings ---------------------------------------------------------------- */

void rt_dump_settings(rt_dump *dump, const rt_load_options *options, const rt_scene *scene)
{
    size_t count;
    const rt_setting *settings = rt_settings(&count);
    rt_render_options values;
    rt_scene_get_options(scene, &values);
    for (int is_film = 1; is_film >= 0; is_film--) {
        put(dump, is_film ? "film {" : "render {");
        for (size_t i = 0; i < count; i++) {
            const rt_setting *setting = &settings[i];
            char text[64];
            if ((setting->topic == RT_TOPIC_FILM) != is_film)
                continue;
            if (rt_setting_value(setting, &values) != 0)
                put_words(dump, setting->field.name,
                          rt_setting_get(text, sizeof text, setting, &values));
            else if (is_value(&setting->field) && !rt_setting_missing(setting, &values))
                put_words(dump, setting->field.name, setting->field.fallback);
        }
        finish(dump, options);
    }
}

static void free_names(rt_dump_names *names)
{
    for (size_t i = 0; i < names->count; i++)
        free(names->items[i]);
    free(names->items);
}

void rt_dump_free(rt_dump *dump)
{
    free_names(&dump->materials);
    free_names(&dump->textures);
    free_names(&dump->grids);
    free_names(&dump->meshes);
    free(dump->line);
}
