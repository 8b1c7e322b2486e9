/* parallel.h - numbered jobs on a few threads. */
#ifndef RT_LIB_BASE_PARALLEL_H
#define RT_LIB_BASE_PARALLEL_H

#include <stdint.h>

/*
 * Runs job(user, i) for i in 0 .. jobs - 1, in any order, on up to `threads` threads; returns when
 * all are done.
 */
typedef void rt_parallel_job(void *user, uint32_t index);
void rt_parallel(uint32_t threads, uint32_t jobs, rt_parallel_job *job, void *user);

#endif
