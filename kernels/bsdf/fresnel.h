/*
 * fresnel.h - how much light a smooth boundary reflects, exactly, for unpolarised light.
 *
 * References:
 *   Born, Wolf: "Principles of Optics", 7th ed., sections 1.5.2 (dielectrics) and 14.2 (metals).
 *   Schlick: "An Inexpensive BRDF Model for Physically-based Rendering", Computer Graphics Forum
 *     13, 1994 (Eurographics '94).
 */
#ifndef RT_KERNELS_BSDF_FRESNEL_H
#define RT_KERNELS_BSDF_FRESNEL_H

#include "math/frame.h"

#include "math/width1.inc.h"
#include "bsdf/fresnel.inc.h"

/*
 * Reflectance between dielectrics at cos_i > 0, eta = eta_i/eta_t; 1 at total internal reflection.
 * Writes the cosine of the refracted direction.
 */
static inline float fresnel(float cos_i, float eta, float *cos_t)
{
    *cos_t = refracted_cosine(cos_i, eta);
    return *cos_t == 0.0f ? 1.0f : fresnel_of_cosines(cos_i, *cos_t, eta);
}

#endif
