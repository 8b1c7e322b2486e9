/*
 * bias.h - the bias of photon estimates, for the layer photon.bias.
 *
 * A density estimate blurs light over the disc that it gathers from, which to first order makes an
 * error in proportion to the disc's area: E[L_a] = L + c a. A second estimate from the same photons
 * over a smaller area q a then gives the error of the first (Richardson's extrapolation): (L_a -
 * L_qa) / (1 - q). Where the radius is given, it is that of half the area. The area of the k
 * nearest photons is on average proportional to k, so the finer gather uses (k + 1) / 2 of them,
 * rounded down.
 */
#ifndef RT_LIB_MODE_PHOTON_BIAS_H
#define RT_LIB_MODE_PHOTON_BIAS_H

#include "photon/gather.h"

/* A gatherer over a smaller area, beside an ordinary one. */
typedef struct rt_finer {
    rt_gatherer *gatherer; /* or NULL */
    double factor;         /* 1 / (1 - q) */
} rt_finer;

/* The bias of a batch of eye paths. All zero is none. */
typedef struct rt_photon_bias {
    rt_device *device;
    size_t capacity, rows; /* paths a batch, and earlier gather points of each */
    /* rt_gather_point [1 + rows][capacity]: copies for the finer gatherers */
    cl_mem copies;
    rt_gather_point *host; /* [capacity] */
    double *sums;          /* [capacity], the bias of each path, the mean of its three channels */
} rt_photon_bias;

/* The options of a finer gatherer and its factor; 0 when there are too few photons for one. */
int rt_photon_bias_finer(rt_gather_options *out, double *factor, const rt_gather_options *options);

rt_status rt_photon_bias_create(rt_photon_bias *out, rt_device *device, size_t capacity,
                                size_t rows, rt_error *error);
void rt_photon_bias_release(rt_photon_bias *bias);

/*
 * Copies the gather points of a batch, at the ends of paths and the earlier ones [rows][capacity],
 * before anything is gathered for them.
 */
rt_status rt_photon_bias_begin(rt_photon_bias *bias, cl_mem points, cl_mem earlier, size_t count,
                               rt_error *error);

/*
 * rt_gatherer_add at the points first .. first + count - 1, and the finer one at their copies: row
 * 0 holds the ends of paths, the next ones the earlier points. The sums grow by the bias.
 */
rt_status rt_photon_bias_add(rt_photon_bias *bias, rt_gatherer *gatherer, const rt_finer *finer,
                             cl_mem points, size_t first, size_t row, size_t count,
                             rt_gather_disc *discs, rt_error *error);

#endif
