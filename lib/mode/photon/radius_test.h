/* radius_test.h - the kernels of radius rules, and the tests of whether photons are even. */
#ifndef RT_LIB_MODE_PHOTON_RADIUS_TEST_H
#define RT_LIB_MODE_PHOTON_RADIUS_TEST_H

#include "base/progress.h"
#include "device/device.h"
#include "rt.h"
#include "types.h"

/* Passes of a pilot. Then the radius of passes shrinks as if these had come first. */
enum { RT_PILOT_PASSES = 16 };

/* Whether the radius rule of a render takes a pilot. */
int rt_radius_is_tested(const rt_render_options *options);

/*
 * Builds, as part of the stage `compile`, the kernel that a pilot launches at its gather points,
 * count_sectors or halve_discs, and test_sectors where the rule has tests.
 */
rt_status rt_radius_test_prepare(cl_kernel *sectors, cl_kernel *test, rt_radius_rule rule,
                                 rt_device *device, cl_mem any, rt_stage_progress *progress,
                                 rt_error *error);

/* What a test's statistic has to exceed, [RT_RADIUS_LENGTHS], at 1, 2, 4 .. passes. */
const float *rt_radius_test_critical(rt_radius_rule rule);

#endif
