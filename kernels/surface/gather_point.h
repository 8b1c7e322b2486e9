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
    vstore3(zero, 0, point->shading);
    for (uint i = 0u; i < RT_POINT_NUMBERS; i++)
        point->numbers[i] = 0.0f;
    point->pixel = pixel;
    point->material = 0u;
    point->sample = sample;
    point->film_weight = film_weight;
    point->lobe = RT_LOBE_LAMBERT;
    point->cut_off = 0.0f;
}

/* Where a point gathers; weight: of what its lobe scatters, on its way to the film. */
static inline void place_gather_point(global rt_gather_point *point, float3 position, float3 normal,
                                      float3 shading, float3 wo, uint material, float3 weight)
{
    vstore3(position, 0, point->position);
    vstore3(normal, 0, point->normal);
    vstore3(shading, 0, point->shading);
    vstore3(wo, 0, point->wo);
    vstore3(weight, 0, point->weight);
    point->material = material;
}

/* Gathers photons at a surface that has Lambert's lobe alone. */
static inline void set_simple_point(global rt_gather_point *point, float3 position, float3 normal,
                                    float3 shading, float3 wo, float3 albedo, uint material,
                                    float3 throughput)
{
    place_gather_point(point, position, normal, shading, wo, material, throughput * albedo);
    point->lobe = RT_LOBE_LAMBERT;
    vstore3(albedo, 0, point->numbers); /* as lambert_keep does */
}

/* What a rough lobe reads, of a boundary that reflects alone. */
static inline void keep_facets(const struct specular *specular, global float *numbers)
{
    vstore3(specular->ks, 0, numbers);
    vstore3(specular->tangent, 0, numbers + 3);
    numbers[6] = specular->alpha;
    numbers[7] = specular->alpha_v;
    numbers[8] = specular->eta;
}

static inline void restore_facets(struct bsdf *bsdf, global const float *numbers)
{
    struct specular *specular = &bsdf->specular;
    specular->ks = row3(numbers);
    specular->kt = (float3)(0.0f);
    specular->tangent = row3(numbers + 3);
    specular->alpha = numbers[6];
    specular->alpha_v = numbers[7];
    specular->eta = numbers[8];
    specular->fresnel = false;
    specular->normal = bsdf->shading;
    bsdf->reflected = split_light(specular, fabs(dot(bsdf->wo, bsdf->shading))).reflected;
}

/*
 * Gathers photons at a surface by a lobe of it, which was chosen with this probability; throughput:
 * from there to the film.
 */
static inline void set_gather_point(global rt_gather_point *point, float3 position,
                                    const struct bsdf *bsdf, uint lobe, float probability,
                                    uint material, float3 throughput)
{
    const float3 fixed = lobe == RT_LOBE_LAMBERT ? bsdf->kd : (float3)(1.0f);
    place_gather_point(point, position, bsdf->normal, bsdf->shading, bsdf->wo, material,
                       throughput * (fixed / probability));
    point->lobe = lobe;
    if (lobe_is_rough(lobe))
        keep_facets(&bsdf->specular, point->numbers);
    else
        diffuse_keep(bsdf, lobe, point->numbers);
}

/* Whether the lobe reads the material; gathers without such points go without a scene. */
static inline bool lobe_reads_material(uint lobe)
{
    return lobe_is_rough(lobe) || lobe == RT_LOBE_COATED || lobe == RT_LOBE_PRINCIPLED_DIFFUSE;
}

/*
 * The BSDF at a gather point, with the members that its lobe reads. header: of the scene, which is
 * read where lobe_reads_material says so.
 */
static inline struct bsdf bsdf_of_point(global const rt_gather_point *point,
                                        global const rt_scene_header *header)
{
    struct bsdf bsdf;
    bsdf.second = bsdf.reflected = bsdf.refracted = (float3)(0.0f);
    bsdf.normal = row3(point->normal);
    bsdf.shading = row3(point->shading);
    bsdf.wo = row3(point->wo);
    bsdf.diffuse = 1.0f;
    bsdf.reflection = bsdf.refraction = 0.0f;
    bsdf.diffuse_lobe = point->lobe;
    bsdf.transport = CARRY_RADIANCE;
    bsdf.specular.alpha = 0.0f;
    if (lobe_reads_material(point->lobe))
        bsdf.specular.material = scene_open(header).materials + point->material;
    if (lobe_is_rough(point->lobe))
        restore_facets(&bsdf, point->numbers);
    else
        diffuse_restore(&bsdf, point->lobe, point->numbers);
    return bsdf;
}

/* Whether the point's fr is the same for all photons. */
static inline bool point_is_constant(global const rt_gather_point *point)
{
    return point->lobe == RT_LOBE_LAMBERT;
}

/* Whether it gathers the photons of both sides of its surface. */
static inline bool point_is_translucent(global const rt_gather_point *point)
{
    return point->lobe == RT_LOBE_TRANSLUCENT;
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
