/*
 * principled_diffuse.h - the diffuse lobe of a principled material: Disney's diffuse reflection,
 * its imitation of subsurface scattering, and sheen.
 *
 *   fr = kd/pi mix(d + r, s, flatness) + sheen Ws c (1 - cos td)^5
 *   d = (1 - Wo/2) (1 - Wi/2),   r = Rr (Wo + Wi + Wo Wi (Rr - 1)),   Rr = 2 roughness cos^2 td
 *   s = 5/4 (S (1 / (n.wo + n.wi) - 1/2) + 1/2),   S = mix(1, Rr/2, Wo) mix(1, Rr/2, Wi)
 *
 * with W = (1 - n.w)^5 Schlick's weight of a direction, and td half of the angle between wo and wi:
 * 2 cos^2 td = 1 + wo.wi. kd is base_color (1 - metallic) (1 - spec_trans), of a sheet base_color
 * (1 - spec_trans). The weight Ws of sheen is 1 - metallic, of a sheet 1 - spec_trans, and its
 * colour c is mix(1, base_color / its luminance, sheen_tint). Of a sheet the part diff_trans / 2 of
 * all this goes through it instead (principled_thin.h). The lobe is reciprocal. It keeps no
 * account of energy: what a white surface of roughness 1 reflects of light at grazing angles is
 * more than arrives (theory.md). Directions are sampled by the cosine.
 *
 * The albedo of d + r is a polynomial of n.wo; that of s is an upper bound, and that of sheen a
 * fit, to 4 % of it.
 *
 * References:
 *   Burley: "Physically Based Shading at Disney", SIGGRAPH 2012 courses (d, r, sheen, s).
 *   Burley: "Extending the Disney BRDF to a BSDF with Integrated Subsurface Scattering", SIGGRAPH
 *     2015 courses (d and r as a product and a sum).
 *   Jakob et al.: Mitsuba 3, principled.cpp and principledthin.cpp, 2022 (how the parts are
 *     weighted).
 */
#ifndef RT_KERNELS_BSDF_PRINCIPLED_DIFFUSE_H
#define RT_KERNELS_BSDF_PRINCIPLED_DIFFUSE_H

#include "bsdf/fresnel.h"
#include "bsdf/lambert.h"
#include "bsdf/lobe.h"

/* A colour of luminance 1, by the primaries of sRGB; of black, white. */
static inline float3 tint_of(float3 colour)
{
    const float luminance = dot(colour, (float3)(0.212671f, 0.71516f, 0.072169f));
    return luminance > 0.0f ? colour / luminance : (float3)(1.0f);
}

/* What is scattered: kd, and sheen; the part of a sheet that reflects is in both. */
struct principled_colours {
    float3 kd, sheen;
};

static inline struct principled_colours principled_colours_of(const struct bsdf *bsdf)
{
    const struct principled part = bsdf->specular.principled;
    const float kept = is_thin(bsdf->specular.material) ? 1.0f - 0.5f * part.diff_trans : 1.0f;
    struct principled_colours colours;
    colours.kd = kept * bsdf->kd;
    colours.sheen = kept * part.sheen * mix((float3)(1.0f), tint_of(bsdf->kd), part.sheen_tint);
    return colours;
}

/* The factors of kd/pi and of sheen, for these cosines to the normal and between the two. */
RARELY_CALLED float2 principled_factors(float roughness, float flatness, float cos_o, float cos_i,
                                        float between)
{
    const float wo = schlick_weight(cos_o), wi = schlick_weight(cos_i);
    const float both = fmax(1.0f + between, 0.0f), rr = roughness * both;
    const float base = (1.0f - 0.5f * wo) * (1.0f - 0.5f * wi);
    const float retro = rr * (wo + wi + wo * wi * (rr - 1.0f));
    const float s = mix(1.0f, 0.5f * rr, wo) * mix(1.0f, 0.5f * rr, wi);
    const float below = 1.25f * (s * (1.0f / fmax(cos_o + cos_i, 1e-6f) - 0.5f) + 0.5f);
    return (float2)(mix(base + retro, below, flatness), schlick_weight(sqrt(0.5f * both)));
}

/* Their albedos, for light that is seen along this cosine. */
RARELY_CALLED float2 principled_factor_albedos(float roughness, float flatness, float c)
{
    const float w = schlick_weight(c), r = roughness, x = 1.0f - c;
    /* The integrals of (1 - u)^5 u^n 2 du from 0 to 1. */
    const float m1 = 1.0f / 21.0f, m2 = 1.0f / 84.0f, m3 = 1.0f / 252.0f;
    const float base = (1.0f - 0.5f * w) * (1.0f - 0.5f * m1);
    const float once = (m1 + c * m2) * (1.0f - w) + w * (1.0f + c * (2.0f / 3.0f));
    const float twice = m1 + 2.0f * c * m2 + c * c * m3 + 0.5f * (1.0f - c * c) * (m1 - m3);
    const float retro = r * once + r * r * w * twice;
    const float least = fmax(c, 1e-4f);
    const float below = 2.5f * (1.0f - least * log(1.0f + 1.0f / least)) *
                        (1.0f - w * (1.0f - 0.5f * r * (1.0f + c)));
    const float sheen = 2.5237e-4f + x * (7.37297e-3f + x * (0.01665394f + x * 0.06141107f));
    return (float2)(mix(base + retro, below, flatness), sheen);
}

static inline float principled_diffuse_pdf_w(const struct bsdf *bsdf, float3 wi)
{
    return lambert_pdf_w(bsdf, wi);
}

static inline struct lobe_value principled_diffuse_eval(const struct bsdf *bsdf, float3 wi)
{
    const float pdf_w = principled_diffuse_pdf_w(bsdf, wi);
    if (pdf_w == 0.0f)
        return no_light();
    const float cos_o = clamp(dot(bsdf->wo, bsdf->shading), 0.0f, 1.0f);
    const float cos_i = clamp(dot(wi, bsdf->shading), 0.0f, 1.0f);
    const float2 factors = principled_factors(bsdf->roughness, bsdf->specular.principled.flatness,
                                              cos_o, cos_i, dot(bsdf->wo, wi));
    const struct principled_colours colours = principled_colours_of(bsdf);
    struct lobe_value lobe;
    lobe.value = pdf_w * (factors.x * colours.kd + RT_PI * factors.y * colours.sheen);
    lobe.pdf_w = pdf_w;
    return lobe;
}

static inline struct lobe_sample principled_diffuse_sample(const struct bsdf *bsdf, float3 u)
{
    struct lobe_sample sample = lambert_sample(bsdf, u);
    const struct lobe_value lobe = principled_diffuse_eval(bsdf, sample.wi);
    sample.weight = lobe.pdf_w > 0.0f ? lobe.value / lobe.pdf_w : (float3)(0.0f);
    return sample;
}

static inline float3 principled_diffuse_albedo(const struct bsdf *bsdf)
{
    const float cosine = clamp(dot(bsdf->wo, bsdf->shading), 0.0f, 1.0f);
    const float2 albedos =
        principled_factor_albedos(bsdf->roughness, bsdf->specular.principled.flatness, cosine);
    const struct principled_colours colours = principled_colours_of(bsdf);
    return albedos.x * colours.kd + albedos.y * colours.sheen;
}

static inline void principled_diffuse_keep(const struct bsdf *bsdf, global float *numbers)
{
    const struct principled *part = &bsdf->specular.principled;
    vstore3(bsdf->kd, 0, numbers);
    numbers[3] = bsdf->roughness;
    numbers[4] = part->sheen;
    numbers[5] = part->sheen_tint;
    numbers[6] = part->flatness;
    numbers[7] = part->diff_trans;
}

static inline void principled_diffuse_restore(struct bsdf *bsdf, global const float *numbers)
{
    struct principled *part = &bsdf->specular.principled;
    bsdf->kd = row3(numbers);
    bsdf->roughness = numbers[3];
    part->sheen = numbers[4];
    part->sheen_tint = numbers[5];
    part->flatness = numbers[6];
    part->diff_trans = numbers[7];
}

#endif
