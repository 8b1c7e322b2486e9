/*
 * translucent.h - diffuse reflection and transmission, as of leaves, paper and lampshades: the same
 * radiance in all directions of each side.
 *
 *   fr = kd / pi on the side of wo, kt / pi on the other,   albedo = kd + kt
 *
 * with kt the diffuse transmittance. A side is chosen by its part of the mean albedo, a direction
 * by the cosine there. The medium is the same on both sides, so light is not refracted, and what
 * crosses is not scaled.
 *
 * Reference:
 *   Pharr, Jakob, Humphreys: "Physically Based Rendering", fourth edition, 2023, section 9.4: its
 *     diffuse transmission.
 */
#ifndef RT_KERNELS_BSDF_TRANSLUCENT_H
#define RT_KERNELS_BSDF_TRANSLUCENT_H

#include "bsdf/lambert.h"
#include "bsdf/lobe.h"

/* The probability of a side. */
static inline float translucent_share(const struct bsdf *bsdf, bool through)
{
    const float kept = mean3(bsdf->kd), crossing = mean3(bsdf->second);
    const float share = kept > 0.0f ? kept / (kept + crossing) : 0.0f;
    return through ? 1.0f - share : share;
}

/* Whether wi is on the other side. */
static inline bool translucent_crosses(const struct bsdf *bsdf, float3 wi)
{
    return dot(wi, bsdf->normal) < 0.0f;
}

/* Lambert's density of wi about an axis on the side of wo, on either side, given that side. */
static inline float translucent_density(const struct bsdf *bsdf, float3 axis, float3 wi)
{
    const float side = translucent_crosses(bsdf, wi) ? -1.0f : 1.0f;
    return lambert_density(side * bsdf->normal, side * axis, wi);
}

static inline float translucent_pdf_w(const struct bsdf *bsdf, float3 wi)
{
    return translucent_share(bsdf, translucent_crosses(bsdf, wi)) *
           translucent_density(bsdf, bsdf->shading, wi);
}

static inline struct lobe_value translucent_eval(const struct bsdf *bsdf, float3 wi)
{
    const float3 albedo = translucent_crosses(bsdf, wi) ? bsdf->second : bsdf->kd;
    struct lobe_value lobe;
    lobe.value = albedo * translucent_density(bsdf, bsdf->shading, wi);
    lobe.pdf_w = translucent_pdf_w(bsdf, wi);
    return lobe;
}

/* A direction by the cosine about an axis, or about its opposite: sets wi and through. */
static inline struct lobe_sample translucent_about(const struct bsdf *bsdf, float3 axis, float3 u)
{
    const float3 wi = frame_to_world(frame_about(axis), sample_cosine(u.xy));
    struct lobe_sample sample;
    sample.through = u.z >= translucent_share(bsdf, false);
    sample.wi = sample.through ? -wi : wi;
    sample.weight = (float3)(0.0f);
    sample.pdf_w = 0.0f;
    return sample;
}

static inline struct lobe_sample translucent_sample(const struct bsdf *bsdf, float3 u)
{
    struct lobe_sample sample = translucent_about(bsdf, bsdf->shading, u);
    const struct lobe_value lobe = translucent_eval(bsdf, sample.wi);
    if (lobe.pdf_w > 0.0f && translucent_crosses(bsdf, sample.wi) == sample.through)
        sample.weight = lobe.value / lobe.pdf_w;
    sample.pdf_w = lobe.pdf_w;
    return sample;
}

static inline float3 translucent_albedo(const struct bsdf *bsdf)
{
    return bsdf->kd + bsdf->second;
}

static inline void translucent_keep(const struct bsdf *bsdf, global float *numbers)
{
    vstore3(bsdf->kd, 0, numbers);
    vstore3(bsdf->second, 0, numbers + 3);
}

static inline void translucent_restore(struct bsdf *bsdf, global const float *numbers)
{
    bsdf->kd = row3(numbers);
    bsdf->second = row3(numbers + 3);
}

#endif
