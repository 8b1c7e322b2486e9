/*
 * build.h - building a program for a device, out of the cache of compiled kernels where it is in
 * there.
 */
#ifndef RT_LIB_DEVICE_BUILD_H
#define RT_LIB_DEVICE_BUILD_H

#include "device/device.h"

/*
 * Builds a program; the caller releases *out. Fails with RT_ERROR_DEVICE where it does not build,
 * as rt_device_kernel says.
 */
rt_status rt_program_build(rt_device *device, cl_program *out, const rt_kernel_source *source,
                           const rt_hooks *hooks, rt_error *error);

/* Whether something of it is stored. */
int rt_program_is_stored(const rt_device *device, const rt_kernel_source *source);

#endif
