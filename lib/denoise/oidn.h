/*
 * oidn.h - Open Image Denoise, whose library is opened at run time: versions 1.3 to 2.
 */
#ifndef RT_LIB_DENOISE_OIDN_H
#define RT_LIB_DENOISE_OIDN_H

#include "rt.h"

/* A device of the library, on the CPU. All zero is none. */
typedef struct rt_oidn rt_oidn;

/* One image: rows of pixels whose three floats are `stride` bytes apart. */
typedef struct rt_oidn_image {
    const char *name; /* as the library has it: color, albedo, normal, output */
    float *data;
    size_t stride;
} rt_oidn_image;

/*
 * Opens the library, and a device of it; NULL: by the names that it has. Fails with
 * RT_ERROR_DEVICE. The caller owns *out.
 */
rt_status rt_oidn_open(rt_oidn **out, const char *library, rt_error *error);
void rt_oidn_close(rt_oidn *oidn);

void rt_oidn_version(char version[16], const rt_oidn *oidn);

/* Filters images of high dynamic range. */
rt_status rt_oidn_run(rt_oidn *oidn, const rt_oidn_image *images, size_t count, uint32_t width,
                      uint32_t height, rt_error *error);

#endif
