/*
 * gather_point.h - gather points: what an eye path records where it gathers photons, and what the
 * point's lobe scatters of the photons around it.
 *
 *   L(x, wo) = sum over the photons p near x of fr(x, wo, w_p) flux_p K(|x - x_p|)      Jensen 1996
 *
 * with flux_p the flux of its path over the number of emitted paths, and fr the point's lobe, by
 * the same eval as paths use. Lambert's fr is kd/pi for every photon: the point's weight then holds
 * kd, and the sum is of flux density alone. Of facets the lobe is that of a boundary which reflects
 * alone, smooth in its dependence on w_p only as far as the surface is rough.
 *
 * Photon density follows the geometric normal, while reflection uses the shading normal:
 * photon.shading is the ratio of the two cosines (Veach 1997, section 5.3).
 */
#ifndef RT_KERNELS_SURFACE_GATHER_POINT_H
#define RT_KERNELS_SURFACE_GATHER_POINT_H

#include "bsdf/lobes.h"
#include "math/frame.h"
#include "math/lanes.h"
#include "scene.h"
#include "types.h"

#define RT_ALPHA_UNIT 0xffffffu /* what stands for 1 beside the lobe: of alpha, a coat or sheen */

static inline uint point_lobe(global const rt_gather_point *point)
{
    return point->lobe & 0xffu;
}

/* The number from 0 to 1 that is kept beside the lobe. */
static inline float packed_number(global const rt_gather_point *point)
{
    return (point->lobe >> 8) * (1.0f / RT_ALPHA_UNIT);
}

/* A point that gathers nothing. */
static inline void clear_gather_point(global rt_gather_point *point, uint pixel, uint sample,
                                      float film_weight)
{
    const float3 zero = (float3)(0.0f);
    vstore3(zero, 0, point->position);
    vstore3(zero, 0, point->normal);
    vstore3(zero, 0, point->weight);
    vstore3(zero, 0, point->wo);
    vstore3(zero, 0, point->radiance);
    vstore3(zero, 0, point->kd);
    vstore3(zero, 0, point->shading);
    vstore3(zero, 0, point->tangent);
    point->alpha_v = 0.0f;
    point->pixel = pixel;
    point->material = 0u;
    point->sample = sample;
    point->film_weight = film_weight;
    point->lobe = RT_LOBE_LAMBERT;
    point->roughness = 0.0f;
    point->cut_off = 0.0f;
}

/*
 * Gathers photons at a surface by a lobe of it, which was chosen with this probability; throughput:
 * from there to the film.
 */
static inline void set_gather_point(global rt_gather_point *point, float3 position,
                                    const struct bsdf *bsdf, uint lobe, float probability,
                                    uint material, float3 throughput)
{
    const bool is_rough = lobe_is_rough(lobe);
    const float3 kd = bsdf->kd, ks = bsdf->specular.ks;
    const float eta = bsdf->specular.eta, roughness = bsdf->roughness;
    const float packed = lobe == RT_LOBE_GGX                  ? bsdf->specular.alpha
                         : lobe == RT_LOBE_COATED             ? bsdf->specular.coat.amount
                         : lobe == RT_LOBE_PRINCIPLED_DIFFUSE ? bsdf->specular.principled.sheen
                                                              : 0.0f;
    const float3 fixed = lobe == RT_LOBE_LAMBERT ? kd : (float3)(1.0f);
    vstore3(position, 0, point->position);
    vstore3(bsdf->normal, 0, point->normal);
    vstore3(bsdf->wo, 0, point->wo);
    vstore3(is_rough ? ks : kd, 0, point->kd);
    vstore3(bsdf->shading, 0, point->shading);
    const struct principled part = bsdf->specular.principled;
    vstore3(lobe == RT_LOBE_TRANSLUCENT ? bsdf->transmitted
            : lobe == RT_LOBE_PRINCIPLED_DIFFUSE
                ? (float3)(part.sheen_tint, part.flatness, part.diff_trans)
            : lobe == RT_LOBE_COATED ? ks
                                     : bsdf->specular.tangent,
            0, point->tangent);
    point->alpha_v = lobe == RT_LOBE_COATED ? bsdf->specular.coat.alpha : bsdf->specular.alpha_v;
    point->material = material;
    point->lobe = lobe | convert_uint_rte(packed * RT_ALPHA_UNIT) << 8;
    point->roughness = is_rough || lobe == RT_LOBE_COATED ? eta : roughness;
    vstore3(throughput * (fixed / probability), 0, point->weight);
}

/* Gathers photons at a surface that has Lambert's lobe alone. */
static inline void set_lambert_point(global rt_gather_point *point, float3 position, float3 normal,
                                     float3 shading, float3 wo, float3 albedo, uint material,
                                     float3 throughput)
{
    struct bsdf bsdf;
    bsdf.kd = albedo;
    bsdf.transmitted = (float3)(0.0f);
    bsdf.normal = normal;
    bsdf.shading = shading;
    bsdf.wo = wo;
    bsdf.roughness = 0.0f;
    bsdf.specular.alpha = bsdf.specular.alpha_v = 0.0f;
    bsdf.specular.coat.amount = bsdf.specular.coat.alpha = 0.0f;
    bsdf.specular.ks = bsdf.specular.tangent = (float3)(0.0f);
    bsdf.specular.eta = 1.0f;
    set_gather_point(point, position, &bsdf, RT_LOBE_LAMBERT, 1.0f, material, throughput);
}

/* The boundary at a gather point of a rough lobe. */
static inline struct specular specular_of_point(global const rt_gather_point *point,
                                                global const rt_material_data *materials)
{
    struct specular specular;
    specular.ks = row3(point->kd);
    specular.kt = (float3)(0.0f);
    specular.eta = point->roughness;
    specular.material = materials + point->material;
    specular.alpha =
        point_lobe(point) == RT_LOBE_GGX ? packed_number(point) : specular.material->exponent;
    specular.alpha_v = point->alpha_v;
    specular.tangent = row3(point->tangent);
    specular.fresnel = false;
    specular.normal = row3(point->shading);
    return specular;
}

/*
 * The BSDF at a gather point, with the members that its lobe reads. header: of the scene, which is
 * read where the lobe is rough or below a coat.
 */
static inline struct bsdf bsdf_of_point(global const rt_gather_point *point,
                                        global const rt_scene_header *header)
{
    struct bsdf bsdf;
    bsdf.kd = row3(point->kd);
    bsdf.transmitted = row3(point->tangent);
    bsdf.reflected = bsdf.refracted = (float3)(0.0f);
    bsdf.normal = row3(point->normal);
    bsdf.shading = row3(point->shading);
    bsdf.wo = row3(point->wo);
    bsdf.diffuse = 1.0f;
    bsdf.reflection = bsdf.refraction = 0.0f;
    bsdf.diffuse_lobe = point_lobe(point);
    bsdf.roughness = point->roughness;
    bsdf.transport = CARRY_RADIANCE;
    bsdf.specular.alpha = 0.0f;
    if (bsdf.diffuse_lobe == RT_LOBE_COATED) {
        bsdf.transmitted = (float3)(0.0f);
        bsdf.specular.ks = row3(point->tangent);
        bsdf.specular.coat.amount = packed_number(point);
        bsdf.specular.coat.alpha = point->alpha_v;
        bsdf.specular.eta = bsdf.roughness;
        bsdf.specular.material = scene_open(header).materials + point->material;
    }
    if (bsdf.diffuse_lobe == RT_LOBE_PRINCIPLED_DIFFUSE) {
        bsdf.transmitted = (float3)(0.0f);
        bsdf.specular.principled.sheen = packed_number(point);
        bsdf.specular.principled.sheen_tint = point->tangent[0];
        bsdf.specular.principled.flatness = point->tangent[1];
        bsdf.specular.principled.diff_trans = point->tangent[2];
        bsdf.specular.material = scene_open(header).materials + point->material;
    }
    if (lobe_is_rough(bsdf.diffuse_lobe)) {
        bsdf.specular = specular_of_point(point, scene_open(header).materials);
        bsdf.reflected = split_light(&bsdf.specular, fabs(dot(bsdf.wo, bsdf.shading))).reflected;
    }
    return bsdf;
}

/* Whether the point's fr is the same for all photons. */
static inline bool point_is_constant(global const rt_gather_point *point)
{
    return point_lobe(point) == RT_LOBE_LAMBERT;
}

/* Whether it gathers the photons of both sides of its surface. */
static inline bool point_is_translucent(global const rt_gather_point *point)
{
    return point_lobe(point) == RT_LOBE_TRANSLUCENT;
}

/* fr of the point's lobe, for light from wi. */
INLINE_NEVER float3 fr_of_point(const struct bsdf *bsdf, float3 wi)
{
    const float above = dot(wi, bsdf->shading);
    const float cosine = bsdf->diffuse_lobe == RT_LOBE_TRANSLUCENT ? fabs(above) : above;
    return cosine > 0.0f ? lobe_eval(bsdf, bsdf->diffuse_lobe, wi).value / cosine : (float3)(0.0f);
}

/* What a photon adds to the sum: its flux, times fr where that is not constant. */
static inline float3 photon_term(const struct bsdf *bsdf, global const rt_photon *photon)
{
    const float3 flux = row3(photon->flux);
    return bsdf->diffuse_lobe == RT_LOBE_LAMBERT ? flux
                                                 : fr_of_point(bsdf, row3(photon->wi)) * flux;
}

/*
 * Adds what the point scatters towards the film to its radiance; sum: of flux_p K where fr is
 * constant, else of fr flux_p K.
 */
static inline void add_scattered(global rt_gather_point *point, float3 sum)
{
    float3 weight = row3(point->weight);
    if (point_is_constant(point))
        weight = weight / RT_PI;
    vstore3(row3(point->radiance) + weight * sum, 0, point->radiance);
}

#endif
