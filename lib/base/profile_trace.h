/* profile_trace.h - what a profile holds: sums, and for a trace each event by itself. */
#ifndef RT_LIB_BASE_PROFILE_TRACE_H
#define RT_LIB_BASE_PROFILE_TRACE_H

#include <pthread.h>

#include "base/error.h"

#define RT_PROFILE_NONE UINT32_MAX

enum { RT_PROFILE_DEPTH = 16 }; /* stages that are told apart within another */

/* A stage that has begun. */
typedef struct rt_profile_open {
    const char *name;
    double began, within; /* rt_clock(), and the seconds of the stages within it */
} rt_profile_open;

typedef struct rt_profile_thread {
    pthread_t id;
    uint32_t depth;
    rt_profile_open open[RT_PROFILE_DEPTH];
} rt_profile_thread;

typedef struct rt_profile_device {
    char name[128];
} rt_profile_device;

/* A stage on the track of a thread, or without a name a command on that of a device. */
typedef struct rt_profile_event {
    const char *name;
    double began, seconds;
    uint64_t amount;
    uint32_t track, command;
} rt_profile_event;

#define RT_PROFILE_LIST(type)                                                                      \
    struct {                                                                                       \
        type *items;                                                                               \
        size_t count, room;                                                                        \
    }

struct rt_profile {
    uint32_t holders;     /* the caller until rt_profile_destroy, and devices */
    pthread_mutex_t lock; /* of what follows `began` */
    pthread_t maker;
    int has_trace;
    double began; /* rt_clock() */
    RT_PROFILE_LIST(rt_profile_thread) threads;
    RT_PROFILE_LIST(rt_profile_stage) stages;
    RT_PROFILE_LIST(rt_profile_command) commands;
    RT_PROFILE_LIST(rt_profile_device) devices;
    RT_PROFILE_LIST(rt_profile_event) events;
};

#endif
