/* tga.h - pictures from Truevision TGA files in memory. */
#ifndef RT_LIB_IMAGE_TGA_H
#define RT_LIB_IMAGE_TGA_H

#include "base/bytes.h"
#include "image/image.h"

/*
 * Whether a file begins as a TGA does. The format has no magic number: its header is plausible
 * where every field has one of the few values that are possible beside the others.
 */
int rt_tga_is_plausible(const rt_bytes *file);

/*
 * Decodes a TGA with a plausible header: true colour of 15, 16, 24 or 32 bits, grey of 8 or 16, or
 * by a map of colours, run-length encoded or not, of any of the four origins; to the channels R, G,
 * B, or Y, and A where the header has bits of it. Values are codes divided by the greatest one, and
 * are marked as sRGB. Fails with RT_ERROR_INPUT when the file is damaged, cut short or too large;
 * what follows its pixels is ignored. `name` stands for it in messages. The caller destroys *out.
 */
rt_status rt_tga_decode(rt_image **out, const rt_bytes *file, const char *name, rt_error *error);

#endif
