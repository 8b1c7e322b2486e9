/*
 * mixture.h - makes the mixture of lobes of a surface: which normal each of them has, and how often
 * each is chosen.
 */
#ifndef RT_KERNELS_BSDF_MIXTURE_H
#define RT_KERNELS_BSDF_MIXTURE_H

#include "bsdf/lobes.h"
#include "material/material.h"
#include "material/medium.h"
#include "types.h"

/* Whether the boundary refracts at angles at which it does not reflect totally. */
static inline bool can_refract(const struct specular *specular)
{
    return !has_flag(specular->material, RT_MATERIAL_CONDUCTOR) &&
           (specular->fresnel ? !is_coated(specular->material) : largest3(specular->kt) > 0.0f);
}

/* Whether about this normal reflection stays on the geometric side of wo and refraction crosses. */
static inline bool keeps_sides(const struct bsdf *bsdf, float3 normal)
{
    struct bsdf about = *bsdf;
    about.specular.normal = normal;
    const float cosine = dot(bsdf->wo, normal);
    if (!(cosine > 0.0f && dot(reflect_direction(&about), bsdf->normal) > 0.0f))
        return false;
    if (!can_refract(&bsdf->specular))
        return true;
    const float cos_t = refracted_cosine(cosine, bsdf->specular.eta);
    return cos_t == 0.0f || dot(refract_direction(&about, cos_t), bsdf->normal) < 0.0f;
}

/*
 * The normal of the boundary as seen from wo: the shading normal, but the geometric one where from
 * there a rough boundary has no facets to see, and where a smooth one would lose light.
 */
static inline float3 boundary_normal(const struct bsdf *bsdf)
{
    const bool is_rough = bsdf->specular.alpha > 0.0f;
    const bool has_facets = !is_rough || dot(bsdf->wo, bsdf->shading) >= RT_LEAST_TILT;
    const bool has_mirror = !is_rough || is_lacquered(bsdf->specular.material);
    return has_facets && (!has_mirror || keeps_sides(bsdf, bsdf->shading)) ? bsdf->shading
                                                                           : bsdf->normal;
}

/*
 * Whether the shading normal is another than the geometric one. A program that defines RT_FACETED
 * is for scenes where it nowhere is: the code for such normals, though not run, takes a ninth of
 * the time of mode vcm on a CPU, and a quarter on a GPU.
 */
static inline bool is_tilted(const struct bsdf *bsdf)
{
#ifdef RT_FACETED
    return false;
#else
    return any(bsdf->shading != bsdf->normal);
#endif
}

/* Whether the material has a specular part. */
static inline bool has_specular(const struct bsdf *bsdf)
{
    return largest3(bsdf->specular.ks + bsdf->specular.kt) > 0.0f ||
           has_flag(bsdf->specular.material, RT_MATERIAL_PRINCIPLED | RT_MATERIAL_LACQUER);
}

/* Lobes are chosen in proportion to throughput times albedo; diffuse: the albedo of that lobe. */
static inline void set_probabilities(struct bsdf *bsdf, float3 diffuse, float3 beta)
{
    const float d = dot(beta, diffuse), r = dot(beta, bsdf->reflected),
                t = dot(beta, bsdf->refracted);
    const float sum = d + r + t;
    bsdf->diffuse = sum > 0.0f ? d / sum : 0.0f;
    bsdf->reflection = sum > 0.0f ? r / sum : 0.0f;
    bsdf->refraction = sum > 0.0f ? t / sum : 0.0f;
}

/* Gives facets the two alphas of a material and their direction; smooth only where both are. */
static inline void set_anisotropy(struct specular *specular, const struct bsdf_params *params)
{
    if (fmax(params->roughness, params->roughness_v) < RT_SMOOTH_ALPHA)
        return;
    specular->alpha = fmax(params->roughness, RT_SMOOTH_ALPHA);
    specular->alpha_v = fmax(params->roughness_v, RT_SMOOTH_ALPHA);
    specular->tangent = params->tangent;
}

/* Covers the facets of ks with a coat, which if it is rough blurs what is seen through it. */
static inline void cover_facets(struct specular *specular, global const rt_material_data *material)
{
    const float alpha = specular->alpha,
                alpha_v = is_anisotropic(material) ? specular->alpha_v : alpha;
    specular->coat.bare_alpha = alpha;
    specular->coat.bare_alpha_v = alpha_v;
    if (!(specular->coat.alpha > 0.0f))
        return;
    const float blur = RT_COAT_BLUR(specular->coat.alpha, specular->eta);
    specular->alpha = fmax(sqrt(square(alpha) + square(blur)), RT_SMOOTH_ALPHA);
    specular->alpha_v = fmax(sqrt(square(alpha_v) + square(blur)), RT_SMOOTH_ALPHA);
}

/* Adds the specular part of a material, and sets the probabilities of the lobes. */
static inline void add_specular(struct bsdf *bsdf, const struct bsdf_params *params,
                                global const rt_material_data *material, float3 beta)
{
    const float alpha =
        has_flag(material, RT_MATERIAL_PHONG) ? material->exponent : bsdf->roughness;
    if (alpha >= RT_SMOOTH_ALPHA)
        bsdf->specular.alpha = alpha;
    if (is_anisotropic(material))
        set_anisotropy(&bsdf->specular, params);
    if (is_lacquered(material))
        cover_facets(&bsdf->specular, material);
    if (is_tilted(bsdf))
        bsdf->specular.normal = boundary_normal(bsdf);
    const struct split split =
        split_boundary(&bsdf->specular, fabs(dot(bsdf->wo, bsdf->specular.normal)));
    bsdf->reflected = split.reflected;
    bsdf->refracted = split.refracted;
    bsdf->cos_t = split.cos_t;
    set_probabilities(bsdf, lobe_albedo(bsdf, bsdf->diffuse_lobe), beta);
}

/* Makes the coat of a material the boundary of its BSDF, or puts it over that. */
static inline void put_on_coat(struct bsdf *bsdf, const struct bsdf_params *params,
                               global const rt_material_data *material)
{
    const float alpha = params->coat_roughness;
    bsdf->specular.eta /= material->coat_ior;
    bsdf->specular.fresnel = true;
    bsdf->specular.coat.amount = params->coat;
    bsdf->specular.coat.alpha = alpha >= RT_SMOOTH_ALPHA ? alpha : 0.0f;
    bsdf->specular.coat.diffuse = params->kd;
    bsdf->specular.coat.absorption = params->coat_absorption;
    if (is_lacquered(material))
        return;
    bsdf->specular.ks = (float3)(params->coat);
    bsdf->roughness = alpha;
}

/*
 * Makes the boundary a sheet. The medium is the same on both sides, so that light goes straight on
 * and is not scaled; its index is what the boundary of an opaque surface has as eta. What fills a
 * sheet counts as having the index of the medium around it, which eta or its inverse then is.
 */
static inline void make_thin(struct bsdf *bsdf, global const rt_material_data *material)
{
    const float eta = bsdf->specular.eta;
    bsdf->specular.sheet =
        is_filled(material) ? fmax(eta, 1.0f / eta) / material->coat_ior : eta / material->ior;
    bsdf->specular.eta = 1.0f;
    bsdf->specular.fresnel = (material->flags & RT_MATERIAL_FRESNEL) != 0u;
}

/*
 * Makes the mixture of a principled material, whose kd, ks and kt hold base_color, metallic and
 * spec_trans; is_inside: seen from its inside.
 */
static inline void take_principled(struct bsdf *bsdf, const struct bsdf_params *params,
                                   bool is_inside, float3 beta)
{
    bsdf->specular.fresnel = true;
    bsdf->specular.tangent = params->tangent;
    set_principled(bsdf, &params->numbers, is_inside);
    if (is_tilted(bsdf))
        bsdf->specular.normal = boundary_normal(bsdf);
    const float cosine = fabs(dot(bsdf->wo, bsdf->specular.normal));
    const struct split split = principled_split(&bsdf->specular, cosine);
    bsdf->reflected = split.reflected + clearcoat_albedo(&bsdf->specular, cosine);
    bsdf->refracted = split.refracted + transmitted_diffusely(bsdf);
    bsdf->cos_t = split.cos_t;
    set_probabilities(bsdf, principled_diffuse_albedo(bsdf), beta);
}

/*
 * Makes *out the scattering of radiance by a surface of these evaluated parameters and this
 * geometric normal, on either side, at this boundary, for a path that arrives along -wo with
 * throughput beta.
 */
INLINE_ALWAYS void make_radiance_bsdf(struct bsdf *out, const struct bsdf_params *params,
                                      global const rt_material_data *material, float3 normal,
                                      float3 wo, const struct boundary *boundary, float3 beta)
{
    const float side = dot(wo, normal) < 0.0f ? -1.0f : 1.0f;
    out->normal = side * normal;
    out->shading = side * params->shading;
    out->wo = wo;
    out->transport = CARRY_RADIANCE;
    out->kd = params->kd;
    out->second = params->diffuse_transmission;
    out->reflected = (float3)(0.0f);
    out->refracted = (float3)(0.0f);
    out->cos_t = 0.0f;
    out->diffuse_lobe = material->diffuse_lobe;
    out->roughness = params->roughness;
    if (out->diffuse_lobe == RT_LOBE_FUZZ) {
        out->second = params->fuzz;
        out->roughness = params->fuzz_roughness;
    }
    out->diffuse = largest3(out->kd + out->second) > 0.0f ? 1.0f : 0.0f;
    out->reflection = 0.0f;
    out->refraction = 0.0f;
    out->specular.ks = params->ks;
    out->specular.kt = params->kt;
    out->specular.eta = boundary->eta;
    out->specular.fresnel = boundary->fresnel;
    out->specular.sheet = 1.0f;
    out->specular.alpha = 0.0f;
    out->specular.alpha_v = 0.0f;
    out->specular.tangent = (float3)(0.0f);
    out->specular.normal = out->shading;
    out->specular.material = material;
    if (is_coated(material))
        put_on_coat(out, params, material);
    if (is_thin(material))
        make_thin(out, material);
    if (is_translucent(material))
        out->specular.eta = 1.0f;
    if (is_principled(material)) {
        struct bsdf principled = *out; /* a copy, so that the other can live in registers */
        take_principled(&principled, params,
                        is_transparent(material) && boundary->beyond.x != material->medium, beta);
        *out = principled;
    } else if (has_specular(out))
        add_specular(out, params, material, beta);
}

#endif
