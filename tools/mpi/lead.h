/* lead.h - rank 0: hands out the work, adds up what comes back, and renders too. */
#ifndef RTC_MPI_LEAD_H
#define RTC_MPI_LEAD_H

#include <pthread.h>

#include "wire.h"
#include "../options.h"
#include "rt.h"

/* What rank 0 knows of another. */
typedef struct member {
    int is_gone;    /* it has said its last word */
    int is_waiting; /* for an answer */
    int is_new;     /* that answer is what it begins with */
    int has_joined;
    int is_sending;  /* it was told to hand its film to this process */
    int passes_to;   /* rank that was told to collect its film, and has not said so yet; or 0 */
    uint32_t worker; /* its number in the share */
    rt_photon_map *part;
} member;

typedef struct lead {
    int ranks;
    rt_memory *memory;
    const char *note; /* of the film to be resumed, "" for none */
    member *members;  /* [ranks] */
    int left;         /* that have not said their last word */
    int status;       /* exit status of the first one that failed, or 0 */
    char why[512];    /* what it said */
    double deadline;  /* when no film is waited for any more; 0: none */
    int has_stopped;  /* all were told to stop */

    /* What the thread that talks and the one that renders share. */
    pthread_mutex_t lock;
    int is_over;     /* there is nothing to do any more */
    rt_share *share; /* NULL: not yet */
    int parts;       /* of the map that are there */
    void *map;       /* the whole map, to be sent; NULL: not yet */
    size_t map_size;
    int map_is_sent;
} lead;

/* Returns whether there was memory. Free with lead_free in either case. */
int lead_begin(lead *out, int ranks);
void lead_free(lead *lead);

/* For team.render. */
rt_status lead_render(void *user, rt_film **out, rt_renderer *renderer,
                      const rt_render_options *options, rt_error *error);

/* Emits a part of the photon map, and joins it with those of the others. */
rt_status lead_share_map(lead *lead, rt_photon_map **out, rt_renderer *renderer,
                         const rt_render_options *options, rt_error *error);

/* Tells all others to end, and waits for their last word. */
void lead_end(lead *lead);

#endif
