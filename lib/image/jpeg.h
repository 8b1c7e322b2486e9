/* jpeg.h - pictures from JPEG files in memory, through libjpeg-turbo. */
#ifndef RT_LIB_IMAGE_JPEG_H
#define RT_LIB_IMAGE_JPEG_H

#include "base/bytes.h"
#include "image/image.h"

/*
 * Decodes a JPEG of 8 bits a sample, baseline or progressive, to the channels R, G, B, or Y of a
 * grey one. Values are codes divided by 255, and are marked as sRGB; profiles and the orientation
 * of EXIF are not followed. Fails with RT_ERROR_INPUT when the file is damaged, cut short or too
 * large, holds more than 2^28 values in less than a byte for each 64, has more than 100 scans, or
 * is one of CMYK colours, arithmetic coding or another depth; `name` stands for it in messages.
 * The caller destroys *out.
 */
rt_status rt_jpeg_decode(rt_image **out, const rt_bytes *file, const char *name, rt_error *error);

#endif
