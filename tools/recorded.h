/* recorded.h - the command line as it is recorded in an image. */
#ifndef RTC_RECORDED_H
#define RTC_RECORDED_H

#include "options.h"

/*
 * The command line as far as it decides the pixels, so that two equal images are equal files. To be
 * freed; NULL without memory.
 */
char *recorded_command(const command_line *arguments, const char *scene);

#endif
