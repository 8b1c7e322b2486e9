/* arguments.h - arguments of rtc made from its tables of options and settings. */
#ifndef RT_TESTS_FUZZ_ARGUMENTS_H
#define RT_TESTS_FUZZ_ARGUMENTS_H

#include "fuzz/fuzz.h"

/* The files that commands find in the current directory; NULL behind the last. */
extern const char *const fuzz_command_files[];

/* Appends an option with its value, an argument a line; `number` counts through all of them. */
void fuzz_option(rt_bytes *out, size_t number, fuzz_random *random);
size_t fuzz_option_count(void);

/* Appends a random argument: an option, a command, a file, a number. */
void fuzz_any_argument(rt_bytes *out, fuzz_random *random);

/* Adds all words of the command line. */
void fuzz_argument_words(fuzz_inputs *words);

#endif
