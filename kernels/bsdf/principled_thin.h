/*
 * principled_thin.h - the rough lobe of a principled sheet: what it reflects, what goes through it
 * as through frosted glass, and what goes through diffusely.
 *
 *   reflected   fr |n.wi| = R(wo.h) D(h) G1(wo) G1(wi) / (4 n.wo)
 *   through     fr |n.wi| = s b (1 - F(wo.h')) D'(h') G1'(wo) G1'(wi) / (4 n.wo)
 *   diffusely   fr |n.wi| = b (1 - s) diff_trans/2 |n.wi| / pi
 *
 * with the names of principled_solid.h, h' the half vector of wo and of wi mirrored by the surface,
 * and D' and G1' facets of the roughness (0.65 ior - 0.35) roughness: light is bent twice, and
 * spreads less than by reflection where ior is low. R = s mix(F, S, t), where S is Schlick's
 * reflectance from b' ((eta - 1)/(eta + 1))^2 to 1. What is diffuse and stays on the side of wo is
 * in principled_diffuse.h.
 *
 * As in Mitsuba, light from wi goes through facets only where wi.h' < 0: where it comes from the
 * back of the facet, too. That is not reciprocal; flux has the condition for the direction that it
 * comes from. Elsewhere the lobe is reciprocal.
 *
 * References:
 *   Burley: "Extending the Disney BRDF to a BSDF with Integrated Subsurface Scattering", SIGGRAPH
 *     2015 courses (thin surfaces).
 *   Jakob et al.: Mitsuba 3, principledthin.cpp, 2022.
 */
#ifndef RT_KERNELS_BSDF_PRINCIPLED_THIN_H
#define RT_KERNELS_BSDF_PRINCIPLED_THIN_H

#include "bsdf/principled_solid.h"

/* What goes through diffusely, of all light. */
static inline float3 transmitted_diffusely(const struct bsdf *bsdf)
{
    return is_thin(bsdf->specular.material) ? 0.5f * bsdf->specular.principled.diff_trans * bsdf->kd
                                            : (float3)(0.0f);
}

/* How often each of the three is sampled, as seen from wo. */
struct thin_shares {
    float reflects, passes, diffuses;
};

static inline struct thin_shares thin_shares_of(const struct bsdf *bsdf, float3 wo)
{
    const struct split split = principled_split(&bsdf->specular, clamp(wo.z, 0.0f, 1.0f));
    const float r = mean3(split.reflected), t = mean3(split.refracted);
    const float d = mean3(transmitted_diffusely(bsdf)), sum = r + t + d;
    /* Facets of other angles split light otherwise. */
    const float reflects = r * t > 0.0f ? clamp(r / (r + t), 0.1f, 0.9f) : r > 0.0f ? 1.0f : 0.0f;
    struct thin_shares shares;
    shares.diffuses = sum > 0.0f ? d / sum : 0.0f;
    shares.reflects = sum > 0.0f ? reflects * (r + t) / sum : 0.0f;
    shares.passes = sum > 0.0f ? (1.0f - reflects) * (r + t) / sum : 0.0f;
    return shares;
}

/* The facets by which light goes through. */
static inline struct specular facets_through(const struct bsdf *bsdf)
{
    struct specular facets = bsdf->specular;
    const float narrowed = square(0.65f * facets.material->ior - 0.35f);
    facets.alpha = fmax(narrowed * facets.alpha, RT_SMOOTH_ALPHA);
    facets.alpha_v = fmax(narrowed * facets.alpha_v, RT_SMOOTH_ALPHA);
    return facets;
}

static inline float3 mirrored(float3 w)
{
    return (float3)(w.xy, -w.z);
}

/* Whether facets of normal h let light from wi, mirrored, to wo: by where the light comes from. */
static inline bool facets_pass(const struct bsdf *bsdf, float3 wo, float3 below, float3 h)
{
    return dot(bsdf->transport == CARRY_FLUX ? wo : below, mirrored(h)) < 0.0f;
}

static inline struct lobe_value thin_through(const struct bsdf *bsdf, float3 wo, float3 wi,
                                             const struct thin_shares *shares)
{
    const struct specular facets = facets_through(bsdf);
    const float3 below = mirrored(wi), h = unit(wo + below);
    const struct split split = principled_split(&facets, dot(wo, h));
    const float passing =
        facets_pass(bsdf, wo, below, h) ? facet_pdf_w(&facets, wo, below, h) : 0.0f;
    const float diffuse = cosine_pdf_w(below.z);
    struct lobe_value lobe;
    lobe.value = split.refracted * (passing * facets_seen(&facets, below)) +
                 transmitted_diffusely(bsdf) * diffuse;
    lobe.pdf_w = shares->passes * passing + shares->diffuses * diffuse;
    return lobe;
}

static inline struct lobe_value thin_reflected(const struct bsdf *bsdf, float3 wo, float3 wi,
                                               const struct thin_shares *shares)
{
    const float3 h = unit(wo + wi);
    const struct split split = principled_split(&bsdf->specular, dot(wo, h));
    const float facets = facet_pdf_w(&bsdf->specular, wo, wi, h);
    struct lobe_value lobe;
    lobe.value = split.reflected * (facets * facets_seen(&bsdf->specular, wi));
    lobe.pdf_w = shares->reflects * facets;
    return lobe;
}

static inline struct lobe_value thin_eval(const struct bsdf *bsdf, float3 wo, float3 wi)
{
    const struct thin_shares shares = thin_shares_of(bsdf, wo);
    if (wi.z == 0.0f || !(wo.z > 0.0f))
        return no_light();
    return wi.z > 0.0f ? thin_reflected(bsdf, wo, wi, &shares)
                       : thin_through(bsdf, wo, wi, &shares);
}

/* A direction by u in [0,1)^3: which of the three by u.z. */
static inline float3 thin_direction(const struct bsdf *bsdf, float3 wo, float3 u)
{
    const struct thin_shares shares = thin_shares_of(bsdf, wo);
    if (u.z < shares.diffuses)
        return mirrored(sample_cosine(u.xy));
    const bool reflects = u.z < shares.diffuses + shares.reflects;
    const struct specular facets = reflects ? bsdf->specular : facets_through(bsdf);
    const float3 h = sample_facet(&facets, wo, u.xy);
    const float3 wi = unit(2.0f * dot(wo, h) * h - wo);
    /* What is reflected to below is lost, and so is what would pass to above, or does not pass. */
    if (!(wi.z > 0.0f && (reflects || facets_pass(bsdf, wo, wi, h))))
        return (float3)(0.0f);
    return reflects ? wi : mirrored(wi);
}

static inline float3 thin_sample(const struct bsdf *bsdf, float3 wo, float3 u, float3 *wi,
                                 float *pdf_w)
{
    *wi = thin_direction(bsdf, wo, u);
    *pdf_w = 0.0f;
    if (wi->z == 0.0f) {
        *wi = wo;
        return (float3)(0.0f);
    }
    const struct lobe_value lobe = thin_eval(bsdf, wo, *wi);
    *pdf_w = lobe.pdf_w;
    return lobe.pdf_w > 0.0f ? lobe.value / lobe.pdf_w : (float3)(0.0f);
}

#endif
