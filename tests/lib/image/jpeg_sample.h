/* jpeg_sample.h - JPEG files of all kinds, by libjpeg's encoder. */
#ifndef RT_TESTS_IMAGE_JPEG_SAMPLE_H
#define RT_TESTS_IMAGE_JPEG_SAMPLE_H

#include "base/bytes.h"

typedef enum jpeg_colours {
    JPEG_GREY,
    JPEG_YCBCR, /* 4:4:4 */
    JPEG_420,   /* the same with chroma of half the size */
    JPEG_RGB,
    JPEG_CMYK,
    JPEG_YCCK,
    JPEG_PAIR /* two components, as no program writes */
} jpeg_colours;

/* All zero is a grey baseline file without rows. */
typedef struct jpeg_sample {
    jpeg_colours colours;
    uint32_t width, height;
    int is_progressive, is_arithmetic;
    int is_apart; /* a scan for each component; not of a progressive one */
    int restart;  /* blocks between restart markers; 0: no markers */
} jpeg_sample;

/* Components of a file of these colours. */
int jpeg_sample_channels(jpeg_colours colours);

/*
 * The code of a channel at (x, y), smooth so that compression of the best quality moves it by
 * little, and chroma of half the size too.
 */
uint8_t jpeg_sample_code(uint32_t x, uint32_t y, int channel);

/* The file; libjpeg ends the program when it fails. The caller frees it. */
rt_bytes jpeg_sample_file(const jpeg_sample *sample);

#endif
