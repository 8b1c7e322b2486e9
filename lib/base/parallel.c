/*
 * parallel.c - runs jobs on threads that live for one call; each takes the next job until none is
 * left.
 */
#include "base/parallel.h"

#include <pthread.h>

enum { MAX_HELPERS = 255 };

typedef struct queue {
    pthread_mutex_t lock;
    uint32_t next, jobs;
    rt_parallel_job *job;
    void *user;
} queue;

static int take(queue *q, uint32_t *index)
{
    pthread_mutex_lock(&q->lock);
    int taken = q->next < q->jobs;
    if (taken)
        *index = q->next++;
    pthread_mutex_unlock(&q->lock);
    return taken;
}

static void *work(void *data)
{
    queue *q = data;
    uint32_t index;
    while (take(q, &index))
        q->job(q->user, index);
    return NULL;
}

void rt_parallel(uint32_t threads, uint32_t jobs, rt_parallel_job *job, void *user)
{
    queue q = {PTHREAD_MUTEX_INITIALIZER, 0, jobs, job, user};
    pthread_t helpers[MAX_HELPERS];
    uint32_t wanted = threads < jobs ? threads : jobs;
    uint32_t started = 0;

    /* A thread that cannot be started is not an error: the others and this one do its share. */
    while (started + 1 < wanted && started < MAX_HELPERS &&
           pthread_create(&helpers[started], NULL, work, &q) == 0)
        started++;
    work(&q);
    for (uint32_t i = 0; i < started; i++)
        pthread_join(helpers[i], NULL);
    pthread_mutex_destroy(&q.lock);
}
