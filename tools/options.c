#include "options.h"

#include <stdlib.h>
#include <string.h>

#include "message.h"
#include "nearest.h"
#include "number.h"
#include "rtc.h"

static const char *const command_names[COMMAND_COUNT] = {
    [COMMAND_RENDER] = "",         [COMMAND_CHECK] = "check",   [COMMAND_MESH] = "mesh",
    [COMMAND_DEVICES] = "devices", [COMMAND_DOCTOR] = "doctor", [COMMAND_PHOTONS] = "photons",
    [COMMAND_COMPARE] = "compare",
};

const char *command_name(command_id command)
{
    return command_names[command];
}

/* The subcommand that word names, or COMMAND_RENDER. */
static command_id find_command(const char *word)
{
    for (int i = COMMAND_RENDER + 1; i < COMMAND_COUNT; i++)
        if (strcmp(word, command_names[i]) == 0)
            return (command_id)i;
    return COMMAND_RENDER;
}

/*
 * The option whose name is name[0] to name[length - 1], the command's own if it has one, or NULL.
 */
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

static int fail_unknown_option(const char *name, size_t length, command_id command)
{
    message_error("unknown option '--%.*s'", (int)length, name);
    char wanted[64];
    snprintf(wanted, sizeof wanted, "%.*s", (int)length, name);
    nearest search = nearest_begin(wanted);
    for (int i = 0; i < OPTION_COUNT; i++)
        if (option_table[i].commands & (1u << command))
            nearest_offer(&search, option_table[i].name);
    if (search.best)
        message_hint("did you mean --%s?", search.best);
    else
        message_hint("`rtc %s%s--help` lists the options", command_name(command),
                     command == COMMAND_RENDER ? "" : " ");
    return STATUS_USAGE;
}

/* ---- Values --------------------------------------------------------------- */

void option_join_choices(char *out, size_t size, const option_choice *choices)
{
    out[0] = '\0';
    for (; choices->word; choices++) {
        size_t used = strlen(out);
        snprintf(out + used, size - used, "%s%s", used ? ", " : "", choices->word);
    }
}

static int read_choice(option_value *value, const option *option, const char *text)
{
    nearest search = nearest_begin(text);
    char words[128];
    for (const option_choice *choice = option->choices; choice->word; choice++) {
        if (strcmp(choice->word, text) == 0) {
            value->choice = choice->value;
            return STATUS_DONE;
        }
        nearest_offer(&search, choice->word);
    }
    option_join_choices(words, sizeof words, option->choices);
    message_error("--%s takes one of %s; not '%s'", option->name, words, text);
    if (search.best)
        message_hint("did you mean %s?", search.best);
    return STATUS_USAGE;
}

/* Whether text is one of the words that stand for a number; then it is read. */
static int read_number_word(option_value *value, const option *option, const char *text)
{
    for (const option_choice *choice = option->choices; choice && choice->word; choice++)
        if (strcmp(choice->word, text) == 0) {
            value->count = (uint32_t)choice->value;
            return 1;
        }
    return 0;
}

static int is_in_range(const option *option, double number)
{
    if (option->kind == KIND_BETWEEN)
        return number > option->min && number < option->max;
    return number >= option->min && number <= option->max;
}

static int read_number(option_value *value, const option *option, const char *text)
{
    char words[128] = "";
    if (read_number_word(value, option, text))
        return STATUS_DONE;
    int is_count = option->kind == KIND_WHOLE;
    int bad = is_count ? number_count(&value->count, text) : number_real(&value->real, text);
    double number = is_count ? (double)value->count : value->real;
    if (!bad && is_in_range(option, number))
        return STATUS_DONE;
    if (option->choices)
        option_join_choices(words, sizeof words, option->choices);
    const char *limits = option->kind == KIND_BETWEEN ? "between %.10g and %.10g, both excluded"
                                                      : "from %.10g to %.10g";
    char range[96];
    snprintf(range, sizeof range, limits, option->min, option->max);
    message_error("--%s takes a %s %s%s%s; not '%s'", option->name,
                  is_count ? "whole number" : "number", range, words[0] ? ", or " : "", words,
                  text);
    return STATUS_USAGE;
}

int option_takes_value(const option *option)
{
    return option->kind != KIND_FLAG && option->kind != KIND_SWITCH;
}

/* Reads text, NULL for none, as the value of an option. */
static int read_value(command_line *out, const option *option, const char *text)
{
    option_value *value = &out->options[option - option_table];
    if (!option_takes_value(option) && text) {
        message_error("--%s takes no value; not '%s'", option->name, text);
        return STATUS_USAGE;
    }
    if (option_takes_value(option) && (!text || text[0] == '\0')) {
        message_error("--%s needs a value: --%s %s", option->name, option->name, option->value);
        return STATUS_USAGE;
    }
    int status = STATUS_DONE;
    if (option->kind == KIND_CHOICE)
        status = read_choice(value, option, text);
    else if (option->kind == KIND_WHOLE || option->kind == KIND_REAL ||
             option->kind == KIND_BETWEEN)
        status = read_number(value, option, text);
    else if (option->kind == KIND_SWITCH)
        value->choice = 1;
    value->given = 1;
    value->text = text;
    if (option == &option_table[OPTION_OUT])
        out->outputs[out->output_count++] = text;
    return status;
}

/* The switch that --no-NAME takes back, or NULL. */
static const option *find_switched_off(const char *name, size_t length, command_id command)
{
    if (length < 4 || memcmp(name, "no-", 3) != 0)
        return NULL;
    const option *found = find_option(name + 3, length - 3, command);
    return found && found->kind == KIND_SWITCH ? found : NULL;
}

/* ---- The line ------------------------------------------------------------- */

/* Reads the option at argv[*at], and its value where that is the next argument. */
static int read_option(command_line *out, int argc, char **argv, int *at)
{
    const char *name = argv[*at] + 2;
    const char *equals = strchr(name, '=');
    size_t length = equals ? (size_t)(equals - name) : strlen(name);
    const option *off = find_switched_off(name, length, out->command);
    const option *option = off ? off : find_option(name, length, out->command);
    if (!option)
        return fail_unknown_option(name, length, out->command);
    if (!(option->commands & (1u << out->command))) {
        message_error("`rtc%s%s` takes no option --%s", out->command == COMMAND_RENDER ? "" : " ",
                      command_name(out->command), option->name);
        return STATUS_USAGE;
    }
    const char *text = equals ? equals + 1 : NULL;
    /* A word that starts with two dashes is the next option, not a value that was forgotten. */
    if (!text && option_takes_value(option) && *at + 1 < argc &&
        strncmp(argv[*at + 1], "--", 2) != 0)
        text = argv[++*at];
    int status = read_value(out, option, text);
    if (off)
        out->options[off - option_table].choice = 0;
    return status;
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
        return read_value(out, &option_table[OPTION_HELP], NULL);
    if (word[1] == '-')
        return read_option(out, argc, argv, at);
    message_error("unknown option '%s'", word);
    message_hint("options are written out, as in --spp 16; `rtc --help` lists them");
    return STATUS_USAGE;
}

int arguments_parse(command_line *out, int argc, char **argv)
{
    memset(out, 0, sizeof *out);
    out->outputs = malloc(((size_t)argc + 1) * sizeof *out->outputs);
    out->operands = malloc(((size_t)argc + 1) * sizeof *out->operands);
    if (!out->outputs || !out->operands) {
        message_error("out of memory");
        return STATUS_DEVICE;
    }
    int at = 1, options_end = 0, status = STATUS_DONE;
    /* `rtc help COMMAND` is `rtc COMMAND --help`. */
    if (argc > 1 && strcmp(argv[1], "help") == 0) {
        out->options[OPTION_HELP].given = 1;
        at++;
    }
    if (argc > at)
        out->command = find_command(argv[at]);
    if (at == 2 && argc > at && out->command == COMMAND_RENDER && strcmp(argv[at], "render") != 0) {
        message_error("there is no command '%s' to help with; see `rtc --help`", argv[at]);
        return STATUS_USAGE;
    }
    if (out->command != COMMAND_RENDER)
        at++;
    /* Say all that is wrong, not only the first. */
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

void arguments_free(command_line *arguments)
{
    free(arguments->outputs);
    free(arguments->operands);
}
