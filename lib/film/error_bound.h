/*
 * error_bound.h - the layer error_bound: how far pixels of progressive photon passes are from the
 * light that is there, noise and bias together.
 *
 * A pixel is off by its bias b and by noise of the variance v, which is estimated from R sequences
 * (noise.h). Its own b cannot be told: of P passes P/8 are measured (bias.h), and with the kernel
 * of Epanechnikov the difference that a disc of twice the area makes has 1/4 of the variance of a
 * pass, so that its mean has the variance 8/4 v, while at edges it is 0.311 b: the estimate of b
 * has a standard deviation of 4.5 sqrt(v). But B^2, the mean of b^2 over the picture, is told, and
 * so b is taken for random with that mean square. With 95 % confidence the error is below
 *
 *   t sqrt(v + B^2),
 *
 * t two-sided of Student's distribution with (R - 1) (v + B^2)^2 / v^2 degrees of freedom, as v is
 * an estimate with R - 1 (Satterthwaite). This holds of pixels in the mean: bias gathers at edges
 * of light and of surfaces, so that fewer of the pixels there are within the bound, and more of
 * the others. How it is spread matters little. Where a part f of the pixels has all bias, b or -b,
 * the others none, and v is s^2 everywhere, the part
 *
 *   f (F(w - b/s) - F(-w - b/s)) + (1 - f) (F(w) - F(-w)), w = 1.96 sqrt(1 + B^2/s^2), b^2 = B^2/f,
 *
 * is within it, F the normal distribution: 94.2 to 96.4 % for B^2 = s^2/2 and any f above 0.02,
 * 93.0 to 97.5 % for B = s, and 90 to 99 % for B = 2 s.
 *
 * References:
 *   Hachisuka, Jarosz, Jensen: "A Progressive Error Estimation Framework for Photon Density
 *     Estimation", ACM Transactions on Graphics 29(6), 2010: an interval of each pixel by its bias
 *     and noise.
 *   Satterthwaite: "An Approximate Distribution of Estimates of Variance Components", Biometrics
 *     Bulletin 2(6), 1946.
 */
#ifndef RT_LIB_FILM_ERROR_BOUND_H
#define RT_LIB_FILM_ERROR_BOUND_H

#include "film/film.h"

/*
 * Makes the layer from the layer variance and from the stats of the film, which are resolved;
 * infinite where the bias is unknown.
 */
rt_status rt_error_bound_resolve(rt_film *film, rt_error *error);

#endif
