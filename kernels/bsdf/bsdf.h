/*
 * bsdf.h - how a surface scatters: a mixture of diffuse reflection, and specular reflection and
 * refraction, which are perfect or rough.
 *
 *   fr = kd/pi + ks R + kt T;   smooth: R = delta_r/|n.wi|, T = delta_t/|n.wi|;   rough: see
 *                               rough.h
 *
 * wo and wi are unit vectors that point away from the surface. The geometric normal says on which
 * side a direction is, the shading normal gives the cosine of diffuse reflection and the axis of
 * reflection and refraction. Diffuse and rough light that would cross the surface by the shading
 * normal alone is lost, not leaked; what is smooth then goes by the geometric normal.
 *
 * A path takes one event a surface, diffuse or specular, and carries the light of that event alone.
 * So each event is weighed by itself against light sampling, and photon maps, which hold what
 * diffuse events scatter, leave the others to the path, rough or not.
 *
 * References:
 *   Veach: "Robust Monte Carlo Methods for Light Transport Simulation", PhD thesis, 1997, chapter 5
 *     (radiance and flux at refraction and at shading normals), chapter 10 (Russian roulette).
 */
#ifndef RT_KERNELS_BSDF_BSDF_H
#define RT_KERNELS_BSDF_BSDF_H

#include "math/frame.h"
#include "material/material.h"
#include "bsdf/ggx.h"
#include "sample/sample.h"
#include "scene.h"
#include "shape/surface.h"
#include "types.h"

/*
 * What a path carries: radiance from the eye, or flux from a light; these differ where scattering
 * is not symmetric.
 */
enum transport { CARRY_RADIANCE, CARRY_FLUX };

/* A rough surface chooses between reflection and refraction late, at the facet. */
enum event { EVENT_ABSORBED, EVENT_DIFFUSE, EVENT_REFLECTED, EVENT_REFRACTED, EVENT_ROUGH };

/* A surface's scattering as seen from wo. */
struct bsdf {
    float3 kd;
    /* specular parts about the shading normal, without the radiance's (eta_i/eta_t)^2 */
    float3 reflected, refracted;
    float3 normal;  /* geometric, on the side of wo */
    float3 shading; /* on the side of wo as well */
    float3 wo;
    float cos_t; /* of the refracted direction, unless reflected totally */
    /* probabilities of the events, given survival; all 0: black */
    float diffuse, reflection, refraction;
    /* alpha 0: smooth; the rest is set only where there is a specular part */
    struct specular specular;
};

/* One scattering event, survival left out. */
struct scatter {
    float3 wi; /* unit */
    /* fr |n.wi| / density, without `eta_scale`; 0: the direction is on the wrong side */
    float3 weight;
    float eta_scale; /* (eta_i/eta_t)^2 of a refraction that carries radiance, else 1 */
    float pdf_w;     /* density of wi by this event, its choice included; delta events: 0 */
    bool through;    /* wi is on the other side */
};

/*
 * Makes the specular part rough. Where the shading normal turns away from wo there are no facets to
 * see, and the geometric one takes its place.
 */
static inline void roughen(struct bsdf *bsdf, float alpha)
{
    bsdf->specular.alpha = alpha;
    if (dot(bsdf->wo, bsdf->shading) < RT_LEAST_TILT)
        bsdf->shading = bsdf->normal;
}

/* The direction of perfect reflection. */
static inline float3 reflect_direction(const struct bsdf *bsdf)
{
    return unit(2.0f * dot(bsdf->wo, bsdf->shading) * bsdf->shading - bsdf->wo);
}

/* The direction of perfect refraction, where there is one. */
static inline float3 refract_direction(const struct bsdf *bsdf, float cos_t)
{
    const float eta = bsdf->specular.eta;
    const float cos_i = dot(bsdf->wo, bsdf->shading);
    const float3 axis = cos_i < 0.0f ? -bsdf->shading : bsdf->shading;
    return unit((eta * fabs(cos_i) - cos_t) * axis - eta * bsdf->wo);
}

/*
 * What is perfectly reflected stays on its side of the surface, and what is refracted goes to the
 * other: where the shading normal would have it otherwise, the geometric one takes its place. So
 * smooth glass loses no light.
 */
static inline void keep_sides(struct bsdf *bsdf)
{
    const struct split split = split_light(&bsdf->specular, fabs(dot(bsdf->wo, bsdf->shading)));
    const bool stays =
        dot(bsdf->wo, bsdf->shading) > 0.0f && dot(reflect_direction(bsdf), bsdf->normal) > 0.0f;
    const bool crosses = largest3(split.refracted) == 0.0f ||
                         dot(refract_direction(bsdf, split.cos_t), bsdf->normal) < 0.0f;
    if (!(stays && crosses))
        bsdf->shading = bsdf->normal;
}

/*
 * The scattering of a surface for a path that arrives along -wo with throughput beta. eta is the
 * index on the side of wo over that on the other. The events are to be chosen in proportion to what
 * the throughput keeps in each.
 */
static inline struct bsdf bsdf_at(const struct scene *scene,
                                  global const rt_material_data *material,
                                  const struct surface *surface, float3 wo, float eta, float3 beta)
{
    const struct bsdf_params params = evaluate_material(scene, material, surface);
    const float side = dot(wo, surface->normal) < 0.0f ? -1.0f : 1.0f;
    struct bsdf bsdf;
    bsdf.normal = side * surface->normal;
    bsdf.shading = side * params.shading;
    bsdf.wo = wo;
    bsdf.kd = params.kd;
    bsdf.reflected = (float3)(0.0f);
    bsdf.refracted = (float3)(0.0f);
    bsdf.specular.alpha = 0.0f;
    bsdf.diffuse = largest3(bsdf.kd) > 0.0f ? 1.0f : 0.0f;
    bsdf.reflection = 0.0f;
    bsdf.refraction = 0.0f;
    if (largest3(params.ks + params.kt) > 0.0f) {
        bsdf.specular.ks = params.ks;
        bsdf.specular.kt = params.kt;
        bsdf.specular.eta = eta;
        bsdf.specular.material = material;
        if (material->roughness >= RT_SMOOTH_ALPHA)
            roughen(&bsdf, material->roughness);
        else if (any(bsdf.shading != bsdf.normal))
            keep_sides(&bsdf);
        const struct split split = split_light(&bsdf.specular, fabs(dot(wo, bsdf.shading)));
        bsdf.reflected = split.reflected;
        bsdf.refracted = split.refracted;
        bsdf.cos_t = split.cos_t;
        const float d = dot(beta, bsdf.kd), r = dot(beta, bsdf.reflected),
                    t = dot(beta, bsdf.refracted);
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
    if (event == EVENT_ROUGH)
        return (bsdf->reflected + bsdf->refracted) / (bsdf->reflection + bsdf->refraction);
    return event == EVENT_REFLECTED ? bsdf->reflected / bsdf->reflection
                                    : bsdf->refracted / bsdf->refraction;
}

/* Whether the surface reflects diffusely: photons are left, and asked for, only there. */
static inline bool bsdf_is_diffuse(const struct bsdf *bsdf)
{
    return largest3(bsdf->kd) > 0.0f;
}

/* Whether it scatters to a lamp by a rough lobe. */
static inline bool bsdf_is_rough(const struct bsdf *bsdf)
{
    return bsdf->specular.alpha > 0.0f;
}

/*
 * Diffuse light from wi, and its density by diffuse events, their choice included; 0 below the
 * surface.
 */
static inline struct lobe bsdf_diffuse(const struct bsdf *bsdf, float3 wi)
{
    const float pdf_w = dot(wi, bsdf->normal) > 0.0f ? cosine_pdf_w(dot(wi, bsdf->shading)) : 0.0f;
    struct lobe lobe;
    lobe.value = bsdf->kd * pdf_w;
    lobe.pdf_w = bsdf->diffuse * pdf_w;
    return lobe;
}

/* The same of rough events, for a path that carries radiance. */
static inline struct lobe bsdf_rough(const struct bsdf *bsdf, float3 wi)
{
    const struct frame frame = frame_about(bsdf->shading);
    const float3 way = frame_to_local(frame, wi);
    struct lobe lobe = ggx_eval(&bsdf->specular, frame_to_local(frame, bsdf->wo), way);
    const bool above = way.z > 0.0f;
    const float kept = above == (dot(wi, bsdf->normal) > 0.0f) ? 1.0f : 0.0f;
    lobe.value *= kept * (above ? 1.0f : square(bsdf->specular.eta));
    lobe.pdf_w *= kept * (bsdf->reflection + bsdf->refraction);
    return lobe;
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

static inline void scatter_diffuse(struct scatter *scatter, const struct bsdf *bsdf, float2 u)
{
    const float3 way = sample_cosine(u);
    scatter->wi = frame_to_world(frame_about(bsdf->shading), way);
    scatter->pdf_w = bsdf->diffuse * cosine_pdf_w(way.z);
    if (way.z > 0.0f && dot(scatter->wi, bsdf->normal) > 0.0f)
        scatter->weight = bsdf->kd / bsdf->diffuse;
}

static inline void scatter_reflected(struct scatter *scatter, const struct bsdf *bsdf)
{
    scatter->wi = reflect_direction(bsdf);
    if (dot(scatter->wi, bsdf->normal) > 0.0f)
        scatter->weight = bsdf->reflected / bsdf->reflection;
}

static inline void scatter_refracted(struct scatter *scatter, const struct bsdf *bsdf)
{
    scatter->wi = refract_direction(bsdf, bsdf->cos_t);
    scatter->through = true;
    if (dot(scatter->wi, bsdf->normal) < 0.0f)
        scatter->weight = bsdf->refracted / bsdf->refraction;
}

static inline void scatter_rough(struct scatter *scatter, const struct bsdf *bsdf, float3 u)
{
    const struct frame frame = frame_about(bsdf->shading);
    const float chosen = bsdf->reflection + bsdf->refraction;
    float3 way;
    const float3 weight =
        ggx_sample(&bsdf->specular, frame_to_local(frame, bsdf->wo), u, &way, &scatter->pdf_w);
    scatter->wi = unit(frame_to_world(frame, way));
    scatter->pdf_w *= chosen;
    scatter->through = way.z < 0.0f;
    if (scatter->through == (dot(scatter->wi, bsdf->normal) < 0.0f))
        scatter->weight = weight / chosen;
}

/* Chooses an event of a path that survives with probability `survival`, by u in [0,1). */
static inline uint bsdf_choose(const struct bsdf *bsdf, float survival, float u)
{
    const float d = survival * bsdf->diffuse;
    const float r = survival * bsdf->reflection;
    const float t = survival * bsdf->refraction;
    if (u < d)
        return EVENT_DIFFUSE;
    if (u >= d + r + t)
        return EVENT_ABSORBED;
    if (bsdf_is_rough(bsdf))
        return EVENT_ROUGH;
    return u < d + r ? EVENT_REFLECTED : EVENT_REFRACTED;
}

/* Makes the direction of an event other than absorption, by u in [0,1)^3. */
static inline struct scatter bsdf_scatter(const struct bsdf *bsdf, uint event, float3 u,
                                          uint transport)
{
    struct scatter scatter;
    scatter.weight = (float3)(0.0f);
    scatter.eta_scale = 1.0f;
    scatter.pdf_w = 0.0f;
    scatter.through = false;
    if (event == EVENT_DIFFUSE)
        scatter_diffuse(&scatter, bsdf, u.xy);
    else if (event == EVENT_REFLECTED)
        scatter_reflected(&scatter, bsdf);
    else if (event == EVENT_REFRACTED)
        scatter_refracted(&scatter, bsdf);
    else
        scatter_rough(&scatter, bsdf, u);
    if (transport == CARRY_FLUX)
        scatter.weight *= shading_factor(bsdf, scatter.wi);
    else if (scatter.through)
        scatter.eta_scale = square(bsdf->specular.eta);
    return scatter;
}

#endif
