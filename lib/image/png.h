/* png.h - pictures as PNG files in memory, through libpng. */
#ifndef RT_LIB_IMAGE_PNG_H
#define RT_LIB_IMAGE_PNG_H

#include "base/bytes.h"
#include "image/image.h"

/*
 * Encodes R, G and B as 8-bit sRGB, exposed and tone mapped as the options say. The caller frees
 * *out.
 */
rt_status rt_png_encode(rt_bytes *out, const rt_image *image, const rt_image_options *options,
                        rt_error *error);

#endif
