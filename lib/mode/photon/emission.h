/* emission.h - the photons of one pass. */
#ifndef RT_LIB_MODE_PHOTON_EMISSION_H
#define RT_LIB_MODE_PHOTON_EMISSION_H

#include "mode/photon/photon_render.h"

/* Fills the map, unless one is given, with the photons of a pass. */
rt_status rt_photon_render_emit(rt_photon_render *r, uint32_t pass, rt_stage_progress *progress,
                                rt_error *error);

/* Adds the photons that were emitted last to the film's stats and ledger. */
rt_status rt_photon_render_book(const rt_photon_render *r, rt_error *error);

#endif
