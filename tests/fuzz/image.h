/* image.h - what the targets of image files share. */
#ifndef RT_TESTS_FUZZ_IMAGE_H
#define RT_TESTS_FUZZ_IMAGE_H

#include "fuzz/fuzz.h"
#include "image/image.h"

typedef rt_status fuzz_decoder(rt_image **out, const rt_bytes *file, const char *name,
                               rt_error *error);
typedef rt_status fuzz_encoder(rt_bytes *out, const rt_image *image, rt_error *error);

/*
 * Decodes bytes and checks the image: its size, its channels, codes between 0 and 1; the same from
 * a file by rt_image_read; and its R, G and B, as rt_image_get_rgb has them, encoded and decoded
 * again: to the bit, or codes to half of an 8-bit step. Returns whether the bytes were accepted.
 */
int fuzz_image_run(fuzz_decoder *decode, fuzz_encoder *encode, const uint8_t *data, size_t size);

/* Decodes what must be an image, or NULL where it is refused. The caller destroys it. */
rt_image *fuzz_image_decode(fuzz_decoder *decode, const uint8_t *data, size_t size);

#endif
