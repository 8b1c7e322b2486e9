/* command_line.c - reads the command line: the command, its options and values, the operands. */
#include "command_line.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "message.h"
#include "number.h"
#include "photons.h"
#include "preview/target.h"
#include "settings.h"
#include "status.h"
#include "untrusted.h"

static const char *const command_names[COMMAND_COUNT] = {
    [COMMAND_RENDER] = "",         [COMMAND_CHECK] = "check",   [COMMAND_MESH] = "mesh",
    [COMMAND_DEVICES] = "devices", [COMMAND_DOCTOR] = "doctor", [COMMAND_PHOTONS] = "photons",
    [COMMAND_COMPARE] = "compare", [COMMAND_MERGE] = "merge",   [COMMAND_INFO] = "info",
    [COMMAND_KERNELS] = "kernels", [COMMAND_PATHS] = "paths",   [COMMAND_STUDY] = "study",
    [COMMAND_FMT] = "fmt",         [COMMAND_IMPORT] = "import",
};

const char *command_name(command_id command)
{
    return command_names[command];
}

const char *command_nearest(const char *word)
{
    rt_nearest search;
    rt_nearest_begin(&search, word, strlen(word));
    for (int i = COMMAND_RENDER + 1; i < COMMAND_COUNT; i++)
        rt_nearest_offer(&search, command_names[i], strlen(command_names[i]));
    return search.best;
}

/* The subcommand that word names, or COMMAND_RENDER. */
static command_id find_command(const char *word)
{
    for (int i = COMMAND_RENDER + 1; i < COMMAND_COUNT; i++)
        if (strcmp(word, command_names[i]) == 0)
            return (command_id)i;
    return COMMAND_RENDER;
}

/* What a name stands for: an option of the table, or a setting, which --no-NAME turns off. */
typedef struct meaning {
    const option *option;
    const rt_setting *setting;
    int is_off;
} meaning;

/* The option of the table that has this name, the command's own if it has one, or NULL. */
static const option *find_option(const char *name, size_t length, command_id command)
{
    const option *found = NULL;
    for (int i = 0; i < OPTION_COUNT; i++) {
        const option *option = &option_table[i];
        if (strlen(option->name) == length && memcmp(option->name, name, length) == 0 &&
            (!found || option->commands & (1u << command)))
            found = option;
    }
    return found;
}

/* What name[0] to name[length - 1] stands for. */
static meaning find_meaning(const char *name, size_t length, command_id command)
{
    meaning found = {find_option(name, length, command), NULL, 0};
    if (!found.option)
        found.setting = settings_find(name, length);
    if (!found.option && !found.setting && length > 3 && memcmp(name, "no-", 3) == 0) {
        const rt_setting *setting = settings_find(name + 3, length - 3);
        if (setting && settings_is_switch(setting)) {
            found.setting = setting;
            found.is_off = 1;
        }
    }
    return found;
}

static int is_taken(const meaning *meaning, command_id command)
{
    return meaning->option ? (meaning->option->commands & (1u << command)) != 0
                           : settings_is_taken(meaning->setting, command);
}

/* Names a command that takes an option. */
static void hint_takers(const meaning *meaning)
{
    for (int i = 0; i < COMMAND_COUNT; i++)
        if (is_taken(meaning, (command_id)i)) {
            message_hint("`rtc%s%s` takes it", i == COMMAND_RENDER ? "" : " ",
                         command_name((command_id)i));
            return;
        }
}

/* Offers the names of a command's options. */
static void offer_names(rt_nearest *search, command_id command, char names[][SETTING_NAME_SIZE])
{
    size_t count;
    const rt_setting *settings = rt_settings(&count);
    for (int i = 0; i < OPTION_COUNT; i++)
        if (option_table[i].commands & (1u << command))
            rt_nearest_offer(search, option_table[i].name, strlen(option_table[i].name));
    for (size_t i = 0; i < count; i++)
        if (settings_is_taken(&settings[i], command)) {
            const char *name = settings_name(names[i], &settings[i]);
            rt_nearest_offer(search, name, strlen(name));
        }
}

/* Names that begin as what was given does. */
typedef struct beginning {
    const char *name;
    size_t length;               /* of what was given */
    const char *found, *nearest; /* the last one, and one that lacks a single letter */
    int matches;
} beginning;

static void offer_beginning(beginning *b, const char *known)
{
    if (strncmp(known, b->name, b->length) != 0)
        return;
    b->found = known;
    b->matches++;
    if (strlen(known) == b->length + 1)
        b->nearest = known;
}

/*
 * The one option of a command, of those names too, that begins like this, or of several one that
 * lacks a single letter; or NULL.
 */
static const char *find_beginning(const char *name, size_t length, command_id command,
                                  char names[][SETTING_NAME_SIZE])
{
    size_t count;
    beginning b = {.name = name, .length = length};
    rt_settings(&count);
    for (int i = 0; i < OPTION_COUNT; i++)
        if (option_table[i].commands & (1u << command))
            offer_beginning(&b, option_table[i].name);
    for (size_t i = 0; i < count && length > 0; i++)
        offer_beginning(&b, names[i]);
    return b.matches == 1 ? b.found : b.nearest;
}

static int fail_unknown_option(const char *name, size_t length, command_id command)
{
    size_t count;
    rt_settings(&count);
    char(*names)[SETTING_NAME_SIZE] = calloc(count, sizeof *names);
    rt_nearest search;
    message_error("unknown option '--%.*s'", (int)length, name);
    rt_nearest_begin(&search, name, length);
    if (names)
        offer_names(&search, command, names);
    const char *meant =
        search.best || !names ? search.best : find_beginning(name, length, command, names);
    char field[64];
    snprintf(field, sizeof field, "%.*s", (int)length, name);
    const char *const block = rt_field_block(field);
    if (block && search.distance > 0)
        message_hint_constant(field, block, "--set", "VALUE");
    else if (meant && strcmp(meant, "width") == 0 && search.distance == 0)
        message_hint("did you mean --width W and --height H?");
    else if (meant)
        message_hint("did you mean --%s?", meant);
    else
        message_hint("`rtc %s%s--help` lists the options", command_name(command),
                     command == COMMAND_RENDER ? "" : " ");
    free(names);
    return STATUS_USAGE;
}

/* ---- Values --------------------------------------------------------------- */

static int read_choice(option_value *value, const option *option, const char *text)
{
    char words[128];
    const rt_word *word = rt_word_find(option->words, text, strlen(text));
    rt_nearest search;
    if (word) {
        value->choice = word->value;
        return STATUS_DONE;
    }
    message_error("--%s takes %s; not '%s'", option->name,
                  rt_words_join(words, sizeof words, option->words), text);
    rt_nearest_begin(&search, text, strlen(text));
    rt_nearest_offer_words(&search, option->words);
    if (search.best)
        message_hint("did you mean %s?", search.best);
    return STATUS_USAGE;
}

static int read_number(option_value *value, const option *option, const char *text)
{
    const rt_range range = {RT_RANGE_CLOSED, option->min, option->max};
    char phrase[96];
    int is_count = option->kind == KIND_WHOLE;
    int bad = is_count ? number_count(&value->count, text) : number_real(&value->real, text);
    if (!bad && rt_range_holds(range, is_count ? (double)value->count : value->real))
        return STATUS_DONE;
    message_error("--%s takes a %s %s; not '%s'", option->name,
                  is_count ? "whole number" : "number",
                  rt_range_phrase(phrase, sizeof phrase, range), text);
    return STATUS_USAGE;
}

static int read_size(option_value *value, const option *option, const char *text)
{
    if (number_size(&value->count, text) == 0)
        return STATUS_DONE;
    message_error("--%s takes a number of bytes, as in 800M or 4G; not '%s'", option->name, text);
    return STATUS_USAGE;
}

/* The definition of a name, or NULL. */
static rt_definition *find_definition(const command_line *arguments, const char *name,
                                      size_t length)
{
    for (size_t i = 0; i < arguments->definition_count; i++) {
        const char *known = arguments->definitions[i].name;
        if (strlen(known) == length && memcmp(known, name, length) == 0)
            return &arguments->definitions[i];
    }
    return NULL;
}

/* Reads NAME=VALUE; text must outlive *out. */
static int read_definition(command_line *out, const char *text)
{
    const char *equals = strchr(text, '=');
    if (!equals || equals == text || !equals[1]) {
        message_error("--set takes NAME=VALUE; not '%s'", text);
        return STATUS_USAGE;
    }
    const size_t length = (size_t)(equals - text);
    rt_definition *known = find_definition(out, text, length);
    if (known) {
        known->value = equals + 1;
        return STATUS_DONE;
    }
    rt_definition *more =
        realloc(out->definitions, (out->definition_count + 1) * sizeof *out->definitions);
    char *name = malloc(length + 1);
    out->definitions = more ? more : out->definitions;
    if (!more || !name) {
        free(name);
        message_error("out of memory");
        return STATUS_DEVICE;
    }
    memcpy(name, text, length);
    name[length] = '\0';
    more[out->definition_count++] = (rt_definition){name, equals + 1};
    return STATUS_DONE;
}

static int add_sweep(command_line *out, const char *text)
{
    const char **more = realloc(out->sweeps, (out->sweep_count + 1) * sizeof *more);
    if (!more) {
        message_error("out of memory");
        return STATUS_DEVICE;
    }
    out->sweeps = more;
    more[out->sweep_count++] = text;
    return STATUS_DONE;
}

/* Reads text, NULL for none, as the value of an option of the table. */
static int read_option_value(command_line *out, const option *option, const char *text)
{
    option_value *value = &out->options[option - option_table];
    int status = STATUS_DONE;
    switch (option->kind) {
    case KIND_CHOICE:
        status = read_choice(value, option, text);
        break;
    case KIND_WHOLE:
    case KIND_REAL:
        status = read_number(value, option, text);
        break;
    case KIND_SIZE:
        status = read_size(value, option, text);
        break;
    case KIND_FLAG:
    case KIND_TEXT:
        break;
    }
    value->given = 1;
    value->text = text;
    if (option == &option_table[OPTION_SET])
        status = read_definition(out, text);
    if (option == &option_table[OPTION_SWEEP])
        status = add_sweep(out, text);
    if (option == &option_table[OPTION_OUT])
        out->outputs[out->output_count++] = text;
    return status;
}

/* The name of the value that an option takes, or NULL. */
static const char *value_name(const meaning *meaning)
{
    return meaning->option ? meaning->option->value : settings_value_name(meaning->setting);
}

/* Reads text, NULL for none, as the value of what an option stands for. */
static int read_value(command_line *out, const meaning *meaning, const char *text)
{
    char buffer[SETTING_NAME_SIZE];
    const char *name =
        meaning->option ? meaning->option->name : settings_name(buffer, meaning->setting);
    const char *value = value_name(meaning);
    if (!value && text) {
        message_error("--%s takes no value; not '%s'", name, text);
        return STATUS_USAGE;
    }
    if (value && (!text || text[0] == '\0')) {
        message_error("--%s needs a value: --%s %s", name, name, value);
        return STATUS_USAGE;
    }
    if (meaning->option)
        return read_option_value(out, meaning->option, text);
    return settings_read(out, meaning->setting, value ? text : meaning->is_off ? "false" : "true");
}

/* ---- The line ------------------------------------------------------------- */

/*
 * Whether a word is the value of --preview, which may be left out, and not a scene: one that begins
 * as a value is refused as such.
 */
static int is_preview(const char *word)
{
    preview_target target;
    return preview_target_read(&target, word) || strncmp(word, "tev:", 4) == 0 ||
           strncmp(word, "page:", 5) == 0 || strncmp(word, "open:", 5) == 0;
}

/* Whether a word can be a scene: a file, or what is called like one. */
static int is_scene(const char *word)
{
    const size_t length = strlen(word);
    return word[0] == '-' || access(word, F_OK) == 0 ||
           (length > 4 && strcmp(word + length - 4, ".rts") == 0);
}

/* Reads the option at argv[*at], and its value where that is the next argument. */
static int read_option(command_line *out, int argc, char **argv, int *at)
{
    const char *name = argv[*at] + 2;
    const char *equals = strchr(name, '=');
    size_t length = equals ? (size_t)(equals - name) : strlen(name);
    const meaning meaning = find_meaning(name, length, out->command);
    if (!meaning.option && !meaning.setting)
        return fail_unknown_option(name, length, out->command);
    if (!is_taken(&meaning, out->command)) {
        message_error("`rtc%s%s` takes no option --%.*s", out->command == COMMAND_RENDER ? "" : " ",
                      command_name(out->command), (int)length, name);
        if (out->command == COMMAND_CHECK && meaning.setting)
            message_hint("a scene is checked with the settings of its own film and render blocks");
        else
            hint_takers(&meaning);
        return STATUS_USAGE;
    }
    const char *text = equals ? equals + 1 : NULL;
    /* A word that starts with two dashes is the next option, not a value that was forgotten. */
    if (meaning.option == &option_table[OPTION_PREVIEW])
        text = text ? text
               : *at + 1 < argc && (is_preview(argv[*at + 1]) || !is_scene(argv[*at + 1]))
                   ? argv[++*at]
                   : "page";
    else if (!text && value_name(&meaning) && *at + 1 < argc &&
             strncmp(argv[*at + 1], "--", 2) != 0)
        text = argv[++*at];
    return read_value(out, &meaning, text);
}

/* -D NAME=VALUE or -DNAME=VALUE, as other programs write --set. */
static int read_define(command_line *out, int argc, char **argv, int *at)
{
    const option *const set = &option_table[OPTION_SET];
    const meaning meaning = {.option = set};
    const char *text = argv[*at] + 2;
    if (!is_taken(&meaning, out->command)) {
        message_error("`rtc%s%s` takes no option -D", out->command == COMMAND_RENDER ? "" : " ",
                      command_name(out->command));
        return STATUS_USAGE;
    }
    if (!*text && *at + 1 < argc)
        text = argv[++*at];
    return read_value(out, &meaning, *text ? text : NULL);
}

/* Reads the argument at argv[*at]; after `--` every argument is an operand. */
static int read_argument(command_line *out, int argc, char **argv, int *at, int *options_end)
{
    const char *word = argv[*at];
    if (*options_end || word[0] != '-' || word[1] == '\0') {
        out->operands[out->operand_count++] = word;
        return STATUS_DONE;
    }
    if (strcmp(word, "--") == 0) {
        *options_end = 1;
        return STATUS_DONE;
    }
    if (strcmp(word, "-h") == 0)
        return read_option_value(out, &option_table[OPTION_HELP], NULL);
    if (word[1] == '-')
        return read_option(out, argc, argv, at);
    if (word[1] == 'D')
        return read_define(out, argc, argv, at);
    message_error("unknown option '%s'", word);
    if (word[1] == 'o')
        message_hint("did you mean --out?");
    else
        message_hint("options are written out, as in --spp 16; `rtc --help` lists them");
    return STATUS_USAGE;
}

/* Room for one more output. */
static int reserve_output(command_line *out)
{
    const char **outputs = realloc(out->outputs, (out->output_count + 1) * sizeof *outputs);
    if (!outputs) {
        message_error("out of memory");
        return STATUS_DEVICE;
    }
    out->outputs = outputs;
    return STATUS_DONE;
}

int arguments_give(command_line *out, const char *name, const char *text)
{
    const meaning meaning = find_meaning(name, strlen(name), out->command);
    if ((!meaning.option && !meaning.setting) || !is_taken(&meaning, out->command))
        return STATUS_DONE;
    if (meaning.setting && settings_text(out, meaning.setting))
        return STATUS_DONE;
    if (meaning.option == &option_table[OPTION_OUT]) {
        int status = reserve_output(out);
        if (status != STATUS_DONE)
            return status;
    } else if (meaning.option == &option_table[OPTION_SET]) {
        if (find_definition(out, text, strcspn(text, "=")))
            return STATUS_DONE;
    } else if (meaning.option && out->options[meaning.option - option_table].given) {
        return STATUS_DONE;
    }
    return meaning.setting ? settings_read(out, meaning.setting, text)
                           : read_option_value(out, meaning.option, text);
}

/* Help is asked for with what is no command; a form of photons that is spelt right goes first. */
static int fail_help(const char *word)
{
    const char *command = command_nearest(word), *form = photons_nearest_form(word);
    message_error("there is no command '%s' to help with; see `rtc --help`", word);
    if (form && (!command || strcmp(form, word) == 0))
        message_hint("did you mean `rtc photons %s --help`?", form);
    else if (command)
        message_hint("did you mean %s?", command);
    else
        message_hint("scenes and their fields are described by `man 5 rts` and dsl/reference.md");
    return STATUS_USAGE;
}

int arguments_parse(command_line *out, int argc, char **argv)
{
    size_t settings;
    memset(out, 0, sizeof *out);
    rt_settings(&settings);
    out->settings = calloc(settings, sizeof *out->settings);
    out->outputs = malloc(((size_t)argc + 1) * sizeof *out->outputs);
    out->operands = malloc(((size_t)argc + 1) * sizeof *out->operands);
    if (!out->settings || !out->outputs || !out->operands) {
        message_error("out of memory");
        return STATUS_DEVICE;
    }
    int at = 1, options_end = 0, status = STATUS_DONE;
    /* `rtc help COMMAND` and `rtc --help COMMAND` are `rtc COMMAND --help`. */
    const int names_command = argc > 2 && find_command(argv[2]) != COMMAND_RENDER;
    if (argc > 1 &&
        (strcmp(argv[1], "help") == 0 || (names_command && strcmp(argv[1], "--help") == 0))) {
        out->options[OPTION_HELP].given = 1;
        at++;
    }
    if (argc > at)
        out->command = find_command(argv[at]);
    if (at == 2 && argc > at && out->command == COMMAND_RENDER && strcmp(argv[at], "render") != 0)
        return fail_help(argv[at]);
    if (out->command != COMMAND_RENDER)
        at++;
    /* Report all errors, not only the first. */
    for (; at < argc; at++) {
        int now = read_argument(out, argc, argv, &at, &options_end);
        status = status == STATUS_DONE ? now : status;
    }
    if (status == STATUS_DONE && out->options[OPTION_VERBOSE].given &&
        out->options[OPTION_QUIET].given) {
        message_error("--verbose and --quiet exclude each other");
        status = STATUS_USAGE;
    }
    return status;
}

int arguments_limit_memory(command_line *arguments)
{
    const option_value *limit = &arguments->options[OPTION_MEMORY];
    uint64_t bytes = limit->given ? limit->count
                     : arguments->options[OPTION_UNTRUSTED].given
                         ? (uint64_t)UNTRUSTED_MEMORY_MIB << 20
                         : 0;
    rt_error error;
    /* --stats tells how much it was, limit or not. */
    const int is_counted = bytes > 0 || arguments->options[OPTION_STATS].given;
    return !is_counted || rt_memory_create(&arguments->memory, bytes, &error) == RT_OK
               ? STATUS_DONE
               : message_failure(&error);
}

void arguments_free(command_line *arguments)
{
    rt_film_destroy(arguments->film);
    rt_profile_destroy(arguments->profile);
    file_lock_release(&arguments->lock);
    free(arguments->note);
    free(arguments->paths);
    free(arguments->settings);
    free(arguments->outputs);
    for (size_t i = 0; i < arguments->definition_count; i++)
        free((char *)arguments->definitions[i].name);
    free(arguments->definitions);
    free(arguments->sweeps);
    free(arguments->operands);
}
