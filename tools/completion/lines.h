/*
 * lines.h - what a shell can complete of a command line, taken from the tables that the parser and
 * the help read.
 */
#ifndef RTC_LINES_H
#define RTC_LINES_H

#include <stddef.h>

#include "../options.h"
#include "../photons.h"
#include "../settings.h"

/* What follows a word: nothing that is known, words, or files. */
typedef struct line_value {
    const rt_word *words;
    const char *files; /* suffixes, "exr png"; "" any file; NULL: no file */
} line_value;

/* An option of a command. */
typedef struct line_option {
    char name[SETTING_NAME_SIZE + 4]; /* without the dashes */
    char help[96];
    const char *value_name; /* NULL of a flag */
    line_value value;
    int is_repeated; /* several count, not the last alone */
} line_option;

/* A command, or a form of `rtc photons`. */
typedef struct line_command {
    const char *first, *second; /* its words; "" for none */
    char help[96];
    command_id command;
    const photons_form *form;
    line_value operands;
} line_command;

/* How many there are, rendering first, the forms last; and one of them. */
size_t line_command_count(void);
line_command line_command_at(size_t i);

/* Writes the first `capacity` options of a command; returns how many it has. */
size_t line_options(line_option *out, size_t capacity, const line_command *command);

/* More than any command has. */
enum { LINE_OPTIONS_MAX = 256 };

/* Prints the script of a shell to stdout. */
void line_print_bash(void);
void line_print_zsh(void);
void line_print_fish(void);

#endif
