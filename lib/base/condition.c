/* condition.c - conditions of the monotonic clock. */
#include "base/condition.h"

#include <time.h>

int rt_condition_begin(pthread_cond_t *condition)
{
    pthread_condattr_t how;
    int code = pthread_condattr_init(&how);
    if (code)
        return code;
    code = pthread_condattr_setclock(&how, CLOCK_MONOTONIC);
    if (!code)
        code = pthread_cond_init(condition, &how);
    pthread_condattr_destroy(&how);
    return code;
}

int rt_condition_wait(pthread_cond_t *condition, pthread_mutex_t *lock, double seconds)
{
    struct timespec until;
    clock_gettime(CLOCK_MONOTONIC, &until);
    until.tv_sec += (time_t)seconds;
    until.tv_nsec += (long)((seconds - (double)(time_t)seconds) * 1e9);
    until.tv_sec += until.tv_nsec / 1000000000;
    until.tv_nsec %= 1000000000;
    return pthread_cond_timedwait(condition, lock, &until);
}
