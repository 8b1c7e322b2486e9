/* expect.h - what the tests of rtc ask of a run. Each fails the test with all that rtc said. */
#ifndef RT_TESTS_EXPECT_H
#define RT_TESTS_EXPECT_H

#include "spawn.h"

/* A run ended with this status. */
void expect_status(const run *run, int status);

/* Runs rtc with this line; it ends with this status. */
void expect_rtc(int status, const char *line);

/* Its stdout or stderr holds this text; expect_no_err: it does not. */
void expect_out(const run *run, const char *text);
void expect_err(const run *run, const char *text);
void expect_no_err(const run *run, const char *text);

/* The files are there and hold the same bytes, or differ. */
void expect_same_files(const char *a, const char *b);
void expect_different_files(const char *a, const char *b);

/* The file is there and holds this text somewhere; expect_not_in_file: it does not. */
void expect_in_file(const char *name, const char *text);
void expect_not_in_file(const char *name, const char *text);

/* There is, or is not, such a file. */
void expect_file(const char *name);
void expect_no_file(const char *name);

/* Whether all devices are CPUs, to which some of what rtc does is limited. */
int device_is_cpu(void);

/* Whether the system can give up rights as --untrusted needs: Landlock of version 2 or later. */
int has_landlock(void);

/* A number that --stats prints: the one behind "name: " at the start of a line. */
double stats_number(const run *run, const char *name);

#endif
