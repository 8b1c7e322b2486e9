/* forecast.h - whether the photons that are still to come will fit into memory. */
#ifndef RT_LIB_PHOTON_FORECAST_H
#define RT_LIB_PHOTON_FORECAST_H

#include "rt.h"

/* Paths after which the number of photons that a path leaves is known well enough. */
enum { RT_FORECAST_PATHS = 20000 };

/*
 * This machine's memory in bytes; 0 where it cannot be known. Limits that are set on a process are
 * not seen.
 */
uint64_t rt_physical_memory(void);

/*
 * Fails with RT_ERROR_MEMORY when `photons`, left by `done` of `paths` paths, grow on like this to
 * more than fit into so many bytes of memory beside `others`, which are there already. 0 bytes:
 * unknown, anything fits.
 */
rt_status rt_photon_forecast(uint64_t others, uint64_t photons, uint64_t done, uint64_t paths,
                             uint64_t memory, rt_error *error);

#endif
