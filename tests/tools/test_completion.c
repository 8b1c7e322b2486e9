/*
 * test_completion.c - the command line of rtc as the shells complete it: bash and zsh on a terminal
 * of their own, fish by its command `complete`. A shell that is not installed is skipped.
 */
#define _DEFAULT_SOURCE

#include <poll.h>
#include <pty.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "lib/image/scratch.h"

/* What is typed, and the line that rtc gets; `=` and a space between words count as the same. */
static const struct {
    const char *typed, *line;
} cases[] = {
    {"rtc --mod\tpho\tb\t", "--mode photon b.rts"},
    {"rtc --gather=dev\t", "--gather device"},
    {"rtc a\t", "a.rts"},
    {"rtc comp\tb\t", "compare b.exr"},
    {"rtc photons inf\tm\t", "photons info m.rtp"},
    {"rtc photons export --out m.p\t", "photons export --out m.ply"},
    {"rtc photons b\t", "photons b.rts"},
    {"rtc check b\t", "check b.rts"},
    {"rtc check sub/i\t", "check sub/inner.rts"},
    {"rtc mesh tor\t--tri\t", "mesh torus --triangles"},
    {"rtc --out f\t", "--out f.rtpart"},
    {"rtc study a.rts --out p\t", "study a.rts --out p.html"},
    {"rtc help ker\t", "help kernels"},
    {"rtc merge --inc\t", "merge --incomplete"},
    {"rtc info --sp\t", "info --sp"},
    {"rtc photons info --sp\t", "photons info --sp"},
    {"rtc --no-ao\t", "--no-aov"},
    {"rtc --spp a\t", "--spp a"},
};

static char build[4096]; /* the folder of the scripts */

static int enter(void **state)
{
    static const char *const names[] = {"a.rts", "b.rts", "b.exr", "m.rtp",    "m.rts",
                                        "m.ply", "f.rts", "p.rts", "f.rtpart", "p.html"};
    if (!build[0])
        assert_non_null(realpath("build/completion", build));
    if (scratch_enter(state))
        return -1;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        scratch_write(names[i], "");
    return system("mkdir sub; touch sub/inner.rts sub/inner.exr");
}

static int leave(void **state)
{
    return system("rm -r sub .folder 2>/dev/null") == -1 ? -1 : scratch_leave(state);
}

static int has_shell(const char *name)
{
    char command[64];
    snprintf(command, sizeof command, "command -v %s >/dev/null", name);
    return system(command) == 0;
}

/* ---- On a terminal -------------------------------------------------------------------------- */

/* Reads from the terminal until it says `word`, for at most ten seconds. */
static void wait_for(int terminal, char *said, size_t size, const char *word)
{
    size_t used = 0;
    said[0] = '\0';
    while (!strstr(said, word)) {
        struct pollfd ready = {terminal, POLLIN, 0};
        ssize_t got = poll(&ready, 1, 10000) > 0 ? read(terminal, said + used, size - 1 - used) : 0;
        if (got <= 0)
            fail_msg("no '%s' in: %s", word, said);
        used += (size_t)got;
        said[used] = '\0';
    }
}

static void type(int terminal, const char *text)
{
    assert_int_equal(write(terminal, text, strlen(text)), (ssize_t)strlen(text));
}

/* Starts a shell in which `rtc` prints its arguments between "got:" and ":end". */
static pid_t start(int *terminal, const char *const arguments[], const char *source)
{
    char line[8192], said[16384];
    const struct winsize size = {50, 200, 0, 0};
    pid_t shell = forkpty(terminal, NULL, NULL, &size);
    assert_true(shell >= 0);
    if (shell == 0) {
        setenv("TERM", "xterm", 1);
        setenv("HOME", "/nonexistent", 1);
        setenv("PS1", "begin> ", 1);
        execvp(arguments[0], (char *const *)arguments);
        _exit(127);
    }
    wait_for(*terminal, said, sizeof said, "begin> ");
    snprintf(line, sizeof line, source, build);
    type(*terminal, line);
    type(*terminal, "rtc() { echo \"got\"\":$*:\"\"end\"; }; PS1='ready''> '\n");
    wait_for(*terminal, said, sizeof said, "ready> ");
    return shell;
}

static void expect_completed(const char *const arguments[], const char *source)
{
    int terminal;
    char said[16384];
    if (!has_shell(arguments[0])) {
        print_message("%s is not installed: skipped\n", arguments[0]);
        skip();
    }
    pid_t shell = start(&terminal, arguments, source);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        type(terminal, cases[i].typed);
        type(terminal, "\n");
        wait_for(terminal, said, sizeof said, ":end");
        char *got = strstr(said, "got:") + strlen("got:");
        *strstr(got, ":end") = '\0';
        for (char *c = got; *c; c++)
            *c = *c == '=' ? ' ' : *c;
        assert_string_equal(got, cases[i].line);
    }
    kill(shell, SIGKILL);
    waitpid(shell, NULL, 0);
    close(terminal);
}

static void bash_completes(void **state)
{
    static const char *const arguments[] = {"bash", "--norc", "--noprofile", "-i", NULL};
    (void)state;
    expect_completed(arguments, "bind 'set bell-style none'; source '%s/rtc.bash'\n");
}

static void zsh_completes(void **state)
{
    static const char *const arguments[] = {"zsh", "-f", "-i", NULL};
    (void)state;
    expect_completed(arguments,
                     "mkdir .folder; cp '%s/rtc.zsh' .folder/_rtc; fpath=($PWD/.folder $fpath); "
                     "autoload -U compinit; compinit -u -D; unsetopt beep\n");
}

/* ---- By the command `complete` of fish --------------------------------------------------- */

/* Completes the last word of the line as a TAB would, where there is one way. */
static void complete_in_fish(char *line, size_t size)
{
    char command[8192], word[256] = "", other[256];
    snprintf(command, sizeof command,
             "HOME=/nonexistent fish --no-config -c \"source '%s/rtc.fish'; complete -C '%s'\"",
             build, line);
    FILE *out = popen(command, "r");
    assert_non_null(out);
    if (!fgets(word, sizeof word, out) || fgets(other, sizeof other, out))
        word[0] = '\0';
    pclose(out);
    char *last = strrchr(line, ' ') + 1;
    word[strcspn(word, "\t\n")] = '\0';
    if (word[0])
        snprintf(last, size - (size_t)(last - line), "%s ", word);
}

static void fish_completes(void **state)
{
    (void)state;
    if (!has_shell("fish")) {
        print_message("fish is not installed: skipped\n");
        skip();
    }
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char line[512] = "";
        for (const char *c = cases[i].typed; *c; c++)
            if (*c == '\t')
                complete_in_fish(line, sizeof line);
            else
                snprintf(line + strlen(line), sizeof line - strlen(line), "%c", *c);
        for (char *c = line; *c; c++)
            *c = *c == '=' ? ' ' : *c;
        while (line[0] && line[strlen(line) - 1] == ' ')
            line[strlen(line) - 1] = '\0';
        assert_string_equal(line + strlen("rtc "), cases[i].line);
    }
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, enter, leave)

int main(void)
{
    const struct CMUnitTest tests[] = {TEST(bash_completes), TEST(zsh_completes),
                                       TEST(fish_completes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
