/*
 * passes.h - progressive photon mapping: emission and gathering again and again with fresh paths,
 * and a radius that shrinks so that the mean of the passes converges to the reference.
 */
#ifndef RT_LIB_MODE_PHOTON_PASSES_H
#define RT_LIB_MODE_PHOTON_PASSES_H

#include "mode/photon/photon_render.h"

/*
 * Pass after pass, as one stage, until there are enough, or time is up, or the error small. The
 * film always holds whole passes.
 */
rt_status rt_photon_render_passes(rt_photon_render *r, rt_error *error);

#endif
