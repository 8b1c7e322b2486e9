/*
 * visibility_pilot.h - the pilot of visual importance: camera paths find where photons are
 * gathered, photon paths find where these starts lead, and those of the render begin by both.
 *
 * The pilot has seeds of its own, the same in every render of the same settings: parts of a render,
 * and one that is continued, follow the same importance, so no film holds it. None of its photons
 * is in the picture.
 */
#ifndef RT_LIB_MODE_PHOTON_VISIBILITY_PILOT_H
#define RT_LIB_MODE_PHOTON_VISIBILITY_PILOT_H

#include "mode/photon/photon_render.h"

/* Where the options ask for importance, has the emitter follow it; counts as emission. */
rt_status rt_visibility_pilot_run(rt_photon_render *render, rt_stage_progress *progress,
                                  rt_error *error);

#endif
