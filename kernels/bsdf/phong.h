/*
 * phong.h - the modified Phong lobe: a power of the cosine about the mirror direction r.
 *
 *   fr = R (n + 2) / (2 pi) (r.wi)^n,   pdf_w = (n + 1) / (2 pi) (r.wi)^n,   albedo <= R
 *
 * At normal incidence the albedo is R. Elsewhere the part of the lobe below the surface is lost,
 * and the cosine of wi makes the rest darker: towards grazing directions the albedo falls to 0.
 *
 * Powers of numbers up to 1 are taken by exp2 and log2, which leave out what powr does for its last
 * bits: that took a seventh of the time of a render.
 *
 * References:
 *   Lafortune, Willems: "Using the Modified Phong Reflectance Model for Physically Based
 *     Rendering", Report CW 197, KU Leuven, 1994.
 */
#ifndef RT_KERNELS_BSDF_PHONG_H
#define RT_KERNELS_BSDF_PHONG_H

#include "bsdf/lobe.h"
#include "bsdf/specular_reflection.h"

/* (r.wi)^n / (2 pi); 0 where wi is below the surface. */
static inline float phong_power(const struct bsdf *bsdf, float3 wi)
{
    const float cosine = dot(reflect_direction(bsdf), wi);
    const bool above = dot(wi, bsdf->normal) > 0.0f && dot(wi, bsdf->specular.normal) > 0.0f;
    return cosine > 0.0f && above ? exp2(bsdf->specular.alpha * log2(cosine)) * (0.5f / RT_PI)
                                  : 0.0f;
}

static inline float phong_pdf_w(const struct bsdf *bsdf, float3 wi)
{
    return (bsdf->specular.alpha + 1.0f) * phong_power(bsdf, wi);
}

static inline struct lobe_value phong_eval(const struct bsdf *bsdf, float3 wi)
{
    const float n = bsdf->specular.alpha, power = phong_power(bsdf, wi);
    struct lobe_value lobe;
    lobe.pdf_w = (n + 1.0f) * power;
    lobe.value = bsdf->reflected * ((n + 2.0f) * power * dot(wi, bsdf->specular.normal));
    return lobe;
}

static inline struct lobe_sample phong_sample(const struct bsdf *bsdf, float3 u)
{
    const float n = bsdf->specular.alpha;
    const float z = exp2(log2(1.0f - u.x) / (n + 1.0f));
    const float2 arc = sin_cos(2.0f * RT_PI * u.y);
    const float r = sqrt(fmax(0.0f, 1.0f - z * z));
    const struct frame frame = frame_about(reflect_direction(bsdf));
    struct lobe_sample sample;
    sample.wi = unit(frame_to_world(frame, (float3)(r * arc.y, r * arc.x, z)));
    sample.pdf_w = phong_pdf_w(bsdf, sample.wi);
    sample.weight = (float3)(0.0f);
    if (sample.pdf_w > 0.0f)
        sample.weight =
            bsdf->reflected * ((n + 2.0f) / (n + 1.0f) * dot(sample.wi, bsdf->specular.normal));
    sample.through = false;
    return sample;
}

/* That of a mirror, an upper bound. */
static inline float3 phong_albedo(const struct bsdf *bsdf)
{
    return bsdf->reflected;
}

#endif
