/* rt/share.h - a picture that several renderers make together. Part of rt.h, the manual. */
#ifndef RT_RT_SHARE_H
#define RT_RT_SHARE_H

#include "film.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Sharing a picture ----------------------------------------------------------------------- */

/*
 * An rt_share hands out the units of a picture to workers, by demand and in amounts that suit their
 * speed, and adds up what they hand over. Workers may be devices of this process, by
 * rt_share_render, or renders anywhere else, whose questions and films the caller carries. The
 * picture has the same bits whoever renders what, as long as the devices are of the same kind; a
 * target_error is tested exactly where rt_render tests it. In photon mode without passes all
 * workers need the same map, in rt_render_options.photon_map.
 *
 * Any thread may call these functions at any time, but for create, finish and destroy. So may the
 * callbacks of the options, while which the others wait, but for rt_share_add and rt_share_render.
 */
typedef struct rt_share rt_share;

/*
 * Of the options, time counts from the first question of a worker on, and checkpoint is called
 * about every checkpoint_seconds, from the thread that adds a film, and by rt_share_finish. preview
 * is called from that thread too. part and next_units are not for it.
 * What the options point to must outlive the share. The caller owns *out.
 */
RT_API rt_status rt_share_create(rt_share **out, rt_renderer *renderer,
                                 const rt_render_options *options, rt_error *error);
RT_API void rt_share_destroy(rt_share *share);

/* What workers elsewhere set rt_render_options.raised_from to. */
RT_API uint32_t rt_share_raised_from(const rt_share *share);

/*
 * The number of a new worker. Where a number is of none, rt_share_ask answers RT_SHARE_END,
 * as for one that has left, rt_share_add fails with RT_ERROR_USAGE, and the others do nothing.
 */
RT_API rt_status rt_share_join(uint32_t *worker, rt_share *share, rt_error *error);

/* What a worker is to do next. */
typedef enum rt_share_task {
    RT_SHARE_END,       /* nothing more: the picture is finished, or the work is to stop */
    RT_SHARE_RENDER,    /* to render the units */
    RT_SHARE_HAND_OVER, /* to hand over what it has, then to ask again */
    RT_SHARE_WAIT       /* to ask again later: others have what is left */
} rt_share_task;
RT_API rt_share_task rt_share_ask(rt_share *share, uint32_t worker, uint64_t *first,
                                  uint64_t *count);

/* Notes that a worker took so long to render units, which it has not handed over yet. */
RT_API void rt_share_note(rt_share *share, uint32_t worker, uint64_t first, uint64_t count,
                          double seconds);

/*
 * Adds the film that a worker hands over. seconds: what it took to receive and decode; workers are
 * told to hand over so seldom that this and adding take a tenth of the time, but before they have
 * ten times checkpoint_seconds to lose. Fails as rt_film_add does, and where the worker was not to
 * render what the film has; what it was given is then given to others.
 */
RT_API rt_status rt_share_add(rt_share *share, uint32_t worker, const rt_film *film, double seconds,
                              rt_error *error);

/*
 * A worker has handed its film over to another, which adds it to its own: from now on that one has
 * the units. So films of many workers come together in a tree, of whatever shape.
 */
RT_API void rt_share_pass(rt_share *share, uint32_t from, uint32_t to);

/* A worker is gone. What it was given and has not handed over is given to others. */
RT_API void rt_share_leave(rt_share *share, uint32_t worker);

/* From now on workers are told to hand over what they have, and to end. */
RT_API void rt_share_stop(rt_share *share);

/* How far the picture is. */
RT_API void rt_share_get_progress(rt_share *share, rt_progress *out);

/*
 * Joins as a worker and renders on this thread until there is nothing more to do. hooks: as those
 * of rt_render, with the progress of the whole picture; may be NULL. Cancelling stops the share.
 */
RT_API rt_status rt_share_render(rt_share *share, rt_renderer *renderer, const rt_hooks *hooks,
                                 rt_error *error);

/*
 * Makes means, layers and statistics of what was handed over, when all workers have ended. Returns
 * RT_CANCELLED where the share was stopped before the picture was finished; *out then receives the
 * film as rt_render's, or NULL. hooks: for warnings; may be NULL. The caller owns *out.
 */
RT_API rt_status rt_share_finish(rt_film **out, rt_share *share, const rt_hooks *hooks,
                                 rt_error *error);

#ifdef __cplusplus
}
#endif

#endif
