/*
 * density.h - the kernels of photon density estimation.
 *
 * The density of points at x is the sum over the points p within r of K(|p - x|), where the
 * integral of K over the disc of radius r is 1. With t = d/r:
 *   box           1 / (pi r^2)
 *   cone          (1 - t/c) / ((1 - 2/(3c)) pi r^2), c >= 1
 *   gaussian      a [1 - (1 - exp(-b t^2/2)) / (1 - exp(-b))] / (pi r^2)
 *   epanechnikov  2 (1 - t^2) / (pi r^2)
 *   silverman     3 (1 - t^2)^2 / (pi r^2)
 *
 * The Gaussian's a: with s = t^2 the integral over the disc is a times
 *   integral of [1 - (1 - exp(-b s/2)) / (1 - exp(-b))] ds, s in [0, 1]
 *     = 1 - (1 - (2/b)(1 - exp(-b/2))) / (1 - exp(-b)) = 0.578600 for b = 1.953,
 * so that a = 1.728309. The often printed a = 0.918 gives 0.531155 of the density; it is kept
 * under a name of its own for comparison.
 *
 * References:
 *   Jensen: "Global Illumination using Photon Maps", EGWR 1996 (cone and Gaussian).
 *   Silverman: "Density Estimation for Statistics and Data Analysis", 1986, section 4.2
 *     (Epanechnikov and its square in two dimensions).
 */
#ifndef RT_KERNELS_PHOTON_DENSITY_H
#define RT_KERNELS_PHOTON_DENSITY_H

#include "types.h"

#define GAUSSIAN_B 1.953f
#define GAUSSIAN_A 1.728309f
#define GAUSSIAN_A_JENSEN 0.918f

static inline float8 gaussian8(float8 t2, float a)
{
    return a * (1.0f - (1.0f - exp(-0.5f * GAUSSIAN_B * t2)) / (1.0f - exp(-GAUSSIAN_B)));
}

/* K over that of the box, at squared distances t2 in discs of radius 1. */
static inline float8 density_profile8(uint density, float cone_k, float8 t2)
{
    float8 k = (float8)(0.0f);
    switch (density) {
    case RT_DENSITY_EPANECHNIKOV:
        k = 2.0f * (1.0f - t2);
        break;
    case RT_DENSITY_BOX:
        k = (float8)(1.0f);
        break;
    case RT_DENSITY_CONE:
        k = (1.0f - sqrt(t2) / cone_k) / (1.0f - 2.0f / (3.0f * cone_k));
        break;
    case RT_DENSITY_GAUSSIAN:
        k = gaussian8(t2, GAUSSIAN_A);
        break;
    case RT_DENSITY_SILVERMAN:
        k = 3.0f * (1.0f - t2) * (1.0f - t2);
        break;
    case RT_DENSITY_GAUSSIAN_JENSEN:
        k = gaussian8(t2, GAUSSIAN_A_JENSEN);
        break;
    }
    return k;
}

/*
 * K, 1/m^2, at squared distances d2 from the centre of a disc of squared radius r2; zero outside
 * it, and for a disc without area. cone_k is the cone's constant c.
 */
static inline float8 density_kernel8(uint density, float cone_k, float8 d2, float r2)
{
    const float box = 1.0f / (M_PI_F * r2);
    if (!(r2 > 0.0f))
        return (float8)(0.0f);
    const float8 k = density_profile8(density, cone_k, d2 * (1.0f / r2));
    return d2 <= r2 ? box * k : (float8)(0.0f);
}

/* The same at one distance. */
static inline float density_kernel(uint density, float cone_k, float d2, float r2)
{
    return density_kernel8(density, cone_k, (float8)(d2), r2).s0;
}

#endif
