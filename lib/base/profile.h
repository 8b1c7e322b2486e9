/* profile.h - what devices tell a profile of the commands that they have done. */
#ifndef RT_LIB_BASE_PROFILE_H
#define RT_LIB_BASE_PROFILE_H

#include "rt.h"

/* A command that has ended; times by rt_clock(). */
typedef struct rt_profile_done {
    const char *name; /* copied */
    int is_transfer;
    uint64_t amount;              /* work-items, or bytes */
    double asked, started, ended; /* by the host, then by the device */
} rt_profile_done;

/*
 * Has the profile last until rt_profile_destroy is called once more; returns it. It may be NULL.
 */
rt_profile *rt_profile_hold(rt_profile *profile);

/* The number of a device in the trace; its name is copied. */
uint32_t rt_profile_add_device(rt_profile *profile, const char *name);
void rt_profile_add(rt_profile *profile, uint32_t device, const rt_profile_done *done);

#endif
