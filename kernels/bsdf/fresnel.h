/*
 * fresnel.h - how much light a smooth boundary reflects, exactly, for unpolarised light.
 *
 * References:
 *   Born, Wolf: "Principles of Optics", 7th ed., sections 1.5.2 (dielectrics) and 14.2 (metals).
 */
#ifndef RT_KERNELS_BSDF_FRESNEL_H
#define RT_KERNELS_BSDF_FRESNEL_H

#include "math/frame.h"

/* Snell's law, kept precise when grazing: the cosine beyond; 0: light is reflected totally. */
static inline float refracted_cosine(float cos_i, float eta)
{
    return sqrt(fmax((1.0f - eta) * (1.0f + eta) + square(eta * cos_i), 0.0f));
}

/*
 * Reflectance between dielectrics at cos_i > 0, eta = eta_i/eta_t; 1 at total internal reflection.
 * Writes the cosine of the refracted direction.
 */
static inline float fresnel(float cos_i, float eta, float *cos_t)
{
    *cos_t = refracted_cosine(cos_i, eta);
    if (*cos_t == 0.0f)
        return 1.0f;
    const float s = (eta * cos_i - *cos_t) / (eta * cos_i + *cos_t);
    const float p = (cos_i - eta * *cos_t) / (cos_i + eta * *cos_t);
    return 0.5f * (s * s + p * p);
}

#include "math/width1.inc.h"
#include "bsdf/fresnel.inc.h"

#endif
