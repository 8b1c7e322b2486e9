/* light_image.h - reads the image of a light: of the environment, a projector, a luminaire. */
#ifndef RT_LIB_SCENE_LIGHT_IMAGE_H
#define RT_LIB_SCENE_LIGHT_IMAGE_H

#include "base/memory.h"

typedef struct rt_light_image {
    uint32_t width, height;
    float *texels; /* [height][width][4], linear, the top row first, w = 0; rt_memory_free */
} rt_light_image;

/*
 * Reads an image, or its layer, whose colours must be from 0 to 1e30. who: the light in messages;
 * errors name the field "path" or "layer".
 */
rt_status rt_light_image_read(rt_light_image *out, const char *path, const char *layer,
                              const char *who, rt_memory *memory, rt_error *error);

#endif
