/* prepare.h - kernels compiled ahead of their first launch. */
#ifndef RT_LIB_RENDER_PREPARE_H
#define RT_LIB_RENDER_PREPARE_H

#include "base/progress.h"
#include "device/device.h"

/*
 * Builds one of the library's kernels, and has the driver compile it for the device's work-group
 * size by a launch that does nothing, so that the first real launch is not slow. args as for
 * rt_kernel_args; the first must be an rt_params, which is sent with item_count 0. Runs as part of
 * a stage. The caller releases *out.
 */
rt_status rt_kernel_prepare(rt_device *device, cl_kernel *out, const char *program,
                            const char *kernel, const rt_arg *args, cl_uint count,
                            rt_stage_progress *progress, rt_error *error);

#endif
