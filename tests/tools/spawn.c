/* spawn.c - starts rtc, reads its output and waits for it. */
#define _XOPEN_SOURCE 700
#include "spawn.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

enum { MOST_WORDS = 64, LONGEST_LINE = 4096 };

static char rtc_path[PATH_MAX];

int spawn_find_rtc(void)
{
    const char *given = getenv("RTC"), *built = given && *given ? given : "build/rtc";
    if (realpath(built, rtc_path))
        return 0;
    fprintf(stderr, "%s: %s\n", built, strerror(errno));
    return -1;
}

/* ---- The child ------------------------------------------------------------ */

/* Where the child's standard streams go; -1 closes none and /dev/null stands in. */
typedef struct streams {
    int in, out, err;
    unsigned closed; /* bits 0 to 2: those that are closed nevertheless */
} streams;

/* Becomes rtc; line is cut into words. */
static void become_rtc(char *line)
{
    char *words[MOST_WORDS + 1];
    int count = 0;
    words[count++] = rtc_path;
    char *start = line;
    char *rtc = strstr(line, "rtc ");
    if (rtc && strchr(line, '=') && strchr(line, '=') < rtc) {
        for (char *pair = strtok(line, " "); strcmp(pair, "rtc") != 0; pair = strtok(NULL, " "))
            putenv(pair);
        start = rtc + 4;
    }
    for (char *word = strtok(start, " "); word && count < MOST_WORDS; word = strtok(NULL, " "))
        words[count++] = word;
    words[count] = NULL;
    execv(rtc_path, words);
    _exit(126);
}

static pid_t start(streams streams, char *line)
{
    pid_t pid = fork();
    assert_true(pid >= 0);
    if (pid > 0)
        return pid;
    int null = open("/dev/null", O_RDWR);
    dup2(streams.in >= 0 ? streams.in : null, STDIN_FILENO);
    dup2(streams.out >= 0 ? streams.out : null, STDOUT_FILENO);
    dup2(streams.err >= 0 ? streams.err : null, STDERR_FILENO);
    for (int fd = 0; fd <= STDERR_FILENO; fd++)
        if (streams.closed >> fd & 1)
            close(fd);
    /* What the caller of the tests ignores is not to be inherited. */
    signal(SIGINT, SIG_DFL);
    signal(SIGTERM, SIG_DFL);
    signal(SIGHUP, SIG_DFL);
    signal(SIGQUIT, SIG_DFL);
    become_rtc(line);
    return 0;
}

static int wait_status(pid_t pid)
{
    int status;
    while (waitpid(pid, &status, 0) < 0)
        assert_int_equal(errno, EINTR);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/* ---- Runs to the end -------------------------------------------------------- */

static char *read_whole(FILE *file)
{
    fseek(file, 0, SEEK_END);
    long size = ftell(file);
    rewind(file);
    char *text = malloc((size_t)size + 1);
    assert_non_null(text);
    assert_int_equal(fread(text, 1, (size_t)size, file), size);
    text[size] = '\0';
    fclose(file);
    return text;
}

static run run_line(FILE *in, unsigned closed, char *line)
{
    FILE *out = tmpfile(), *err = tmpfile();
    assert_true(out && err);
    streams streams = {in ? fileno(in) : -1, fileno(out), fileno(err), closed};
    run run;
    run.status = wait_status(start(streams, line));
    run.out = read_whole(out);
    run.err = read_whole(err);
    return run;
}

/* Declares line: the text that format and the arguments after it make. */
#define FORMAT_LINE(line, format)                                                                  \
    char line[LONGEST_LINE];                                                                       \
    do {                                                                                           \
        va_list args;                                                                              \
        va_start(args, format);                                                                    \
        assert_true(vsnprintf(line, sizeof line, format, args) < LONGEST_LINE);                    \
        va_end(args);                                                                              \
    } while (0)

run run_rtc(const char *format, ...)
{
    FORMAT_LINE(line, format);
    return run_line(NULL, 0, line);
}

run run_rtc_closed(unsigned closed, const char *format, ...)
{
    FORMAT_LINE(line, format);
    return run_line(NULL, closed, line);
}

run run_rtc_input(const char *input, size_t length, const char *format, ...)
{
    FORMAT_LINE(line, format);
    FILE *in = tmpfile();
    assert_non_null(in);
    assert_int_equal(fwrite(input, 1, length, in), length);
    rewind(in);
    run run = run_line(in, 0, line);
    fclose(in);
    return run;
}

run run_rtc_to(const char *path, const char *format, ...)
{
    FORMAT_LINE(line, format);
    FILE *err = tmpfile();
    int out = open(path, O_WRONLY | O_CLOEXEC);
    assert_true(err && out >= 0);
    streams streams = {-1, out, fileno(err), 0};
    run run = {0, calloc(1, 1), NULL};
    run.status = wait_status(start(streams, line));
    run.err = read_whole(err);
    close(out);
    return run;
}

void run_free(run *run)
{
    free(run->out);
    free(run->err);
}

/* ---- Runs under way ---------------------------------------------------------- */

static running start_line(int in, char *line)
{
    int pipes[2];
    assert_int_equal(pipe(pipes), 0);
    fcntl(pipes[0], F_SETFD, FD_CLOEXEC);
    fcntl(pipes[1], F_SETFD, FD_CLOEXEC);
    streams streams = {in, -1, pipes[1], 0};
    running running = {start(streams, line), pipes[0]};
    close(pipes[1]);
    return running;
}

running start_rtc(const char *format, ...)
{
    FORMAT_LINE(line, format);
    return start_line(-1, line);
}

running start_rtc_reading(int in, const char *format, ...)
{
    FORMAT_LINE(line, format);
    return start_line(in, line);
}

/* Reads once, behind what buffer holds; returns 0, or -1 at the end. */
static int read_more(int fd, char *buffer, size_t size)
{
    size_t used = strlen(buffer);
    assert_true(used + 1 < size);
    ssize_t count;
    do
        count = read(fd, buffer + used, size - used - 1);
    while (count < 0 && errno == EINTR);
    if (count <= 0)
        return -1;
    buffer[used + (size_t)count] = '\0';
    return 0;
}

int running_wait_for(const running *running, const char *text, char *buffer, size_t size)
{
    while (!strstr(buffer, text))
        if (read_more(running->err, buffer, size) != 0)
            return -1;
    return 0;
}

int running_finish(running *running, char *buffer, size_t size)
{
    while (read_more(running->err, buffer, size) == 0)
        ;
    close(running->err);
    return wait_status(running->pid);
}

int running_abandon(running *running)
{
    close(running->err);
    return wait_status(running->pid);
}

run run_rtc_terminal(const char *format, ...)
{
    FORMAT_LINE(line, format);
    enum { SIZE = 1 << 16 };
    int master = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (master < 0) {
        print_message("this system has no pseudo-terminals (%s)\n", strerror(errno));
        skip();
    }
    assert_true(grantpt(master) == 0 && unlockpt(master) == 0);
    int slave = open(ptsname(master), O_RDWR | O_NOCTTY | O_CLOEXEC);
    assert_true(slave >= 0);
    streams streams = {slave, slave, slave, 0};
    pid_t pid = start(streams, line);
    close(slave);
    run run = {0, calloc(1, SIZE), calloc(1, 1)};
    assert_true(run.out && run.err);
    while (read_more(master, run.out, SIZE) == 0)
        ;
    close(master);
    run.status = wait_status(pid);
    return run;
}
