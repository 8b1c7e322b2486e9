/* display.h - from linear radiance to an 8-bit sRGB picture. */
#ifndef RT_LIB_IMAGE_DISPLAY_H
#define RT_LIB_IMAGE_DISPLAY_H

#include "image/image.h"

/*
 * Exposes, tone maps and quantises the channels R, G and B to *out, [height][width][3], top row
 * first; the caller frees it. NaN and negative values are black, infinity is as bright as the
 * tone map gets. Fails with RT_ERROR_USAGE when a channel is missing or an option is out of range.
 */
rt_status rt_display_rgb8(uint8_t **out, const rt_image *image, const rt_image_options *options,
                          rt_error *error);

#endif
