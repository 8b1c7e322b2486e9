/*
 * bias.h - the bias and the noise of a picture by progressive photon passes, from their moments.
 *
 * Passes are independent, but for their camera paths and photons coming from sequences that fill
 * space more evenly than chance does, so that the variance among them overestimates that of their
 * mean. With y_p the value of a channel in pass p of P,
 *
 *   var of the mean = (sum of y_p^2 - (sum of y_p)^2 / P) / (P (P - 1)).
 *
 * In M of the passes the same photons are gathered once more from discs of twice the area. Where
 * bias goes by the area to the power g, the difference d_p of both has 2^g - 1 times it as its
 * expected value (Richardson's extrapolation): all of it in smooth light, where g is 1, and 0.41 of
 * a mean across an edge of light or of surfaces, where it goes by the radius. The latter is taken,
 * which makes too much of smooth light rather than too little of edges. The square of the bias is
 *
 *   B^2 = ((sum of d_p)^2 - sum of d_p^2) / (M (M - 1) (2^g - 1)^2),
 *
 * a mean over pairs of different passes, which share no noise: its expected value is free of it.
 * Pixels are lost in noise, so B^2 is averaged over the picture. Its bound adds 1.645 standard
 * errors of that mean, by the variance between blocks of 16 x 16 pixels, in small pictures of a
 * quarter of their side.
 *
 * References:
 *   Hachisuka, Jarosz, Jensen: "A Progressive Error Estimation Framework for Photon Density
 *     Estimation", ACM Transactions on Graphics 29(6), 2010: bias and noise estimated from the
 *     passes themselves, there by derivatives of the density.
 */
#ifndef RT_LIB_FILM_BIAS_H
#define RT_LIB_FILM_BIAS_H

#include "film/film.h"

/* Passes that are measured at least. */
enum { RT_BIAS_FEWEST = 4 };

/* Of a picture: roots of means of squares over pixels and channels, over the mean radiance. */
typedef struct rt_film_bias {
    double bias, bound; /* infinite where too few passes were measured */
    double noise;       /* likewise */
} rt_film_bias;

/* All zero for a film without moments. */
rt_film_bias rt_film_find_bias(const rt_film *film);

#endif
