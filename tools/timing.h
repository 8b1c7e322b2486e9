/* timing.h - where the time and the memory of a command went, for --stats and --profile. */
#ifndef RTC_TIMING_H
#define RTC_TIMING_H

#include "options.h"

/*
 * Begins to time the command if --stats or --profile wants it, or refuses the name of the trace.
 * Returns an exit status.
 */
int timing_begin(command_line *arguments);

/*
 * Prints tables on stdout: stages in seconds and percent of the time since timing_begin, what
 * devices did by their own clocks, and memory. Or the same as members of a JSON object, after
 * others.
 */
void timing_print(const command_line *arguments);
void timing_print_json(const command_line *arguments);

/* Writes the trace that --profile asked for, if it did. Returns an exit status. */
int timing_write(const command_line *arguments);

#endif
