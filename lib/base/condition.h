/* condition.h - waiting for another thread, for a while. */
#ifndef RT_LIB_BASE_CONDITION_H
#define RT_LIB_BASE_CONDITION_H

#include <pthread.h>

/* A condition that waits by rt_clock, which nobody sets back. Returns 0, or an error. */
int rt_condition_begin(pthread_cond_t *condition);

/* Waits for so many seconds at most; returns ETIMEDOUT after them, else 0. */
int rt_condition_wait(pthread_cond_t *condition, pthread_mutex_t *lock, double seconds);

#endif
