/*
 * visibility_pilot.h - the pilot of visual importance: camera paths find where photons are
 * gathered, photon paths find where these starts lead, and those of the render begin by both.
 *
 * The pilot has seeds of its own, the same in every render of the same settings: parts of a render,
 * and one that is continued, follow the same importance, so no film holds it. None of its photons
 * is in the picture.
 *
 * Without importance a pilot that takes a hundredth of the render's time is a trial: it tells what
 * part of the paths the camera gathers from, and where that is small, what importance would make
 * of it. The render goes on as if there had been none. Importance is not chosen by it: useful paths
 * take longer, and where camera paths make most of the noise, that is not made up for.
 */
#ifndef RT_LIB_MODE_PHOTON_VISIBILITY_PILOT_H
#define RT_LIB_MODE_PHOTON_VISIBILITY_PILOT_H

#include "mode/photon/photon_render.h"

/* Whether a job's options ask for importance, or for so many paths that a trial is due. */
int rt_visibility_pilot_is_run(const rt_render_job *job);

/*
 * Where that is so, fills in what the film's stats say of it, and where the options ask for
 * importance, has the emitter follow it; counts as emission.
 */
rt_status rt_visibility_pilot_run(rt_photon_render *render, rt_stage_progress *progress,
                                  rt_error *error);

#endif
