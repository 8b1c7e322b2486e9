/* pass_sums.h - the layers of one pass, cleared and added to the render's on several threads. */
#ifndef RT_LIB_MODE_PHOTON_PASS_SUMS_H
#define RT_LIB_MODE_PHOTON_PASS_SUMS_H

#include "film/film.h"

/* Clears what the layers of a pass sum. */
void rt_pass_sums_clear(rt_photon_sums *pass, size_t pixels, uint32_t threads);

/* Adds it to the sums of the render's layers. */
void rt_pass_sums_join(rt_photon_sums *sums, const rt_photon_sums *pass, size_t pixels,
                       uint32_t threads);

#endif
