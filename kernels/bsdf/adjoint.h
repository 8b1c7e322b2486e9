/*
 * adjoint.h - how a surface scatters flux where its shading normal ns is not the geometric one ng.
 *
 * Radiance that arrives from l and leaves to c, on camera paths, is scattered by what the surface
 * is as seen from c: which normal each lobe has and on which side directions are depends on c
 * (mixture.h). Per projected solid angle about the geometric normal, this is the BSDF
 *
 *   f(c, l) = fr(c, l) |ns.l| / |ng.l|
 *
 * which is not symmetric. Light paths come from l and go on to c, so they need the same f with c as
 * the direction in which they go on: of unit flux, f(c, l) |ng.c| per steradian.
 *
 * Here wo is l and wi is c. Values come from the lobes as seen from c, nothing is evaluated as seen
 * from l, so all modes have one picture. Directions are sampled so that all c with f > 0 are found:
 *
 *   diffuse   by the cosine to ng, which for Lambert's lobe is in proportion to the flux, on
 *             either side where the lobe transmits
 *   rough     about ns or ng, by a mixture of both densities
 *   smooth    in the directions about ns and about ng from which radiance takes that normal, in
 *             proportion to their flux
 *
 * Reference:
 *   Veach: "Robust Monte Carlo Methods for Light Transport Simulation", PhD thesis, 1997, section
 *     5.3.
 */
#ifndef RT_KERNELS_BSDF_ADJOINT_H
#define RT_KERNELS_BSDF_ADJOINT_H

#include "bsdf/mixture.h"

/*
 * Whether eval, pdf and sample are those of the adjoint. A program that defines RT_RADIANCE_ALONE
 * has no light paths.
 */
static inline bool is_adjoint(const struct bsdf *bsdf)
{
#ifdef RT_RADIANCE_ALONE
    return false;
#else
    return bsdf->transport == CARRY_FLUX && is_tilted(bsdf);
#endif
}

/* The lobes as radiance leaves the surface to wi, on either side; albedos are not made again. */
static inline struct bsdf seen_from(const struct bsdf *bsdf, float3 wi)
{
    const float side = dot(wi, bsdf->normal) < 0.0f ? -1.0f : 1.0f;
    struct bsdf seen = *bsdf;
    seen.transport = CARRY_RADIANCE;
    seen.wo = wi;
    seen.normal = side * bsdf->normal;
    seen.shading = side * bsdf->shading;
    if (side < 0.0f)
        seen.specular.eta = 1.0f / bsdf->specular.eta;
    seen.specular.normal = boundary_normal(&seen);
    return seen;
}

/* The same lobes about this normal, on the side of wo. */
static inline struct bsdf bsdf_about(const struct bsdf *bsdf, float3 normal)
{
    struct bsdf about = *bsdf;
    about.specular.normal = normal;
    return about;
}

/* a / b for cosines, 0 for flux that only grazes the surface. */
static inline float cosine_ratio(float a, float b)
{
    return b > 0.0f ? a / b : 0.0f;
}

/* The albedo of the diffuse lobe: of flux times |ns.l| / |ng.l|. */
INLINE_ALWAYS float3 diffuse_albedo(const struct bsdf *bsdf)
{
    const float3 albedo = lobe_albedo(bsdf, bsdf->diffuse_lobe);
    if (!is_adjoint(bsdf))
        return albedo;
    return albedo *
           cosine_ratio(fmax(dot(bsdf->wo, bsdf->shading), 0.0f), dot(bsdf->wo, bsdf->normal));
}

/*
 * The directional albedo for wo of radiance, by which light paths survive: flux that shading
 * normals make weaker goes on as often.
 */
static inline float3 radiance_albedo(const struct bsdf *bsdf)
{
    float3 specular = bsdf->reflected + bsdf->refracted;
    if (is_adjoint(bsdf) && has_specular(bsdf) && !is_principled(bsdf->specular.material)) {
        const struct split split =
            split_boundary(&bsdf->specular, fabs(dot(bsdf->wo, bsdf->specular.normal)));
        specular = split.reflected + split.refracted;
    }
    return lobe_albedo(bsdf, bsdf->diffuse_lobe) + specular;
}

/* ---- Smooth lobes ---------------------------------------------------------------- */

/* Whether radiance that leaves the boundary to wi, on either side, takes the shading normal. */
static inline bool takes_shading(const struct bsdf *bsdf, float3 wi)
{
    const struct bsdf seen = seen_from(bsdf, wi);
    return all(seen.specular.normal == seen.shading);
}

/*
 * What a delta lobe sends of unit flux in the direction *wi about this normal; 0 where there is
 * none, or where radiance that leaves to *wi takes the other normal. Of radiance the boundary
 * reflects and refracts as much.
 */
static inline float3 delta_flux(const struct bsdf *bsdf, uint lobe, bool is_shading, float3 *wi)
{
    const bool reflects = lobe == RT_LOBE_SPECULAR_REFLECTION;
    const float3 normal = is_shading ? bsdf->shading : bsdf->normal;
    const struct bsdf about = bsdf_about(bsdf, normal);
    const float cosine = dot(bsdf->wo, normal);
    const struct split split = split_boundary(&about.specular, fabs(cosine));
    const float3 sent = reflects ? split.reflected : split.refracted;
    *wi = reflects ? reflect_direction(&about) : refract_direction(&about, split.cos_t);
    if (!(cosine > 0.0f && reflects == (dot(*wi, bsdf->normal) > 0.0f) && largest3(sent) > 0.0f) ||
        takes_shading(bsdf, *wi) != is_shading)
        return (float3)(0.0f);
    return sent * cosine_ratio(cosine * fabs(dot(*wi, bsdf->normal)),
                               dot(bsdf->wo, bsdf->normal) * fabs(dot(*wi, normal)));
}

/* The two directions of a delta lobe, about ns and ng, and their flux. */
struct delta_pair {
    float3 along_shading, along_normal;
    float3 shading_flux, normal_flux;
    float share; /* of the first */
};

static inline struct delta_pair delta_pair_of(const struct bsdf *bsdf, uint lobe)
{
    struct delta_pair pair;
    pair.shading_flux = delta_flux(bsdf, lobe, true, &pair.along_shading);
    pair.normal_flux = delta_flux(bsdf, lobe, false, &pair.along_normal);
    const float s = mean3(pair.shading_flux), n = mean3(pair.normal_flux);
    pair.share = s > 0.0f ? s / (s + n) : 0.0f;
    return pair;
}

/* The probability that a delta event that was chosen goes along wi. */
RARELY_CALLED float adjoint_delta_share(const struct bsdf *bsdf, uint lobe, float3 wi)
{
    const struct delta_pair pair = delta_pair_of(bsdf, lobe);
    /* Of one direction there is no other; close ones are told apart by their differences. */
    if (pair.share == 0.0f || pair.share == 1.0f)
        return 1.0f;
    const float3 off_shading = wi - pair.along_shading, off_normal = wi - pair.along_normal;
    return dot(off_shading, off_shading) < dot(off_normal, off_normal) ? pair.share
                                                                       : 1.0f - pair.share;
}

/* ---- Rough lobes ----------------------------------------------------------------- */

/*
 * How often rough lobes are sampled about ns: most often where the mirror direction about ng is far
 * from those that radiance leaves by facets about ng.
 */
static inline float shading_share(const struct bsdf *bsdf)
{
    const float cosine = dot(bsdf->wo, bsdf->shading);
    const float mirrored =
        2.0f * dot(bsdf->wo, bsdf->normal) * dot(bsdf->normal, bsdf->shading) - cosine;
    return cosine > 0.0f ? clamp(0.5f + mirrored, 0.5f, 0.95f) : 0.0f;
}

static inline float adjoint_pdf_w(const struct bsdf *bsdf, uint lobe, float3 wi)
{
    if (lobe == RT_LOBE_TRANSLUCENT)
        return translucent_share(bsdf, translucent_crosses(bsdf, wi)) *
               translucent_density(bsdf, bsdf->normal, wi);
    if (lobe_is_diffuse(lobe))
        return cosine_pdf_w(dot(wi, bsdf->normal));
    const float share = shading_share(bsdf);
    const struct bsdf geometric = bsdf_about(bsdf, bsdf->normal);
    float pdf_w = (1.0f - share) * lobe_pdf_w(&geometric, lobe, wi);
    if (share > 0.0f) {
        const struct bsdf shading = bsdf_about(bsdf, bsdf->shading);
        pdf_w += share * lobe_pdf_w(&shading, lobe, wi);
    }
    return pdf_w;
}

/* ---- Any lobe -------------------------------------------------------------------- */

/*
 * Flux along wi, per steradian, of unit flux, and the density of wi. Of Lambert's lobe, which is
 * the same from everywhere, it needs no more than cosines.
 */
static inline struct lobe_value adjoint_lambert(const struct bsdf *bsdf, float3 wi)
{
    const float cosine = dot(wi, bsdf->normal);
    const float ratio = cosine_ratio(fmax(cosine, 0.0f), fabs(dot(bsdf->wo, bsdf->normal)));
    struct lobe_value flux;
    flux.value = ratio * (bsdf->kd * lambert_density(bsdf->normal, bsdf->shading, bsdf->wo));
    flux.pdf_w = cosine_pdf_w(cosine);
    return flux;
}

/* Delta lobes: 0. */
RARELY_CALLED struct lobe_value adjoint_any(const struct bsdf *bsdf, uint lobe, float3 wi)
{
    const struct bsdf seen = seen_from(bsdf, wi);
    const float ratio =
        cosine_ratio(fabs(dot(wi, bsdf->normal)), fabs(dot(bsdf->wo, bsdf->normal)));
    struct lobe_value flux;
    flux.value = ratio * lobe_eval(&seen, lobe, bsdf->wo).value;
    flux.pdf_w = adjoint_pdf_w(bsdf, lobe, wi);
    return flux;
}

static inline struct lobe_value adjoint_eval(const struct bsdf *bsdf, uint lobe, float3 wi)
{
    if (lobe == RT_LOBE_LAMBERT)
        return adjoint_lambert(bsdf, wi);
    return adjoint_any(bsdf, lobe, wi);
}

/*
 * Refraction of a rough lobe between nearly equal indices, sampled about this normal, which counts
 * as a delta event.
 */
static inline float3 matched_flux(const struct bsdf *bsdf, const struct lobe_sample *sample,
                                  float3 normal)
{
    if (takes_shading(bsdf, sample->wi) != all(normal == bsdf->shading))
        return (float3)(0.0f);
    const float above = fabs(dot(bsdf->wo, normal) * dot(sample->wi, bsdf->normal));
    return sample->weight *
           cosine_ratio(above, fabs(dot(bsdf->wo, bsdf->normal) * dot(sample->wi, normal)));
}

static inline struct lobe_sample sample_rough_adjoint(const struct bsdf *bsdf, uint lobe, float3 u)
{
    const float share = shading_share(bsdf);
    const bool along = u.x < share;
    const float part = along ? share : 1.0f - share;
    const float3 normal = along ? bsdf->shading : bsdf->normal;
    const struct bsdf about = bsdf_about(bsdf, normal);
    const float x = fmin((along ? u.x : u.x - share) / part, RT_BELOW_ONE);
    struct lobe_sample sample = lobe_sample(&about, lobe, (float3)(x, u.yz));
    if (!(largest3(sample.weight) > 0.0f))
        return sample;
    if (sample.pdf_w == 0.0f) {
        sample.weight = matched_flux(bsdf, &sample, normal) / part;
        return sample;
    }
    const struct lobe_value flux = adjoint_eval(bsdf, lobe, sample.wi);
    sample.weight = flux.value / flux.pdf_w;
    sample.pdf_w = flux.pdf_w;
    return sample;
}

static inline struct lobe_sample sample_diffuse_adjoint(const struct bsdf *bsdf, uint lobe,
                                                        float3 u)
{
    struct lobe_sample sample;
    sample.through = false;
    if (lobe == RT_LOBE_TRANSLUCENT)
        sample = translucent_about(bsdf, bsdf->normal, u);
    else
        sample.wi = frame_to_world(frame_about(bsdf->normal), sample_cosine(u.xy));
    const struct lobe_value flux = adjoint_eval(bsdf, lobe, sample.wi);
    sample.weight = flux.pdf_w > 0.0f ? flux.value / flux.pdf_w : (float3)(0.0f);
    sample.pdf_w = flux.pdf_w;
    return sample;
}

static inline struct lobe_sample sample_delta_adjoint(const struct bsdf *bsdf, uint lobe, float u)
{
    const struct delta_pair pair = delta_pair_of(bsdf, lobe);
    const bool along = u < pair.share;
    struct lobe_sample sample;
    sample.wi = along ? pair.along_shading : pair.along_normal;
    sample.weight = along ? pair.shading_flux / pair.share : pair.normal_flux / (1.0f - pair.share);
    sample.pdf_w = 0.0f;
    sample.through = lobe == RT_LOBE_SPECULAR_TRANSMISSION;
    return sample;
}

RARELY_CALLED struct lobe_sample sample_specular_adjoint(const struct bsdf *bsdf, uint lobe,
                                                         float3 u)
{
    return lobe_is_delta(lobe) ? sample_delta_adjoint(bsdf, lobe, u.x)
                               : sample_rough_adjoint(bsdf, lobe, u);
}

/* A direction by u in [0,1)^3, and the flux along it over its density. */
static inline struct lobe_sample adjoint_sample(const struct bsdf *bsdf, uint lobe, float3 u)
{
    if (lobe_is_diffuse(lobe))
        return sample_diffuse_adjoint(bsdf, lobe, u);
    return sample_specular_adjoint(bsdf, lobe, u);
}

/* What a smooth boundary sends of the flux about both normals. */
static inline float3 adjoint_delta_albedo(const struct bsdf *bsdf, uint lobe)
{
    const struct delta_pair pair = delta_pair_of(bsdf, lobe);
    return pair.shading_flux + pair.normal_flux;
}

/* Turns the BSDF for radiance into that for flux, of a path of throughput beta. */
RARELY_CALLED void take_adjoint(struct bsdf *bsdf, float3 beta)
{
    if (!has_specular(bsdf))
        return;
    const bool is_smooth = bsdf->specular.alpha == 0.0f;
    if (is_smooth || is_lacquered(bsdf->specular.material))
        bsdf->reflected = adjoint_delta_albedo(bsdf, RT_LOBE_SPECULAR_REFLECTION);
    if (is_smooth) {
        bsdf->refracted = adjoint_delta_albedo(bsdf, RT_LOBE_SPECULAR_TRANSMISSION);
    }
    set_probabilities(bsdf, diffuse_albedo(bsdf), beta);
}

#endif
