/* expect.c - compares what rtc said and wrote with what is expected. */
#define _GNU_SOURCE /* syscall */
#include "expect.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#if defined(__linux__)
#include <linux/landlock.h>
#include <sys/syscall.h>
#endif

#include <cmocka.h>

#include "lib/image/scratch.h"

static void fail_run(const run *run, const char *what, const char *text)
{
    fail_msg("%s %s\nstatus %d\nstdout: %s\nstderr: %s", what, text, run->status, run->out,
             run->err);
}

void expect_status(const run *run, int status)
{
    char text[16];
    snprintf(text, sizeof text, "%d", status);
    if (run->status != status)
        fail_run(run, "expected status", text);
}

void expect_rtc(int status, const char *line)
{
    run run = run_rtc("%s", line);
    expect_status(&run, status);
    run_free(&run);
}

void expect_out(const run *run, const char *text)
{
    if (!strstr(run->out, text))
        fail_run(run, "expected on stdout:", text);
}

void expect_err(const run *run, const char *text)
{
    if (!strstr(run->err, text))
        fail_run(run, "expected on stderr:", text);
}

void expect_no_err(const run *run, const char *text)
{
    if (strstr(run->err, text))
        fail_run(run, "not expected on stderr:", text);
}

/* Whether two files hold the same bytes. */
static int is_same(const char *a, const char *b)
{
    FILE *x = fopen(a, "rb"), *y = fopen(b, "rb");
    assert_true(x && y);
    int c, d;
    do {
        c = getc(x);
        d = getc(y);
    } while (c == d && c != EOF);
    fclose(x);
    fclose(y);
    return c == d;
}

void expect_same_files(const char *a, const char *b)
{
    if (!is_same(a, b))
        fail_msg("%s and %s differ", a, b);
}

void expect_different_files(const char *a, const char *b)
{
    if (is_same(a, b))
        fail_msg("%s and %s are the same", a, b);
}

void expect_in_file(const char *name, const char *text)
{
    char *held = scratch_read(name);
    if (!strstr(held, text))
        fail_msg("no '%s' in %s:\n%s", text, name, held);
    free(held);
}

void expect_not_in_file(const char *name, const char *text)
{
    char *held = scratch_read(name);
    if (strstr(held, text))
        fail_msg("'%s' in %s:\n%s", text, name, held);
    free(held);
}

void expect_file(const char *name)
{
    if (access(name, F_OK) != 0)
        fail_msg("there is no %s", name);
}

void expect_no_file(const char *name)
{
    if (access(name, F_OK) == 0)
        fail_msg("there is a file %s", name);
}

int device_is_cpu(void)
{
    run run = run_rtc("devices");
    int is_cpu = strstr(run.out, "not a CPU") == NULL;
    run_free(&run);
    return is_cpu;
}

double stats_number(const run *run, const char *name)
{
    size_t length = strlen(name);
    for (const char *line = run->out; line; line = strchr(line, '\n')) {
        line += *line == '\n';
        if (strncmp(line, name, length) == 0 && strncmp(line + length, ": ", 2) == 0)
            return strtod(line + length + 2, NULL);
    }
    fail_run(run, "expected among the statistics:", name);
    return 0.0;
}

int has_landlock(void)
{
#if defined(__linux__)
    return syscall(SYS_landlock_create_ruleset, NULL, 0, LANDLOCK_CREATE_RULESET_VERSION) >= 2;
#else
    return 0;
#endif
}
