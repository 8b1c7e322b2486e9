/* error.h - how internal functions report what went wrong. */
#ifndef RT_LIB_BASE_ERROR_H
#define RT_LIB_BASE_ERROR_H

#include <stdarg.h>

#include "rt.h"

#if defined(__GNUC__)
#define RT_PRINTF(string, first) __attribute__((format(printf, string, first)))
#else
#define RT_PRINTF(string, first)
#endif

/* Writes a message, which is one line whatever is quoted in it: of a name with a line end, too. */
void rt_write_line(char *out, size_t size, const char *format, va_list args);

/* Fills *error (may be NULL) with status and a one-line message; returns status. */
rt_status rt_fail(rt_error *error, rt_status status, const char *format, ...) RT_PRINTF(3, 4);

/* The same, naming the option or field at fault, so that a parser can point at its place. */
rt_status rt_fail_field(rt_error *error, rt_status status, const char *field, const char *format,
                        ...) RT_PRINTF(4, 5);

/*
 * Names the file that was worked on in *error (may be NULL) when status is a failure of that work,
 * unless the error already names another file. Returns status.
 */
rt_status rt_at_file(rt_status status, const char *path, rt_error *error);

/* What an errno means, as strerror says it. Returns out. */
enum { RT_CAUSE_SIZE = 128 };
const char *rt_cause(char out[RT_CAUSE_SIZE], int code);

/*
 * Whether a pointer that a call cannot do without is NULL; then *error says so as RT_ERROR_USAGE.
 */
int rt_is_missing(const void *pointer, const char *name, rt_error *error);

#endif
