/* whole_file.h - a file, or stdin, read into memory at once. */
#ifndef RTC_WHOLE_FILE_H
#define RTC_WHOLE_FILE_H

#include <stddef.h>

/*
 * The bytes of a regular file, or of stdin for "-", and a NUL behind them, to be freed; at most
 * `limit`. NULL, with a part of a sentence that says why in cause (of cause_size bytes).
 */
char *whole_file_read(const char *path, size_t limit, size_t *size, char *cause, size_t cause_size);

#endif
