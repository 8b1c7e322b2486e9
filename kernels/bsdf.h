/*
 * bsdf.h - how a surface scatters: a mixture of diffuse reflection, mirror reflection and refraction.
 *
 *   fr = kd/pi + ks delta_r/|n.wi| + kt delta_t/|n.wi|
 *
 * wo and wi are unit vectors that point away from the surface. The geometric normal says on which
 * side a direction is, the shading normal gives the cosine of diffuse reflection and the axis of
 * reflection and refraction; light that would cross the surface by the shading normal alone is
 * lost, not leaked.
 *
 * References:
 *   Veach: "Robust Monte Carlo Methods for Light Transport Simulation", PhD thesis, 1997, chapter 5
 *     (radiance and flux at refraction and at shading normals), chapter 10 (Russian roulette).
 *   Born, Wolf: "Principles of Optics", 7th ed., section 1.5.2 (Fresnel formulae).
 */
#ifndef RT_BSDF_H
#define RT_BSDF_H

#include "frame.h"
#include "sample.h"
#include "surface.h"
#include "types.h"

/* What a path carries: radiance from the eye, or flux from a light. They differ where the scattering is not symmetric. */
enum transport { CARRY_RADIANCE, CARRY_FLUX };

enum event { EVENT_ABSORBED, EVENT_DIFFUSE, EVENT_REFLECTED, EVENT_REFRACTED };

/* A surface's scattering as seen from wo. */
struct bsdf {
    float3 kd;
    float3 reflected, refracted; /* weights of the two delta parts; refracted without the radiance's (eta_i/eta_t)^2 */
    float3 normal;               /* geometric, on the side of wo */
    float3 shading;              /* on the side of wo as well */
    float3 wo;
    float eta;                   /* index on the side of wo / index on the other */
    float cos_t;                 /* of the refracted direction, unless reflected totally */
    float diffuse, reflection, refraction; /* probabilities of the events, given survival; all 0: black */
};

/* One scattering event, survival left out. */
struct scatter {
    float3 wi;     /* unit */
    float3 weight; /* fr |n.wi| / density, without `squeeze`; 0: the direction is on the wrong side */
    float squeeze; /* (eta_i/eta_t)^2 of a refraction that carries radiance, else 1 */
    float pdf_w;   /* diffuse: density of wi, the choice of the event included; delta events: 0 */
};

/*
 * Fresnel reflectance of unpolarised light at cos_i > 0, eta = eta_i/eta_t; 1 at total internal
 * reflection. Writes the cosine of the refracted direction.
 */
static inline float fresnel(float cos_i, float eta, float *cos_t)
{
    const float cos2_t = (1.0f - eta) * (1.0f + eta) + square(eta * cos_i); /* Snell's law, kept precise when grazing */
    *cos_t = 0.0f;
    if (cos2_t <= 0.0f)
        return 1.0f;
    *cos_t = sqrt(cos2_t);
    const float s = (eta * cos_i - *cos_t) / (eta * cos_i + *cos_t);
    const float p = (cos_i - eta * *cos_t) / (cos_i + eta * *cos_t);
    return 0.5f * (s * s + p * p);
}

/* Splits the delta part of the material between reflection and refraction. */
static inline void split_delta(struct bsdf *bsdf, global const rt_material_data *material)
{
    const float cos_i = fabs(dot(bsdf->wo, bsdf->shading));
    const float3 ks = row3(material->ks), kt = row3(material->kt);
    const float reflectance = fresnel(cos_i, bsdf->eta, &bsdf->cos_t);
    if (material->flags & RT_MATERIAL_FRESNEL) {
        bsdf->reflected = reflectance * (ks + kt);
        bsdf->refracted = (1.0f - reflectance) * (ks + kt);
    } else {
        const bool total = reflectance >= 1.0f;
        bsdf->reflected = total ? ks + kt : ks;
        bsdf->refracted = total ? (float3)(0.0f) : kt;
    }
}

/*
 * The scattering of a surface for a path that arrives along -wo with throughput beta. The events
 * are to be chosen in proportion to what the throughput keeps in each.
 */
static inline struct bsdf bsdf_at(global const rt_material_data *material, const struct surface *surface, float3 wo,
                                  float eta, float3 beta)
{
    const float side = dot(wo, surface->normal) < 0.0f ? -1.0f : 1.0f;
    struct bsdf bsdf;
    bsdf.normal = side * surface->normal;
    bsdf.shading = side * surface->shading;
    bsdf.wo = wo;
    bsdf.eta = eta;
    bsdf.kd = row3(material->kd);
    bsdf.reflected = (float3)(0.0f);
    bsdf.refracted = (float3)(0.0f);
    bsdf.diffuse = largest3(bsdf.kd) > 0.0f ? 1.0f : 0.0f;
    bsdf.reflection = 0.0f;
    bsdf.refraction = 0.0f;
    if (largest3(row3(material->ks) + row3(material->kt)) > 0.0f) {
        split_delta(&bsdf, material);
        const float d = dot(beta, bsdf.kd), r = dot(beta, bsdf.reflected), t = dot(beta, bsdf.refracted);
        const float sum = d + r + t;
        bsdf.diffuse = sum > 0.0f ? d / sum : 0.0f;
        bsdf.reflection = sum > 0.0f ? r / sum : 0.0f;
        bsdf.refraction = sum > 0.0f ? t / sum : 0.0f;
    }
    return bsdf;
}

/* The part of the light from each direction that the surface does not absorb. */
static inline float3 bsdf_albedo(const struct bsdf *bsdf)
{
    return bsdf->kd + bsdf->reflected + bsdf->refracted;
}

/* The part of the light that an event stands for, over the probability of its choice. */
static inline float3 bsdf_event_weight(const struct bsdf *bsdf, uint event)
{
    if (event == EVENT_DIFFUSE)
        return bsdf->kd / bsdf->diffuse;
    return event == EVENT_REFLECTED ? bsdf->reflected / bsdf->reflection : bsdf->refracted / bsdf->refraction;
}

/* Whether the surface reflects diffusely at all: if not, light sampling is pointless. */
static inline bool bsdf_is_diffuse(const struct bsdf *bsdf)
{
    return largest3(bsdf->kd) > 0.0f;
}

/* fr |n.wi| of the diffuse part; 0 below the surface. The delta parts evaluate to 0. */
static inline float3 bsdf_eval(const struct bsdf *bsdf, float3 wi)
{
    return dot(wi, bsdf->normal) > 0.0f ? bsdf->kd * cosine_pdf_w(dot(wi, bsdf->shading)) : (float3)(0.0f);
}

/* The density of wi by diffuse events, their choice included, survival left out. */
static inline float bsdf_pdf_w(const struct bsdf *bsdf, float3 wi)
{
    return bsdf->diffuse * cosine_pdf_w(dot(wi, bsdf->shading));
}

/*
 * With shading normals, light paths need |wo.ns| |wi.ng| / (|wo.ng| |wi.ns|) more than eye paths
 * (Veach, section 5.3.2).
 */
static inline float shading_factor(const struct bsdf *bsdf, float3 wi)
{
    const float above = fabs(dot(bsdf->wo, bsdf->shading) * dot(wi, bsdf->normal));
    const float below = fabs(dot(bsdf->wo, bsdf->normal) * dot(wi, bsdf->shading));
    return above == below ? 1.0f : above / below;
}

static inline void scatter_diffuse(struct scatter *scatter, const struct bsdf *bsdf, float2 u, uint transport)
{
    const float3 way = sample_cosine(u);
    scatter->wi = frame_to_world(frame_about(bsdf->shading), way);
    scatter->pdf_w = bsdf->diffuse * cosine_pdf_w(way.z);
    if (way.z > 0.0f && dot(scatter->wi, bsdf->normal) > 0.0f)
        scatter->weight = bsdf->kd * ((transport == CARRY_FLUX ? shading_factor(bsdf, scatter->wi) : 1.0f) / bsdf->diffuse);
}

static inline void scatter_reflected(struct scatter *scatter, const struct bsdf *bsdf)
{
    scatter->wi = unit(2.0f * dot(bsdf->wo, bsdf->shading) * bsdf->shading - bsdf->wo);
    if (dot(scatter->wi, bsdf->normal) > 0.0f)
        scatter->weight = bsdf->reflected / bsdf->reflection;
}

static inline void scatter_refracted(struct scatter *scatter, const struct bsdf *bsdf, uint transport)
{
    const float cos_i = dot(bsdf->wo, bsdf->shading);
    const float3 axis = cos_i < 0.0f ? -bsdf->shading : bsdf->shading;
    scatter->wi = unit((bsdf->eta * fabs(cos_i) - bsdf->cos_t) * axis - bsdf->eta * bsdf->wo);
    if (transport == CARRY_RADIANCE)
        scatter->squeeze = bsdf->eta * bsdf->eta;
    if (dot(scatter->wi, bsdf->normal) < 0.0f)
        scatter->weight = bsdf->refracted / bsdf->refraction;
}

/* Chooses an event of a path that survives with probability `survival`, by u in [0,1). */
static inline uint bsdf_choose(const struct bsdf *bsdf, float survival, float u)
{
    const float d = survival * bsdf->diffuse;
    const float r = survival * bsdf->reflection;
    const float t = survival * bsdf->refraction;
    if (u < d)
        return EVENT_DIFFUSE;
    if (u < d + r)
        return EVENT_REFLECTED;
    return u < d + r + t ? EVENT_REFRACTED : EVENT_ABSORBED;
}

/* Makes the direction of an event other than absorption, by u in [0,1)^2. */
static inline struct scatter bsdf_scatter(const struct bsdf *bsdf, uint event, float2 u, uint transport)
{
    struct scatter scatter;
    scatter.weight = (float3)(0.0f);
    scatter.squeeze = 1.0f;
    scatter.pdf_w = 0.0f;
    if (event == EVENT_DIFFUSE)
        scatter_diffuse(&scatter, bsdf, u, transport);
    else if (event == EVENT_REFLECTED)
        scatter_reflected(&scatter, bsdf);
    else
        scatter_refracted(&scatter, bsdf, transport);
    return scatter;
}

#endif
