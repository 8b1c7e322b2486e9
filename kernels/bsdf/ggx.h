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

/* (wo.h) dh/dwi of facets of normal h (Walter et al., eqs. 14 and 17). */
static inline float facet_spread(const struct specular *specular, float3 wo, float3 wi, float3 h)
{
    if (wi.z > 0.0f)
        return 0.25f;
    const float cos_o = dot(wo, h), cos_i = dot(wi, h);
    return cos_o * fabs(cos_i) / square(specular->eta * cos_o + cos_i);
}

/* The density of wi by them, with that of visible normals. */
static inline float facet_pdf_w(const struct specular *specular, float3 wo, float3 wi, float3 h)
{
    return facet_density(specular, h) * facet_spread(specular, wo, wi, h) /
           facing_area(specular, wo);
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
 * For reflection or refraction depending on the side of wi, of light that is scattered once. Seen
 * from wi the facet is the same and reflects as much, and eta is 1 / eta.
 */
static inline struct facets_value once_eval(const struct specular *specular, float3 wo, float3 wi)
{
    const bool reflects = wi.z > 0.0f;
    struct facets_value facets;
    facets.value = (float3)(0.0f);
    facets.pdf_w = facets.back_pdf_w = 0.0f;
    float3 h;
    if (!facet_between(specular, wo, wi, &h))
        return facets;
    const struct split split = split_light(specular, dot(wo, h));
    const float density = facet_density(specular, h) * facet_spread(specular, wo, wi, h);
    const float chosen = reflects ? split.probability : 1.0f - split.probability;
    const float facing = facing_area(specular, wo), hidden = hidden_area(specular, wi);
    const float there = density / facing, back = density / (fabs(wi.z) + hidden);
    facets.pdf_w = there * chosen;
    facets.back_pdf_w = back * chosen * (reflects ? 1.0f : square(specular->eta));
    facets.value = (reflects ? split.reflected : split.refracted) *
                   (there * facet_unshadowed(specular, facing, hidden, wo, wi));
    return facets;
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
    const float lit =
        facet_unshadowed(specular, facing_area(specular, wo), hidden_area(specular, *wi), wo, *wi);
    return (reflects ? split.reflected : split.refracted) * (lit / probability);
}

/* ---- Once or often --------------------------------------------------------------- */

static inline struct facets_value facets_eval(const struct specular *specular, float3 wo, float3 wi)
{
    const struct facets_value once = once_eval(specular, wo, wi);
    return scatters_often(specular) ? with_multiple(specular, wo, wi, once) : once;
}

static inline float facets_pdf_w(const struct specular *specular, float3 wo, float3 wi)
{
    struct facets_value once;
    once.value = (float3)(0.0f);
    once.pdf_w = once_pdf_w(specular, wo, wi);
    once.back_pdf_w = 0.0f;
    return scatters_often(specular) ? with_multiple(specular, wo, wi, once).pdf_w : once.pdf_w;
}

/* As once_sample; u.z chooses how often light is scattered, too. */
static inline float3 sample_often(const struct specular *specular, float3 wo, float3 u, float3 *wi,
                                  float *pdf_w)
{
    const struct multiple multiple = multiple_of(specular, wo);
    const float often = often_probability(multiple.loss), rest = 1.0f - often;
    struct facets_value facets;
    if (u.z < often) {
        const float2 alpha = both_alphas(specular);
        *wi = sample_lost(alpha, lost_range(losses_of(specular->material), alpha), u.xy);
        wi->z = u.z < often * multiple.share ? wi->z : -wi->z;
        facets = once_eval(specular, wo, *wi);
    } else {
        const float z = fmin((u.z - often) / rest, RT_BELOW_ONE);
        const float3 weight = once_sample(specular, wo, (float3)(u.xy, z), wi, &facets.pdf_w);
        facets.value = weight * facets.pdf_w;
        facets.back_pdf_w = 0.0f;
        *pdf_w = facets.pdf_w;
        if (facets.pdf_w == 0.0f)
            return weight / rest;
    }
    facets = with_multiple(specular, wo, *wi, facets);
    *pdf_w = facets.pdf_w;
    return facets.pdf_w > 0.0f ? facets.value / facets.pdf_w : (float3)(0.0f);
}

static inline float3 facets_sample(const struct specular *specular, float3 wo, float3 u, float3 *wi,
                                   float *pdf_w)
{
    return scatters_often(specular) ? sample_often(specular, wo, u, wi, pdf_w)
                                    : once_sample(specular, wo, u, wi, pdf_w);
}

/* The same about the normal of the surface; the value for a path that carries radiance. */
INLINE_ALWAYS struct facets_value ggx_eval_both(const struct bsdf *bsdf, float3 wi)
{
    const struct frame frame = facet_frame(&bsdf->specular);
    const float3 wi_local = frame_to_local(frame, wi);
    struct facets_value facets =
        facets_eval(&bsdf->specular, frame_to_local(frame, bsdf->wo), wi_local);
    const bool above = wi_local.z > 0.0f;
    const float kept = above == (dot(wi, bsdf->normal) > 0.0f) ? 1.0f : 0.0f;
    facets.value *= kept * (above ? 1.0f : square(bsdf->specular.eta));
    facets.pdf_w *= kept;
    facets.back_pdf_w *= kept;
    return facets;
}

INLINE_ALWAYS struct lobe_value ggx_eval(const struct bsdf *bsdf, float3 wi)
{
    const struct facets_value facets = ggx_eval_both(bsdf, wi);
    struct lobe_value lobe;
    lobe.value = facets.value;
    lobe.pdf_w = facets.pdf_w;
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
