/* emit.h - photon emission: fills a photon map by a device. */
#ifndef RT_LIB_PHOTON_EMIT_H
#define RT_LIB_PHOTON_EMIT_H

#include "device/device.h"
#include "photon/photon_map.h"
#include "progress.h"

/*
 * Emits `paths` photon paths from the lights of a scene on the device and appends what they leave to
 * the map, in batches of bounded memory. kernel: photon_emit of the program of that name; params: seed,
 * sampler, max_depth and direct. Path i is always the same path, whatever the batches. The flux of
 * each photon is divided by `paths`, so a map should come from one call.
 */
rt_status rt_photon_emit(rt_photon_map *map, rt_device *device, cl_kernel kernel, cl_mem scene, const rt_params *params,
                         uint64_t paths, rt_stage_progress *progress, rt_error *error);

#endif
