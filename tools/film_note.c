/* film_note.c - the options of a render as lines in its film, and read from there. */
#include "film_note.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "command_line.h"
#include "film_place.h"
#include "message.h"
#include "settings.h"
#include "status.h"

/* Options that belong to a picture, not to the run that rendered a part of it. */
static const option_id of_picture[] = {OPTION_CAMERA,       OPTION_ACCEL,      OPTION_PHOTON_MAP,
                                       OPTION_LIGHT_SHARES, OPTION_CHECKPOINT, OPTION_EVERY,
                                       OPTION_PART,         OPTION_EXPOSURE,   OPTION_TONEMAP};

/* A text that grows; without memory it has failed, and stays so. */
typedef struct text {
    char *at;
    size_t size;
    int failed;
} text;

/* Adds a line, `given NAME VALUE` or `scene PATH`; one with a newline in it is left out. */
static void add_line(text *out, const char *word, const char *name, const char *value)
{
    if (strchr(value, '\n') || out->failed)
        return;
    const size_t length = strlen(word) + strlen(name) + strlen(value) + 4;
    char *longer = realloc(out->at, out->size + length);
    if (!longer) {
        out->failed = 1;
        return;
    }
    out->at = longer;
    out->size += (size_t)snprintf(out->at + out->size, length, "%s %s%s%s\n", word, name,
                                  name[0] ? " " : "", value);
}

/* Adds a definition as --set takes it. */
static void add_definition(text *out, const rt_definition *definition)
{
    const size_t size = strlen(definition->name) + strlen(definition->value) + 2;
    char *both = malloc(size);
    if (both) {
        snprintf(both, size, "%s=%s", definition->name, definition->value);
        add_line(out, "given", option_table[OPTION_SET].name, both);
    }
    out->failed |= !both;
    free(both);
}

/*
 * --time is for one sitting: a film keeps what it was begun with, and nothing that was given when
 * it was continued.
 */
static void add_time(text *out, const command_line *arguments)
{
    char value[64];
    const char *kept = settings_text(arguments, rt_setting_find("time"));
    if (arguments->film) {
        const size_t length = film_note_find(&kept, arguments->film, "given time");
        snprintf(value, sizeof value, "%.*s", (int)length, length > 0 ? kept : "");
        kept = length > 0 ? value : NULL;
    }
    if (kept)
        add_line(out, "given", "time", kept);
}

/* Adds all other settings that are given. */
static void add_settings(text *out, const command_line *arguments)
{
    size_t count;
    const rt_setting *settings = rt_settings(&count), *time = rt_setting_find("time");
    for (size_t i = 0; i < count; i++) {
        char name[SETTING_NAME_SIZE];
        if (settings_text(arguments, &settings[i]) && &settings[i] != time)
            add_line(out, "given", settings_name(name, &settings[i]),
                     settings_text(arguments, &settings[i]));
    }
}

char *film_note_make(const command_line *arguments, const char *scene)
{
    char folder[PATH_MAX];
    text note = {0};
    if (getcwd(folder, sizeof folder))
        add_line(&note, "folder", "", folder);
    add_line(&note, "scene", "", scene);
    add_settings(&note, arguments);
    add_time(&note, arguments);
    for (size_t i = 0; i < sizeof of_picture / sizeof *of_picture; i++) {
        const option_id id = of_picture[i];
        if (arguments->options[id].given)
            add_line(&note, "given", option_table[id].name, arguments->options[id].text);
    }
    for (size_t i = 0; i < arguments->definition_count; i++)
        add_definition(&note, &arguments->definitions[i]);
    for (size_t i = 0; i < arguments->output_count; i++)
        add_line(&note, "given", "out", arguments->outputs[i]);
    if (note.failed) {
        free(note.at);
        return NULL;
    }
    return note.at;
}

size_t film_note_find(const char **value, const rt_film *film, const char *name)
{
    const size_t length = strlen(name);
    for (const char *line = rt_film_note(film), *end; (end = strchr(line, '\n')); line = end + 1)
        if (strncmp(line, name, length) == 0 && line[length] == ' ') {
            *value = line + length + 1;
            return (size_t)(end - *value);
        }
    return 0;
}

/* A stranger's film does not choose what is read, either. */
static int fail_name(const char *what, const char *path)
{
    message_error("--untrusted: the film names the %s %s, outside of this folder", what, path);
    message_hint("name it on the command line");
    return STATUS_INPUT;
}

/* Whether what a film may say belongs to its picture: settings, definitions, outputs and these. */
static int is_of_picture(const char *name)
{
    char setting[SETTING_NAME_SIZE];
    size_t count;
    const rt_setting *settings = rt_settings(&count);
    for (size_t i = 0; i < sizeof of_picture / sizeof *of_picture; i++)
        if (strcmp(name, option_table[of_picture[i]].name) == 0)
            return 1;
    for (size_t i = 0; i < count; i++)
        if (strcmp(name, settings_name(setting, &settings[i])) == 0)
            return 1;
    return strcmp(name, option_table[OPTION_SET].name) == 0 ||
           strcmp(name, option_table[OPTION_OUT].name) == 0;
}

/* Gives what a line says; it ends in a zero byte. */
static int give_line(command_line *arguments, char *line, int has_outputs)
{
    const int is_untrusted = arguments->options[OPTION_UNTRUSTED].given;
    if (strncmp(line, "scene ", 6) == 0) {
        if (arguments->operand_count > 0)
            return STATUS_DONE;
        if (is_untrusted && !film_place_may_name(line + 6))
            return fail_name("scene", line + 6);
        arguments->operands[arguments->operand_count++] = line + 6;
        return STATUS_DONE;
    }
    char *value = strncmp(line, "given ", 6) == 0 ? strchr(line + 6, ' ') : NULL;
    if (!value)
        return STATUS_DONE;
    *value++ = '\0';
    if (!is_of_picture(line + 6)) {
        message_error("the film names the option --%.40s, which is no part of a picture", line + 6);
        return STATUS_INPUT;
    }
    const option *map = &option_table[OPTION_PHOTON_MAP];
    if (is_untrusted && strcmp(line + 6, map->name) == 0 &&
        !arguments->options[OPTION_PHOTON_MAP].given && !film_place_may_name(value))
        return fail_name(map->name, value);
    /* A stranger's film does not choose which files are written. */
    if ((has_outputs || is_untrusted) && strcmp(line + 6, option_table[OPTION_OUT].name) == 0)
        return STATUS_DONE;
    if (is_untrusted && strcmp(line + 6, option_table[OPTION_CHECKPOINT].name) == 0)
        return STATUS_DONE;
    return arguments_give(arguments, line + 6, value);
}

/* Of the note of a film. Each --set is looked for among all before it. */
enum { LINES_MAX = 10000 };

int film_note_give_text(command_line *arguments, char *note)
{
    const int has_outputs = arguments->output_count > 0;
    int status = STATUS_DONE, lines = 0;
    for (char *line = note, *end; status == STATUS_DONE && (end = strchr(line, '\n'));
         line = end + 1) {
        *end = '\0';
        if (++lines > LINES_MAX) {
            message_error("the note of the film has more than %d lines", LINES_MAX);
            return STATUS_INPUT;
        }
        status = give_line(arguments, line, has_outputs);
    }
    return status;
}

int film_note_give(command_line *arguments, char **text, const rt_film *film)
{
    const char *note = rt_film_note(film);
    char *copy = malloc(strlen(note) + 1);
    if (!copy) {
        message_error("out of memory");
        return STATUS_DEVICE;
    }
    memcpy(copy, note, strlen(note) + 1);
    *text = copy;
    return film_note_give_text(arguments, copy);
}
