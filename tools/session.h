/* session.h - what the commands that render or emit share: hooks, options, the device. */
#ifndef RTC_SESSION_H
#define RTC_SESSION_H

#include "options.h"
#include "progress.h"
#include "rt.h"
#include "team.h"

/* A command under way. Must stay where it is: the hooks point to it. */
typedef struct session {
    const command_line *arguments;
    int quiet;
    progress_display progress;
    rt_hooks hooks;
    struct preview *preview; /* that is told how far it is, or NULL */
    struct watch *watch;     /* of files whose change ends a render, or NULL */
    double began; /* when light was first followed, by a clock that is never set; 0: not yet */
} session;

/*
 * Begins to show progress, the log and warnings, as the command line wants them, and to catch
 * Ctrl-C; with --untrusted, only to put it off until session_catch.
 */
void session_begin(session *session, const command_line *arguments);

/* Catches Ctrl-C, by a thread, once rights are given up: each thread gives up its own. */
void session_catch(const session *session);

/* Seconds since light was first followed; what was compiled before does not count. */
double session_seconds(const session *session);

const option_value *session_value(const session *session, option_id id);

/* What the command line says goes before what the options say; hooks are set. */
void session_merge_options(const session *session, rt_render_options *options);

/*
 * Prints a failure of the library; where an option is at fault, by its name on the command line.
 * Returns the exit status.
 */
int session_fail(const rt_error *error);

/*
 * Whether the options, merged from the scene's own, go together. Says what does not by the option
 * that was typed. Returns an exit status.
 */
int session_check_options(const session *session, const rt_render_options *own,
                          const rt_render_options *options);

/*
 * Whether a call of the library ended by Ctrl-C: also when it says that a kernel does not build,
 * because the compiler removes its files at the signal.
 */
int session_was_interrupted(rt_status result);

/*
 * Opens the device of this name, as in rt_device_options; from then on the first Ctrl-C stops the
 * work by its hooks. Returns an exit status; the caller owns *out.
 */
int session_open_device(const session *session, rt_device **out, const char *select);

#endif
