/*
 * fuzz.h - cloth: a diffuse surface below a layer of fuzz, fibres that stand up and are brightest
 * where light or the eye grazes them.
 *
 *   fr = f c D V + kd/pi (1 - s E(n.wo)) (1 - s E(n.wi)) / (1 - s Em)
 *   D = (2 + 1/a) sin^(1/a) h / (2 pi),   V = 1 / (4 (n.wo) (n.wi) (1 + L(n.wo) + L(n.wi)))
 *
 * with f the colour of the fuzz, `second`, s its largest channel, a the square of its roughness, h
 * the angle from the normal to the half vector, and L the masking that Estevez and Kulla fitted:
 *
 *   L(u) = exp l(u) where u < 1/2, else exp(2 l(1/2) - l(1 - u)),   l(u) = A/(1 + B u^C) + D u + E
 *
 * Their fit reflects more than arrives where a rough fuzz is below 0.26, at grazing angles; c, 1
 * above that, scales it so that no more than all is. V of Ashikhmin, which is used for this
 * distribution, too, does so up to a roughness of 0.45. E is the albedo of c D V at a cosine, and
 * Em its mean, 2 int E(u) u du: what fuzz does not reflect enters the cloth, and leaves through it
 * again. So the lobe is reciprocal, white below white fuzz passes the white-furnace test as far as
 * E goes, and its albedo is f E + kd (1 - s E). E is c times the square of a polynomial of the
 * fourth root of the cosine and the square root of the roughness, to 2.5e-3 of all light. A
 * roughness below 0.1 counts as that, and a cosine below 0.005, in L, V and E.
 *
 * Directions are sampled by the cosine, as those of all diffuse lobes are, on which densities of
 * paths from the other end rely.
 *
 * References:
 *   Estevez, Kulla: "Production Friendly Microfacet Sheen BRDF", SIGGRAPH 2017 courses.
 *   Ashikhmin, Premoze: "Distribution-based BRDFs", 2007.
 *   Khronos Group: KHR_materials_sheen, glTF 2.0 (cloth below, which loses s E of one direction).
 */
#ifndef RT_KERNELS_BSDF_FUZZ_H
#define RT_KERNELS_BSDF_FUZZ_H

#include "bsdf/lambert.h"
#include "bsdf/lobe.h"

#define RT_LEAST_FUZZ 0.1f /* roughness */
#define RT_LEAST_FUZZ_COSINE 0.005f

/* c */
static inline float fuzz_scale(float roughness)
{
    return fmin(roughness / (0.19f + 0.27f * roughness), 1.0f);
}

/* l(u) for (1 - a)^2. */
static inline float fuzz_masking(float u, float smooth)
{
    const float4 at0 = (float4)(25.3245f, 3.32435f, 0.16801f, -1.27393f),
                 at1 = (float4)(21.5473f, 3.82987f, 0.19823f, -1.97760f);
    const float4 p = mix(at1, at0, smooth);
    return p.x / (1.0f + p.y * pow(u, p.z)) + p.w * u + mix(-4.32054f, -4.85967f, smooth);
}

/* L(u) */
static inline float fuzz_lambda(float u, float smooth)
{
    return u < 0.5f ? exp(fuzz_masking(u, smooth))
                    : exp(2.0f * fuzz_masking(0.5f, smooth) - fuzz_masking(1.0f - u, smooth));
}

/* c D V, for these cosines to the normal and between the two. */
RARELY_CALLED float fuzz_reflected(float roughness, float cos_o, float cos_i, float between)
{
    const float r = fmax(roughness, RT_LEAST_FUZZ), alpha = r * r, smooth = square(1.0f - alpha);
    const float o = fmax(cos_o, RT_LEAST_FUZZ_COSINE), i = fmax(cos_i, RT_LEAST_FUZZ_COSINE);
    const float sine2 = 1.0f - square(cos_o + cos_i) / fmax(2.0f + 2.0f * between, 1e-7f);
    const float d = (2.0f + 1.0f / alpha) * pow(clamp(sine2, 0.0f, 1.0f), 0.5f / alpha);
    const float masked = 1.0f + fuzz_lambda(o, smooth) + fuzz_lambda(i, smooth);
    return fuzz_scale(r) * d / (8.0f * RT_PI * o * i * masked);
}

/* E of a cosine. */
RARELY_CALLED float fuzz_albedo_at(float roughness, float cosine)
{
    const float4 c5 = (float4)(0.0153553f, -0.00490185f, -0.124909f, 0.0373127f),
                 c4 = (float4)(-0.130488f, 0.00475883f, 0.246379f, 0.0328078f),
                 c3 = (float4)(0.025376f, 0.174732f, -0.104082f, -0.216422f),
                 c2 = (float4)(0.104663f, -0.356705f, -0.0485712f, 0.225457f),
                 c1 = (float4)(0.113429f, 0.281363f, 0.0746893f, -0.0680914f),
                 c0 = (float4)(0.665814f, -0.40464f, -0.115959f, 0.0111648f);
    const float r = fmax(roughness, RT_LEAST_FUZZ), y = 2.9249506f * sqrt(r) - 1.9249506f;
    const float x = 2.7244794f * sqrt(sqrt(clamp(cosine, RT_LEAST_FUZZ_COSINE, 1.0f))) - 1.7244794f;
    const float4 a = fma(fma(fma(fma(fma(c5, y, c4), y, c3), y, c2), y, c1), y, c0);
    const float high = fma(fma(0.0643612f, y, -0.0895855f), y, -0.0449844f);
    const float a4 = fma(fma(fma(high, y, 0.126415f), y, -0.0501953f), y, -0.0424646f);
    const float root = fma(fma(fma(fma(a4, x, a.w), x, a.z), x, a.y), x, a.x);
    return fmin(fuzz_scale(r) * square(root), 1.0f);
}

/* Em, to 4e-4. */
static inline float fuzz_mean_albedo(float roughness)
{
    const float r = fmax(roughness, RT_LEAST_FUZZ), y = 2.9249506f * sqrt(r) - 1.9249506f;
    const float high = fma(fma(-0.0320753f, y, -0.0421925f), y, 0.0370089f);
    return fuzz_scale(r) * square(fma(fma(high, y, 0.242144f), y, 0.34227f));
}

/* What the lobe is made of, as seen from wo. */
struct fuzz_parts {
    float3 colour; /* f */
    float most;    /* s */
    float albedo;  /* E */
    float3 below;  /* the albedo of what kd scatters */
};

static inline struct fuzz_parts fuzz_parts_of(const struct bsdf *bsdf)
{
    struct fuzz_parts parts;
    parts.colour = fmin(bsdf->second, 1.0f);
    parts.most = largest3(parts.colour);
    parts.albedo = fuzz_albedo_at(bsdf->roughness, dot(bsdf->wo, bsdf->shading));
    parts.below = bsdf->kd * (1.0f - parts.most * parts.albedo);
    return parts;
}

static inline float fuzz_pdf_w(const struct bsdf *bsdf, float3 wi)
{
    return lambert_pdf_w(bsdf, wi);
}

static inline struct lobe_value fuzz_eval(const struct bsdf *bsdf, float3 wi)
{
    const float pdf_w = fuzz_pdf_w(bsdf, wi);
    if (pdf_w == 0.0f)
        return no_light();
    const struct fuzz_parts parts = fuzz_parts_of(bsdf);
    const float cos_o = clamp(dot(bsdf->wo, bsdf->shading), 0.0f, 1.0f);
    const float cos_i = clamp(dot(wi, bsdf->shading), 0.0f, 1.0f);
    const float above = fuzz_reflected(bsdf->roughness, cos_o, cos_i, dot(bsdf->wo, wi));
    const float enters = (1.0f - parts.most * fuzz_albedo_at(bsdf->roughness, cos_i)) /
                         (1.0f - parts.most * fuzz_mean_albedo(bsdf->roughness));
    struct lobe_value lobe;
    lobe.value = pdf_w * (RT_PI * above * parts.colour + enters * parts.below);
    lobe.pdf_w = pdf_w;
    return lobe;
}

static inline struct lobe_sample fuzz_sample(const struct bsdf *bsdf, float3 u)
{
    struct lobe_sample sample = lambert_sample(bsdf, u);
    const struct lobe_value lobe = fuzz_eval(bsdf, sample.wi);
    sample.weight = lobe.pdf_w > 0.0f ? lobe.value / lobe.pdf_w : (float3)(0.0f);
    return sample;
}

static inline float3 fuzz_albedo(const struct bsdf *bsdf)
{
    const struct fuzz_parts parts = fuzz_parts_of(bsdf);
    return parts.colour * parts.albedo + parts.below;
}

static inline void fuzz_keep(const struct bsdf *bsdf, global float *numbers)
{
    vstore3(bsdf->kd, 0, numbers);
    vstore3(bsdf->second, 0, numbers + 3);
    numbers[6] = bsdf->roughness;
}

static inline void fuzz_restore(struct bsdf *bsdf, global const float *numbers)
{
    bsdf->kd = row3(numbers);
    bsdf->second = row3(numbers + 3);
    bsdf->roughness = numbers[6];
}

#endif
