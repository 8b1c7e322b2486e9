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

/* Encodes R, G and B as little-endian PFM, which keeps every bit of them. The caller frees *out. */
rt_status rt_pfm_encode(rt_bytes *out, const rt_image *image, rt_error *error);

#endif
