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
#include "rt/scene.h"
#include "types.h"

/* Where the values of a texture stand in an image, and how they become linear. */
typedef struct rt_texture_reading {
    uint32_t channels[3];
    int is_srgb; /* they are codes of sRGB */
    float power; /* to which they are raised once linear */
} rt_texture_reading;

/*
 * How an image is read by the channel, layer, power and `linear` of a texture. Alpha is linear in
 * every file. Fails with RT_ERROR_INPUT, naming the texture's path, when there are no such
 * channels.
 */
rt_status rt_texture_read_as(rt_texture_reading *out, const rt_image *image, const rt_texture *from,
                             rt_error *error);

/* The linear value of one that stands in the image. */
double rt_texture_linear(const rt_texture_reading *reading, double value);

/*
 * Appends the texels of an image to the table and describes them in *out: repeated, scale 1, offset
 * 0. Uses what rt_texture_read_as finds. Fails with RT_ERROR_INPUT, naming the texture's path, as
 * that does, and when a value is infinite or not a number, or negative where it has a power; and
 * with RT_ERROR_MEMORY; *out and the table are then as before.
 */
rt_status rt_texture_pack(rt_texture_data *out, rt_bytes *texels, const rt_image *image,
                          const rt_texture *from, rt_error *error);

#endif
