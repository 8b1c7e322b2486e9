/*
 * phase.h - the phase function of Henyey and Greenstein: how a medium scatters.
 *
 *   p(cos) = (1 - g^2) / (4 pi (1 + g^2 - 2 g cos)^(3/2))
 *
 * cos is that of the angle by which light is turned, so g > 0 scatters forward, and the mean cosine
 * is g. p integrates to 1 over the sphere: it is the density of its own samples.
 *
 * References:
 *   Henyey, Greenstein: "Diffuse Radiation in the Galaxy", Astrophysical Journal 93, 1941.
 */
#ifndef RT_KERNELS_VOLUME_PHASE_H
#define RT_KERNELS_VOLUME_PHASE_H

#include "math/frame.h"
#include "sample/sample.h"

/* p for light that travels along `direction` and leaves along wi, both unit. */
static inline float phase_pdf_w(float g, float3 direction, float3 wi)
{
    /* (1 - |g|)^2 + 2 |g| (1 -+ cos) keeps its digits where the lobe is narrow. */
    const float cosine = g < 0.0f ? -dot(direction, wi) : dot(direction, wi);
    const float a = fabs(g);
    const float d = square(1.0f - a) + 2.0f * a * fmax(1.0f - cosine, 0.0f);
    return (1.0f - a * a) / (4.0f * RT_PI * d * sqrt(d));
}

/*
 * A direction of that density, by u in [0,1)^2. With c = 2 u - 1 the cumulative distribution is
 * inverted by
 *   cos = (1 + g^2 - ((1 - g^2) / (1 + g c))^2) / (2 g)
 *       = (2 c + g (c^2 + 3) + 2 g^2 c + g^3 (c^2 - 1)) / (2 (1 + g c)^2),
 * of which the second form holds for g = 0 too.
 */
static inline float3 phase_sample(float g, float3 direction, float2 u)
{
    const float c = 2.0f * u.x - 1.0f;
    const float above = 2.0f * c + g * (c * c + 3.0f + g * (2.0f * c + g * (c * c - 1.0f)));
    const float cosine = clamp(above / (2.0f * square(1.0f + g * c)), -1.0f, 1.0f);
    const float sine = sqrt(fmax(1.0f - cosine * cosine, 0.0f));
    const float2 arc = sin_cos(2.0f * RT_PI * u.y);
    return frame_to_world(frame_about(direction), (float3)(sine * arc.y, sine * arc.x, cosine));
}

#endif
