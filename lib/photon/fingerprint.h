/*
 * fingerprint.h - a hash that identifies a scene, so that photons are used only in the scene that
 * they were emitted in.
 */
#ifndef RT_LIB_PHOTON_FINGERPRINT_H
#define RT_LIB_PHOTON_FINGERPRINT_H

#include "device/device.h"

/*
 * A hash of what photons depend on in a scene on the device (geometry, materials, lights), and not
 * on the camera or on how the hierarchy was built.
 */
rt_status rt_scene_fingerprint(uint64_t *out, rt_device *device, cl_mem scene, rt_error *error);

/* The same, of a scene that a camera takes a picture of. */
rt_status rt_picture_fingerprint(uint64_t *out, rt_device *device, cl_mem scene, rt_error *error);

/* A hash of numbers, which goes on from `seed`: 0, or that of the numbers before. */
uint64_t rt_fingerprint(uint64_t seed, const void *words, size_t bytes);

#endif
