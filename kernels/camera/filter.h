/*
 * filter.h - where in the plane of the film a sample of a pixel lies: reconstruction filters by
 * importance sampling.
 *
 * A filter f about the pixel's centre is sampled with a density proportional to |f|, and each
 * sample has the weight sign(f): the sum of weight times radiance over the sum of weights is the
 * filtered radiance, from samples of that pixel alone. Only Mitchell's filter has negative lobes;
 * the others have weight 1, and their mean is unbiased. The quotient keeps a uniform picture
 * exactly uniform with Mitchell's filter too; its bias falls with the number of samples, as the
 * variance does. (To divide by the expected sum, the integral of f over that of |f|, would be
 * unbiased, but adds the noise of the signs, half the radiance per sample.)
 *
 * References:
 *   Mitchell, Netravali: "Reconstruction Filters in Computer Graphics", SIGGRAPH 1988.
 *   Ernst, Stamminger, Greiner: "Filter Importance Sampling", IEEE Symposium on Interactive Ray
 *     Tracing, 2006.
 */
#ifndef RT_KERNELS_CAMERA_FILTER_H
#define RT_KERNELS_CAMERA_FILTER_H

#include "math/lanes.h"
#include "sample/sample.h"
#include "types.h"

/* radii, pixels */
#define RT_TENT_RADIUS 1.0f
#define RT_GAUSSIAN_RADIUS 1.5f
#define RT_MITCHELL_RADIUS 2.0f
#define RT_GAUSSIAN_DEVIATION 0.5f /* pixels */
/* 1 - exp(-r^2 / (2 deviation^2)): the part of a Gaussian within r = 1.5 pixels */
#define RT_GAUSSIAN_CUT 0.988891003f
#define RT_MITCHELL_ROOT (8.0f / 7.0f)    /* where the filter turns negative */
#define RT_MITCHELL_POSITIVE 0.517492711f /* its integral from 0 to the root */
#define RT_MITCHELL_SIZE 1.069970845f     /* integral of its magnitude from -2 to 2 */
#define RT_MITCHELL_STEPS 20

/* The integral from 0 to x of Mitchell's filter in one dimension, B = C = 1/3, for x in [0, 2]. */
static inline float2 mitchell_integral(float2 x)
{
    const float2 y = 2.0f - x;
    const float2 near = x * (64.0f + x * x * (21.0f * x - 48.0f)) * (1.0f / 72.0f);
    const float2 far = 0.5f + y * y * y * (8.0f - 7.0f * y) * (1.0f / 72.0f);
    return x < 1.0f ? near : far;
}

/* The same of its magnitude. */
static inline float2 mitchell_magnitude(float2 x)
{
    const float2 signed_integral = mitchell_integral(x);
    return x < RT_MITCHELL_ROOT ? signed_integral : 2.0f * RT_MITCHELL_POSITIVE - signed_integral;
}

/*
 * By the magnitude of Mitchell's filter in each coordinate: inverts its integral by bisection, to
 * 2e-6 of a pixel.
 */
static inline float2 sample_mitchell(float2 u, float *weight)
{
    const float2 side = u < 0.5f ? (float2)(-1.0f) : (float2)(1.0f);
    const float2 target = fabs(2.0f * u - 1.0f) * (0.5f * RT_MITCHELL_SIZE);
    float2 x = 0.0f;
    float step = 1.0f;
    for (int i = 0; i < RT_MITCHELL_STEPS; i++) {
        x += mitchell_magnitude(x + step) <= target ? (float2)(step) : (float2)(0.0f);
        step *= 0.5f;
    }
    const bool negative = (x.x > RT_MITCHELL_ROOT) != (x.y > RT_MITCHELL_ROOT);
    *weight = negative ? -1.0f : 1.0f;
    return side * x;
}

/* A point of the filter's circle: the radius by inversion, the angle evenly. */
static inline float2 sample_gaussian(float2 u)
{
    const float radius = RT_GAUSSIAN_DEVIATION * sqrt(-2.0f * log(1.0f - RT_GAUSSIAN_CUT * u.x));
    return radius * sin_cos(2.0f * RT_PI * u.y).yx;
}

/*
 * A point of the film, in pixels from the corner of the pixel, for u in [0,1)^2. The filter is
 * scaled to this radius in pixels, 0 for its own; the box is always the pixel.
 */
static inline float2 sample_filter(uint filter, float radius, float2 u, float *weight)
{
    *weight = 1.0f;
    switch ((rt_filter)filter) {
    case RT_FILTER_BOX:
        break;
    case RT_FILTER_TENT:
        return 0.5f + (radius > 0.0f ? radius / RT_TENT_RADIUS : 1.0f) * sample_tent(u);
    case RT_FILTER_GAUSSIAN:
        return 0.5f + (radius > 0.0f ? radius / RT_GAUSSIAN_RADIUS : 1.0f) * sample_gaussian(u);
    case RT_FILTER_MITCHELL:
        return 0.5f +
               (radius > 0.0f ? radius / RT_MITCHELL_RADIUS : 1.0f) * sample_mitchell(u, weight);
    }
    return u;
}

#endif
