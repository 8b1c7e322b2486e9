/*
 * microfacet.h - the GGX distribution of microfacets about +z, with Smith's masking.
 *
 * Directions are unit vectors in the frame of the surface. alpha > 0 is the roughness. All is
 * written so that it stays precise in float32 down to RT_SMOOTH_ALPHA.
 *
 * References:
 *   Walter, Marschner, Li, Torrance: "Microfacet Models for Refraction through Rough Surfaces",
 *     EGSR 2007.
 *   Heitz: "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 3(2),
 *     2014.
 *   Dupuy, Benyoub: "Sampling Visible GGX Normals with Spherical Caps", HPG 2023.
 */
#ifndef RT_KERNELS_BSDF_MICROFACET_H
#define RT_KERNELS_BSDF_MICROFACET_H

#include "math/frame.h"
#include "sample/sample.h"

/* Density of normals: the integral of D(h) h.z over the hemisphere is 1. */
static inline float ggx_density(float alpha, float3 h)
{
    const float a2 = alpha * alpha;
    return a2 / (RT_PI * square(a2 * h.z * h.z + h.x * h.x + h.y * h.y));
}

/*
 * Projected area, along w, of the microfacets facing w per unit of macrosurface area, masked ones
 * included: |w.z| (1 + Lambda(w)), with Smith's Lambda. |w.z| of it is visible. Unlike Lambda it is
 * finite for a w that only grazes the surface.
 */
static inline float ggx_facing(float alpha, float3 w)
{
    return 0.5f * (fabs(w.z) + sqrt(w.z * w.z + alpha * alpha * (w.x * w.x + w.y * w.y)));
}

/*
 * The masked part of it, |w.z| Lambda(w); as a quotient, because the difference of the two would
 * cancel.
 */
static inline float ggx_hidden(float alpha, float3 w)
{
    return 0.25f * alpha * alpha * (w.x * w.x + w.y * w.y) / ggx_facing(alpha, w);
}

/*
 * A normal among those that wo, wo.z >= 0, can see: density D(h) (wo.h) / ggx_facing(wo). Stretched
 * to roughness 1 the surface is a hemisphere of which wo sees a cap of mirror directions, uniform
 * in solid angle. alpha: along x and y.
 */
static inline float3 sample_visible_normal(float2 alpha, float3 wo, float2 u)
{
    const float3 seen = unit((float3)(alpha * wo.xy, wo.z));
    const float z = 1.0f - u.x * (1.0f + seen.z);
    const float2 arc = sin_cos(2.0f * RT_PI * u.y);
    const float r = sqrt(fmax((1.0f - z) * (1.0f + z), 0.0f));
    const float3 h = (float3)(r * arc.yx, z) + seen;
    return unit((float3)(alpha * h.xy, fmax(h.z, 1e-12f)));
}

#endif
