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

/*
 * Decodes a PNG of any colour type and depth, interlaced or not, to the channels R, G, B, or Y of a
 * grey one, and A where something may be transparent. Values are codes divided by the greatest one,
 * and are marked as sRGB. Colours are not multiplied by alpha; chunks that describe another gamma
 * or profile are not followed. Fails with RT_ERROR_INPUT when the file is damaged, cut short or too
 * large, or holds more than 2^28 values in less than a byte for each 64; `name` stands for it in
 * messages. The caller destroys *out.
 */
rt_status rt_png_decode(rt_image **out, const rt_bytes *file, const char *name, rt_error *error);

#endif
