/* help.h - the help of every command. */
#ifndef RTC_HELP_H
#define RTC_HELP_H

#include "options.h"

/* Prints the help of a command, or of the form of it that is named, on stdout. */
void help_print(const command_line *arguments);

#endif
