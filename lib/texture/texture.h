/*
 * texture.h - images made ready for kernels/material/texture.h: texels in the table that all
 * textures of a scene share.
 *
 * The choice of format is by content and loses nothing that can be seen:
 *   code8  when every value is a multiple of 1/255, as in every 8-bit file: 4 bytes a texel, and
 *          the exact linear value of each code from a table of its own;
 *   grey   when the channels are equal, as in a height map of more than 8 bits: 4 bytes a texel,
 *          float, for slopes show steps in heights that colours would hide;
 *   half   for all else: 8 bytes a texel, precise to 1/2048 of the value down to 2^-28 of the
 *          brightest one, whatever that is, and to 2^-39 of the brightest one below.
 */
#ifndef RT_LIB_TEXTURE_TEXTURE_H
#define RT_LIB_TEXTURE_TEXTURE_H

#include "base/bytes.h"
#include "image/image.h"
#include "types.h"

/*
 * Appends the texels of an image to the table and describes them in *out: repeated, scale 1, offset
 * 0. Uses the channels that rt_image_colour_channels finds. sRGB codes are decoded unless
 * is_linear, which takes them for plain numbers. Fails with RT_ERROR_INPUT, naming `name`, when
 * there are no such channels or a value is infinite or not a number, and with RT_ERROR_MEMORY; *out
 * and the table are then as before.
 */
rt_status rt_texture_pack(rt_texture_data *out, rt_bytes *texels, const rt_image *image,
                          int is_linear, const char *layer, const char *name, rt_error *error);

#endif
