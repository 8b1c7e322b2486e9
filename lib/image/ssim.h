/* ssim.h - structural similarity of two pictures. */
#ifndef RT_LIB_IMAGE_SSIM_H
#define RT_LIB_IMAGE_SSIM_H

#include <stdint.h>

#include "base/error.h"

/*
 * The mean structural similarity of a and b, linear RGB [height][width][3]: of their luminance,
 * brightened by `exposure` stops, clamped to 0..1 and sRGB-encoded. NaN when a side is under 11
 * pixels. Fails with RT_ERROR_MEMORY.
 */
rt_status rt_ssim(double *out, const float *a, const float *b, uint32_t width, uint32_t height,
                  double exposure, rt_error *error);

#endif
