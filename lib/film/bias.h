/*
 * bias.h - the bias and the noise of a picture by progressive photon passes, or by iterations of
 * mode vcm that merge, from their moments.
 *
 * Passes are independent, but for their camera paths and photons coming from sequences that fill
 * space more evenly than chance does, so that the variance among them overestimates that of their
 * mean. With y_p the value of a channel in pass p of P,
 *
 *   var of the mean = (sum of y_p^2 - (sum of y_p)^2 / P) / (P (P - 1)).
 *
 * In M of the passes the same photons are gathered once more from discs of twice the area, and of
 * four times; d_p is the difference that a larger disc makes. The mean of d^2 over the picture,
 *
 *   D^2 = ((sum of d_p)^2 - sum of d_p^2) / (M (M - 1)),
 *
 * is one over pairs of different passes, which share no noise: its expected value is free of it. In
 * smooth light bias goes by the area, and d is 1 and 3 times the bias B. At edges of light and of
 * surfaces, and where a line of light is narrower than the disc, bias is a function of the distance
 * from the edge over the radius, and the means of squares are
 *
 *   D_2^2 = p^2 B^2, D_4^2 = e p^2 B^2, p = 0.311, e = 4.47
 *
 * for a straight edge and the kernel of Epanechnikov (p is 0.305 to 0.327 with the other kernels,
 * 0.30 to 0.39 for lines). Pictures have both, of which the squares add up:
 *
 *   D_2^2 = p^2 B_e^2 + B_s^2, D_4^2 = e p^2 B_e^2 + 9 B_s^2, B^2 = B_e^2 + B_s^2.
 *
 * Pixels are lost in noise, so D^2 is averaged over the picture, and B_s is what noise does not
 * explain of D_4^2 - e D_2^2: it less 1.645 standard errors. The bound adds as many of D_2^2. They
 * come from the variance between blocks of 16 x 16 pixels, in small pictures of a quarter of their
 * side.
 *
 * Discs that are larger than all that is lit spread its light evenly, as 1 over their area, so that
 * D_4^2 is 2.25 D_2^2, and both fall to 0 while the bias grows. Where D_4^2 is below 2.5 D_2^2 by
 * more than noise explains, nothing is told of the bias.
 *
 * Iterations of mode vcm merge over half and over a quarter of the area of their discs as well, one
 * in four of them, as that takes no other search. The differences are then those that half and the
 * whole make to a quarter, d is 1 and 3 times the bias of a quarter, and that of the whole is B_s^2
 * times 16 and B_e^2 times 2.
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
    /* infinite where too few passes were measured, or discs are larger than what is lit */
    double bias, bound;
    double noise; /* infinite in the first case */
} rt_film_bias;

/* All zero for a film without moments. */
rt_film_bias rt_film_find_bias(const rt_film *film);

#endif
