/* compare.h - what the files of a comparison share: the pictures, and the results. */
#ifndef RT_LIB_IMAGE_COMPARE_H
#define RT_LIB_IMAGE_COMPARE_H

#include <stddef.h>
#include <stdint.h>

#include "base/error.h"

/* Pictures of one size: linear, [height][width][3], top row first. */
typedef struct rt_pictures {
    uint32_t width, height;
    size_t count;    /* of renders */
    float **renders; /* [count] */
    float *mean;     /* of the renders */
    float *reference;
    float *variance; /* of mean - reference, or NULL where it is not known */
} rt_pictures;

struct rt_comparison {
    rt_comparison_info info;
    rt_image_block *blocks; /* [info.blocks], row by row */
    float *difference;      /* mean - reference, [height][width][3] */
};

/* How many blocks of that side cover the pictures, across and in all. */
uint32_t rt_block_columns(const rt_pictures *pictures, uint32_t side);
size_t rt_block_count(const rt_pictures *pictures, uint32_t side);

/* Fills blocks [rt_block_count]; the rule is rt_image_block's. Fails with RT_ERROR_MEMORY. */
rt_status rt_compare_blocks(rt_image_block *blocks, const rt_pictures *pictures, uint32_t side,
                            double tolerance, rt_error *error);

/*
 * The difference [pixel_count][3] that 95 % of the pixels do not exceed in the channel that differs
 * most, to 1 %; where that is 0, the largest. Fails with RT_ERROR_MEMORY.
 */
rt_status rt_typical_difference(double *out, const float *difference, size_t pixel_count,
                                rt_error *error);

#endif
