/*
 * image.h - the members of rt_image: named float channels and text attributes.
 *
 * Colour channels are named R, G, B and hold linear sRGB, or codes of the sRGB transfer function
 * where is_srgb says so; a single grey channel is named Y. A channel of a further layer is named
 * LAYER.CHANNEL, such as albedo.R or depth.Z.
 */
#ifndef RT_LIB_IMAGE_IMAGE_H
#define RT_LIB_IMAGE_IMAGE_H

#include <stddef.h>
#include <stdint.h>

#include "base/memory.h"

#define RT_IMAGE_SIDE_MAX 65536u
#define RT_IMAGE_CHANNELS_MAX 256u
#define RT_IMAGE_VALUES_MAX                                                                        \
    (UINT64_C(1) << 30) /* most pixels times channels that are read: 4 GiB of floats */
/*
 * A file that decodes to more than this many values, 1 GiB of floats, must have a byte for each
 * RT_IMAGE_VALUES_PER_BYTE of them: pictures have, decompression bombs have not.
 */
#define RT_IMAGE_VALUES_UNCHECKED (UINT64_C(1) << 28)
#define RT_IMAGE_VALUES_PER_BYTE 64
#define RT_IMAGE_NAME_SIZE 256u /* with the closing zero; what the EXR format allows */
#define RT_IMAGE_NO_CHANNEL UINT32_MAX

typedef struct rt_image_attribute {
    char name[RT_IMAGE_NAME_SIZE];
    char *value;
} rt_image_attribute;

struct rt_image {
    uint32_t width, height, channel_count;
    /* [channel_count], all different, in the order of the data */
    char (*names)[RT_IMAGE_NAME_SIZE];
    /* values are sRGB codes from 0 to 1, as 8- and 16-bit files hold, but for alpha, A */
    int is_srgb;
    float *data;                    /* [height][width][channel_count], top row first */
    rt_image_attribute *attributes; /* [attribute_count], in the order in which they were set */
    size_t attribute_count;
};

/*
 * A black image of these channels. Fails with RT_ERROR_USAGE when a side or the number of channels
 * is zero or over its limit, or a name is empty, too long or repeated. The caller destroys *out.
 */
rt_status rt_image_create(rt_image **out, uint32_t width, uint32_t height, const char *const *names,
                          uint32_t channel_count, rt_error *error);

/* The same, with values that count in `memory`. */
rt_status rt_image_create_in(rt_image **out, rt_memory *memory, uint32_t width, uint32_t height,
                             const char *const *names, uint32_t channel_count, rt_error *error);

/*
 * Whether a file of so many bytes is too short for so many values, whatever its compression; asked
 * before memory is taken for them.
 */
int rt_image_is_bomb(uint64_t values, size_t file_size);

/* The index of the channel of that name, or RT_IMAGE_NO_CHANNEL. */
uint32_t rt_image_channel(const rt_image *image, const char *name);

/* The indices of R, G and B; fails with RT_ERROR_USAGE when one is missing. */
rt_status rt_image_rgb_channels(uint32_t rgb[3], const rt_image *image, rt_error *error);

/*
 * The channels of colours: R, G and B, or a grey one three times; those of a layer as
 * rt_image_get_rgb finds them, but no pair. Fails with RT_ERROR_INPUT, naming the channels that
 * there are, and with error->field "layer" where that is given.
 */
rt_status rt_image_colour_channels(uint32_t channels[3], const rt_image *image, const char *layer,
                                   rt_error *error);

/*
 * The index of alpha, A, of the picture or of a layer. Fails with RT_ERROR_INPUT, naming the
 * channels that there are.
 */
rt_status rt_image_alpha_channel(uint32_t *channel, const rt_image *image, const char *layer,
                                 rt_error *error);

/* Whether the values of a channel are codes of sRGB: of all but alpha, where is_srgb says so. */
int rt_image_is_coded(const rt_image *image, uint32_t channel);

/* Whether rt_image_get_rgb finds that layer. */
int rt_image_has_layer(const rt_image *image, const char *layer);

/* Sets a text attribute, replacing one of that name; value is copied. */
rt_status rt_image_set_attribute(rt_image *image, const char *name, const char *value,
                                 rt_error *error);

/*
 * Makes *image one that has the channels of `count` others of the same size as well: named
 * LAYER.CHANNEL where their name has no layer and that of layers[count] is neither NULL nor empty.
 * Those whose names are there are left out. Fails with RT_ERROR_USAGE where there would be too
 * many, and leaves *image then.
 */
rt_status rt_image_add(rt_image **image, rt_image *const *more, const char *const *layers,
                       uint32_t count, rt_memory *memory, rt_error *error);

/* Moves all text attributes to an image that has none. */
void rt_image_move_attributes(rt_image *to, rt_image *from);

/* The value of a text attribute, owned by the image, or NULL. */
const char *rt_image_attribute_value(const rt_image *image, const char *name);

#endif
