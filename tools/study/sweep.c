/* sweep.c - reads --sweep NAME=VALUE,VALUE,... */
#include "sweep.h"

#include <stdlib.h>
#include <string.h>

#include "../message.h"
#include "../settings.h"
#include "../status.h"

static const rt_word accels[] = {RT_ACCELS(RT_WORD) RT_WORD_END};

enum { CELLS_MAX = 10000 };

#define LET "let:"

static int fail_memory(void)
{
    message_error("out of memory");
    return STATUS_DEVICE;
}

static char *copy_of(const char *text, size_t length)
{
    char *copy = malloc(length + 1);
    if (!copy)
        return NULL;
    memcpy(copy, text, length);
    copy[length] = '\0';
    return copy;
}

static int add_value(sweep_axis *axis, const char *text, size_t length)
{
    char **more = realloc(axis->values, (axis->count + 1) * sizeof *more);
    char *copy = copy_of(text, length);
    axis->values = more ? more : axis->values;
    if (!more || !copy) {
        free(copy);
        return fail_memory();
    }
    more[axis->count++] = copy;
    return STATUS_DONE;
}

/* The words that an axis can have, or NULL. */
static const rt_word *words_of(const sweep_axis *axis)
{
    return axis->kind == SWEEP_ACCEL     ? accels
           : axis->kind == SWEEP_SETTING ? axis->setting->field.words
                                         : NULL;
}

static int add_all(sweep_axis *axis)
{
    const rt_word *words = words_of(axis);
    int status = STATUS_DONE;
    for (; words->name && status == STATUS_DONE; words++)
        status = add_value(axis, words->name, strlen(words->name));
    return status;
}

/* Splits at commas, but for those in brackets and parentheses. */
static int add_values(sweep_axis *axis, const char *text)
{
    int depth = 0, status = STATUS_DONE;
    const char *from = text;
    for (const char *at = text; status == STATUS_DONE; at++) {
        depth += *at == '[' || *at == '(' ? 1 : *at == ']' || *at == ')' ? -1 : 0;
        if (*at && (*at != ',' || depth > 0))
            continue;
        if (at == from) {
            message_error("--sweep %s: a value is missing in '%s'", axis->name, text);
            return STATUS_USAGE;
        }
        status = add_value(axis, from, (size_t)(at - from));
        if (!*at)
            break;
        from = at + 1;
    }
    return status;
}

/* What a name stands for; that of a setting may be written as the option's. */
static int find_meaning(sweep_axis *axis)
{
    if (strncmp(axis->name, LET, strlen(LET)) == 0) {
        axis->kind = SWEEP_CONSTANT;
        axis->constant = axis->name + strlen(LET);
        return STATUS_DONE;
    }
    axis->setting = rt_setting_find(axis->name);
    if (!axis->setting)
        axis->setting = settings_find(axis->name, strlen(axis->name));
    axis->kind = axis->setting                      ? SWEEP_SETTING
                 : strcmp(axis->name, "scene") == 0 ? SWEEP_SCENE
                 : strcmp(axis->name, "accel") == 0 ? SWEEP_ACCEL
                                                    : SWEEP_CONSTANT;
    axis->constant = axis->name;
    if (!axis->setting)
        return STATUS_DONE;
    const char *name = axis->setting->field.name;
    free(axis->name);
    axis->name = copy_of(name, strlen(name));
    return axis->name ? STATUS_DONE : fail_memory();
}

/* Whether a value stands among those before it. */
static int is_repeated(const sweep_axis *axis, size_t value)
{
    for (size_t i = 0; i < value; i++)
        if (strcmp(axis->values[i], axis->values[value]) == 0)
            return 1;
    return 0;
}

/* Whether the values of a setting are what it takes. */
static int check_values(const sweep_axis *axis)
{
    for (size_t i = 0; i < axis->count; i++) {
        if (is_repeated(axis, i)) {
            message_error("--sweep %s: the value '%s' is given twice", axis->name, axis->values[i]);
            return STATUS_USAGE;
        }
        rt_render_options scratch = {0};
        rt_error error;
        char words[128];
        if (axis->kind == SWEEP_SETTING &&
            rt_setting_set(&scratch, axis->setting, axis->values[i], &error) != RT_OK) {
            message_error("--sweep %s: %s", axis->name, error.message);
            return STATUS_USAGE;
        }
        if (axis->kind == SWEEP_ACCEL &&
            !rt_word_find(accels, axis->values[i], strlen(axis->values[i]))) {
            message_error("--sweep accel: it is %s; not '%s'",
                          rt_words_join(words, sizeof words, accels), axis->values[i]);
            return STATUS_USAGE;
        }
    }
    return STATUS_DONE;
}

static int is_same(const sweep_axis *a, const sweep_axis *b)
{
    return a->kind == SWEEP_CONSTANT && b->kind == SWEEP_CONSTANT
               ? strcmp(a->constant, b->constant) == 0
               : strcmp(a->name, b->name) == 0;
}

static int check_axis(const sweep *sweep, const sweep_axis *axis)
{
    for (const sweep_axis *other = sweep->axes; other < axis; other++)
        if (is_same(other, axis)) {
            message_error("--sweep %s is given twice", axis->name);
            return STATUS_USAGE;
        }
    if (sweep_cells(sweep) > CELLS_MAX) {
        message_error("--sweep: more than %d combinations", CELLS_MAX);
        return STATUS_USAGE;
    }
    return check_values(axis);
}

/* Says what a name without values may stand for. */
static void hint_form(const char *name)
{
    const char *const block = rt_field_block(name);
    const int is_setting = rt_setting_find(name) != NULL || settings_find(name, strlen(name));
    if (!is_setting && block)
        message_hint_constant(name, block, "--sweep", "1,2");
    else
        message_hint("such as --sweep %s=1,2", is_setting ? name : "k");
}

int sweep_add(sweep *sweep, const char *text)
{
    const char *equals = strchr(text, '=');
    const size_t lead = strncmp(text, LET, strlen(LET)) == 0 ? strlen(LET) : 0;
    if (!equals || equals == text + lead || !equals[1]) {
        message_error("--sweep takes NAME=VALUE,VALUE,...; not '%s'", text);
        if (!equals)
            hint_form(text);
        return STATUS_USAGE;
    }
    if (sweep->count == SWEEP_AXES) {
        message_error("--sweep may be given %d times at most", SWEEP_AXES);
        return STATUS_USAGE;
    }
    sweep_axis *axis = &sweep->axes[sweep->count++];
    *axis = (sweep_axis){.name = copy_of(text, (size_t)(equals - text))};
    int status = axis->name ? find_meaning(axis) : fail_memory();
    if (status != STATUS_DONE)
        return status;
    const int is_all = strcmp(equals + 1, "all") == 0 && words_of(axis) != NULL;
    status = is_all ? add_all(axis) : add_values(axis, equals + 1);
    return status == STATUS_DONE ? check_axis(sweep, axis) : status;
}

void sweep_free(sweep *sweep)
{
    for (size_t i = 0; i < sweep->count; i++) {
        sweep_axis *axis = &sweep->axes[i];
        for (size_t v = 0; v < axis->count; v++)
            free(axis->values[v]);
        free(axis->values);
        free(axis->name);
    }
    sweep->count = 0;
}

size_t sweep_cells(const sweep *sweep)
{
    size_t cells = 1;
    for (size_t i = 0; i < sweep->count; i++)
        cells = cells > CELLS_MAX ? cells : cells * sweep->axes[i].count;
    return cells;
}

size_t sweep_place(const sweep *sweep, size_t cell, size_t axis)
{
    for (size_t i = sweep->count; i-- > axis + 1;)
        cell /= sweep->axes[i].count;
    return cell % sweep->axes[axis].count;
}

const char *sweep_value(const sweep *sweep, size_t cell, size_t axis)
{
    return sweep->axes[axis].values[sweep_place(sweep, cell, axis)];
}

int sweep_is_numeric(const sweep_axis *axis)
{
    double number;
    for (size_t i = 0; i < axis->count; i++)
        if (rt_number_read(&number, axis->values[i], strlen(axis->values[i])) != RT_NUMBER_OK)
            return 0;
    return 1;
}

const sweep_axis *sweep_find(const sweep *sweep, sweep_kind kind)
{
    for (size_t i = 0; i < sweep->count; i++)
        if (sweep->axes[i].kind == kind)
            return &sweep->axes[i];
    return NULL;
}
