/* command_line.h - reads the command line. */
#ifndef RTC_COMMAND_LINE_H
#define RTC_COMMAND_LINE_H

#include "options.h"

/*
 * Parses argv[1] to argv[argc - 1]. Where an option is given twice, the last one counts; --out
 * adds up. Returns STATUS_DONE, or the exit status after saying what is wrong. Free *out with
 * arguments_free in either case.
 */
int arguments_parse(command_line *out, int argc, char **argv);
/*
 * Makes the count of what --memory limits and --stats tells; what strangers send has a limit in
 * any case.
 */
int arguments_limit_memory(command_line *arguments);
void arguments_free(command_line *arguments);

/*
 * Gives an option or setting by its name without dashes, where it is not given yet; outputs add up,
 * and so do definitions of several names.
 * What the command does not take is passed over. text must outlive *out. Returns an exit status.
 */
int arguments_give(command_line *out, const char *name, const char *text);

/* The subcommand that a mistyped word probably meant, or NULL. */
const char *command_nearest(const char *word);

/* The name of a subcommand as typed; "" for COMMAND_RENDER. */
const char *command_name(command_id command);

#endif
