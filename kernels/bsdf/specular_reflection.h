/*
 * specular_reflection.h - the delta lobe of a perfect mirror.
 *
 *   fr = R delta(wi - reflect(wo)) / |n.wi|,   reflect(wo) = 2 (n.wo) n - wo
 *
 * with R what the boundary reflects (boundary.h) and n its normal.
 *
 * Reference:
 *   Veach: "Robust Monte Carlo Methods for Light Transport Simulation", PhD thesis, 1997, section
 *     5.2.1.1.
 */
#ifndef RT_KERNELS_BSDF_SPECULAR_REFLECTION_H
#define RT_KERNELS_BSDF_SPECULAR_REFLECTION_H

#include "bsdf/lobe.h"

static inline float3 reflect_direction(const struct bsdf *bsdf)
{
    const float3 n = bsdf->specular.normal;
    return unit(2.0f * dot(bsdf->wo, n) * n - bsdf->wo);
}

static inline float specular_reflection_pdf_w(const struct bsdf *bsdf, float3 wi)
{
    return 0.0f;
}

static inline struct lobe_sample specular_reflection_sample(const struct bsdf *bsdf, float3 u)
{
    struct lobe_sample sample;
    sample.wi = reflect_direction(bsdf);
    sample.weight = dot(sample.wi, bsdf->normal) > 0.0f ? bsdf->reflected : (float3)(0.0f);
    sample.pdf_w = 0.0f;
    sample.through = false;
    return sample;
}

static inline float3 specular_reflection_albedo(const struct bsdf *bsdf)
{
    return bsdf->reflected;
}

#endif
