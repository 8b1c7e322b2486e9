/* radius_test.h - the tests of whether photons are even within the radius of a pixel. */
#ifndef RT_LIB_MODE_PHOTON_RADIUS_TEST_H
#define RT_LIB_MODE_PHOTON_RADIUS_TEST_H

#include "base/progress.h"
#include "device/device.h"
#include "rt.h"
#include "types.h"

/* Whether the settings of a render ask for them. */
int rt_radius_is_tested(const rt_render_options *options);

/* Builds the kernels count_sectors and test_sectors, as part of the stage `compile`. */
rt_status rt_radius_test_prepare(cl_kernel *sectors, cl_kernel *test, rt_device *device, cl_mem any,
                                 rt_stage_progress *progress, rt_error *error);

/* What a test's statistic has to exceed, [RT_RADIUS_LENGTHS], at 1, 2, 4 .. passes. */
const float *rt_radius_test_critical(rt_radius_rule rule);

#endif
