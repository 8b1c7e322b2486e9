/*
 * oren_nayar.h - diffuse reflection by a rough surface: the energy-preserving Oren-Nayar lobe.
 *
 *   fr = kd/pi A (1 + r s/t)  +  ms/pi A r g(n.wo) g(n.wi) / (c1 - c2)
 *
 * with r the roughness from 0 to 1, s = wo.wi - (n.wo)(n.wi), t = max(n.wo, n.wi) where s > 0 and
 * else 1, A = 1 / (1 + c1 r), c1 = 1/2 - 2/(3 pi) and c2 = 2/3 - 28/(15 pi). The first term is
 * Fujii's form of the model: V-shaped grooves of Lambert facets, brightest towards the light. Of
 * white light it loses A r g(n.wo) between the grooves:
 *
 *   g(u) = c1 - G(u)/pi,   G(u) = v (acos u - v u) + 2/3 (v/u (1 - v^3) - v),   v = sqrt(1 - u^2)
 *
 * The second term restores it, with the colour of two or more bounces: E = A (1 + c2 r) is the mean
 * albedo of the first term for white, and ms = kd^2 E / (1 - kd (1 - E)). So the lobe passes the
 * white-furnace test, is reciprocal, and has the albedo kd (1 - A r g(n.wo)) + ms A r g(n.wo). At r
 * = 0 it is Lambert's. Directions are sampled by the cosine.
 *
 * References:
 *   Oren, Nayar: "Generalization of Lambert's Reflectance Model", SIGGRAPH 1994.
 *   Portsmouth, Kutz, Hill: "EON: A Practical Energy-Preserving Rough Diffuse BRDF", JCGT 14(1),
 *     2025.
 */
#ifndef RT_KERNELS_BSDF_OREN_NAYAR_H
#define RT_KERNELS_BSDF_OREN_NAYAR_H

#include "bsdf/lambert.h"
#include "bsdf/lobe.h"

#define OREN_NAYAR_C1 (0.5f - 2.0f / (3.0f * RT_PI))
#define OREN_NAYAR_C2 (2.0f / 3.0f - 28.0f / (15.0f * RT_PI))

/* acos(u) / sqrt(1 - u^2) from 0 to 1, to 3e-7: interpolated at the zeros of Chebyshev's T9. */
static inline float angle_over_sine(float u)
{
    const float4 high = (float4)(0.0171853694f, -0.0960763047f, 0.250126529f, -0.421895718f),
                 low = (float4)(0.555748958f, -0.660758619f, 0.784853813f, -0.99998017f);
    float sum = fma(fma(fma(high.x, u, high.y), u, high.z), u, high.w);
    sum = fma(fma(fma(fma(sum, u, low.x), u, low.y), u, low.z), u, low.w);
    return fma(sum, u, 1.57079621f);
}

/* g of the cosine u, with (1 - v^3) / u written so that it is finite and precise at u = 0. */
static inline float oren_nayar_g(float u)
{
    const float v2 = fmax(1.0f - u * u, 0.0f), v = sqrt(v2);
    const float facets = v2 * (angle_over_sine(u) - u);
    const float grooves = (2.0f / 3.0f) * v * (u * (1.0f + v + v2) / (1.0f + v) - 1.0f);
    return fmax(OREN_NAYAR_C1 - (facets + grooves) * (1.0f / RT_PI), 0.0f);
}

static inline float oren_nayar_scale(float roughness)
{
    return 1.0f / (1.0f + OREN_NAYAR_C1 * roughness);
}

/* ms, the albedo of what is reflected more than once. */
static inline float3 oren_nayar_interreflected(float3 kd, float roughness)
{
    const float mean = oren_nayar_scale(roughness) * (1.0f + OREN_NAYAR_C2 * roughness);
    return kd * kd * mean / (1.0f - kd * (1.0f - mean));
}

static inline float oren_nayar_pdf_w(const struct bsdf *bsdf, float3 wi)
{
    return lambert_pdf_w(bsdf, wi);
}

static inline struct lobe_value oren_nayar_eval(const struct bsdf *bsdf, float3 wi)
{
    const float pdf_w = oren_nayar_pdf_w(bsdf, wi);
    if (pdf_w == 0.0f)
        return no_light();
    const float r = bsdf->roughness, scale = oren_nayar_scale(r);
    const float cos_o = clamp(dot(bsdf->wo, bsdf->shading), 0.0f, 1.0f);
    const float cos_i = clamp(dot(wi, bsdf->shading), 0.0f, 1.0f);
    const float s = dot(bsdf->wo, wi) - cos_o * cos_i;
    const float t = s > 0.0f ? fmax(cos_o, cos_i) : 1.0f;
    const float once = scale * (1.0f + r * s / t);
    const float often =
        scale * r * oren_nayar_g(cos_o) * oren_nayar_g(cos_i) / (OREN_NAYAR_C1 - OREN_NAYAR_C2);
    struct lobe_value lobe;
    lobe.value = pdf_w * (once * bsdf->kd + often * oren_nayar_interreflected(bsdf->kd, r));
    lobe.pdf_w = pdf_w;
    return lobe;
}

static inline struct lobe_sample oren_nayar_sample(const struct bsdf *bsdf, float3 u)
{
    struct lobe_sample sample = lambert_sample(bsdf, u);
    const struct lobe_value lobe = oren_nayar_eval(bsdf, sample.wi);
    sample.weight = lobe.pdf_w > 0.0f ? lobe.value / lobe.pdf_w : (float3)(0.0f);
    return sample;
}

static inline float3 oren_nayar_albedo(const struct bsdf *bsdf)
{
    const float r = bsdf->roughness;
    const float cos_o = clamp(dot(bsdf->wo, bsdf->shading), 0.0f, 1.0f);
    const float lost = oren_nayar_scale(r) * r * oren_nayar_g(cos_o);
    return mix(bsdf->kd, oren_nayar_interreflected(bsdf->kd, r), lost);
}

static inline void oren_nayar_keep(const struct bsdf *bsdf, global float *numbers)
{
    vstore3(bsdf->kd, 0, numbers);
    numbers[3] = bsdf->roughness;
}

static inline void oren_nayar_restore(struct bsdf *bsdf, global const float *numbers)
{
    bsdf->kd = row3(numbers);
    bsdf->roughness = numbers[3];
}

#endif
