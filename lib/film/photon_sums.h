/* photon_sums.h - what the layers photon.count and so on are made of: sums of one pixel. */
#ifndef RT_LIB_FILM_PHOTON_SUMS_H
#define RT_LIB_FILM_PHOTON_SUMS_H

#include <stddef.h>

#include "base/exact_sum.h"

typedef struct rt_photon_sums {
    uint64_t asked, photons;      /* query points at ends of paths, and the photons found there */
    rt_exact_sum radius, density; /* of these points */
    /* of all samples: mean of the three channels, its square and bias */
    uint64_t samples;
    rt_exact_sum value, square, bias;
} rt_photon_sums;

/* Adds the sums of so many pixels to others. */
void rt_photon_sums_join(rt_photon_sums *sums, const rt_photon_sums *others, size_t pixels);

#endif
