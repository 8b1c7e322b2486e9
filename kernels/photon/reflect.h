/*
 * reflect.h - what a gather point makes of the flux density around it.
 *
 *   L(x, wo) = sum over the photons p in the disc of fr(x, wo, w_p) flux_p K(|x - x_p|)
 *
 * with fr = kd/pi, of which the point's weight has kd, and flux_p the flux of its path over the
 * number of emitted paths. Photons are as dense as the geometric surface makes them, while
 * reflection goes by the shading normal: photon.shading is the ratio of the two cosines (Veach
 * 1997, section 5.3).
 */
#ifndef RT_KERNELS_PHOTON_REFLECT_H
#define RT_KERNELS_PHOTON_REFLECT_H

#include "math/frame.h"
#include "types.h"

/* Adds the light that the point reflects, on its way to the film, to its radiance. */
static inline void add_reflected(global rt_gather_point *point, float3 flux_density)
{
    vstore3(row3(point->radiance) + row3(point->weight) / RT_PI * flux_density, 0, point->radiance);
}

#endif
