/*
 * environment.h - the mean of an environment's image, and the distribution by which it is sampled.
 *
 * The image covers the unit square: u from 0 to 1 along a row, v from 0 at the top, +y, to 1 at the
 * bottom. Each pixel is chosen in proportion to the mean of its channels times the sine of the
 * polar angle of its row's middle; kernels/light/environment.h samples directions from it.
 */
#ifndef RT_LIB_SCENE_ENVIRONMENT_H
#define RT_LIB_SCENE_ENVIRONMENT_H

#include <stdint.h>

/*
 * The mean radiance over the sphere, by channel; texels is [height][width][4], the top row first.
 */
void rt_environment_mean(float mean[3], const float *texels, uint32_t width, uint32_t height);

/*
 * Fills conditional[height][width + 1] and marginal[height + 1], as rt_environment_data describes
 * them; each begins with 0 and ends with exactly 1. Radiance counts as far as it exceeds `floor`. A
 * row, or an image, without such light gets a uniform distribution. Returns the integral of the
 * sampled function over the unit square.
 */
double rt_environment_tabulate(float *conditional, float *marginal, const float *texels,
                               uint32_t width, uint32_t height, double floor);

/*
 * Turns a running sum over so many cells, cdf[count + 1], into a cumulative distribution; a sum of
 * 0 into the even one.
 */
void rt_cumulative_normalise(float *cdf, uint32_t count, double total);

#endif
