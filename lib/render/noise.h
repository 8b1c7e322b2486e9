/*
 * noise.h - how far a picture is from the mean that it estimates.
 *
 * The samples of one scrambled Sobol sequence depend on each other, so that the spread among them
 * says nothing of the error of their mean. So where the error is wanted, R sequences that are
 * independent of each other share the samples (replicates.h; in photon mapping each has photons of
 * its own), and the spread among them tells the variance of a pixel (Owen 1997: internal
 * replication).
 *
 * A pixel is a quotient of sums, Q = sum of S_r over sum of W_r, S_r being the weighted radiance
 * and W_r the sum of weights of replicate r, which is the number of its samples but for a filter
 * with negative parts. Its variance is that of the ratio estimator (Cochran 1977, section 2.11),
 *
 *   var Q = R/(R - 1) sum over r of z_r^2 / (sum of W_r)^2,    z_r = S_r - Q W_r,
 *
 * or s^2/R of the replicates' means when all W_r are the same. With 95 % confidence the pixel's
 * mean lies within t sqrt(var Q) of Q, t two-sided of Student's distribution with R - 1 degrees of
 * freedom.
 *
 * The relative error of the picture is sqrt(mean of var Q) / mean of Q, means over all pixels and
 * channels: what its root mean squared error is to be, by its mean radiance. The mean of var Q has
 * no bias; its root is low by 3.5 % at the most, where all pixels err as one (the mean of the
 * square root of a chi-square of 7 degrees), and where they do not, by nothing that 100 renders
 * would show. What the error turns out to be lies, with 95 % confidence, below a bound found from
 * the parts that the replicates have in it,
 *
 *   q_r = mean of R/(R - 1) z_r^2 / (sum of W_r)^2,
 *
 * whose sum is the mean of var Q. R q_r is spread like the mean squared error of the picture
 * itself, or more, because the sum of all replicates is closer to normal than one; and where pixels
 * err together, as those do that share photons, both are spread more. So with s the standard
 * deviation of q_r over their mean, and as if their logarithm were normal, the error is at most
 *
 *   relative error times exp(t s sqrt(1 + 1/R) / 2),    t one-sided.
 *
 * With few replicates s says nothing (of two, z_1 = -z_2), so that there is no bound until all have
 * samples.
 *
 * References:
 *   Owen: "Monte Carlo Variance of Scrambled Net Quadrature", SIAM Journal on Numerical Analysis
 *     34(5), 1997.
 *   Cochran: "Sampling Techniques", third edition, Wiley 1977.
 */
#ifndef RT_LIB_RENDER_NOISE_H
#define RT_LIB_RENDER_NOISE_H

#include <stddef.h>

#include "device/device.h"
#include "render/film.h"
#include "render/replicates.h"
#include "rt.h"

/* What the replicates of a film tell. */
typedef struct rt_noise rt_noise;

/* Whether complete options ask for it, and whether they allow it. */
int rt_noise_wanted(const rt_render_options *options);
rt_status rt_noise_check(const rt_render_options *options, rt_error *error);

/* The caller owns *out. */
rt_status rt_noise_create(rt_noise **out, size_t pixels, rt_error *error);
void rt_noise_destroy(rt_noise *noise);

/*
 * Reads the sums of the film from the device; what has come to them since the last time is this
 * stretch.
 */
rt_status rt_noise_read(rt_noise *noise, const rt_stretch *stretch, rt_device *device,
                        cl_mem pixels, rt_film *film, rt_error *error);

/*
 * Looks at the error when it is time to, all replicates having `length` samples or passes: at the
 * lengths that rt_replicate_grow gives, and so seldom that the chance to find it small by luck
 * stays near that of a single look. Returns whether its bound is at most `target`, from a length of
 * 4 on and if target is above 0.
 */
int rt_noise_look(rt_noise *noise, uint32_t length, double target);

/* The relative error at the last look; negative before. */
double rt_noise_last(const rt_noise *noise);

/*
 * What part of the way to `target` is gone, with replicates of this length; 0 before a look, or
 * without target.
 */
double rt_noise_progress(const rt_noise *noise, double length, double target);

/*
 * Makes the film's layer `variance` and the figures of its stats; neither with fewer than two
 * replicates.
 */
rt_status rt_noise_resolve(const rt_noise *noise, rt_film *film, rt_error *error);

#endif
