/* recorded.h - the command line as it is recorded in an image. */
#ifndef RTC_RECORDED_H
#define RTC_RECORDED_H

#include "options.h"
#include "rt.h"

/* A word as a shell reads it, for a hint: in quotes where it is not plain, and cut. Returns out. */
#define RECORDED_WORD_SIZE 1024
const char *recorded_word(char out[RECORDED_WORD_SIZE], const char *text);

/*
 * The command line, for a shell, as far as it decides the picture and its layers, so that it makes
 * them again, and two equal images are equal files. Of a film, or NULL, that ended before it had
 * all samples, by time or an interrupt, with as many as every pixel has. To be freed; NULL without
 * memory.
 */
char *recorded_command(const command_line *arguments, const char *scene, const rt_film *film);

#endif
