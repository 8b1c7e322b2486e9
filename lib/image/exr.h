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

/*
 * Decodes a scan-line or tiled file: every channel, converted to float, over the display window, at
 * full resolution, and the string attributes of the first part. Channels of further parts are added
 * by rt_image_add as the layers that the parts are named by; such a part that is not read, as a
 * deep one, one of another size or one with which the parts are too large, is left out. A data
 * window that is smaller leaves zeros around it, one that is larger is cut off. Fails with
 * RT_ERROR_INPUT for deep or subsampled files, for damaged ones, and for those that hold more than
 * 2^28 values in less than a byte for each 64; `name` stands for the file in messages. The caller
 * destroys *out.
 */
rt_status rt_exr_decode(rt_image **out, const rt_bytes *file, const char *name, rt_error *error);

#endif
