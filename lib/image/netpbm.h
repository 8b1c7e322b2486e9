/*
 * netpbm.h - images as PPM, PGM and PFM files in memory.
 *
 * References: the manual page ppm(5) of Netpbm; P. Debevec, "PFM Portable FloatMap Image Format".
 */
#ifndef RT_LIB_IMAGE_NETPBM_H
#define RT_LIB_IMAGE_NETPBM_H

#include "base/bytes.h"
#include "image/image.h"

/*
 * Encodes R, G and B as binary 8-bit PPM (P6), sRGB, exposed and tone mapped. The caller frees
 * *out.
 */
rt_status rt_ppm_encode(rt_bytes *out, const rt_image *image, const rt_image_options *options,
                        rt_error *error);

/*
 * Decodes a PPM or PGM, plain (P3, P2) or binary (P6, P5), of up to 16 bits, to the channels R, G,
 * B, or Y. Values are codes divided by the greatest one, and are marked as sRGB. Fails with
 * RT_ERROR_INPUT when the file is damaged or cut short, a code is over the greatest, or more than
 * white space follows the pixels; `name` stands for it in messages. The caller destroys *out.
 */
rt_status rt_ppm_decode(rt_image **out, const rt_bytes *file, const char *name, rt_error *error);

/* Encodes R, G and B as little-endian PFM, which keeps every bit of them. The caller frees *out. */
rt_status rt_pfm_encode(rt_bytes *out, const rt_image *image, rt_error *error);

/*
 * Decodes a PFM of either byte order to the channels R, G, B, or Y when it has only one; the
 * magnitude of its scale is not applied. Fails with RT_ERROR_INPUT when the file is damaged, cut
 * short or too long; `name` stands for it in messages. The caller destroys *out.
 */
rt_status rt_pfm_decode(rt_image **out, const rt_bytes *file, const char *name, rt_error *error);

#endif
