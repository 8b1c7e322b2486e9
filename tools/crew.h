/* crew.h - the devices that render a picture, one or several of this process. */
#ifndef RTC_CREW_H
#define RTC_CREW_H

#include "session.h"

/* The devices, each with the scene. All zero is none. */
typedef struct crew {
    rt_device **devices;
    rt_renderer **renderers;
    size_t count;
} crew;

/*
 * Opens the devices of --device: one, several by their numbers, or all; a process of a team takes
 * one of them. Returns an exit status. Release with crew_close in either case.
 */
int crew_open(crew *out, const session *session);

/* Makes the scene ready on all of them, with the hooks of the session. */
rt_status crew_prepare(crew *crew, const rt_scene *scene, const rt_renderer_options *options,
                       rt_error *error);

/* rt_render, on all devices together, and with the others of a team. */
rt_status crew_render(rt_film **out, const crew *crew, const rt_render_options *options,
                      const team *team, rt_error *error);

/* Whether a render emits one map for all its samples, which can be emitted in parts. */
int crew_emits(const rt_render_options *options);

/* Lets go of the scene; the devices stay open. */
void crew_forget(crew *crew);

void crew_close(crew *crew);

#endif
