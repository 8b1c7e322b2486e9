/*
 * specular_transmission.h - the delta lobe of perfect refraction.
 *
 *   fr = T delta(wi - refract(wo)) / |n.wi|,   refract(wo) = (eta (n.wo) - cos_t) n - eta wo
 *
 * with T the flux that the boundary refracts (boundary.h), n its normal, and eta the index on the
 * side of wo over that on the other.
 *
 * Reference:
 *   Veach: "Robust Monte Carlo Methods for Light Transport Simulation", PhD thesis, 1997, section
 *     5.2.1.2.
 */
#ifndef RT_KERNELS_BSDF_SPECULAR_TRANSMISSION_H
#define RT_KERNELS_BSDF_SPECULAR_TRANSMISSION_H

#include "bsdf/lobe.h"

/* Where there is a refracted direction, of this cosine. */
static inline float3 refract_direction(const struct bsdf *bsdf, float cos_t)
{
    const float eta = bsdf->specular.eta;
    const float3 n = bsdf->specular.normal;
    const float cos_i = dot(bsdf->wo, n);
    const float3 axis = cos_i < 0.0f ? -n : n;
    return unit((eta * fabs(cos_i) - cos_t) * axis - eta * bsdf->wo);
}

static inline float specular_transmission_pdf_w(const struct bsdf *bsdf, float3 wi)
{
    return 0.0f;
}

static inline struct lobe_sample specular_transmission_sample(const struct bsdf *bsdf, float3 u)
{
    struct lobe_sample sample;
    sample.wi = refract_direction(bsdf, bsdf->cos_t);
    sample.weight = dot(sample.wi, bsdf->normal) < 0.0f ? bsdf->refracted : (float3)(0.0f);
    sample.pdf_w = 0.0f;
    sample.through = true;
    return sample;
}

static inline float3 specular_transmission_albedo(const struct bsdf *bsdf)
{
    return bsdf->refracted;
}

#endif
