/*
 * interrupt.c - what Ctrl-C and the other signals that end a program do.
 *
 * They are blocked in all threads, and one thread waits for them: drivers install handlers of their
 * own (LLVM, inside PoCL, takes all of these when it compiles), which then are never called.
 */
#include "interrupt.h"

#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "status.h"

/* Seconds in which the same signal is no second one. */
static const double echo = 0.25;

static const int caught[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU};

/* What the thread that waits and the others share. */
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static int deferred, pending, ending, held;

/* Set before that thread begins. */
static int as_json, is_quiet;
static sigset_t waited, ignored;

static int get(const int *flag)
{
    pthread_mutex_lock(&lock);
    int value = *flag;
    pthread_mutex_unlock(&lock);
    return value;
}

static void set(int *flag)
{
    pthread_mutex_lock(&lock);
    *flag = 1;
    pthread_mutex_unlock(&lock);
}

/* Past stdio: the other threads may hold its locks, and the end must not wait for them. */
static void say(const char *plain, const char *json)
{
    const char *text = as_json ? json : plain;
    if (is_quiet)
        return;
    if (write(STDERR_FILENO, text, strlen(text)) < 0) {
        /* There is nobody to tell. */
    }
}

/* Ends the program as the signal does by default. */
static void die_of(int signal_number)
{
    sigset_t one;
    sigemptyset(&one);
    sigaddset(&one, signal_number);
    signal(signal_number, SIG_DFL);
    pthread_sigmask(SIG_UNBLOCK, &one, NULL);
    raise(signal_number);
}

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static void say_stopping(void)
{
    say("\nrtc: stopping; interrupt again to stop at once\n",
        "{\"severity\":\"note\",\"message\":\"stopping; interrupt again to stop at once\"}\n");
}

static void *wait_for_signals(void *data)
{
    int signal_number, first = 0;
    double since = 0;
    (void)data;
    while (sigwait(&waited, &signal_number) == 0) {
        if (sigismember(&ignored, signal_number))
            continue;
        /* Impatience is Ctrl-C, or the same again; a service manager may send HUP with TERM. */
        const int is_again = signal_number == first || signal_number == SIGINT || first == SIGINT;
        /* timeout(1) signals a process and then its group, and mpirun passes on what all hear. */
        if ((get(&pending) || get(&ending)) && signal_number == first && now() - since < echo)
            continue;
        /* The system tells each second from the soft limit on; the hard one kills. */
        if (get(&pending) && signal_number == SIGXCPU)
            continue;
        if (signal_number == SIGQUIT || (get(&pending) && is_again)) {
            die_of(signal_number);
        } else if (get(&pending)) {
            continue;
        } else if (!get(&deferred) && get(&ending)) {
            die_of(signal_number);
        } else if (!get(&deferred) && get(&held)) {
            set(&ending);
            first = signal_number;
            since = now();
        } else if (!get(&deferred)) {
            set(&ending);
            say("\nrtc: interrupted; nothing was written\n",
                "{\"severity\":\"note\",\"message\":\"interrupted; nothing was written\"}\n");
            _exit(STATUS_INTERRUPTED);
        } else {
            set(&pending);
            first = signal_number;
            since = now();
            say_stopping();
        }
    }
    return NULL;
}

/* Before interrupt_catch they end the program by their default, unless they are blocked. */
static sigset_t before_hold;

void interrupt_hold(void)
{
    sigset_t all;
    sigemptyset(&all);
    for (size_t i = 0; i < sizeof caught / sizeof *caught; i++)
        if (caught[i] != SIGQUIT)
            sigaddset(&all, caught[i]);
    set(&held);
    pthread_sigmask(SIG_BLOCK, &all, &before_hold);
}

int interrupt_is_ending(void)
{
    sigset_t waiting;
    int is_waiting = get(&ending);
    sigpending(&waiting);
    for (size_t i = 0; i < sizeof caught / sizeof *caught && get(&held); i++)
        is_waiting |= sigismember(&waiting, caught[i]) == 1;
    return is_waiting;
}

void interrupt_release(void)
{
    pthread_mutex_lock(&lock);
    held = 0;
    pthread_mutex_unlock(&lock);
    if (get(&ending)) {
        say("\nrtc: interrupted; nothing was written\n",
            "{\"severity\":\"note\",\"message\":\"interrupted; nothing was written\"}\n");
        _exit(STATUS_INTERRUPTED);
    }
    pthread_sigmask(SIG_SETMASK, &before_hold, NULL);
}

void interrupt_block(void)
{
    sigset_t all;
    sigemptyset(&all);
    for (size_t i = 0; i < sizeof caught / sizeof *caught; i++)
        sigaddset(&all, caught[i]);
    pthread_sigmask(SIG_BLOCK, &all, NULL);
}

void interrupt_catch(int in_json, int quiet)
{
    pthread_t thread;
    as_json = in_json;
    is_quiet = quiet;
    sigemptyset(&waited);
    sigemptyset(&ignored);
    for (size_t i = 0; i < sizeof caught / sizeof *caught; i++) {
        struct sigaction old;
        sigaddset(&waited, caught[i]);
        if (sigaction(caught[i], NULL, &old) == 0 && old.sa_handler == SIG_IGN)
            sigaddset(&ignored, caught[i]);
    }
    pthread_sigmask(SIG_BLOCK, &waited, NULL);
    /* Without the thread each ends the program at once. */
    if (pthread_create(&thread, NULL, wait_for_signals, NULL) != 0)
        pthread_sigmask(SIG_UNBLOCK, &waited, NULL);
    else
        pthread_detach(thread);
}

void interrupt_defer(void)
{
    set(&deferred);
}

void interrupt_request(void)
{
    if (get(&pending))
        return;
    set(&pending);
    say_stopping();
}

void interrupt_let_end(void)
{
    while (get(&ending))
        pause();
}

int interrupt_pending(void)
{
    return get(&pending);
}
