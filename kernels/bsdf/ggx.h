/*
 * ggx.h - the lobe of a rough boundary: reflection and refraction by microfacets, of GGX unless the
 * material has others (distribution.h).
 *
 *   reflected   fr |n.wi| = R(wo.h) D(h) G2(wo, wi) / (4 n.wo)
 *   refracted   fr |n.wi| = T(wo.h) D(h) G2(wo, wi) |wo.h| |wi.h| / (n.wo (eta wo.h + wi.h)^2)
 *
 * Each facet is a smooth boundary about its own normal h, which scatters light once. What would
 * meet a second facet is scattered on as multiple.h says, or, where the material has no losses
 * there, it is lost: this percentage of the light that a rough surface receives.
 *
 *   alpha                                         0.01   0.1    0.2    0.5    1
 *   white metal, normal view / all directions     0/0    1/3    5/8   31/30  69/59  %
 *   clear glass, normal view / all directions     0/0    0/1    1/2    3/8   10/20  %
 *   the same from inside                          0/0    1/3    4/10  24/30  58/52  %
 *
 * The functions named facets_ are in the frame of the surface, wo.z > 0, or 0 by rounding. eta is
 * the index on the side of wo over that on the other. Refracted light is given as flux there;
 * radiance is to be scaled by eta^2.
 *
 * References:
 *   Walter, Marschner, Li, Torrance: "Microfacet Models for Refraction through Rough Surfaces",
 *     EGSR 2007.
 *   Heitz: "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 3(2),
 *     2014.
 */
#ifndef RT_KERNELS_BSDF_GGX_H
#define RT_KERNELS_BSDF_GGX_H

#include "bsdf/distribution.h"
#include "bsdf/lobe.h"
#include "bsdf/multiple.h"

/*
 * With indices as close as this, refraction hardly bends light: its density is too narrow for
 * float32, so it is not light-sampled, like a delta lobe.
 */
#define RT_MATCHED_INDEX 1e-2f

static inline bool is_matched(const struct specular *specular)
{
    return fabs(1.0f - specular->eta) < RT_MATCHED_INDEX;
}

/*
 * G2 / G1, the probability that a microfacet visible from wo is not shadowed from wi; for
 * correlated heights, (1 + Lambda(wo)) / (1 + Lambda(wo) + Lambda(wi)), times |wo.z wi.z| above and
 * below.
 */
static inline float unshadowed(const struct specular *specular, float3 wo, float3 wi)
{
    const float seen = facing_area(specular, wo) * fabs(wi.z);
    return seen / (seen + fabs(wo.z) * hidden_area(specular, wi));
}

/*
 * The density of wi by facets of normal h: that of visible normals, times dh/dwi (Walter et al.,
 * eqs. 14 and 17).
 */
static inline float facet_pdf_w(const struct specular *specular, float3 wo, float3 wi, float3 h)
{
    const float visible = facet_density(specular, h) / facing_area(specular, wo);
    if (wi.z > 0.0f)
        return 0.25f * visible;
    const float cos_o = dot(wo, h), cos_i = dot(wi, h);
    return visible * cos_o * fabs(cos_i) / square(specular->eta * cos_o + cos_i);
}

/*
 * The normal of the facets by which light goes from wi to wo, the half vector; false: there are
 * none, or wo or wi is on their wrong side.
 */
static inline bool facet_between(const struct specular *specular, float3 wo, float3 wi, float3 *h)
{
    const bool reflects = wi.z > 0.0f;
    *h = unit(reflects ? wo + wi : specular->eta * wo + wi);
    *h = h->z < 0.0f ? -*h : *h;
    const float cos_i = dot(wi, *h);
    return wi.z != 0.0f && dot(wo, *h) > 0.0f &&
           (reflects ? cos_i > 0.0f : cos_i < 0.0f && !is_matched(specular));
}

/*
 * fr |n.wi| and the density of wi, for reflection or refraction depending on the side of wi, of
 * light that is scattered once.
 */
static inline struct lobe_value once_eval(const struct specular *specular, float3 wo, float3 wi)
{
    const bool reflects = wi.z > 0.0f;
    float3 h;
    if (!facet_between(specular, wo, wi, &h))
        return no_light();
    const struct split split = split_light(specular, dot(wo, h));
    const float facets = facet_pdf_w(specular, wo, wi, h);
    struct lobe_value lobe;
    lobe.pdf_w = facets * (reflects ? split.probability : 1.0f - split.probability);
    lobe.value =
        (reflects ? split.reflected : split.refracted) * (facets * unshadowed(specular, wo, wi));
    return lobe;
}

static inline float once_pdf_w(const struct specular *specular, float3 wo, float3 wi)
{
    float3 h;
    if (!facet_between(specular, wo, wi, &h))
        return 0.0f;
    const float reflection = reflection_probability(specular, dot(wo, h));
    return facet_pdf_w(specular, wo, wi, h) * (wi.z > 0.0f ? reflection : 1.0f - reflection);
}

/*
 * Samples a direction: the facet by u.xy among those that wo sees, reflection or refraction by u.z.
 * Writes the density of wi, 0 for what counts as smooth, and returns fr |n.wi| over the true
 * density; 0: the light is lost.
 */
static inline float3 once_sample(const struct specular *specular, float3 wo, float3 u, float3 *wi,
                                 float *pdf_w)
{
    const float3 h = sample_facet(specular, wo, u.xy);
    const float cos_o = dot(wo, h);
    const struct split split = split_light(specular, cos_o);
    const bool reflects = u.z < split.probability;
    const float probability = reflects ? split.probability : 1.0f - split.probability;
    *wi = unit(reflects ? 2.0f * cos_o * h - wo
                        : (specular->eta * cos_o - split.cos_t) * h - specular->eta * wo);
    *pdf_w = 0.0f;
    if (cos_o <= 0.0f || (reflects ? wi->z <= 0.0f : wi->z >= 0.0f))
        return (float3)(0.0f);
    if (reflects || !is_matched(specular))
        *pdf_w = probability * facet_pdf_w(specular, wo, *wi, h);
    return (reflects ? split.reflected : split.refracted) *
           (unshadowed(specular, wo, *wi) / probability);
}

/* ---- Once or often --------------------------------------------------------------- */

static inline struct lobe_value facets_eval(const struct specular *specular, float3 wo, float3 wi)
{
    const struct lobe_value once = once_eval(specular, wo, wi);
    if (!scatters_often(specular))
        return once;
    const struct multiple multiple = multiple_of(specular, wo);
    return add_multiple(specular, &multiple, once, wi);
}

static inline float facets_pdf_w(const struct specular *specular, float3 wo, float3 wi)
{
    struct lobe_value once = no_light();
    once.pdf_w = once_pdf_w(specular, wo, wi);
    if (!scatters_often(specular))
        return once.pdf_w;
    const struct multiple multiple = multiple_of(specular, wo);
    return add_multiple(specular, &multiple, once, wi).pdf_w;
}

/* As once_sample; u.z chooses how often light is scattered, too. */
static inline float3 sample_often(const struct specular *specular, float3 wo, float3 u, float3 *wi,
                                  float *pdf_w)
{
    const struct multiple multiple = multiple_of(specular, wo);
    const float often = multiple.probability, rest = 1.0f - often;
    struct lobe_value lobe;
    if (u.z < often) {
        *wi = sample_lost(both_alphas(specular), u.xy);
        wi->z = u.z < often * multiple.share ? wi->z : -wi->z;
        lobe = once_eval(specular, wo, *wi);
    } else {
        const float z = fmin((u.z - often) / rest, RT_BELOW_ONE);
        const float3 weight = once_sample(specular, wo, (float3)(u.xy, z), wi, &lobe.pdf_w);
        lobe.value = weight * lobe.pdf_w;
        *pdf_w = lobe.pdf_w;
        if (lobe.pdf_w == 0.0f)
            return weight / rest;
    }
    lobe = add_multiple(specular, &multiple, lobe, *wi);
    *pdf_w = lobe.pdf_w;
    return lobe.pdf_w > 0.0f ? lobe.value / lobe.pdf_w : (float3)(0.0f);
}

static inline float3 facets_sample(const struct specular *specular, float3 wo, float3 u, float3 *wi,
                                   float *pdf_w)
{
    return scatters_often(specular) ? sample_often(specular, wo, u, wi, pdf_w)
                                    : once_sample(specular, wo, u, wi, pdf_w);
}

/* For a path that carries radiance. */
INLINE_ALWAYS struct lobe_value ggx_eval(const struct bsdf *bsdf, float3 wi)
{
    const struct frame frame = facet_frame(&bsdf->specular);
    const float3 wi_local = frame_to_local(frame, wi);
    struct lobe_value lobe =
        facets_eval(&bsdf->specular, frame_to_local(frame, bsdf->wo), wi_local);
    const bool above = wi_local.z > 0.0f;
    const float kept = above == (dot(wi, bsdf->normal) > 0.0f) ? 1.0f : 0.0f;
    lobe.value *= kept * (above ? 1.0f : square(bsdf->specular.eta));
    lobe.pdf_w *= kept;
    return lobe;
}

INLINE_NEVER float ggx_pdf_w(const struct bsdf *bsdf, float3 wi)
{
    const struct frame frame = facet_frame(&bsdf->specular);
    const float3 wi_local = frame_to_local(frame, wi);
    const bool is_kept = (wi_local.z > 0.0f) == (dot(wi, bsdf->normal) > 0.0f);
    return is_kept ? facets_pdf_w(&bsdf->specular, frame_to_local(frame, bsdf->wo), wi_local)
                   : 0.0f;
}

static inline struct lobe_sample ggx_sample(const struct bsdf *bsdf, float3 u)
{
    const struct frame frame = facet_frame(&bsdf->specular);
    float3 wi_local;
    struct lobe_sample sample;
    const float3 weight = facets_sample(&bsdf->specular, frame_to_local(frame, bsdf->wo), u,
                                        &wi_local, &sample.pdf_w);
    sample.wi = unit(frame_to_world(frame, wi_local));
    sample.through = wi_local.z < 0.0f;
    sample.weight =
        sample.through == (dot(sample.wi, bsdf->normal) < 0.0f) ? weight : (float3)(0.0f);
    return sample;
}

/* That of the smooth boundary, an upper bound: what facets lose is not subtracted. */
static inline float3 ggx_albedo(const struct bsdf *bsdf)
{
    return bsdf->reflected + bsdf->refracted;
}

#endif
