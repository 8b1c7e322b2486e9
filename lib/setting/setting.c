/* setting.c - settings of a render: found by name, read from text, written as text. */
#include "rt/setting.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/error.h"

#define LARGEST_EXACT 9007199254740992.0 /* 2^53: every whole number up to it is a double */

static int is_same_name(const char *name, const char *wanted)
{
    for (; *name && (*name == *wanted || (*name == '_' && *wanted == '-')); name++)
        wanted++;
    return *name == *wanted;
}

const rt_setting *rt_setting_find(const char *name)
{
    size_t count;
    const rt_setting *settings = rt_settings(&count);
    for (size_t i = 0; i < count; i++)
        if (is_same_name(settings[i].field.name, name))
            return &settings[i];
    return NULL;
}

/* ---- Values ----------------------------------------------------------------- */

double rt_setting_value(const rt_setting *setting, const rt_render_options *options)
{
    const rt_field *field = &setting->field;
    const unsigned char *member = (const unsigned char *)options + field->offset;
    union {
        float single;
        double real;
        uint32_t count;
        uint64_t long_count;
        int choice;
    } value;
    memcpy(&value, member, field->size);
    if (field->type == RT_FIELD_NUMBER)
        return field->size == sizeof value.real ? value.real : (double)value.single;
    if (field->type == RT_FIELD_INTEGER && field->size == sizeof value.long_count)
        return (double)value.long_count;
    return field->type == RT_FIELD_INTEGER || field->type == RT_FIELD_COUNT ? (double)value.count
                                                                            : (double)value.choice;
}

static void store(rt_render_options *options, const rt_field *field, double number)
{
    unsigned char *member = (unsigned char *)options + field->offset;
    const float single = (float)number;
    const int is_real = field->type == RT_FIELD_NUMBER;
    if (is_real && field->size == sizeof number) {
        memcpy(member, &number, sizeof number);
    } else if (is_real) {
        memcpy(member, &single, sizeof single);
    } else if (field->size == sizeof(uint64_t)) {
        uint64_t count = (uint64_t)number;
        memcpy(member, &count, sizeof count);
    } else {
        uint32_t count = (uint32_t)(int64_t)number;
        memcpy(member, &count, sizeof count);
    }
}

/* Reads a number; what is too small for a float only is right where the member is a double. */
static int read_real(double *out, const rt_field *field, const char *text)
{
    const rt_number_result result = rt_number_read(out, text, strlen(text));
    return result == RT_NUMBER_OK ||
           (result == RT_NUMBER_TOO_SMALL && field->size == sizeof(double));
}

/* Whether text is a number that the field takes. */
static int read_number(double *out, const rt_field *field, const char *text)
{
    double number;
    if (field->type == RT_FIELD_CHOICE || field->type == RT_FIELD_BOOLEAN ||
        !read_real(&number, field, text))
        return 0;
    if (field->type != RT_FIELD_NUMBER &&
        (number < 0 || number > LARGEST_EXACT || floor(number) != number))
        return 0;
    *out = number;
    /* An end that is excluded is not reached by rounding either. */
    const int is_rounded = field->type == RT_FIELD_NUMBER && field->size == sizeof(float) &&
                           field->range.kind == RT_RANGE_BETWEEN;
    return rt_range_holds(field->range, number) &&
           (!is_rounded || rt_range_holds(field->range, (float)number));
}

rt_status rt_setting_set(rt_render_options *options, const rt_setting *setting, const char *text,
                         rt_error *error)
{
    if (rt_is_missing(options, "options", error) || rt_is_missing(setting, "setting", error) ||
        rt_is_missing(text, "text", error))
        return RT_ERROR_USAGE;
    const rt_field *field = &setting->field;
    const rt_word *word = rt_word_find(rt_field_words(field), text, strlen(text));
    double number;
    char phrase[256];
    if (word)
        number = field->type == RT_FIELD_COUNT ? (double)(uint32_t)word->value : word->value;
    else if (!read_number(&number, field, text))
        return rt_fail_field(error, RT_ERROR_USAGE, field->name, "%s takes %s; not '%s'",
                             field->name, rt_setting_phrase(phrase, sizeof phrase, setting), text);
    store(options, field, number);
    return RT_OK;
}

/*
 * The shortest text that reads back as the value: more digits of a float could be less than the
 * least number of its range.
 */
static void write_real(char *out, size_t size, const rt_field *field, double value)
{
    const int is_single = field->size == sizeof(float);
    double again;
    for (int digits = 1; digits <= 17; digits++) {
        snprintf(out, size, "%.*g", digits, value);
        if (read_real(&again, field, out) &&
            (is_single ? (float)again == (float)value : again == value))
            return;
    }
}

const char *rt_setting_get(char *out, size_t size, const rt_setting *setting,
                           const rt_render_options *options)
{
    const double value = rt_setting_value(setting, options);
    const rt_field *field = &setting->field;
    for (const rt_word *word = rt_field_words(field); word && word->name; word++)
        if (field->type == RT_FIELD_COUNT ? value == RT_K_ALL : value == word->value) {
            snprintf(out, size, "%s", word->name);
            return out;
        }
    if (field->type == RT_FIELD_NUMBER)
        write_real(out, size, field, value);
    else
        snprintf(out, size, "%.17g", value);
    return out;
}

/* ---- Words about it ----------------------------------------------------------- */

const char *rt_setting_phrase(char *out, size_t size, const rt_setting *setting)
{
    const rt_field *field = &setting->field;
    char range[96];
    if (field->type == RT_FIELD_CHOICE || field->type == RT_FIELD_BOOLEAN)
        return rt_field_phrase(out, size, field);
    snprintf(out, size, "a %s %s%s", field->type == RT_FIELD_NUMBER ? "number" : "whole number",
             rt_range_phrase(range, sizeof range, field->range),
             field->type == RT_FIELD_COUNT ? ", or all" : "");
    return out;
}

const char *rt_setting_text(char *out, size_t size, const char *text, rt_name_style style)
{
    size_t used = 0;
    int is_name = 0;
    for (; *text && used + 3 < size; text++) {
        if (*text != '`') {
            out[used++] = is_name && style == RT_NAME_OPTION && *text == '_' ? '-' : *text;
            continue;
        }
        is_name = !is_name;
        if (style == RT_NAME_QUOTED)
            out[used++] = '\'';
        else if (is_name)
            used += (size_t)snprintf(out + used, size - used, "--");
    }
    out[used] = '\0';
    return out;
}

/* ---- What it needs -------------------------------------------------------------- */

static int holds(const rt_condition *condition, const rt_render_options *options)
{
    const rt_setting *setting =
        condition->test == RT_TEST_NONE ? NULL : rt_setting_find(condition->setting);
    const double value = setting ? rt_setting_value(setting, options) : 0;
    switch (condition->test) {
    case RT_TEST_NONE:
        break;
    case RT_TEST_IS:
        return value == condition->value;
    case RT_TEST_IS_NOT:
        return value != condition->value;
    case RT_TEST_ABOVE:
        return value > condition->value;
    case RT_TEST_BELOW:
        return value < condition->value;
    }
    return 0;
}

int rt_setting_need_met(const rt_setting_need *need, const rt_render_options *options)
{
    for (int i = 0; i < RT_CONDITIONS_MAX; i++)
        if (holds(&need->any[i], options))
            return 1;
    return 0;
}

const rt_setting_need *rt_setting_missing(const rt_setting *setting,
                                          const rt_render_options *options)
{
    for (const rt_setting_need *need = setting->needs; need && need->otherwise; need++)
        if (!rt_setting_need_met(need, options))
            return need;
    return NULL;
}
