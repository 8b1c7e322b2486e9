/* zsh.c - the script for zsh, by its _arguments. */
#include <stdio.h>
#include <string.h>

#include "lines.h"

static const char head[] =
    "#compdef rtc\n"
    "# zsh completion for rtc, made from the tables of its options by tools/completion.\n"
    "\n"
    "_rtc()\n"
    "{\n"
    "    local command=\n"
    "    local -a rtc_commands rtc_forms\n";

static const char middle[] = "    if (( CURRENT > 2 )) && [[ $words[2] = help ||\n"
                             "        -n ${rtc_commands[(r)${(b)words[2]}:*]} ]]; then\n"
                             "        command=$words[2]\n"
                             "        shift words\n"
                             "        (( CURRENT-- ))\n"
                             "        if [[ $command = photons ]] && (( CURRENT > 2 )) &&\n"
                             "            [[ -n ${rtc_forms[(r)${(b)words[2]}:*]} ]]; then\n"
                             "            command=photons/$words[2]\n"
                             "            shift words\n"
                             "            (( CURRENT-- ))\n"
                             "        fi\n"
                             "    fi\n"
                             "    case $command in\n"
                             "    (help) _describe command rtc_commands ;;\n";

static const char tail[] = "    esac\n"
                           "}\n"
                           "\n"
                           "_rtc_first()\n"
                           "{\n"
                           "    _describe command rtc_commands\n"
                           "    _files -g '*.rts(-.)'\n"
                           "}\n"
                           "\n"
                           "_rtc_form()\n"
                           "{\n"
                           "    _describe form rtc_forms\n"
                           "    _files -g '*.rts(-.)'\n"
                           "}\n"
                           "\n"
                           "_rtc \"$@\"\n";

/* Text within single quotes, with a backslash before each of some characters. */
static void print_quoted(const char *text, const char *special)
{
    for (; *text; text++)
        if (*text == '\'')
            fputs("'\\''", stdout);
        else
            printf("%s%c", strchr(special, *text) ? "\\" : "", *text);
}

/* The action of _arguments that completes a value. */
static void print_action(const line_value *value)
{
    if (value->files && value->files[0]) {
        fputs("_files -g \"*.(", stdout);
        for (const char *c = value->files; *c; c++)
            putchar(*c == ' ' ? '|' : *c);
        fputs(")(-.)\"", stdout);
    } else if (value->files) {
        fputs("_files", stdout);
    } else if (value->words) {
        for (const rt_word *word = value->words; word->name; word++)
            printf("%s%s", word == value->words ? "(" : " ", word->name);
        putchar(')');
    } else {
        putchar(' ');
    }
}

static void print_option(const line_option *option)
{
    printf("            '%s--%s%s[", option->is_repeated ? "*" : "", option->name,
           option->value_name ? "=" : "");
    print_quoted(option->help, "[]\\");
    putchar(']');
    if (option->value_name) {
        putchar(':');
        print_quoted(option->value_name, ":\\");
        putchar(':');
        print_action(&option->value);
    }
    fputs("' \\\n", stdout);
}

static void print_command(const line_command *command)
{
    line_option options[LINE_OPTIONS_MAX];
    const size_t count = line_options(options, LINE_OPTIONS_MAX, command);
    printf("    ('%s%s%s')\n        _arguments -S \\\n", command->first,
           command->second[0] ? "/" : "", command->second);
    for (size_t i = 0; i < count; i++)
        print_option(&options[i]);
    if (command->command == COMMAND_RENDER)
        fputs("            '1: :_rtc_first' \\\n", stdout);
    if (command->command == COMMAND_PHOTONS && !command->form)
        fputs("            '1: :_rtc_form' \\\n", stdout);
    fputs("            '*: :", stdout);
    print_action(&command->operands);
    fputs("' ;;\n", stdout);
}

/* The words and helps of the commands from..to, for _describe. */
static void print_list(const char *name, size_t from, size_t to, const char *more)
{
    printf("    %s=(\n", name);
    for (size_t i = from; i < to; i++) {
        const line_command command = line_command_at(i);
        printf("        '%s:", command.second[0] ? command.second : command.first);
        print_quoted(command.help, ":\\");
        fputs("'\n", stdout);
    }
    printf("%s    )\n", more);
}

void line_print_zsh(void)
{
    fputs(head, stdout);
    print_list("rtc_commands", 1, COMMAND_COUNT, "        'help:describe a command'\n");
    print_list("rtc_forms", COMMAND_COUNT, line_command_count(), "");
    fputs(middle, stdout);
    for (size_t i = 0; i < line_command_count(); i++) {
        const line_command command = line_command_at(i);
        print_command(&command);
    }
    fputs(tail, stdout);
}
