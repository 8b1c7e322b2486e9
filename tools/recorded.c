/* recorded.c - the command line as it is recorded in an image. */
#include "recorded.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "settings.h"

/* A line that grows, as far as there is room; used counts what there is none for, too. */
typedef struct line {
    char *at;
    size_t size, used;
} line;

static void put(line *out, const char *text, size_t length)
{
    for (size_t i = 0; i < length; i++, out->used++)
        if (out->used < out->size)
            out->at[out->used] = text[i];
}

static void put_text(line *out, const char *text)
{
    put(out, text, strlen(text));
}

/* What stands within quotes of a shell. */
static void put_quoted(line *out, const char *text)
{
    for (; *text; text++)
        if (*text == '\'')
            put_text(out, "'\\''");
        else
            put(out, text, 1);
}

/* As a shell reads it: in quotes where it is not one plain word. */
static void put_word(line *out, const char *text)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                "_-+./,:=@%";
    const char *const quote = *text && text[strspn(text, plain)] == '\0' ? "" : "'";
    put_text(out, quote);
    put_quoted(out, text);
    put_text(out, quote);
}

const char *recorded_word(char out[RECORDED_WORD_SIZE], const char *text)
{
    line made = {out, RECORDED_WORD_SIZE - 1, 0};
    put_word(&made, text);
    out[made.used < made.size ? made.used : made.size] = '\0';
    return out;
}

/* ` --NAME VALUE` */
static void put_option(line *out, const char *name, const char *value)
{
    put_text(out, " --");
    put_text(out, name);
    if (value) {
        put_text(out, " ");
        put_word(out, value);
    }
}

static void put_setting(line *out, const rt_setting *setting, const char *text)
{
    char name[SETTING_NAME_SIZE], off[SETTING_NAME_SIZE + 4];
    settings_name(name, setting);
    snprintf(off, sizeof off, "no-%s", name);
    if (settings_is_switch(setting))
        put_option(out, strcmp(text, "false") == 0 ? off : name, NULL);
    else
        put_option(out, name, text);
}

/* What stands for samples or passes, where a film ended before it had all of them. */
typedef struct ending {
    const rt_setting *setting; /* NULL: it has all, or its error is small enough */
    char count[16];
    const rt_setting *rule; /* of passes, whose default depends on how many there are to be */
    char word[32];
} ending;

static ending ending_of(const rt_film *film)
{
    ending e = {NULL, "", NULL, ""};
    rt_film_info info;
    rt_film_stats stats;
    rt_render_options o;
    rt_film_get_info(film, &info);
    rt_film_get_stats(film, &stats);
    rt_film_get_options(film, &o);
    if (info.done >= 1 || (o.target_error > 0 && stats.relative_error_bound <= o.target_error))
        return e;
    const int in_passes = o.mode == RT_MODE_PHOTON && o.passes > 1;
    e.setting = rt_setting_find(in_passes ? "passes" : "spp");
    snprintf(e.count, sizeof e.count, "%lu", (unsigned long)(in_passes ? stats.passes : stats.spp));
    if (in_passes) {
        e.rule = rt_setting_find("radius_rule");
        o.radius_rule = rt_radius_rule_of(&o);
        rt_setting_get(e.word, sizeof e.word, e.rule, &o);
    }
    return e;
}

/* The text of a setting in a line, or NULL. */
static const char *text_of(const command_line *arguments, const rt_setting *setting,
                           const ending *ending, int has_film)
{
    if (setting == ending->setting)
        return ending->count;
    if (setting == ending->rule)
        return ending->word;
    return has_film && strcmp(setting->field.name, "time") == 0 ? NULL
                                                                : settings_text(arguments, setting);
}

/* Writes the whole line. */
static void put_line(line *out, const command_line *arguments, const char *scene,
                     const rt_film *film)
{
    size_t count;
    const rt_setting *settings = rt_settings(&count);
    const ending ending = film ? ending_of(film) : (struct ending){NULL, "", NULL, ""};
    put_text(out, "rtc ");
    put_word(out, scene);
    for (size_t i = 0; i < count; i++) {
        const char *text = text_of(arguments, &settings[i], &ending, film != NULL);
        if (text)
            put_setting(out, &settings[i], text);
    }
    for (size_t i = 0; i < arguments->definition_count; i++) {
        put_text(out, " --set '");
        put_quoted(out, arguments->definitions[i].name);
        put_text(out, "=");
        put_quoted(out, arguments->definitions[i].value);
        put_text(out, "'");
    }
    for (int i = 0; i < OPTION_COUNT; i++)
        if (option_table[i].decides_pixels && arguments->options[i].given)
            put_option(out, option_table[i].name,
                       option_table[i].value ? arguments->options[i].text : NULL);
    put(out, "", 1);
}

char *recorded_command(const command_line *arguments, const char *scene, const rt_film *film)
{
    line length = {NULL, 0, 0};
    put_line(&length, arguments, scene, film);
    line made = {malloc(length.used), length.used, 0};
    if (made.at)
        put_line(&made, arguments, scene, film);
    return made.at;
}
