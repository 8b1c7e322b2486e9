/*
 * bsdf.h - how a surface scatters: a mixture of the lobes that RT_LOBES lists.
 *
 *   fr = kd fd + ks R + kt T
 *
 * with fd a diffuse lobe, and R and T specular reflection and refraction at a boundary that is
 * smooth or rough. lobe.h has the contract of the lobes, and a header for each its formula.
 *
 * The geometric normal says on which side a direction is, the shading normal gives the cosine of
 * diffuse reflection and the axis of reflection and refraction. Diffuse and rough directions on
 * which the two normals disagree carry no light, so none leaks; a smooth boundary uses the
 * geometric normal there.
 *
 * At each surface a path chooses one lobe, and carries the light of that lobe alone. So each lobe
 * is weighted by itself against light sampling, and photon maps, which hold what diffuse lobes
 * scatter and rough reflection if the setting gather_roughness says so, leave the others to the
 * path, rough or not.
 *
 * References:
 *   Veach: "Robust Monte Carlo Methods for Light Transport Simulation", PhD thesis, 1997, chapter 5
 *     (radiance and flux at refraction and at shading normals), chapter 10 (Russian roulette).
 */
#ifndef RT_KERNELS_BSDF_BSDF_H
#define RT_KERNELS_BSDF_BSDF_H

#include "bsdf/lobes.h"
#include "material/material.h"
#include "material/medium.h"
#include "scene.h"
#include "shape/surface.h"
#include "types.h"

/*
 * What a path carries: radiance from the eye, or flux from a light; these differ where scattering
 * is not symmetric.
 */
enum transport { CARRY_RADIANCE, CARRY_FLUX };

/* One scattering event, given survival. */
struct scatter {
    float3 wi; /* unit */
    /* fr |n.wi| / density, without eta_scale; 0: the direction is on the wrong side */
    float3 weight;
    float eta_scale; /* (eta_i/eta_t)^2 of a refraction that carries radiance, else 1 */
    float pdf_w;     /* density of wi, the choice of the lobe included; delta lobes: 0 */
    bool through;    /* wi is on the other side */
};

/* ---- Making the mixture ---------------------------------------------------------- */

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

/*
 * Specular reflection must stay on the geometric side of wo, and refraction must cross to the
 * other: where the shading normal violates this, use the geometric normal, so that smooth glass
 * loses no energy.
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

/* Adds the specular part of a material, and sets the probabilities of the lobes. */
static inline void add_specular(struct bsdf *bsdf, const struct bsdf_params *params,
                                global const rt_material_data *material,
                                const struct boundary *boundary, float3 beta)
{
    bsdf->specular.ks = params->ks;
    bsdf->specular.kt = params->kt;
    bsdf->specular.eta = boundary->eta;
    bsdf->specular.fresnel = boundary->fresnel;
    bsdf->specular.material = material;
    if (material->roughness >= RT_SMOOTH_ALPHA)
        roughen(bsdf, material->roughness);
    else if (any(bsdf->shading != bsdf->normal))
        keep_sides(bsdf);
    const struct split split = split_light(&bsdf->specular, fabs(dot(bsdf->wo, bsdf->shading)));
    bsdf->reflected = split.reflected;
    bsdf->refracted = split.refracted;
    bsdf->cos_t = split.cos_t;
    const float d = dot(beta, lobe_albedo(bsdf, bsdf->diffuse_lobe)),
                r = dot(beta, bsdf->reflected), t = dot(beta, bsdf->refracted);
    const float sum = d + r + t;
    bsdf->diffuse = sum > 0.0f ? d / sum : 0.0f;
    bsdf->reflection = sum > 0.0f ? r / sum : 0.0f;
    bsdf->refraction = sum > 0.0f ? t / sum : 0.0f;
}

/*
 * The scattering of a surface of these evaluated parameters and this geometric normal, on either
 * side, at this boundary, for a path that arrives along -wo with throughput beta. Lobes are chosen
 * in proportion to throughput times albedo.
 */
static inline struct bsdf bsdf_of(const struct bsdf_params *params,
                                  global const rt_material_data *material, float3 normal, float3 wo,
                                  const struct boundary *boundary, float3 beta)
{
    const float side = dot(wo, normal) < 0.0f ? -1.0f : 1.0f;
    struct bsdf bsdf;
    bsdf.normal = side * normal;
    bsdf.shading = side * params->shading;
    bsdf.wo = wo;
    bsdf.kd = params->kd;
    bsdf.reflected = (float3)(0.0f);
    bsdf.refracted = (float3)(0.0f);
    bsdf.specular.alpha = 0.0f;
    bsdf.diffuse_lobe = material->diffuse_lobe;
    bsdf.roughness = material->roughness;
    bsdf.diffuse = largest3(bsdf.kd) > 0.0f ? 1.0f : 0.0f;
    bsdf.reflection = 0.0f;
    bsdf.refraction = 0.0f;
    if (largest3(params->ks + params->kt) > 0.0f)
        add_specular(&bsdf, params, material, boundary, beta);
    return bsdf;
}

/* The same at a surface, whose material is evaluated first. */
static inline struct bsdf bsdf_at(const struct scene *scene,
                                  global const rt_material_data *material,
                                  const struct surface *surface, float3 wo,
                                  const struct boundary *boundary, float3 beta)
{
    const struct bsdf_params params = evaluate_material(scene, material, surface);
    return bsdf_of(&params, material, surface->normal, wo, boundary, beta);
}

/* ---- The mixture ------------------------------------------------------------------ */

/* Whether the surface has a diffuse lobe. */
static inline bool bsdf_is_diffuse(const struct bsdf *bsdf)
{
    return largest3(bsdf->kd) > 0.0f;
}

/* Whether it has a rough specular lobe. */
static inline bool bsdf_is_rough(const struct bsdf *bsdf)
{
    return bsdf->specular.alpha > 0.0f;
}

/* The lobe of a rough one. */
static inline uint bsdf_rough_lobe(const struct bsdf *bsdf)
{
    return bsdf->specular.material->flags & RT_MATERIAL_PHONG ? RT_LOBE_PHONG : RT_LOBE_GGX;
}

/*
 * The alpha of GGX facets that spread light as much as the rough lobe does: of Phong's with the
 * exponent n, sqrt(2 / (n + 2)) (Walter et al. 2007).
 */
static inline float rough_alpha(const struct bsdf *bsdf)
{
    const float alpha = bsdf->specular.alpha;
    return bsdf_rough_lobe(bsdf) == RT_LOBE_PHONG ? sqrt(2.0f / (alpha + 2.0f)) : alpha;
}

/*
 * Whether photons are gathered by its rough lobe, as by a diffuse one: the lobe reflects alone, and
 * is as rough as gather_alpha, which is 0 where none is gathered.
 */
static inline bool rough_is_gathered(const struct bsdf *bsdf, const rt_params *params)
{
    return params->gather_alpha > 0.0f && bsdf_is_rough(bsdf) &&
           largest3(bsdf->specular.kt) == 0.0f && !bsdf->specular.fresnel &&
           rough_alpha(bsdf) >= params->gather_alpha;
}

/* Whether the photon map accounts for the light that the lobe scatters. */
static inline bool lobe_is_gathered(const struct bsdf *bsdf, uint lobe, const rt_params *params)
{
    return lobe_is_diffuse(lobe) || (lobe_is_rough(lobe) && rough_is_gathered(bsdf, params));
}

/* Whether it accounts for light that some lobe scatters: photons are stored only there. */
static inline bool bsdf_is_gathered(const struct bsdf *bsdf, const rt_params *params)
{
    return bsdf_is_diffuse(bsdf) || rough_is_gathered(bsdf, params);
}

/* The directional albedo for wo, the sum over the lobes. */
static inline float3 bsdf_albedo(const struct bsdf *bsdf)
{
    return lobe_albedo(bsdf, bsdf->diffuse_lobe) + bsdf->reflected + bsdf->refracted;
}

/* The probability that a lobe is chosen, given survival. */
static inline float bsdf_probability(const struct bsdf *bsdf, uint lobe)
{
    if (lobe == bsdf->diffuse_lobe)
        return bsdf->diffuse;
    if (lobe_is_rough(lobe))
        return bsdf->reflection + bsdf->refraction;
    return lobe == RT_LOBE_SPECULAR_REFLECTION ? bsdf->reflection : bsdf->refraction;
}

/* The lobe's albedo over the probability of choosing the lobe. */
static inline float3 bsdf_lobe_weight(const struct bsdf *bsdf, uint lobe)
{
    return lobe_albedo(bsdf, lobe) / bsdf_probability(bsdf, lobe);
}

/* fr |n.wi| of a lobe, and the density of wi including the choice of the lobe. */
static inline struct lobe_value bsdf_eval(const struct bsdf *bsdf, uint lobe, float3 wi)
{
    struct lobe_value value = lobe_eval(bsdf, lobe, wi);
    value.pdf_w *= bsdf_probability(bsdf, lobe);
    return value;
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

/*
 * Chooses the lobe of a path that survives with probability `survival`, by u in [0,1);
 * RT_LOBE_NONE: the path is absorbed.
 */
static inline uint bsdf_choose(const struct bsdf *bsdf, float survival, float u)
{
    const float d = survival * bsdf->diffuse;
    const float r = survival * bsdf->reflection;
    const float t = survival * bsdf->refraction;
    if (u < d)
        return bsdf->diffuse_lobe;
    if (u >= d + r + t)
        return RT_LOBE_NONE;
    if (bsdf_is_rough(bsdf))
        return bsdf_rough_lobe(bsdf);
    return u < d + r ? RT_LOBE_SPECULAR_REFLECTION : RT_LOBE_SPECULAR_TRANSMISSION;
}

/* Samples a direction of the chosen lobe, by u in [0,1)^3. */
static inline struct scatter bsdf_scatter(const struct bsdf *bsdf, uint lobe, float3 u,
                                          uint transport)
{
    const struct lobe_sample sample = lobe_sample(bsdf, lobe, u);
    const float probability = bsdf_probability(bsdf, lobe);
    struct scatter scatter;
    scatter.wi = sample.wi;
    scatter.weight = sample.weight / probability;
    scatter.pdf_w = sample.pdf_w * probability;
    scatter.through = sample.through;
    scatter.eta_scale = 1.0f;
    if (transport == CARRY_FLUX)
        scatter.weight *= shading_factor(bsdf, scatter.wi);
    else if (scatter.through)
        scatter.eta_scale = square(bsdf->specular.eta);
    return scatter;
}

#endif
