/*
 * noise.h - the error of a picture: how far it is from its expected value.
 *
 * The samples of one scrambled Sobol sequence depend on each other, so the variance among them says
 * nothing about the error of their mean. Where the error is to be estimated, the samples are
 * divided among R independent sequences (units.h; in photon mapping each has photons of its
 * own), and the variance among these estimates that of a pixel (Owen 1997: internal replication).
 *
 * A pixel is a quotient of sums, Q = sum of S_r over sum of W_r. S_r is the weighted radiance of
 * replicate r and W_r its sum of weights, which is the number of its samples unless the filter has
 * negative parts. The variance of Q is that of the ratio estimator (Cochran 1977, section 2.11),
 *
 *   var Q = R/(R - 1) sum over r of z_r^2 / (sum of W_r)^2,    z_r = S_r - Q W_r,
 *
 * or s^2/R of the replicates' means when all W_r are the same. With 95 % confidence the pixel's
 * mean lies within t sqrt(var Q) of Q, t two-sided of Student's distribution with R - 1 degrees of
 * freedom.
 *
 * The relative error of the picture is sqrt(mean of var Q) / mean of Q, means over all pixels and
 * channels: the expected root mean squared error over the mean radiance. The mean of var Q has no
 * bias. Its root is too low by at most 3.5 %, where all pixels are fully correlated (the mean of
 * the square root of a chi-square of 7 degrees); where they are not, by less than 100 renders would
 * show. The true error lies, with 95 % confidence, below a bound found from the share of each
 * replicate,
 *
 *   q_r = mean of R/(R - 1) z_r^2 / (sum of W_r)^2,
 *
 * whose sum is the mean of var Q. R q_r varies as the mean squared error of the picture itself
 * does, or more, because the sum of all replicates is closer to normal than one. Where the errors
 * of pixels are correlated, as where they share photons, both vary more. With s the standard
 * deviation of q_r over their mean, and treating q_r as log-normal, the error is at most
 *
 *   relative error times exp(t s sqrt(1 + 1/R) / 2),    t one-sided.
 *
 * With few of eight replicates s is meaningless, so there is no bound until all have samples.
 *
 * Where there are only two (units.h), z_1 = -z_2, and the spread is taken from the pixels, whose
 * samples are independent of each other. Let v_i be the sum of var Q over the channels of pixel i,
 * which count as fully correlated. It varies as chi-square of one degree of freedom does, whose
 * variance is 2/3 of its mean square; so does the sum of the pixel's squared errors. With
 *
 *   s = sqrt((2/3 + 2/3) sum over i of v_i^2) / sum over i of v_i,
 *
 * the error is at most relative error times exp(t s / 2), t one-sided of the normal distribution.
 *
 * References:
 *   Owen: "Monte Carlo Variance of Scrambled Net Quadrature", SIAM Journal on Numerical Analysis
 *     34(5), 1997.
 *   Cochran: "Sampling Techniques", third edition, Wiley 1977.
 */
#ifndef RT_LIB_FILM_NOISE_H
#define RT_LIB_FILM_NOISE_H

#include "film/film.h"
#include "rt.h"

/* When the error is estimated, and what it was the last time. */
typedef struct rt_noise {
    uint32_t next_test;  /* when the replicates have this length */
    double error, bound; /* at the last test, */
    uint32_t tested_at;  /* when they had this length; 0 before */
} rt_noise;

/* The length of the replicates at the first test that can end a render. */
enum { RT_NOISE_FEWEST = 4 };

/* The first test is at this length, or the next one after it that has a test. */
rt_noise rt_noise_begin(uint32_t length);

/* Whether the error is to be estimated at this length; see rt_noise_test. */
int rt_noise_is_due(const rt_noise *noise, uint32_t length);

/*
 * Estimates the error from the planes of a film whose replicates all have `length` samples or
 * passes, which rt_noise_is_due: at the lengths that rt_units_next_test gives, so seldom that the
 * probability of a low estimate by chance stays near that of a single test. In photon passes its
 * bound has that of the bias in it (bias.h). Returns whether the bound is at most `target`, from a
 * length of 4 on and if target is above 0.
 */
int rt_noise_test(rt_noise *noise, const rt_film *film, uint32_t length, double target);

/* The relative error at the last test; negative before. */
double rt_noise_last(const rt_noise *noise);

/*
 * The fraction of the work to `target` that is done, with replicates of this length; 0 before the
 * first test, or without target.
 */
double rt_noise_progress(const rt_noise *noise, double length, double target);

/* What the layer `variance` holds for pixel i; 0 where fewer than two replicates have samples. */
void rt_noise_variance(float rgb[3], const rt_film *film, size_t i);

/*
 * Makes the film's layer `variance` and the figures of its stats; neither where fewer than two
 * replicates have samples.
 */
rt_status rt_noise_resolve(rt_film *film, rt_error *error);

#endif
