/* message.h - what rtc says to a person, on stderr. */
#ifndef RTC_MESSAGE_H
#define RTC_MESSAGE_H

#include <stdio.h>

#include "rt.h"

#if defined(__GNUC__)
#define PRINTF_LIKE(text, first) __attribute__((format(printf, text, first)))
#else
#define PRINTF_LIKE(text, first)
#endif

/*
 * From now on every line on stderr is a JSON object, or no longer: {"severity": "error", "message":
 * ...}, with "warning", "hint" and "note" likewise; where a scene is at fault with "file", "line"
 * and "column" before the message, and its "hint", if it has one, behind.
 */
void message_as_json(int is_json);

/*
 * "rtc: error: ...", "rtc: warning: ...", "  hint: ..." and, without a prefix, a note; each one
 *                                            line.
 */
void message_error(const char *format, ...) PRINTF_LIKE(1, 2);
void message_warning(const char *format, ...) PRINTF_LIKE(1, 2);
void message_hint(const char *format, ...) PRINTF_LIKE(1, 2);
void message_note(const char *format, ...) PRINTF_LIKE(1, 2);

/* Hints how a field of a block of scenes becomes a constant, and that an option takes it then. */
void message_hint_constant(const char *field, const char *block, const char *option,
                           const char *values);

/*
 * From now on all of these are told to somebody else too, without colours: the excerpt of a source
 * as lines. NULL: to nobody.
 */
typedef void message_listener(void *user, const char *severity, const char *text);
void message_listen(message_listener *heard, void *user);

/*
 * Prints a name on stdout, such as that of a file, between two texts. On a terminal '?' stands for
 * each byte that could drive it; whoever else reads gets the name as it is.
 */
void message_put_name(const char *before, const char *name, const char *behind);

/* A note and a warning for rt_hooks. */
void message_of_log(void *user, const char *line);
void message_of_warning(void *user, const char *line);

/* An error or a warning of a scene: place, message, source line, caret and hint. */
void message_diagnostic(const rt_diagnostic *diagnostic);

/* The exit status that stands for a status of the library. */
int message_status(rt_status status);

/* Prints what the library failed with; returns the exit status that stands for it. */
int message_failure(const rt_error *error);

/*
 * Ends output on stdout: returns STATUS_DONE, or STATUS_OUTPUT after saying that it could not be
 * written.
 */
int message_finish_stdout(void);

#endif
