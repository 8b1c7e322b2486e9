/*
 * photon_emit.cl - photon tracing: each work-item follows one path from a light.
 *
 * A path starts with the flux of all lights divided by the number of paths, in the colour of the
 * light that was chosen, and leaves a photon at each surface that reflects diffusely. Its photons
 * go to slots of its own, so that the map does not depend on the order in which paths are followed.
 *
 * A path has at most max_depth - 1 segments: with the one segment from the eye to the place
 * where the map is asked, that is the longest path of path tracing.
 *
 * References:
 *   Jensen: "Global Illumination using Photon Maps", EGWR 1996.
 *   Veach: "Robust Monte Carlo Methods for Light Transport Simulation", PhD thesis, 1997, chapter 5
 *     (flux is not scaled at refraction, radiance is).
 */
#include "bsdf.h"
#include "light.h"
#include "medium.h"
#include "rng.h"
#include "traverse.h"

/* A path under way. */
struct light_path {
    struct ray ray;
    float3 flux;
    uint4 media;
    uint depth;    /* segments, the one under way included */
    uint hidden;   /* boundaries crossed that a stronger medium hides */
    bool straight; /* nothing was met yet: a shadow ray would find the light */
    bool diffused; /* some event was diffuse */
};

static bool start_path(struct light_path *path, const struct scene *scene, const struct sampler *sampler, float emitted)
{
    struct emission emission;
    if (!light_emit(scene, sampler_set(sampler, SET_START), sampler_set(sampler, SET_EMISSION), &emission))
        return false;
    path->ray = make_ray(leave_surface(&emission.at, emission.direction), emission.direction, 0.0f, INFINITY);
    path->flux = emission.flux / emitted;
    path->media = RT_VACUUM;
    path->depth = 1u;
    path->hidden = 0u;
    path->straight = true;
    path->diffused = false;
    return true;
}

static rt_photon make_photon(const struct light_path *path, const struct surface *surface, const struct bsdf *bsdf,
                             uint index)
{
    const bool caustic = !path->straight && !path->diffused;
    rt_photon photon;
    vstore3(surface->position, 0, photon.position);
    photon.path = index;
    vstore3(bsdf->wo, 0, photon.wi);
    photon.flags = (path->depth << 8) | (caustic ? RT_PHOTON_CAUSTIC : 0u);
    vstore3(path->flux, 0, photon.flux);
    photon.shading = max(dot(bsdf->wo, bsdf->shading), 0.0f) / dot(bsdf->wo, bsdf->normal);
    vstore3(bsdf->normal, 0, photon.normal);
    photon.shape = surface->shape;
    return photon;
}

/*
 * Scatters the path at a surface; false when it ends. Survival keeps the flux of all photons alike:
 * it is the share of the strongest channel that the surface leaves.
 */
static bool scatter_path(struct light_path *path, const struct surface *surface, const struct bsdf *bsdf, uint4 beyond,
                         float4 u)
{
    const float survival = min(1.0f, largest3(path->flux * bsdf_albedo(bsdf)) / largest3(path->flux));
    const uint event = bsdf_choose(bsdf, survival, u.z);
    if (event == EVENT_ABSORBED)
        return false;
    const struct scatter scatter = bsdf_scatter(bsdf, event, u.xy, CARRY_FLUX);
    path->flux *= scatter.weight / survival;
    if (!(largest3(path->flux) > 0.0f))
        return false;
    path->ray = make_ray(leave_surface(surface, scatter.wi), scatter.wi, 0.0f, INFINITY);
    path->straight = false;
    path->diffused |= event == EVENT_DIFFUSE;
    if (event == EVENT_REFRACTED)
        path->media = beyond;
    path->depth++;
    return true;
}

/* slots: [item_count][params.slots]; counts: [item_count], the photons that each path left. */
kernel void photon_emit(const rt_params params, global const rt_scene_header *header, global rt_photon *slots,
                        global uint *counts)
{
    const uint item = (uint)get_global_id(0);
    if (item >= params.item_count)
        return;
    const struct scene scene = scene_open(header);
    const uint index = params.first_item + item;
    const struct sampler sampler = sampler_start(&scene, &params, RT_STREAM_PHOTONS, index);
    global rt_photon *own = slots + (size_t)item * params.slots;
    struct light_path path;
    uint count = 0u;

    bool alive = start_path(&path, &scene, &sampler, params.emitted) && can_follow(&path.ray);
    while (alive && path.depth < params.max_depth) {
        /* Find the nearest surface. */
        struct hit hit;
        if (!closest_hit(&scene, &path.ray, &hit))
            break;
        const struct surface surface = surface_at(&scene, &path.ray, &hit);
        const uint material_index = scene.shapes[surface.shape].material;
        global const rt_material_data *material = scene.materials + material_index;
        const float3 wo = -path.ray.direction;

        /* Go straight on through a boundary that a stronger medium hides. */
        struct boundary boundary;
        boundary.beyond = path.media;
        boundary.eta = 1.0f;
        if (is_transparent(material)) {
            boundary = media_cross(&scene, path.media, material_index, dot(wo, surface.normal) > 0.0f);
            if (!boundary.exists) {
                path.ray.origin = leave_surface(&surface, path.ray.direction);
                path.media = boundary.beyond;
                path.straight = false;
                alive = ++path.hidden <= RT_HIDDEN_BOUNDARIES;
                continue;
            }
        }

        /* Leave a photon, unless shadow rays account for it. */
        const struct bsdf bsdf = bsdf_at(material, &surface, wo, boundary.eta, path.flux);
        if (bsdf_is_diffuse(&bsdf) && !(path.straight && params.direct == RT_DIRECT_NEE))
            own[count++] = make_photon(&path, &surface, &bsdf, index);

        /* Choose an event, or absorption, and go on. */
        const float4 u = sampler_set(&sampler, set_scatter(path.depth - 1u));
        alive = scatter_path(&path, &surface, &bsdf, boundary.beyond, u);
    }
    counts[item] = count;
}
