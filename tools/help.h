/* help.h - the help of every command. */
#ifndef RTC_HELP_H
#define RTC_HELP_H

#include "options.h"
#include "photons.h"

/* Prints the help of a command, or of the form of it that is named, on stdout. */
void help_print(const command_line *arguments);

/* The start of it: the usage and, after an empty line, what the command does. */
const char *help_usage(command_id command);

/* What an option does in a command, or in a form of `rtc photons`; form may be NULL. */
const char *help_of(const option *option, command_id command, const photons_form *form);

#endif
