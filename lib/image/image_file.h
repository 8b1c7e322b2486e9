/* image_file.h - images as files: written in the format of the name's extension, read by content. */
#ifndef RT_LIB_IMAGE_IMAGE_FILE_H
#define RT_LIB_IMAGE_IMAGE_FILE_H

#include "image/image.h"

typedef enum rt_image_format { RT_IMAGE_EXR, RT_IMAGE_PNG, RT_IMAGE_PPM, RT_IMAGE_PFM } rt_image_format;

/* The format of a file by its extension, in either case. Fails with RT_ERROR_USAGE for any other. */
rt_status rt_image_format_of(rt_image_format *out, const char *path, rt_error *error);

/*
 * Writes an image as .exr, .png, .ppm or .pfm; NULL options are the defaults. The file appears whole
 * or not at all, see rt_file_replace. The attributes go to .exr alone, exposure and tone map to the
 * 8-bit formats alone. Fails with RT_ERROR_USAGE for another extension or options out of range and
 * with RT_ERROR_OUTPUT when the file cannot be written.
 */
rt_status rt_image_write(const rt_image *image, const char *path, const rt_image_options *options, rt_error *error);

/*
 * Reads an EXR, PNG, PPM, PGM or PFM, known by its first bytes and not by its name. Values of PNG, PPM and
 * PGM are sRGB codes, see rt_image.is_srgb. Fails with RT_ERROR_INPUT, naming path and cause. The caller
 * destroys *out.
 */
rt_status rt_image_read(rt_image **out, const char *path, rt_error *error);

#endif
