/*
 * bsdf.h - how a surface scatters: a mixture of the lobes that RT_LOBES lists.
 *
 *   fr = kd fd + ks R + kt T
 *
 * with fd a diffuse lobe, which may transmit light, too (translucent.h), and R and T specular
 * reflection and refraction at a boundary that is smooth or rough. lobe.h has the contract of the
 * lobes, and a header for each its formula.
 *
 * The geometric normal says on which side a direction is, the shading normal gives the cosine of
 * diffuse reflection and the axis of reflection and refraction. Directions wi of diffuse and rough
 * lobes on which the two normals disagree carry no light, so none leaks; from a wo on which they
 * disagree a diffuse lobe is seen all the same, and a boundary uses the geometric normal. That is
 * the rule for radiance; flux is scattered by its adjoint (adjoint.h).
 *
 * At each surface a path chooses one lobe, by its albedo. In path tracing and photon mapping it
 * carries the light of that lobe alone, and each lobe is weighted by itself against light sampling:
 * photon maps hold what some lobes scatter, diffuse ones and rough reflection if the setting
 * gather_roughness says so, and leave the others to the path. Mode vcm takes all lobes but delta
 * lobes together, by the sum of their values and densities (surface/bidirectional.h). For paths
 * that was tried: of diffuse surfaces with a rough lobe it takes 1 to 3 % of the variance, and 5 to
 * 10 % more time.
 *
 * A set of lobes has the bit 1 << RT_LOBE_* for each.
 *
 * References:
 *   Estevez, Lecocq, Stein: "A Microfacet-Based Shadowing Function to Solve the Bump Terminator
 *     Problem", Ray Tracing Gems, 2019.
 *   Veach: "Robust Monte Carlo Methods for Light Transport Simulation", PhD thesis, 1997, chapter 5
 *     (radiance and flux at refraction and at shading normals), chapter 10 (Russian roulette).
 */
#ifndef RT_KERNELS_BSDF_BSDF_H
#define RT_KERNELS_BSDF_BSDF_H

#include "bsdf/adjoint.h"
#include "bsdf/mixture.h"
#include "scene.h"
#include "shape/surface.h"
#include "types.h"

/* One scattering event, given survival. */
struct scatter {
    float3 wi; /* unit */
    /* fr |n.wi| / density, without eta_scale; 0: the direction is on the wrong side */
    float3 weight;
    float eta_scale; /* (eta_i/eta_t)^2 of a refraction that carries radiance, else 1 */
    float pdf_w;     /* density of wi, the choice of the lobe included; delta lobes: 0 */
    bool through;    /* wi is on the other side */
};

/* ---- Making it ------------------------------------------------------------------- */

/*
 * Makes *out the scattering of a surface of these evaluated parameters and this geometric normal,
 * on either side, at this boundary, for a path that arrives along -wo with throughput beta. Lobes
 * are chosen in proportion to throughput times albedo. It is made where it is used: a copy would
 * read by whole vectors what was just written number by number, which processors wait for.
 */
static inline void make_bsdf(struct bsdf *out, const struct bsdf_params *params,
                             global const rt_material_data *material, float3 normal, float3 wo,
                             const struct boundary *boundary, float3 beta, uint transport)
{
    make_radiance_bsdf(out, params, material, normal, wo, boundary, beta);
    out->transport = transport;
    if (is_adjoint(out)) {
        struct bsdf adjoint = *out; /* a copy, so that the other can live in registers */
        take_adjoint(&adjoint, beta);
        *out = adjoint;
    }
}

/* The same at a surface, whose material is evaluated first. */
static inline struct bsdf bsdf_at(const struct scene *scene,
                                  global const rt_material_data *material,
                                  const struct surface *surface, float3 wo,
                                  const struct boundary *boundary, float3 beta, uint transport)
{
    struct bsdf_params params;
    struct bsdf bsdf;
    evaluate_material(&params, scene, material, surface);
    make_bsdf(&bsdf, &params, material, surface->normal, wo, boundary, beta, transport);
    return bsdf;
}

/* ---- Lobes ------------------------------------------------------------------------ */

/* Whether the surface has a diffuse lobe. */
static inline bool bsdf_is_diffuse(const struct bsdf *bsdf)
{
    return largest3(bsdf->kd + bsdf->second) > 0.0f;
}

/* Whether it has a rough specular lobe. */
static inline bool bsdf_is_rough(const struct bsdf *bsdf)
{
    return bsdf->specular.alpha > 0.0f;
}

/* The lobe of a rough one. */
static inline uint bsdf_rough_lobe(const struct bsdf *bsdf)
{
    global const rt_material_data *material = bsdf->specular.material;
    return has_flag(material, RT_MATERIAL_PHONG) ? RT_LOBE_PHONG
           : is_lacquered(material)              ? RT_LOBE_LACQUER
           : is_principled(material)             ? RT_LOBE_PRINCIPLED
                                                 : RT_LOBE_GGX;
}

/*
 * The alpha of facets that spread light as much as the rough lobe does where it spreads it least:
 * of Phong's with the exponent n, sqrt(2 / (n + 2)) (Walter et al. 2007).
 */
static inline float rough_alpha(const struct bsdf *bsdf)
{
    const float alpha = bsdf->specular.alpha;
    if (is_anisotropic(bsdf->specular.material))
        return fmin(alpha, bsdf->specular.alpha_v);
    return bsdf_rough_lobe(bsdf) == RT_LOBE_PHONG ? sqrt(2.0f / (alpha + 2.0f)) : alpha;
}

/*
 * Whether photons are stored for its rough lobe, as for a diffuse one: the lobe reflects alone, and
 * is as rough as gather_alpha, which is 0 where none is gathered.
 */
static inline bool rough_is_stored(const struct bsdf *bsdf, const rt_params *params)
{
    return params->gather_alpha > 0.0f && bsdf_is_rough(bsdf) &&
           largest3(bsdf->specular.kt) == 0.0f && !bsdf->specular.fresnel &&
           rough_alpha(bsdf) >= params->gather_alpha;
}

/*
 * Whether they are gathered by it: where the facets are about the shading normal, whose cosine
 * photons carry.
 */
static inline bool rough_is_gathered(const struct bsdf *bsdf, const rt_params *params)
{
    return rough_is_stored(bsdf, params) && all(bsdf->specular.normal == bsdf->shading);
}

/* Its lobes that are no delta lobes, some of which it may lack. */
#define RT_BSDF_LOBES 2u
static inline uint bsdf_lobe(const struct bsdf *bsdf, uint i)
{
    return i == 0u ? bsdf->diffuse_lobe : bsdf_rough_lobe(bsdf);
}

/* Whether it has lobe i of these. */
static inline bool bsdf_has(const struct bsdf *bsdf, uint i)
{
    return i == 0u ? bsdf_is_diffuse(bsdf) : bsdf_is_rough(bsdf);
}

/* Those that it has. */
static inline uint bsdf_lobes(const struct bsdf *bsdf)
{
    return (bsdf_is_diffuse(bsdf) ? 1u << bsdf->diffuse_lobe : 0u) |
           (bsdf_is_rough(bsdf) ? 1u << bsdf_rough_lobe(bsdf) : 0u);
}

/* Those of which the photon map holds the light. */
static inline uint bsdf_gathered_lobes(const struct bsdf *bsdf, const rt_params *params)
{
    return (bsdf_is_diffuse(bsdf) ? 1u << bsdf->diffuse_lobe : 0u) |
           (rough_is_gathered(bsdf, params) ? 1u << bsdf_rough_lobe(bsdf) : 0u);
}

/* Whether it may account for light that some lobe scatters: photons are stored only there. */
static inline bool bsdf_is_stored(const struct bsdf *bsdf, const rt_params *params)
{
    return bsdf_is_diffuse(bsdf) || rough_is_stored(bsdf, params);
}

/* The directional albedo for wo, the sum over the lobes. */
static inline float3 bsdf_albedo(const struct bsdf *bsdf)
{
    return diffuse_albedo(bsdf) + bsdf->reflected + bsdf->refracted;
}

/* The probability that the rough lobe is chosen, given survival; a lacquer may be a mirror, too. */
static inline float rough_probability(const struct bsdf *bsdf)
{
    return is_lacquered(bsdf->specular.material) ? bsdf->refraction
                                                 : bsdf->reflection + bsdf->refraction;
}

/* The probability that a lobe is chosen, given survival. */
static inline float bsdf_probability(const struct bsdf *bsdf, uint lobe)
{
    if (lobe == bsdf->diffuse_lobe)
        return bsdf->diffuse;
    if (lobe_is_rough(lobe))
        return rough_probability(bsdf);
    return lobe == RT_LOBE_SPECULAR_REFLECTION ? bsdf->reflection : bsdf->refraction;
}

/* The lobe's albedo over the probability of choosing the lobe. */
static inline float3 bsdf_lobe_weight(const struct bsdf *bsdf, uint lobe)
{
    const float3 albedo =
        lobe == bsdf->diffuse_lobe ? diffuse_albedo(bsdf) : lobe_albedo(bsdf, lobe);
    return albedo / bsdf_probability(bsdf, lobe);
}

/* The probability that lobe i of those that are no delta lobes is chosen, given survival. */
static inline float bsdf_share(const struct bsdf *bsdf, uint i)
{
    return i == 0u ? bsdf->diffuse : rough_probability(bsdf);
}

/*
 * What the bumps of a surface leave of light, from wi of radiance and from wo of flux: shading
 * normals tilted by an angle d are taken for facets of GGX with alpha^2 = tan^2(d) / 8, whose
 * shadowing it is, about the geometric normal. Without it light ends where the tilted normal turns
 * away, at a hard edge.
 */
static inline float bump_shadow(const struct bsdf *bsdf, float3 wi)
{
    if (!(bsdf->specular.material->flags & RT_MATERIAL_SHADOWED))
        return 1.0f;
    const float3 from = bsdf->transport == CARRY_FLUX ? bsdf->wo : wi;
    const float tilt = square(dot(bsdf->shading, bsdf->normal)),
                height = fmax(square(dot(from, bsdf->normal)), 1e-12f);
    const float square_alpha = clamp(0.125f * (1.0f - tilt) / tilt, 0.0f, 1.0f);
    return 2.0f / (1.0f + sqrt(1.0f + square_alpha * fmax(1.0f - height, 0.0f) / height));
}

/*
 * fr |n.wi| of lobe i of those that are no delta lobes, and the density of wi including its choice;
 * of the adjoint the flux along wi, per steradian, of unit flux. i is a constant at each call.
 */
static inline struct lobe_value bsdf_eval(const struct bsdf *bsdf, uint i, float3 wi)
{
    const uint lobe = bsdf_lobe(bsdf, i);
    struct lobe_value value = is_adjoint(bsdf) ? adjoint_eval(bsdf, lobe, wi)
                              : i == 0u        ? diffuse_eval(bsdf, lobe, wi)
                                               : rough_eval(bsdf, lobe, wi);
    value.value *= bump_shadow(bsdf, wi);
    value.pdf_w *= bsdf_share(bsdf, i);
    return value;
}

/* The sums of both over all lobes but delta lobes. */
static inline struct lobe_value bsdf_eval_all(const struct bsdf *bsdf, float3 wi)
{
    struct lobe_value sum = no_light();
    for (uint i = 0u; i < RT_BSDF_LOBES; i++)
        if (bsdf_has(bsdf, i)) {
            const struct lobe_value value = bsdf_eval(bsdf, i, wi);
            sum.value += value.value;
            sum.pdf_w += value.pdf_w;
        }
    return sum;
}

/* That of the densities alone. */
static inline float bsdf_pdf_w(const struct bsdf *bsdf, float3 wi)
{
    float sum = 0.0f;
    for (uint i = 0u; i < RT_BSDF_LOBES; i++) {
        const uint lobe = bsdf_lobe(bsdf, i);
        if (bsdf_has(bsdf, i))
            sum += bsdf_share(bsdf, i) *
                   (is_adjoint(bsdf) ? adjoint_pdf_w(bsdf, lobe, wi) : lobe_pdf_w(bsdf, lobe, wi));
    }
    return sum;
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
    const bool is_mirror = u < d + r && is_lacquered(bsdf->specular.material);
    if (bsdf_is_rough(bsdf) && !is_mirror)
        return bsdf_rough_lobe(bsdf);
    return u < d + r ? RT_LOBE_SPECULAR_REFLECTION : RT_LOBE_SPECULAR_TRANSMISSION;
}

/* Samples a direction of the chosen lobe, by u in [0,1)^3. */
static inline struct scatter bsdf_scatter(const struct bsdf *bsdf, uint lobe, float3 u)
{
    const struct lobe_sample sample =
        is_adjoint(bsdf) ? adjoint_sample(bsdf, lobe, u) : lobe_sample(bsdf, lobe, u);
    const float probability = bsdf_probability(bsdf, lobe);
    struct scatter scatter;
    scatter.wi = sample.wi;
    scatter.weight = sample.weight * (bump_shadow(bsdf, sample.wi) / probability);
    scatter.pdf_w = sample.pdf_w * probability;
    scatter.through = sample.through;
    scatter.eta_scale =
        scatter.through && bsdf->transport == CARRY_RADIANCE ? square(bsdf->specular.eta) : 1.0f;
    return scatter;
}

#endif
