/* image_file.h - the format of a file; rt_image_read and rt_image_write are in rt.h. */
#ifndef RT_LIB_IMAGE_IMAGE_FILE_H
#define RT_LIB_IMAGE_IMAGE_FILE_H

#include "image/image.h"

typedef enum rt_image_format {
    RT_IMAGE_EXR,
    RT_IMAGE_PNG,
    RT_IMAGE_PPM,
    RT_IMAGE_PFM
} rt_image_format;

/*
 * The format of a file by its extension, in either case. Fails with RT_ERROR_USAGE for any other.
 */
rt_status rt_image_format_of(rt_image_format *out, const char *path, rt_error *error);

/* rt_image_read, with an image that counts in `memory`, as does its file while it is read. */
rt_status rt_image_read_in(rt_image **out, const char *path, rt_memory *memory, rt_error *error);

#endif
