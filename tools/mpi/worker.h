/* worker.h - a process that renders what rank 0 gives it. */
#ifndef RTC_MPI_WORKER_H
#define RTC_MPI_WORKER_H

#include "wire.h"
#include "../options.h"
#include "rt.h"

/* A worker. The members `rank` and `ranks` are the caller's. */
typedef struct worker {
    int rank, ranks;
    rt_memory *memory; /* that the photon map counts in, or NULL */
    message finished;  /* what was rendered since the last question */
    message given;     /* what is being rendered; its count 0: nothing */
    double began;
    int is_asked; /* a question is on its way */
    int is_ended;
    int to;          /* rank that gets the film next */
    rt_film *sum;    /* of the films that others handed to this one, or NULL */
    uint8_t *buffer; /* of films */
    size_t capacity;
    rt_status status; /* of handing over */
    rt_error *error;
} worker;

/* What rank 0 says of the film to be resumed, with a zero byte; NULL: there is nothing to do. */
char *worker_hello(void);

/* For team.render. */
rt_status worker_render(void *user, rt_film **out, rt_renderer *renderer,
                        const rt_render_options *options, rt_error *error);

/* The last word, with the exit status and what was said on stderr. */
void worker_bye(worker *worker, int status, const char *text);

#endif
