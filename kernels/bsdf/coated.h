/*
 * coated.h - diffuse reflection below a coat: a Lambert surface under a clear dielectric layer, as
 * plastic, varnish and glazed ceramics have it.
 *
 *   fr = kd/pi ((1 - c) + c (1 - F(n.wo)) (1 - F(n.wi)) / (m^2 (1 - kd Fi)))
 *
 * with c the part of the surface that is coated, m the index of the coat over that before it, and F
 * what the coat reflects of the light from there: the Fresnel reflectance, or, where it is rough,
 * the albedo of its facets, which the host tabulates as what they reflect more (types.h). Light
 * enters the coat, is scattered, and leaves it again; of what comes from below the coat throws back
 * the part Fi, the mean of the inner F over the hemisphere, and what it throws back is scattered
 * anew: that sums to 1 / (1 - kd Fi). So colours are deeper than without a coat; where the flag
 * RT_MATERIAL_LINEAR says that they stay as kd has them, the sum is 1 / (1 - Fi). 1/m^2 is the
 * change of radiance from inside to outside. A white surface below reflects exactly what the coat
 * does not: with the coat's own reflection, c F, it passes the white-furnace test.
 *
 *   Fi = 1 - (1 - Fe) / m^2, with Fe the mean of the outer F, of a smooth coat by Walsh's formula
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
static inline float2 coat_excess(const struct bsdf *bsdf, global const float *excesses,
                                 float cosine)
{
    return excesses ? loss_seen(losses_of(bsdf->specular.material), false,
                                (float2)(bsdf->specular.coat.alpha), RT_COAT_SPREAD, excesses,
                                (float3)(sqrt(1.0f - square(cosine)), 0.0f, cosine))
                    : (float2)(0.0f);
}

/* fr pi kd^-1 but for what depends on wi: the parts without a coat, and with one. */
struct coat_parts {
    float bare, inner; /* inner: Fi */
    float3 coated;
    global const float *excesses;
};

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
    float unused;
    struct coat_parts parts;
    parts.excesses = coat_excesses(bsdf);
    const float2 excess = coat_excess(bsdf, parts.excesses, cosine);
    parts.inner = mean_inner_reflectance(1.0f / eta) + excess.y;
    parts.bare = 1.0f - coat;
    const bool is_linear = bsdf->specular.material->flags & RT_MATERIAL_LINEAR;
    const float3 thrown_back = parts.inner * (is_linear ? (float3)(1.0f) : base_albedo(bsdf));
    parts.coated = coat * square(eta) * (1.0f - fresnel(cosine, eta, &unused) - excess.x) /
                   (1.0f - thrown_back);
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
    float unused;
    const float enters = 1.0f - fresnel(cosine, bsdf->specular.eta, &unused) -
                         coat_excess(bsdf, parts.excesses, cosine).x;
    struct lobe_value lobe;
    lobe.value = pdf_w * bsdf->kd * (parts.bare + enters * parts.coated);
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
    const float m = 1.0f / bsdf->specular.eta;
    const struct coat_parts parts = coat_parts_of(bsdf);
    const float enters = (1.0f - parts.inner) * square(m);
    return bsdf->kd * (parts.bare + enters * parts.coated);
}

static inline void coated_keep(const struct bsdf *bsdf, global float *numbers)
{
    const struct specular *specular = &bsdf->specular;
    vstore3(bsdf->kd, 0, numbers);
    vstore3(specular->ks, 0, numbers + 3);
    numbers[6] = specular->coat.amount;
    numbers[7] = specular->coat.alpha;
    numbers[8] = specular->eta;
}

static inline void coated_restore(struct bsdf *bsdf, global const float *numbers)
{
    struct specular *specular = &bsdf->specular;
    bsdf->kd = row3(numbers);
    specular->ks = row3(numbers + 3);
    specular->coat.amount = numbers[6];
    specular->coat.alpha = numbers[7];
    specular->eta = numbers[8];
}

#endif
