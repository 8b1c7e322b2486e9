/*
 * libfuzzer.c - the targets under libFuzzer. RT_FUZZ in the environment names one where a program
 * has several; RT_FUZZ_SECONDS, where it is set, limits the CPU time of all inputs together. The
 * arguments are those of libFuzzer (https://llvm.org/docs/LibFuzzer.html).
 */
#define _XOPEN_SOURCE 700 /* realpath, setitimer */
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>

#include "fuzz/targets.h"

enum { seconds_max = 10 }; /* CPU time of one input */

size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t room);
int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t room, unsigned seed);

static const fuzz_target *target;
static volatile sig_atomic_t seconds;       /* of CPU time since the input began */
static volatile sig_atomic_t seconds_all;   /* of CPU time since the program began */
static volatile sig_atomic_t seconds_limit; /* of seconds_all; 0: none */

size_t fuzz_mutate_bytes(uint8_t *data, size_t size, size_t room)
{
    return LLVMFuzzerMutate(data, size, room);
}

/* libFuzzer's own limit is by the clock, which goes on while the process is stopped. */
static void on_second(int signal)
{
    (void)signal;
    seconds_all++;
    if (++seconds > seconds_max)
        fuzz_fail(__FILE__, __LINE__, "an input is answered within 10 s of CPU time");
}

/* Ends the run behind the input that is being read. */
static void on_hangup(int signal)
{
    (void)signal;
    seconds_limit = 1;
}

/* The targets leave the directory, so files and folders are named from the root. */
static void make_absolute(int argc, char **argv)
{
    char path[PATH_MAX];
    for (int i = 1; i < argc; i++)
        if (argv[i][0] != '-' && realpath(argv[i], path))
            argv[i] = strdup(path);
}

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    const struct itimerval second = {{1, 0}, {1, 0}};
    const struct sigaction action = {.sa_handler = on_second, .sa_flags = SA_RESTART},
                           hangup = {.sa_handler = on_hangup, .sa_flags = SA_RESTART};
    const char *name = getenv("RT_FUZZ"), *limit = getenv("RT_FUZZ_SECONDS");
    seconds_limit = limit ? atol(limit) : 0;
    target = name ? fuzz_find(name) : fuzz_targets[1] ? NULL : fuzz_targets[0];
    if (!target) {
        fprintf(stderr, "RT_FUZZ has to name a target:");
        for (const fuzz_target *const *t = fuzz_targets; *t; t++)
            fprintf(stderr, " %s", (*t)->name);
        fprintf(stderr, "\n");
        exit(2);
    }
    make_absolute(*argc, *argv);
    fuzz_enter_scratch();
    if (target->begin)
        target->begin();
    sigaction(SIGPROF, &action, NULL);
    sigaction(SIGHUP, &hangup, NULL);
    setitimer(ITIMER_PROF, &second, NULL);
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    seconds = 0;
    fuzz_input_is(data, size);
    target->run(data, size);
    if (seconds_limit && seconds_all >= seconds_limit)
        raise(SIGUSR1); /* libFuzzer sums up and ends */
    return 0;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t room, unsigned seed)
{
    return target->mutate ? target->mutate(data, size, room, seed)
                          : LLVMFuzzerMutate(data, size, room);
}
