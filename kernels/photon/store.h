/* store.h - storing photons: which of them the map under way takes, and what a photon holds. */
#ifndef RT_KERNELS_PHOTON_STORE_H
#define RT_KERNELS_PHOTON_STORE_H

#include "photon/light_path.h"
#include "surface/vertex.h"
#include "types.h"

/*
 * Whether the map under way takes a photon of this path at a vertex whose light is gathered;
 * direct light may be left to shadow rays.
 */
static inline bool is_stored(const struct light_path *path, const rt_params *params)
{
    if (params->store == RT_STORE_CAUSTIC)
        return is_caustic(path);
    if (params->store == RT_STORE_GLOBAL && is_caustic(path))
        return false;
    return !(path->straight && params->direct == RT_DIRECT_NEE);
}

/*
 * A photon stands for all flux that comes there: of a cutout, also for what lies on paths that pass
 * it.
 */
static inline rt_photon make_photon(const struct light_path *path, const struct scene *scene,
                                    const struct vertex *vertex, const struct surface *surface,
                                    uint index)
{
    const struct bsdf *bsdf = &vertex->bsdf;
    rt_photon photon;
    vstore3(vertex->position, 0, photon.position);
    photon.path = index;
    vstore3(bsdf->wo, 0, photon.wi);
    photon.flags = (path->depth << 8) | (is_caustic(path) ? RT_PHOTON_CAUSTIC : 0u);
    vstore3(path->flux / surface_opacity(scene, surface), 0, photon.flux);
    photon.shading = max(dot(bsdf->wo, bsdf->shading), 0.0f) / dot(bsdf->wo, bsdf->normal) *
                     bump_shadow(bsdf, bsdf->wo);
    vstore3(bsdf->normal, 0, photon.normal);
    photon.shape = surface->shape;
    return photon;
}

static inline bool photon_is_finite(const rt_photon *photon)
{
    return all(fabs(vload3(0, photon->position)) <= RT_COORDINATE_MAX) &&
           all(isfinite(vload3(0, photon->wi))) && all(isfinite(vload3(0, photon->flux))) &&
           all(isfinite(vload3(0, photon->normal))) && isfinite(photon->shading);
}

/* Puts a photon into the next slot of the path's column. */
static inline void keep_photon(struct light_path *path, const rt_params *params,
                               const rt_photon *photon, global rt_photon *slots)
{
    if (photon_is_finite(photon))
        slots[path->photons++ * params->slots] = *photon;
    else
        path->rejected++;
}

/*
 * Stores a photon at the surface that a path met, where the map takes one, and scatters the path;
 * false where it is absorbed.
 */
CALLED_ON_GPUS bool shade_photon(struct light_path *path, const struct scene *scene,
                                 const rt_params *params, const struct sampler *sampler,
                                 struct meeting *met, float4 u, uint index, global rt_photon *slots)
{
    const float3 drawn = light_path_disperse(path, scene, sampler, met);
    struct vertex vertex;
    make_vertex(&vertex, scene, met, path->media.x, path->flux * drawn, CARRY_FLUX);
    if (vertex_stores(&vertex, params) && is_stored(path, params)) {
        const rt_photon photon = make_photon(path, scene, &vertex, &met->surface, index);
        keep_photon(path, params, &photon, slots);
    }
    DISPERSED(weigh_flux(path, drawn));
    return scatter_light_path(path, &vertex, u);
}

#endif
