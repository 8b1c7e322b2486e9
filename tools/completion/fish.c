/* fish.c - the script for fish: one line an option. */
#include <stdio.h>
#include <string.h>

#include "lines.h"

static const char head[] =
    "# fish completion for rtc, made from the tables of its options by tools/completion.\n"
    "\n"
    "# The command of the line, or the form of `rtc photons`, is this one.\n"
    "function __rtc_is\n"
    "    set -l words (commandline -opc)[2..]\n"
    "    set -l command ''\n"
    "    if contains -- \"$words[1]\" $__rtc_commands\n"
    "        set command $words[1]\n"
    "        if test $command = photons; and contains -- \"$words[2]\" $__rtc_forms\n"
    "            set command photons/$words[2]\n"
    "        end\n"
    "    end\n"
    "    test \"$command\" = \"$argv\"\n"
    "end\n"
    "\n"
    "# So many words stand before the one that is completed.\n"
    "function __rtc_after\n"
    "    test (count (commandline -opc)) -eq $argv\n"
    "end\n"
    "\n"
    "# Files of these suffixes, and folders.\n"
    "function __rtc_files\n"
    "    set -l token (commandline -ct | string replace -r -- '^--[^=]*=' '')\n"
    "    set -l found $token*\n"
    "    set -l folders $token*/\n"
    "    string join -- \\n $folders\n"
    "    for suffix in $argv\n"
    "        string match -- \"*.$suffix\" $found\n"
    "    end\n"
    "end\n"
    "\n"
    "complete -c rtc -f\n";

/* Text in single quotes. */
static void print_quoted(const char *text)
{
    putchar('\'');
    for (; *text; text++)
        printf("%s%c", strchr("'\\", *text) ? "\\" : "", *text);
    putchar('\'');
}

/* The arguments of `complete` that say what follows. */
static void print_value(const line_value *value)
{
    if (value->files && value->files[0]) {
        printf(" -x -a '(__rtc_files %s)'", value->files);
    } else if (value->files) {
        fputs(" -r -F", stdout);
    } else {
        fputs(" -x", stdout);
        for (const rt_word *word = value->words; word && word->name; word++)
            printf("%s%s", word == value->words ? " -a '" : " ", word->name);
        fputs(value->words ? "'" : "", stdout);
    }
}

static void print_command(const line_command *command)
{
    line_option options[LINE_OPTIONS_MAX];
    const size_t count = line_options(options, LINE_OPTIONS_MAX, command);
    char is[128];
    snprintf(is, sizeof is, "complete -c rtc -n '__rtc_is \"%s%s%s\"'", command->first,
             command->second[0] ? "/" : "", command->second);
    for (size_t i = 0; i < count; i++) {
        printf("%s -l %s", is, options[i].name);
        if (options[i].value_name)
            print_value(&options[i].value);
        fputs(" -d ", stdout);
        print_quoted(options[i].help);
        putchar('\n');
    }
    if (command->operands.files || command->operands.words) {
        fputs(is, stdout);
        print_value(&command->operands);
        putchar('\n');
    }
}

/* The words of the commands from..to as a list, then each with its help after so many words. */
static void print_list(const char *name, size_t from, size_t to)
{
    printf("set -g %s", name);
    for (size_t i = from; i < to; i++) {
        const line_command command = line_command_at(i);
        printf(" %s", command.second[0] ? command.second : command.first);
    }
    putchar('\n');
}

static void print_words(size_t from, size_t to, const char *condition)
{
    for (size_t i = from; i < to; i++) {
        const line_command command = line_command_at(i);
        printf("complete -c rtc -n '%s' -a %s -d ", condition,
               command.second[0] ? command.second : command.first);
        print_quoted(command.help);
        putchar('\n');
    }
}

void line_print_fish(void)
{
    fputs(head, stdout);
    print_list("__rtc_commands help", 1, COMMAND_COUNT);
    print_list("__rtc_forms", COMMAND_COUNT, line_command_count());
    print_words(1, COMMAND_COUNT, "__rtc_after 1");
    print_words(1, COMMAND_COUNT, "__rtc_is help; and __rtc_after 2");
    fputs("complete -c rtc -n '__rtc_after 1' -a help -d 'describe a command'\n", stdout);
    print_words(COMMAND_COUNT, line_command_count(), "__rtc_is photons; and __rtc_after 2");
    for (size_t i = 0; i < line_command_count(); i++) {
        const line_command command = line_command_at(i);
        print_command(&command);
    }
}
