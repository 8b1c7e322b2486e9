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

/*
 * Reflectance of a metal of complex index eta + i k, relative to the medium before it. With the
 * complex cosine a + i b beyond, scaled by the index: a^2 + b^2 = |(eta + i k)^2 - sin^2|, 2 a^2 =
 * that plus its real part.
 */
static inline float3 fresnel_conductor(float cos_i, float3 eta, float3 k)
{
    const float cos2 = cos_i * cos_i, sin2 = 1.0f - cos2;
    const float3 real = eta * eta - k * k - sin2;
    const float3 twice = 2.0f * eta * k; /* the imaginary part */
    const float3 size = sqrt(real * real + twice * twice);
    const float3 a = sqrt(fmax(0.5f * (size + real), (float3)(0.0f)));
    const float3 mixed = 2.0f * cos_i * a;
    const float3 s = (size + cos2 - mixed) / (size + cos2 + mixed);
    const float3 p =
        s * (cos2 * size + sin2 * sin2 - mixed * sin2) / (cos2 * size + sin2 * sin2 + mixed * sin2);
    return 0.5f * (s + p);
}

#endif
