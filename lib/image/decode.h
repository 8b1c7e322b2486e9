/* decode.h - a decoder for each format of RT_IMAGE_FORMATS; the files of the decoders say more. */
#ifndef RT_LIB_IMAGE_DECODE_H
#define RT_LIB_IMAGE_DECODE_H

#include "base/bytes.h"
#include "image/image.h"

/*
 * Decodes a file in memory. Fails with RT_ERROR_INPUT when it is damaged, cut short or too large;
 * `name` stands for it in messages. The caller destroys *out.
 */
typedef rt_status rt_image_decoder(rt_image **out, const rt_bytes *file, const char *name,
                                   rt_error *error);

#define RT_DECLARE_DECODER(format, NAME, extensions, magic) rt_image_decoder rt_##format##_decode;
RT_IMAGE_FORMATS(RT_DECLARE_DECODER)

#endif
