/*
 * optics.h - how much light boundaries reflect, in double precision and by other formulas than
 * those of the kernels.
 */
#ifndef RT_TESTS_PROOF_OPTICS_H
#define RT_TESTS_PROOF_OPTICS_H

#include <complex.h>

/*
 * Unpolarised reflectance of a smooth boundary; index: eta + i k of what lies beyond over that of
 * the side of the light.
 */
double optics_fresnel(double cos_i, double complex index);

/* Reflectance of a boundary of GGX facets, each reflecting once, to a direction of that cosine. */
double optics_rough(double cos_o, double alpha, double complex index);

/* The mean of f(cos) over the directions of diffuse light: integral of 2 c f(c) dc. */
double optics_diffuse_mean(double (*f)(double cos_i));

#endif
