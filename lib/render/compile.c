/* compile.c - a queue of programs, and the threads that take from it. */
#include "render/compile.h"

#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <string.h>
#include <time.h>

#include "device/compiler.h"

/* What is left to compile, and who does it. */
typedef struct queue {
    rt_device *device;
    pthread_mutex_t lock; /* of what follows */
    rt_program_list programs;
    uint32_t next, done, workers;
    pid_t processes[RT_PROGRAMS_OF_RENDER]; /* of each program; 0: none */
    int is_cancelled;
} queue;

void rt_program_list_add(rt_program_list *list, const char *program)
{
    if (list->count < RT_PROGRAMS_OF_RENDER)
        list->names[list->count++] = program;
}

static size_t length_of(const char *program)
{
    return rt_kernel_source_find(rt_kernel_sources, program)->length;
}

/* Those that the device has not, the longest first: begun last, it would be waited for. */
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

/* The next program to compile, or 0 when there is none. */
static int take(queue *q, uint32_t *out)
{
    pthread_mutex_lock(&q->lock);
    const int is_there = !q->is_cancelled && q->next < q->programs.count;
    if (is_there)
        *out = q->next++;
    pthread_mutex_unlock(&q->lock);
    return is_there;
}

static void finish(queue *q, uint32_t program)
{
    pthread_mutex_lock(&q->lock);
    q->processes[program] = 0;
    q->done++;
    pthread_mutex_unlock(&q->lock);
}

static void leave(queue *q)
{
    pthread_mutex_lock(&q->lock);
    q->workers--;
    pthread_mutex_unlock(&q->lock);
}

static void *compile_here(void *data)
{
    queue *q = data;
    uint32_t i;
    while (take(q, &i)) {
        rt_device_compile(q->device, q->programs.names[i], NULL, NULL);
        finish(q, i);
    }
    leave(q);
    return NULL;
}

static void *compile_elsewhere(void *data)
{
    queue *q = data;
    uint32_t i;
    while (take(q, &i)) {
        pid_t process = rt_compiler_begin(q->device, q->programs.names[i]);
        if (process > 0) {
            pthread_mutex_lock(&q->lock);
            q->processes[i] = process;
            if (q->is_cancelled)
                kill(process, SIGTERM);
            pthread_mutex_unlock(&q->lock);
            rt_compiler_wait(process);
        }
        finish(q, i);
        if (process > 0)
            rt_compiler_end(process);
    }
    leave(q);
    return NULL;
}

static void cancel(queue *q)
{
    pthread_mutex_lock(&q->lock);
    q->is_cancelled = 1;
    for (uint32_t i = 0; i < q->programs.count; i++)
        if (q->processes[i] > 0)
            kill(q->processes[i], SIGTERM);
    pthread_mutex_unlock(&q->lock);
}

/*
 * A driver does not say how far it is. So between one program and the next, the fraction follows
 * the time: towards 1, but never there, at a rate that suits some seconds a program.
 */
static double estimate(const queue *q, uint32_t done, double elapsed, uint32_t compilers)
{
    const double seconds_a_program = 3, known = (double)done / q->programs.count;
    const double expected = seconds_a_program * q->programs.count / compilers;
    const double guess = 0.99 * (1 - exp(-elapsed / expected));
    return guess > known ? guess : known;
}

/* Reports until the last thread has left. */
static void wait_for_all(queue *q, uint32_t compilers, rt_stage_progress *progress)
{
    const struct timespec pause = {0, 5000000};
    const double began = rt_clock();
    uint32_t workers;
    do {
        nanosleep(&pause, NULL);
        pthread_mutex_lock(&q->lock);
        progress->step = q->done;
        workers = q->workers;
        pthread_mutex_unlock(&q->lock);
        const double elapsed = rt_clock() - began;
        if (rt_stage_update(progress, estimate(q, progress->step, elapsed, compilers)) != RT_OK)
            cancel(q);
    } while (workers > 0);
}

/* Begins a thread on the queue; what cannot be begun leaves its work to the others. */
static void begin(queue *q, pthread_t *threads, uint32_t *count, void *(*work)(void *))
{
    pthread_mutex_lock(&q->lock);
    if (pthread_create(threads + *count, NULL, work, q) == 0) {
        q->workers++;
        ++*count;
    }
    pthread_mutex_unlock(&q->lock);
}

rt_status rt_programs_compile(rt_device *device, const rt_program_list *programs,
                              rt_stage_progress *progress)
{
    queue q = {.device = device, .lock = PTHREAD_MUTEX_INITIALIZER};
    pthread_t threads[RT_PROGRAMS_OF_RENDER];
    uint32_t count = 0;
    if (!rt_device_stores(device))
        return RT_OK;
    find_missing(&q.programs, device, programs);
    if (q.programs.count == 0)
        return RT_OK;
    progress->steps = q.programs.count;
    begin(&q, threads, &count, compile_here);
    const uint32_t compilers = rt_compilers(device);
    while (count > 0 && count < q.programs.count && count <= compilers) {
        const uint32_t before = count;
        begin(&q, threads, &count, compile_elsewhere);
        if (count == before)
            break;
    }
    if (count > 0)
        wait_for_all(&q, count, progress);
    for (uint32_t i = 0; i < count; i++)
        pthread_join(threads[i], NULL);
    pthread_mutex_destroy(&q.lock);
    progress->step = progress->steps;
    return progress->cancelled ? RT_CANCELLED : RT_OK;
}
