/*
 * pilot.h - pilot passes, which find out before the first pass of a progressive render which pixels
 * have to begin with a smaller radius: because the photons within theirs are uneven, or because the
 * bias would be larger than the noise (radius_choice.h).
 *
 * The pilot has photons and eye paths of its own, of the same numbers in every render of the same
 * settings: any part of a render, and one that is continued, makes the same radii anew, so no film
 * holds them. None of its photons is in the picture, whose passes are therefore independent of the
 * radii: they select none of the noise.
 */
#ifndef RT_LIB_MODE_PHOTON_PILOT_H
#define RT_LIB_MODE_PHOTON_PILOT_H

#include "mode/photon/photon_render.h"

/* Runs the pilot: shrinks the first_radii of each query that sees the surface of a pixel. */
rt_status rt_pilot_run(rt_photon_render *render, rt_stage_progress *progress, rt_error *error);

#endif
