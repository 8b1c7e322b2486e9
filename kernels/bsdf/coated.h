/*
 * coated.h - diffuse reflection below a coat: a Lambert surface under a clear dielectric layer, as
 * plastic, varnish and glazed ceramics have it.
 *
 *   fr = kd/pi ((1 - c) + c T(wo) T(wi) / (m^2 (1 - kd Fi))),   T(w) = (1 - F(w)) exp(-a / n.w')
 *
 * with c the part of the surface that is coated, m the index of the coat over that before it, a its
 * optical depth along the normal, 0 of a clear one, w' the direction inside of light along w, and F
 * what the coat reflects of it: the Fresnel reflectance, or, where it is rough, the albedo of its
 * facets, which the host tabulates as what they reflect more (types.h). Light enters the coat, is
 * scattered, and leaves it again; of what comes from below the coat throws back the part Fi, the
 * mean of the inner F over the hemisphere, and what it throws back is scattered anew: that sums to
 * 1 / (1 - kd Fi). So colours are deeper than without a coat; where the flag RT_MATERIAL_LINEAR
 * says that they stay as kd has them, the sum is 1 / (1 - Fi). 1/m^2 is the change of radiance from
 * inside to outside. A white surface below a clear coat reflects exactly what that does not: with
 * the coat's own reflection, c F, it passes the white-furnace test.
 *
 *   Fi = 1 - (1 - Fe) / m^2, with Fe the mean of the outer F, of a smooth coat by Walsh's formula
 *
 * of a clear coat. Of one that absorbs, with Fu the inner F at the cosine u,
 *
 *   Fi = int Fu exp(-2a/u) 2u du = 2 c^2 E3(2a/c) + int over [c,1],   c^2 = 1 - 1/m^2
 *
 * whose first part is reflected totally. The second, a few percent, and the mean of T are sums over
 * four cosines by Gauss's rule, to 3e-4 and 2e-3. What a rough coat throws back more crosses it
 * with the mean cosine.
 *
 * What a rough coat does not reflect enters it, so that light that meets two of its facets is not
 * lost. Where facets scatter light once, what they do not refract stays out, and Fi is the mean of
 * what those inside reflect, as Mitsuba 3 has it; masking and shadowing are independent then.
 * Directions are sampled by the cosine. The coat's reflection is the boundary of the BSDF. Where ks
 * lies below the coat, too (bsdf/lacquer.h), kd Fi is (kd + ks) Fi.
 *
 * References:
 *   Walsh: "The Reflection Factor of a Polished Glass Surface for Diffused Light", DSIR
 *     Illumination Research Technical Paper 2, 1926; as in Duntley: "The Optical Properties of
 *     Diffusing Materials", Journal of the Optical Society of America 32(2), 1942.
 *   Elias, Simonot: "Bi-directional Reflectance of a Varnished Painting", Optics Communications
 *     231, 2004.
 */
#ifndef RT_KERNELS_BSDF_COATED_H
#define RT_KERNELS_BSDF_COATED_H

#include "bsdf/lambert.h"
#include "bsdf/lobe.h"
#include "bsdf/multiple.h"
#include "math/width1.inc.h"
#include "bsdf/coated.inc.h"

#define RT_MEAN_COSINE 0.6666667f /* of diffuse light */

/* Fe for an index m > 1 over that before it. */
static inline float mean_outer_reflectance(float m)
{
    /* Near 1 the terms cancel; they are a straight line there, to 1e-4. */
    if (m < 1.01f)
        return (m - 1.0f) * 0.32f;
    const float m2 = m * m, m4 = m2 * m2, a = m2 + 1.0f, b = m4 - 1.0f;
    return 0.5f + (m - 1.0f) * (3.0f * m + 1.0f) / (6.0f * square(m + 1.0f)) +
           m2 * square(m2 - 1.0f) / (a * a * a) * log((m - 1.0f) / (m + 1.0f)) -
           2.0f * m * m2 * (m2 + 2.0f * m - 1.0f) / (a * b) +
           8.0f * m4 * (m4 + 1.0f) / (a * b * b) * log(m);
}

/* Fi: of light from below a coat of index m over that before it. */
static inline float mean_inner_reflectance(float m)
{
    return m < 1.0f ? mean_outer_reflectance(1.0f / m)
                    : 1.0f - (1.0f - mean_outer_reflectance(m)) / (m * m);
}

/* The host's table of what a rough coat reflects more than a smooth one; NULL: it is smooth. */
static inline global const float *coat_excesses(const struct bsdf *bsdf)
{
    global const rt_material_data *material = bsdf->specular.material;
    struct multiple found;
    return bsdf->specular.coat.alpha >= RT_SMOOTH_ALPHA && material->facet_losses != 0u &&
                   find_losses(losses_of(material), bsdf->specular.eta, &found)
               ? found.above
               : NULL;
}

/* What it reflects more at this cosine, and Fi more. */
static inline float2 coat_excess_of(global const rt_material_data *material, float alpha,
                                    global const float *excesses, float cosine)
{
    return excesses ? loss_seen(losses_of(material), false, (float2)(alpha), RT_COAT_SPREAD,
                                excesses, (float3)(sqrt(1.0f - square(cosine)), 0.0f, cosine))
                    : (float2)(0.0f);
}

static inline float2 coat_excess(const struct bsdf *bsdf, global const float *excesses,
                                 float cosine)
{
    return coat_excess_of(bsdf->specular.material, bsdf->specular.coat.alpha, excesses, cosine);
}

/* Means over the hemisphere. */
struct coat_means {
    float3 inner;  /* Fi */
    float3 enters; /* T, of light from outside */
};

/* 2 E3(x), the exponential integral, for x >= 0, to 5e-5 of it; 0 beyond what is worth a sum. */
static inline float3 twice_e3(float3 depth)
{
    const float3 x = fmin(depth, 100.0f);
    const float3 above = fma(fma(fma(3.178888f, x, 15.12933f), x, 10.95466f), x, 1.0f);
    const float3 below =
        fma(fma(fma(fma(1.589699f, x, 12.31088f), x, 23.91105f), x, 11.93686f), x, 1.0f);
    return exp(-x) * above / below;
}

/*
 * Of a coat that absorbs; inner_excess: what a rough one has more of Fi. The four cosines are on
 * the side with the lower index, from which no light is reflected totally.
 * It takes values, as distribution.h says of others.
 */
RARELY_CALLED struct coat_means absorbing_means(global const rt_material_data *material,
                                                float alpha, float3 absorption, float eta,
                                                global const float *excesses, float inner_excess)
{
    const float cosines[4] = {0.06943184f, 0.33000948f, 0.66999052f, 0.93056816f};
    const float weights[4] = {0.17392742f, 0.32607258f, 0.32607258f, 0.17392742f};
    const float m = 1.0f / eta;
    const float3 scattered = left_by_coat(absorption, RT_MEAN_COSINE);
    struct coat_means means;
    means.inner = inner_excess * scattered * scattered;
    means.enters = (float3)(0.0f);
    if (m > 1.0f) {
        const float critical = sqrt(1.0f - square(eta));
        means.inner += square(critical) * twice_e3(absorption * (2.0f / critical));
    }
    for (uint i = 0u; i < 4u; i++) {
        const float weight = 2.0f * weights[i] * cosines[i];
        float beyond;
        const float reflected = fresnel(cosines[i], fmin(eta, m), &beyond);
        const float outside = m > 1.0f ? cosines[i] : beyond;
        const float3 left = left_by_coat(absorption, m > 1.0f ? beyond : cosines[i]);
        const float enters =
            1.0f - reflected - coat_excess_of(material, alpha, excesses, outside).x;
        means.inner += weight * fmin(square(eta), 1.0f) * reflected * left * left;
        means.enters += weight * fmin(square(m), 1.0f) * enters * left;
    }
    return means;
}

static inline struct coat_means coat_means(const struct bsdf *bsdf, global const float *excesses,
                                           float inner_excess)
{
    const struct specular *specular = &bsdf->specular;
    if (UNLIKELY(largest3(specular->coat.absorption) > 0.0f))
        return absorbing_means(specular->material, specular->coat.alpha, specular->coat.absorption,
                               specular->eta, excesses, inner_excess);
    const float m = 1.0f / specular->eta, inner = mean_inner_reflectance(m) + inner_excess;
    struct coat_means means;
    means.inner = (float3)(inner);
    means.enters = (float3)((1.0f - inner) * square(m));
    return means;
}

/* fr pi kd^-1 but for what depends on wi: the parts without a coat, and with one. */
struct coat_parts {
    float bare;
    float3 coated, enters; /* enters: as in struct coat_means */
    global const float *excesses;
};

/* T of light that comes with this cosine. */
static inline float3 enters_coat(const struct bsdf *bsdf, global const float *excesses,
                                 float cosine)
{
    float inside;
    const float outer = fresnel(cosine, bsdf->specular.eta, &inside);
    return (1.0f - outer - coat_excess(bsdf, excesses, cosine).x) *
           left_by_coat(bsdf->specular.coat.absorption, inside);
}

/* What scatters the light that is thrown back: kd, and of a lacquer about what ks does. */
static inline float3 base_albedo(const struct bsdf *bsdf)
{
    return is_lacquered(bsdf->specular.material)
               ? bsdf->kd + reflected_below(&bsdf->specular, RT_MEAN_COSINE)
               : bsdf->kd;
}

static inline struct coat_parts coat_parts_of(const struct bsdf *bsdf)
{
    const float eta = bsdf->specular.eta, coat = bsdf->specular.coat.amount;
    const float cosine = clamp(dot(bsdf->wo, bsdf->shading), 0.0f, 1.0f);
    float inside;
    struct coat_parts parts;
    parts.excesses = coat_excesses(bsdf);
    const float2 excess = coat_excess(bsdf, parts.excesses, cosine);
    const struct coat_means means = coat_means(bsdf, parts.excesses, excess.y);
    const float enters = 1.0f - fresnel(cosine, eta, &inside) - excess.x;
    parts.bare = 1.0f - coat;
    parts.enters = means.enters;
    const bool is_linear = bsdf->specular.material->flags & RT_MATERIAL_LINEAR;
    const float3 thrown_back = means.inner * (is_linear ? (float3)(1.0f) : base_albedo(bsdf));
    parts.coated = through_coat(coat * square(eta) * enters, thrown_back) *
                   left_by_coat(bsdf->specular.coat.absorption, inside);
    return parts;
}

static inline float coated_pdf_w(const struct bsdf *bsdf, float3 wi)
{
    return lambert_pdf_w(bsdf, wi);
}

static inline struct lobe_value coated_eval(const struct bsdf *bsdf, float3 wi)
{
    const float pdf_w = coated_pdf_w(bsdf, wi);
    if (pdf_w == 0.0f)
        return no_light();
    const struct coat_parts parts = coat_parts_of(bsdf);
    const float cosine = clamp(dot(wi, bsdf->shading), 0.0f, 1.0f);
    struct lobe_value lobe;
    lobe.value =
        pdf_w * bsdf->kd * (parts.bare + enters_coat(bsdf, parts.excesses, cosine) * parts.coated);
    lobe.pdf_w = pdf_w;
    return lobe;
}

static inline struct lobe_sample coated_sample(const struct bsdf *bsdf, float3 u)
{
    struct lobe_sample sample = lambert_sample(bsdf, u);
    const struct lobe_value lobe = coated_eval(bsdf, sample.wi);
    sample.weight = lobe.pdf_w > 0.0f ? lobe.value / lobe.pdf_w : (float3)(0.0f);
    return sample;
}

/* The mean of 1 - F over wi is that of light which leaves the coat, by m^2: (1 - Fi) m^2. */
static inline float3 coated_albedo(const struct bsdf *bsdf)
{
    const struct coat_parts parts = coat_parts_of(bsdf);
    return bsdf->kd * (parts.bare + parts.enters * parts.coated);
}

static inline void coated_keep(const struct bsdf *bsdf, global float *numbers)
{
    const struct specular *specular = &bsdf->specular;
    vstore3(bsdf->kd, 0, numbers);
    vstore3(specular->ks, 0, numbers + 3);
    numbers[6] = specular->coat.amount;
    numbers[7] = specular->coat.alpha;
    numbers[8] = specular->eta;
    vstore3(specular->coat.absorption, 0, numbers + 9);
}

static inline void coated_restore(struct bsdf *bsdf, global const float *numbers)
{
    struct specular *specular = &bsdf->specular;
    bsdf->kd = row3(numbers);
    specular->ks = row3(numbers + 3);
    specular->coat.amount = numbers[6];
    specular->coat.alpha = numbers[7];
    specular->eta = numbers[8];
    specular->coat.absorption = row3(numbers + 9);
}

#endif
