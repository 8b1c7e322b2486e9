/*
 * damage.h - feeds damaged copies of a file to a decoder, which must refuse or accept but never
 * crash.
 */
#ifndef RT_TESTS_IMAGE_DAMAGE_H
#define RT_TESTS_IMAGE_DAMAGE_H

#include "base/bytes.h"
#include "image/image.h"

typedef rt_status decoder(rt_image **out, const rt_bytes *file, const char *name, rt_error *error);

/* Every proper prefix of file must fail with RT_ERROR_INPUT. */
void damage_truncate(const rt_bytes *file, decoder *decode);

/*
 * Every byte, with several changes, may be accepted or fail with RT_ERROR_INPUT or
 * RT_ERROR_MEMORY.
 */
void damage_flip(const rt_bytes *file, decoder *decode);

#endif
