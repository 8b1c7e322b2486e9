/*
 * radius_choice.h - radii by estimates of bias and noise.
 *
 * The mean squared error that P passes leave at a pixel whose disc is t times the first one's area,
 * and whose square shrinks by the factors s_i from pass to pass, is
 *
 *   b^2 mean(s^g)^2 t^(2 g) + V mean(1/s) / (P t),
 *
 * b the bias and V the variance of a pass with the first disc. g is 1 in smooth light, where bias
 * goes by the area, and 1/2 for a mean across an edge, where it goes by the radius. The least is at
 *
 *   t^(2 g + 1) = V mean(1/s) / (2 g P b^2 mean(s^g)^2).
 *
 * b and V come from pilot passes, which estimate the change of the picture when discs are halved
 * (photon/halvings.h). The bias of one pixel is lost in the noise of so few passes, so pixels are
 * pooled: one half of the pilot ranks them by b^2 / V of their neighbourhood, the other half, whose
 * noise is independent of the ranks, estimates b, V and g of each class of pixels of similar rank.
 * Classes of higher rank have at least the b^2 / V of lower ones (isotonic regression). Then the
 * halves change places, and t is the geometric mean of both choices.
 *
 * So t is at most 1. Pixels that keep half of their disc or more are tried with four times its
 * area as well, by ranks and classes of their own: an edge that a larger disc meets, and the first
 * one does not, says nothing of the first.
 *
 * References:
 *   Kaplanyan, Dachsbacher: "Adaptive Progressive Photon Mapping", ACM Transactions on Graphics
 *     32(2), 2013: the radius of least mean squared error.
 *   Scott: "Multivariate Density Estimation", Wiley 1992, section 6.5.
 */
#ifndef RT_LIB_MODE_PHOTON_RADIUS_CHOICE_H
#define RT_LIB_MODE_PHOTON_RADIUS_CHOICE_H

#include "base/memory.h"
#include "rt.h"
#include "types.h"

/* The passes that radii are chosen for. */
typedef struct rt_radius_passes {
    uint32_t count, pilot; /* passes, and those of the pilot, which radii shrink after */
    double alpha;
    /* how often the largest disc that is tried is to be halved for the first, at most 2 */
    uint32_t larger;
} rt_radius_passes;

/*
 * Multiplies the squared radii of an image of width x height pixels by t, at most 2^larger. halves:
 * the trials of each half of the pilot.
 */
rt_status rt_radius_choose(float *squared, const rt_radius_trial *const halves[2], uint32_t width,
                           uint32_t height, const rt_radius_passes *passes, rt_memory *memory,
                           rt_error *error);

#endif
