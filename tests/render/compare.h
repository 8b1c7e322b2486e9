/*
 * compare.h - whether a render agrees with a reference, block by block, within its noise.
 *
 * The images are cut into blocks of 16x16 pixels. In every block and colour channel the difference of
 * the two means may be as large as the greater of
 *   - `tolerance` times the reference's mean, and
 *   - four standard errors of that difference.
 *
 * The squared standard error is V / n + S, for a block of n pixels:
 *   V  is the variance of the n pixel differences about the plane that fits them best (n - 3 degrees of
 *      freedom). A pixel's true value cancels in the difference, edges and texture included, and the
 *      plane takes a smooth error away, so that V holds the noise of both images, as far as the pixels
 *      of a block are independent of each other.
 *   S  is for renders whose pixels are not, such as those of a photon map, where neighbours share
 *      photons: with several independent renders, whose mean is compared, it is the squared standard
 *      error of that mean from the scatter of the renders' block means, averaged over the block and its
 *      neighbours. With one render it is zero.
 */
#ifndef RT_TESTS_RENDER_COMPARE_H
#define RT_TESTS_RENDER_COMPARE_H

#include <stddef.h>
#include <stdint.h>

#define COMPARE_BLOCK 16u
#define COMPARE_ERRORS 4.0 /* standard errors that a block may be off */

/* Linear radiance, [height][width][3], top row first. */
typedef struct compare_image {
    uint32_t width, height;
    float *rgb;
} compare_image;

typedef struct compare_result {
    size_t count, failed; /* blocks times channels */
    double rmse;          /* over all pixels and channels */
    double ratio;         /* mean of the render by mean of the reference */
    /* The block whose difference is the largest part of what it may be, or the first that is not a number. */
    uint32_t x, y, channel;
    double mean, reference_mean; /* of that block */
    double error;                /* its standard error */
    double excess;               /* its difference by what is allowed; above 1 it failed */
} compare_result;

/*
 * Compares the mean of `count` >= 1 independent renders with a reference of the same size; rgb of each
 * render is [height][width][3]. Returns 0 when memory runs out, else 1.
 */
int compare_blocks(compare_result *out, const float *const *renders, size_t count, const compare_image *reference,
                   double tolerance);

/* Reads R, G, B of an image file; on failure returns 0 and prints why. Free out->rgb. */
int compare_load(compare_image *out, const char *path);

/* Writes the signed difference of the mean of the renders and the reference as an .exr; returns 0 on failure. */
int compare_write_difference(const char *path, const float *const *renders, size_t count,
                             const compare_image *reference);

#endif
