/*
 * compile.c - programs shared out to this process and others: each compiles a list of its own, as a
 * process reads the driver's built-in functions once, whatever it compiles.
 */
#include "render/compile.h"

#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <string.h>
#include <time.h>

#include "device/compiler.h"

/* One that compiles: a thread that does so itself, or waits for a process. */
typedef struct worker {
    struct team *team;
    pthread_t thread;
    rt_program_list programs;
    size_t length; /* of their sources */
    pid_t process; /* 0: none */
} worker;

/* Those that compile; the first does so here. */
typedef struct team {
    rt_device *device;
    pthread_mutex_t lock; /* of what follows, and of the processes */
    worker workers[RT_PROGRAMS_OF_RENDER];
    uint32_t count, programs, done, busy;
    int is_cancelled;
} team;

void rt_program_list_add(rt_program_list *list, const char *program)
{
    if (list->count < RT_PROGRAMS_OF_RENDER)
        list->names[list->count++] = program;
}

static size_t length_of(const char *program)
{
    return rt_kernel_source_find(rt_kernel_sources, program)->length;
}

/* Those that the device has not, the longest first. */
static void find_missing(rt_program_list *out, const rt_device *device, const rt_program_list *all)
{
    for (uint32_t i = 0; i < all->count; i++) {
        if (rt_device_has_program(device, all->names[i]))
            continue;
        uint32_t at = out->count++;
        for (; at > 0 && length_of(out->names[at - 1]) < length_of(all->names[i]); at--)
            out->names[at] = out->names[at - 1];
        out->names[at] = all->names[i];
    }
}

/* The longest first, each to the one that has the least until then (Graham 1969). */
static void share_out(team *t, const rt_program_list *programs)
{
    for (uint32_t i = 0; i < programs->count; i++) {
        worker *least = t->workers;
        for (worker *w = t->workers; w < t->workers + t->count; w++)
            if (w->length < least->length)
                least = w;
        rt_program_list_add(&least->programs, programs->names[i]);
        least->length += length_of(programs->names[i]);
    }
}

static int is_cancelled(team *t)
{
    pthread_mutex_lock(&t->lock);
    const int cancelled = t->is_cancelled;
    pthread_mutex_unlock(&t->lock);
    return cancelled;
}

static void add_done(team *t, uint32_t programs)
{
    pthread_mutex_lock(&t->lock);
    t->done += programs;
    pthread_mutex_unlock(&t->lock);
}

static void leave(team *t)
{
    pthread_mutex_lock(&t->lock);
    t->busy--;
    pthread_mutex_unlock(&t->lock);
}

static void *compile_here(void *data)
{
    const worker *w = data;
    for (uint32_t i = 0; i < w->programs.count && !is_cancelled(w->team); i++) {
        rt_device_compile(w->team->device, w->programs.names[i], NULL, NULL);
        add_done(w->team, 1);
    }
    leave(w->team);
    return NULL;
}

/* The process that a worker waits for, 0 when it has ended; ends it where all is cancelled. */
static void set_process(worker *w, pid_t process)
{
    pthread_mutex_lock(&w->team->lock);
    w->process = process;
    if (process > 0 && w->team->is_cancelled)
        kill(process, SIGTERM);
    pthread_mutex_unlock(&w->team->lock);
}

static void *compile_elsewhere(void *data)
{
    worker *w = data;
    const pid_t process = rt_compiler_begin(w->team->device, w->programs.names, w->programs.count);
    if (process > 0) {
        set_process(w, process);
        rt_compiler_wait(process);
        set_process(w, 0);
        rt_compiler_end(process);
    }
    add_done(w->team, w->programs.count);
    leave(w->team);
    return NULL;
}

static void cancel(team *t)
{
    pthread_mutex_lock(&t->lock);
    t->is_cancelled = 1;
    for (uint32_t i = 0; i < t->count; i++)
        if (t->workers[i].process > 0)
            kill(t->workers[i].process, SIGTERM);
    pthread_mutex_unlock(&t->lock);
}

/*
 * A driver does not say how far it is. So between one program and the next, the fraction follows
 * the time: towards 1, but never there, at a rate that suits some seconds a program.
 */
static double estimate(const team *t, uint32_t done, double elapsed)
{
    const double seconds_a_program = 3, known = (double)done / t->programs;
    const double expected = seconds_a_program * t->programs / t->count;
    const double guess = 0.99 * (1 - exp(-elapsed / expected));
    return guess > known ? guess : known;
}

/* Reports until the last thread has left. */
static void wait_for_all(team *t, rt_stage_progress *progress)
{
    const struct timespec pause = {0, 5000000};
    const double began = rt_clock();
    uint32_t busy;
    do {
        nanosleep(&pause, NULL);
        pthread_mutex_lock(&t->lock);
        progress->step = t->done;
        busy = t->busy;
        pthread_mutex_unlock(&t->lock);
        const double elapsed = rt_clock() - began;
        if (rt_stage_update(progress, estimate(t, progress->step, elapsed)) != RT_OK)
            cancel(t);
    } while (busy > 0);
}

/* Begins the threads; what one that cannot be begun would do is compiled when it is needed. */
static void begin(team *t)
{
    uint32_t begun = 0;
    pthread_mutex_lock(&t->lock);
    for (; begun < t->count; begun++) {
        worker *w = &t->workers[begun];
        w->team = t;
        if (pthread_create(&w->thread, NULL, begun ? compile_elsewhere : compile_here, w) != 0)
            break;
    }
    t->count = t->busy = begun;
    pthread_mutex_unlock(&t->lock);
}

rt_status rt_programs_compile(rt_device *device, const rt_program_list *programs,
                              rt_stage_progress *progress)
{
    team t = {.device = device, .lock = PTHREAD_MUTEX_INITIALIZER};
    rt_program_list missing = {.count = 0};
    if (!rt_device_stores(device))
        return RT_OK;
    find_missing(&missing, device, programs);
    if (missing.count == 0)
        return RT_OK;
    const uint32_t most = 1 + rt_compilers(device);
    t.programs = missing.count;
    t.count = missing.count < most ? missing.count : most;
    share_out(&t, &missing);
    progress->steps = t.programs;
    begin(&t);
    if (t.count > 0)
        wait_for_all(&t, progress);
    for (uint32_t i = 0; i < t.count; i++)
        pthread_join(t.workers[i].thread, NULL);
    pthread_mutex_destroy(&t.lock);
    progress->step = progress->steps;
    return progress->cancelled ? RT_CANCELLED : RT_OK;
}
