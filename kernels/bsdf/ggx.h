/*
 * rough.h - specular reflection and refraction, at a smooth boundary and at one of GGX microfacets.
 *
 * A smooth boundary reflects and refracts about its normal. A rough one is made of facets that do,
 * each by its own angle. Light is scattered once, and what would meet a second facet is lost, so a
 * rough surface never gains light, and is darker than a smooth one by this much of what it gets:
 *
 *   alpha                                         0.01   0.1    0.2    0.5    1
 *   white metal, normal view / all directions     0/0    1/3    5/8   31/30  69/59  %
 *   clear glass, normal view / all directions     0/0    0/1    1/2    3/8   10/20  %
 *   the same from inside                          0/0    1/3    4/10  24/30  58/52  %
 *
 * Directions are unit vectors in the frame of the surface, wo.z > 0, or 0 by rounding. eta is the
 * index on the side of wo over that on the other. Refracted light is given as flux; radiance is to
 * be scaled by eta^2.
 *
 * References:
 *   Walter, Marschner, Li, Torrance: "Microfacet Models for Refraction through Rough Surfaces",
 *     EGSR 2007.
 *   Heitz: "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 3(2),
 *     2014.
 */
#ifndef RT_KERNELS_BSDF_ROUGH_H
#define RT_KERNELS_BSDF_ROUGH_H

#include "bsdf/fresnel.h"
#include "bsdf/microfacet.h"
#include "types.h"

/*
 * With indices as close as this, refraction hardly bends light: its density is too narrow for
 * float32, and light sampling leaves it alone as it does a smooth boundary.
 */
#define RT_MATCHED_INDEX 1e-2f

/* The specular part of a material at one point. */
struct specular {
    float3 ks, kt;
    float eta;
    float alpha;
    global const rt_material_data *material; /* whether and which Fresnel equations hold */
};

/* What a facet does with light. */
struct split {
    float3 reflected, refracted;
    float cos_t;  /* of the refracted direction */
    float chance; /* of reflection, where one of the two is chosen */
};

/* A direction of one lobe. */
struct lobe {
    float3 value; /* fr |n.wi| */
    float pdf_w;  /* per steradian */
};

/*
 * Splits light between reflection and refraction at a boundary met with this cosine. A metal's
 * index is relative to the medium it lies in, whose index eta then is.
 */
static inline struct split split_light(const struct specular *specular, float cos_i)
{
    global const rt_material_data *material = specular->material;
    const float3 both = specular->ks + specular->kt;
    struct split split;
    const float reflectance = fresnel(cos_i, specular->eta, &split.cos_t);
    if (material->flags & RT_MATERIAL_CONDUCTOR) {
        const float inverse = 1.0f / specular->eta;
        split.reflected = specular->ks * fresnel_conductor(cos_i, row3(material->eta) * inverse,
                                                           row3(material->k) * inverse);
        split.refracted = (float3)(0.0f);
    } else if (material->flags & RT_MATERIAL_FRESNEL) {
        split.reflected = reflectance * both;
        split.refracted = (1.0f - reflectance) * both;
    } else {
        const bool total = reflectance >= 1.0f;
        split.reflected = total ? both : specular->ks;
        split.refracted = total ? (float3)(0.0f) : specular->kt;
    }
    const float r = mean3(split.reflected), t = mean3(split.refracted);
    split.chance = r > 0.0f ? r / (r + t) : 0.0f;
    return split;
}

static inline bool is_matched(const struct specular *specular)
{
    return fabs(1.0f - specular->eta) < RT_MATCHED_INDEX;
}

/*
 * The share of light from a facet that wo sees to wi that is not shadowed: G2 / G1 for correlated
 * heights, (1 + Lambda(wo)) / (1 + Lambda(wo) + Lambda(wi)), times |wo.z wi.z| above and below.
 */
static inline float unshadowed(const struct specular *specular, float3 wo, float3 wi)
{
    const float seen = ggx_facing(specular->alpha, wo) * fabs(wi.z);
    return seen / (seen + fabs(wo.z) * ggx_hidden(specular->alpha, wi));
}

/*
 * The density of wi by facets of normal h: that of visible normals, times dh/dwi (Walter et al.,
 * eqs. 14 and 17).
 */
static inline float facet_pdf_w(const struct specular *specular, float3 wo, float3 wi, float3 h)
{
    const float visible = ggx_density(specular->alpha, h) / ggx_facing(specular->alpha, wo);
    if (wi.z > 0.0f)
        return 0.25f * visible;
    const float cos_o = dot(wo, h), cos_i = dot(wi, h);
    return visible * cos_o * fabs(cos_i) / square(specular->eta * cos_o + cos_i);
}

/* Light from wi to wo, by reflection or refraction as the side of wi says. */
static inline struct lobe ggx_eval(const struct specular *specular, float3 wo, float3 wi)
{
    struct lobe lobe;
    lobe.value = (float3)(0.0f);
    lobe.pdf_w = 0.0f;
    const bool reflects = wi.z > 0.0f;
    if (wi.z == 0.0f || (!reflects && is_matched(specular)))
        return lobe;

    /* Find the facet that does it, and see that both directions are on the right sides of it. */
    float3 h = unit(reflects ? wo + wi : specular->eta * wo + wi);
    h = h.z < 0.0f ? -h : h;
    const float cos_o = dot(wo, h), cos_i = dot(wi, h);
    if (cos_o <= 0.0f || (reflects ? cos_i <= 0.0f : cos_i >= 0.0f))
        return lobe;

    const struct split split = split_light(specular, cos_o);
    const float facets = facet_pdf_w(specular, wo, wi, h);
    lobe.pdf_w = facets * (reflects ? split.chance : 1.0f - split.chance);
    lobe.value =
        (reflects ? split.reflected : split.refracted) * (facets * unshadowed(specular, wo, wi));
    return lobe;
}

/*
 * Samples a direction: the facet by u.xy among those that wo sees, reflection or refraction by u.z.
 * Writes the density of wi, 0 for what counts as smooth, and returns fr |n.wi| over the true
 * density; 0: the light is lost.
 */
static inline float3 ggx_sample(const struct specular *specular, float3 wo, float3 u, float3 *wi,
                                float *pdf_w)
{
    const float3 h = sample_visible_normal(specular->alpha, wo, u.xy);
    const float cos_o = dot(wo, h);
    const struct split split = split_light(specular, cos_o);
    const bool reflects = u.z < split.chance;
    const float chance = reflects ? split.chance : 1.0f - split.chance;
    *wi = unit(reflects ? 2.0f * cos_o * h - wo
                        : (specular->eta * cos_o - split.cos_t) * h - specular->eta * wo);
    *pdf_w = 0.0f;
    if (cos_o <= 0.0f || (reflects ? wi->z <= 0.0f : wi->z >= 0.0f))
        return (float3)(0.0f);
    if (reflects || !is_matched(specular))
        *pdf_w = chance * facet_pdf_w(specular, wo, *wi, h);
    return (reflects ? split.reflected : split.refracted) *
           (unshadowed(specular, wo, *wi) / chance);
}

#endif
