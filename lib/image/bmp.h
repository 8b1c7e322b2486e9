/* bmp.h - pictures from BMP files in memory. */
#ifndef RT_LIB_IMAGE_BMP_H
#define RT_LIB_IMAGE_BMP_H

#include "base/bytes.h"
#include "image/image.h"

/*
 * Decodes a BMP of 1, 4, 8, 16, 24 or 32 bits, by a palette or masks of bits, in runs (RLE4, RLE8)
 * or not, bottom-up or top-down, to the channels R, G, B, and A where there is a mask of it. Values
 * are codes divided by the greatest one, and are marked as sRGB; profiles are not followed. Pixels
 * that runs leave out have the first colour of the palette. Fails with RT_ERROR_INPUT when the file
 * is damaged, cut short or too large, or holds a JPEG or PNG; what follows its pixels is ignored.
 * `name` stands for it in messages. The caller destroys *out.
 */
rt_status rt_bmp_decode(rt_image **out, const rt_bytes *file, const char *name, rt_error *error);

#endif
