/* spawn.h - running rtc as a person would, and seeing what it says. */
#ifndef RT_TESTS_SPAWN_H
#define RT_TESTS_SPAWN_H

#include <stddef.h>
#include <sys/types.h>

/* A run that is over. */
typedef struct run {
    int status; /* exit status, or 128 + the signal that ended it */
    char *out;  /* what it wrote on stdout and stderr; a file descriptor each, never a terminal */
    char *err;
} run;

/*
 * Finds the program named by RTC, or build/rtc, from the current directory, before a test leaves
 * it. Returns 0, or -1 after saying so.
 */
int spawn_find_rtc(void);

/*
 * Runs `rtc` with a line of words apart by single spaces, as printf makes it. Words that hold an
 * equals sign and stand before a word "rtc" are set in the environment: "NO_COLOR=1 rtc check
 * a.rts". Fails the test when it cannot be started. Free with run_free.
 */
run run_rtc(const char *format, ...) __attribute__((format(printf, 1, 2)));
void run_free(run *run);

/* The same with standard streams closed: bit 0 stdin, 1 stdout, 2 stderr. */
run run_rtc_closed(unsigned closed, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The same with this text, of length bytes, on stdin. */
run run_rtc_input(const char *input, size_t length, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* The same with stdout going to the file at path; out is then empty. */
run run_rtc_to(const char *path, const char *format, ...) __attribute__((format(printf, 2, 3)));

/*
 * Runs rtc to its end with a terminal on stdin, stdout and stderr; all that it writes comes as out.
 */
run run_rtc_terminal(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* A run that is under way: what it writes on stderr can be read from the descriptor err. */
typedef struct running {
    pid_t pid;
    int err;
} running;

running start_rtc(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* The same with the descriptor `in` as stdin. */
running start_rtc_reading(int in, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Reads until text shows, gathering in buffer; returns 0, or -1 at the end of the stream. */
int running_wait_for(const running *running, const char *text, char *buffer, size_t size);

/* Reads the rest into buffer, waits for the end and returns the status as in run. */
int running_finish(running *running, char *buffer, size_t size);

/* Closes the reading end of its stderr, waits for the end and returns the status. */
int running_abandon(running *running);

#endif
