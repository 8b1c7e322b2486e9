/* profile.c - sums the time of stages and commands, and keeps them one by one for a trace. */
#include "base/profile.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "base/profile_trace.h"
#include "base/progress.h"

/* Room for one more element of an array of *room; 0 without memory. */
static int has_room(void **array, size_t count, size_t *room, size_t size)
{
    if (count < *room)
        return 1;
    const size_t more = *room ? 2 * *room : 16;
    void *grown = realloc(*array, more * size);
    if (!grown)
        return 0;
    *array = grown;
    *room = more;
    return 1;
}

#define HAS_ROOM(list)                                                                             \
    has_room((void **)&(list).items, (list).count, &(list).room, sizeof *(list).items)

rt_status rt_profile_create(rt_profile **out, int has_trace, rt_error *error)
{
    rt_profile *profile = calloc(1, sizeof *profile);
    if (!profile || pthread_mutex_init(&profile->lock, NULL) != 0) {
        free(profile);
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for a profile");
    }
    profile->maker = pthread_self();
    profile->has_trace = has_trace;
    profile->began = rt_clock();
    profile->holders = 1;
    *out = profile;
    return RT_OK;
}

void rt_profile_destroy(rt_profile *profile)
{
    if (!profile || __atomic_sub_fetch(&profile->holders, 1, __ATOMIC_ACQ_REL) > 0)
        return;
    free(profile->threads.items);
    free(profile->stages.items);
    free(profile->commands.items);
    free(profile->devices.items);
    free(profile->events.items);
    pthread_mutex_destroy(&profile->lock);
    free(profile);
}

rt_profile *rt_profile_hold(rt_profile *profile)
{
    if (profile)
        __atomic_add_fetch(&profile->holders, 1, __ATOMIC_RELAXED);
    return profile;
}

double rt_profile_seconds(const rt_profile *profile)
{
    return rt_clock() - profile->began;
}

static void add_event(rt_profile *p, rt_profile_event event)
{
    if (p->has_trace && HAS_ROOM(p->events))
        p->events.items[p->events.count++] = event;
}

/* ---- Stages ------------------------------------------------------------------- */

/* What the calling thread has begun; NULL without memory. */
static rt_profile_thread *thread_of(rt_profile *p)
{
    const pthread_t self = pthread_self();
    for (size_t i = 0; i < p->threads.count; i++)
        if (pthread_equal(p->threads.items[i].id, self))
            return p->threads.items + i;
    if (!HAS_ROOM(p->threads))
        return NULL;
    rt_profile_thread *thread = p->threads.items + p->threads.count++;
    *thread = (rt_profile_thread){.id = self};
    return thread;
}

/* The sums of a stage; NULL without memory. */
static rt_profile_stage *stage_of(rt_profile *p, const char *name)
{
    for (size_t i = 0; i < p->stages.count; i++)
        if (strcmp(p->stages.items[i].name, name) == 0)
            return p->stages.items + i;
    if (!HAS_ROOM(p->stages))
        return NULL;
    rt_profile_stage *stage = p->stages.items + p->stages.count++;
    *stage = (rt_profile_stage){.name = name};
    return stage;
}

void rt_profile_begin(rt_profile *profile, const char *name)
{
    if (!profile)
        return;
    pthread_mutex_lock(&profile->lock);
    rt_profile_thread *thread = thread_of(profile);
    stage_of(profile, name); /* stages are in the order of their beginning */
    /* What is nested too deep counts as the stage around it. */
    if (thread && thread->depth++ < RT_PROFILE_DEPTH)
        thread->open[thread->depth - 1] = (rt_profile_open){name, rt_clock(), 0};
    pthread_mutex_unlock(&profile->lock);
}

/* Books a stage that has ended, and tells the stage around it. */
static void end_stage(rt_profile *p, rt_profile_thread *thread, double now)
{
    const rt_profile_open ended = thread->open[thread->depth];
    const double all = now - ended.began, own = all - ended.within;
    rt_profile_stage *stage = stage_of(p, ended.name);
    if (stage) {
        stage->count++;
        *(pthread_equal(thread->id, p->maker) ? &stage->seconds : &stage->beside) += own;
    }
    if (thread->depth > 0)
        thread->open[thread->depth - 1].within += all;
    add_event(p, (rt_profile_event){.name = ended.name,
                                    .began = ended.began,
                                    .seconds = all,
                                    .track = (uint32_t)(thread - p->threads.items)});
}

void rt_profile_end(rt_profile *profile)
{
    if (!profile)
        return;
    pthread_mutex_lock(&profile->lock);
    rt_profile_thread *thread = thread_of(profile);
    if (thread && thread->depth > 0 && --thread->depth < RT_PROFILE_DEPTH)
        end_stage(profile, thread, rt_clock());
    pthread_mutex_unlock(&profile->lock);
}

size_t rt_profile_get_stages(const rt_profile *profile, rt_profile_stage *out, size_t room)
{
    const size_t count = profile->stages.count;
    for (size_t i = 0; i < count && i < room; i++)
        out[i] = profile->stages.items[i];
    return count;
}

/* ---- Commands ----------------------------------------------------------------- */

uint32_t rt_profile_add_device(rt_profile *p, const char *name)
{
    pthread_mutex_lock(&p->lock);
    const uint32_t number = (uint32_t)p->devices.count;
    if (HAS_ROOM(p->devices)) {
        rt_profile_device *device = p->devices.items + p->devices.count++;
        memset(device, 0, sizeof *device);
        strncpy(device->name, name, sizeof device->name - 1);
    }
    pthread_mutex_unlock(&p->lock);
    return number;
}

/* The sums of a command, by its number; RT_PROFILE_NONE without memory. */
static uint32_t command_of(rt_profile *p, const rt_profile_done *done)
{
    for (size_t i = 0; i < p->commands.count; i++)
        if (strcmp(p->commands.items[i].name, done->name) == 0)
            return (uint32_t)i;
    if (!HAS_ROOM(p->commands))
        return RT_PROFILE_NONE;
    rt_profile_command *command = p->commands.items + p->commands.count;
    *command = (rt_profile_command){.is_transfer = done->is_transfer};
    strncpy(command->name, done->name, sizeof command->name - 1);
    return (uint32_t)p->commands.count++;
}

void rt_profile_add(rt_profile *p, uint32_t device, const rt_profile_done *done)
{
    const double seconds = done->ended - done->started;
    pthread_mutex_lock(&p->lock);
    const uint32_t number = command_of(p, done);
    if (number != RT_PROFILE_NONE) {
        rt_profile_command *command = p->commands.items + number;
        command->count++;
        command->amount += done->amount;
        command->seconds += seconds;
        command->waited += done->started - done->asked;
        add_event(p, (rt_profile_event){.began = done->started,
                                        .seconds = seconds,
                                        .amount = done->amount,
                                        .track = device,
                                        .command = number});
    }
    pthread_mutex_unlock(&p->lock);
}

size_t rt_profile_get_commands(const rt_profile *profile, rt_profile_command *out, size_t room)
{
    const size_t count = profile->commands.count;
    for (size_t i = 0; i < count && i < room; i++)
        out[i] = profile->commands.items[i];
    return count;
}
