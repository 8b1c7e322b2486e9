/* flip.h - FLIP, the perceived difference of two pictures that alternate in the same place. */
#ifndef RT_LIB_IMAGE_FLIP_H
#define RT_LIB_IMAGE_FLIP_H

#include <stdint.h>

#include "base/error.h"

/*
 * The mean of LDR-FLIP over the pixels, 0 to 1, of a and b, linear RGB [height][width][3],
 * brightened by `exposure` stops and clamped to 0..1. It does not matter which of them is first.
 * Fails with RT_ERROR_MEMORY.
 */
rt_status rt_flip(double *out, const float *a, const float *b, uint32_t width, uint32_t height,
                  double exposure, rt_error *error);

#endif
