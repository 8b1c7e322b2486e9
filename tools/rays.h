/* rays.h - the rays of a command, for --stats with --count-rays. */
#ifndef RTC_RAYS_H
#define RTC_RAYS_H

#include <stddef.h>

#include "options.h"

/*
 * Prints the sums of some renderers on stdout, as `name: value` lines with rates by the time in
 * kernels, or as members of a JSON object; nothing where none are counted.
 */
void rays_print(const command_line *arguments, rt_renderer *const *renderers, size_t count);
void rays_print_json(const command_line *arguments, rt_renderer *const *renderers, size_t count);

#endif
