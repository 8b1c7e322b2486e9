/*
 * exr.h - images as OpenEXR files in memory, through the C interface of OpenEXR (OpenEXRCore).
 *
 * Reference: "OpenEXR File Layout" and "Technical Introduction to OpenEXR", openexr.com.
 */
#ifndef RT_LIB_IMAGE_EXR_H
#define RT_LIB_IMAGE_EXR_H

#include "base/bytes.h"
#include "image/image.h"

/*
 * Encodes all channels as 32-bit float scan lines, ZIP compressed, and all attributes as strings.
 * The bytes depend on the image alone. The caller frees *out.
 */
rt_status rt_exr_encode(rt_bytes *out, const rt_image *image, rt_error *error);

#endif
