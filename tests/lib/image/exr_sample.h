/* exr_sample.h - OpenEXR files of kinds that the library reads but does not write. */
#ifndef RT_TESTS_IMAGE_EXR_SAMPLE_H
#define RT_TESTS_IMAGE_EXR_SAMPLE_H

#include "base/bytes.h"
#include "image/exr_core.h"

enum { EXR_SAMPLE_CHANNELS = 6 };

/* Their names; R, G and B first. */
extern const char *const exr_sample_names[EXR_SAMPLE_CHANNELS];

typedef struct exr_sample {
    exr_storage_t storage;
    exr_pixel_type_t type;
    exr_compression_t compression;
    int x, y, width, height; /* data window */
    int tile;                /* side of a tile of a tiled file */
    int sampling;            /* subsampling of channel B; 0 means 1 */
    int channels;            /* at most EXR_SAMPLE_CHANNELS; 0 means 3 */
} exr_sample;

/*
 * The value of channel c at (x, y) of the data window: whole, so that every type holds it.
 */
float exr_sample_value(int x, int y, int c);

/* The file; of a deep one, the header alone. The caller frees it. */
rt_bytes exr_sample_file(const exr_sample *sample);

/*
 * The same of several parts with these names; the values of the second are twice those. A part
 * that is called depth has Z alone.
 */
rt_bytes exr_sample_parts(const exr_sample *sample, const char *const *names, int count);

#endif
