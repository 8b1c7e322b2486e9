/* team.h - a render that several processes share: how the one in hand takes part in it. */
#ifndef RTC_TEAM_H
#define RTC_TEAM_H

#include "rt.h"

typedef struct team {
    int is_worker;   /* another process leads: this one writes nothing */
    uint32_t number; /* of the processes of this machine, from 0: which of its devices it takes */
    /*
     * Renders with the others, as rt_render does; hooks are those of the options. A worker makes no
     * film.
     */
    rt_status (*render)(void *user, rt_film **out, rt_renderer *renderer,
                        const rt_render_options *options, rt_error *error);
    void *user;
} team;

#endif
