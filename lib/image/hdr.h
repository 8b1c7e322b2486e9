/* hdr.h - pictures from Radiance HDR files in memory. */
#ifndef RT_LIB_IMAGE_HDR_H
#define RT_LIB_IMAGE_HDR_H

#include "base/bytes.h"
#include "image/image.h"

/*
 * Decodes a Radiance picture, flat or run-length encoded by either scheme, of any orientation, to
 * the linear channels R, G, B. A mantissa m of exponent e stands for m 2^(e - 136); EXPOSURE and
 * other lines of the header are not followed. Fails with RT_ERROR_INPUT when the file is damaged,
 * cut short or too large, or holds XYZ; what follows its pixels is ignored. `name` stands for it in
 * messages. The caller destroys *out.
 */
rt_status rt_hdr_decode(rt_image **out, const rt_bytes *file, const char *name, rt_error *error);

#endif
