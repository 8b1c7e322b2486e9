/* recorded.h - the command line as it is recorded in an image. */
#ifndef RTC_RECORDED_H
#define RTC_RECORDED_H

#include "options.h"
#include "rt.h"

/*
 * The command line, for a shell, as far as it decides the picture and its layers, so that it makes
 * them again, and two equal images are equal files. Of a film, or NULL, that ended before it had
 * all samples, by time or an interrupt, with as many as every pixel has. To be freed; NULL without
 * memory.
 */
char *recorded_command(const command_line *arguments, const char *scene, const rt_film *film);

#endif
