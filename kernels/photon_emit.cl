/*
 * photon_emit.cl - photon tracing: each work-item follows one path from a light.
 *
 * A path starts with the flux of all lights, in the colour of the light that was chosen, and leaves
 * a photon at each surface that reflects diffusely; specular events, perfect or rough, are
 * followed, here and from the eye, and are no part of what a photon stands for. The division by the
 * number of paths is left to those who use the photons, so that maps can be joined. Its photons go
 * to slots of its own, so that the map does not depend on the order in which paths are followed.
 *
 * Paths for a caustic map alone start towards specular shapes (aim.h).
 *
 * A path has at most max_depth - 1 segments: with the one segment from the eye to the place
 * where the map is asked, that is the longest path of path tracing.
 *
 * Each path keeps account of its flux: what surfaces absorb is taken off as their albedo says,
 * whatever lobe is chosen, and the difference that the choice makes is booked as roulette, whose
 * mean is zero.
 *
 * References:
 *   Jensen: "Global Illumination using Photon Maps", EGWR 1996.
 *   Veach: "Robust Monte Carlo Methods for Light Transport Simulation", PhD thesis, 1997, chapter 5
 *     (flux is not scaled at refraction, radiance is).
 */
#include "photon/aim.h"
#include "bsdf/bsdf.h"
#include "entry.h"
#include "light/emit.h"
#include "material/medium.h"
#include "sample/rng.h"
#include "accel/traverse.h"

/* A path under way. */
struct light_path {
    struct ray ray;
    float3 flux;
    float3 absorbed, roulette; /* as rt_path_account says */
    uint4 media;
    uint depth;     /* segments, the one under way included */
    uint hidden;    /* boundaries crossed that a stronger medium hides */
    bool straight;  /* nothing was met yet: a shadow ray would find the light */
    bool scattered; /* by some event other than a delta one */
    uint photons;   /* that it stored */
    uint rejected;  /* and that it did not, because they were not finite */
};

/*
 * Starts a path and its account, aimed when it is for caustics alone; false when there is no light.
 */
static bool start_path(struct light_path *path, const struct scene *scene,
                       global const rt_light_share *shares, const struct sampler *sampler,
                       bool for_caustics, rt_path_account *account)
{
    struct emission emission;
    const float8 u = sampler_pair(sampler, SET_START); /* and SET_EMISSION, the set after it */
    bool lit = light_emit(scene, shares, u.lo, u.hi, &emission);
    path->flux = path->absorbed = path->roulette = (float3)(0.0f);
    path->media = RT_VACUUM;
    path->photons = path->rejected = 0u;
    account->light = RT_NONE;
    if (lit && for_caustics) {
        aim_at_caustics(scene, u.lo, u.hi, &emission);
        lit = largest3(emission.flux) > 0.0f;
    }
    if (lit) {
        path->ray = make_ray(leave_surface(&emission.at, emission.direction), emission.direction,
                             0.0f, INFINITY);
        path->flux = emission.flux;
        path->media = (uint4)(vload3(0, scene->lights[emission.light].media), 0u) - 1u;
        account->light = emission.light;
    }
    vstore3(path->flux, 0, account->emitted);
    path->depth = 1u;
    path->hidden = 0u;
    path->straight = true;
    path->scattered = false;
    return lit;
}

/* Closes the account of a path that ended so. */
static void end_path(const struct light_path *path, uint end, rt_path_account *account)
{
    vstore3(path->absorbed, 0, account->absorbed);
    account->photons = path->photons;
    vstore3(path->flux, 0, account->left);
    account->end = end;
    vstore3(path->roulette, 0, account->roulette);
    account->rejected = path->rejected;
}

/* Loses what the medium absorbs over a distance; false when nothing is left. */
static bool cross_medium(struct light_path *path, const struct scene *scene, float distance)
{
    const float3 passed =
        path->flux * medium_transmittance(scene->materials, path->media.x, distance);
    path->absorbed += path->flux - passed;
    path->flux = passed;
    return largest3(path->flux) > 0.0f;
}

static bool is_caustic(const struct light_path *path)
{
    return !path->straight && !path->scattered;
}

/*
 * Whether the map under way takes a photon here; what comes straight from a light may be left to
 * shadow rays.
 */
static bool is_stored(const struct light_path *path, const rt_params *params)
{
    if (params->store == RT_STORE_CAUSTIC)
        return is_caustic(path);
    if (params->store == RT_STORE_GLOBAL && is_caustic(path))
        return false;
    return !(path->straight && params->direct == RT_DIRECT_NEE);
}

static rt_photon make_photon(const struct light_path *path, const struct surface *surface,
                             const struct bsdf *bsdf, uint index)
{
    rt_photon photon;
    vstore3(surface->position, 0, photon.position);
    photon.path = index;
    vstore3(bsdf->wo, 0, photon.wi);
    photon.flags = (path->depth << 8) | (is_caustic(path) ? RT_PHOTON_CAUSTIC : 0u);
    vstore3(path->flux, 0, photon.flux);
    photon.shading = max(dot(bsdf->wo, bsdf->shading), 0.0f) / dot(bsdf->wo, bsdf->normal);
    vstore3(bsdf->normal, 0, photon.normal);
    photon.shape = surface->shape;
    return photon;
}

static bool photon_is_sound(const rt_photon *photon)
{
    return all(fabs(vload3(0, photon->position)) <= RT_COORDINATE_MAX) &&
           all(isfinite(vload3(0, photon->wi))) && all(isfinite(vload3(0, photon->flux))) &&
           all(isfinite(vload3(0, photon->normal))) && isfinite(photon->shading);
}

/* Leaves a photon at a surface, in the next slot of the path's column. */
static void leave_photon(struct light_path *path, const rt_params *params,
                         const struct surface *surface, const struct bsdf *bsdf, uint index,
                         global rt_photon *slots)
{
    const rt_photon photon = make_photon(path, surface, bsdf, index);
    if (photon_is_sound(&photon))
        slots[path->photons++ * params->slots] = photon;
    else
        path->rejected++;
}

/*
 * Scatters the path at a surface; false when it ends. Survival keeps the flux of all photons alike:
 * it is the share of the strongest channel that the surface leaves.
 */
static bool scatter_path(struct light_path *path, const struct surface *surface,
                         const struct bsdf *bsdf, uint4 beyond, float4 u)
{
    const float3 arrived = path->flux;
    const float3 kept = arrived * bsdf_albedo(bsdf);
    const float survival = min(1.0f, largest3(kept) / largest3(arrived));
    const uint lobe = bsdf_choose(bsdf, survival, u.z);
    path->absorbed += arrived - kept;
    path->roulette += kept;
    path->flux = (float3)(0.0f);
    if (lobe == RT_LOBE_NONE)
        return false;
    const struct scatter scatter = bsdf_scatter(bsdf, lobe, u.xyw, CARRY_FLUX);
    const float3 chosen = arrived * (bsdf_lobe_weight(bsdf, lobe) / survival);
    path->flux = arrived * (scatter.weight / survival);
    path->roulette -= chosen;
    path->absorbed += chosen - path->flux; /* at shading normals */
    if (!(largest3(path->flux) > 0.0f))
        return false;
    path->ray = make_ray(leave_surface(surface, scatter.wi), scatter.wi, 0.0f, INFINITY);
    path->straight = false;
    path->scattered |= !lobe_is_delta(lobe);
    if (scatter.through)
        path->media = beyond;
    path->depth++;
    return true;
}

/*
 * Follows a path from its start to its end: photons go to the slots of its column, from the first
 * row on, and what became of the flux to the account.
 */
INLINE_NEVER void follow_light_path(const struct scene *scene, const rt_params *params,
                                    const struct sampler *sampler,
                                    global const rt_light_share *shares, uint index,
                                    global rt_photon *slots, rt_path_account *account)
{
    const bool for_caustics = params->store == RT_STORE_CAUSTIC;
    struct light_path path;
    uint end = RT_END_CUT_OFF;

    bool alive =
        start_path(&path, scene, shares, sampler, for_caustics, account) && can_follow(&path.ray);
    while (alive && path.depth < params->max_depth) {
        /*
         * Draw the numbers of the next vertex: they depend on nothing, so a processor makes them
         * while it waits below.
         */
        const float4 u = sampler_set(sampler, set_scatter(path.depth - 1u));

        /* Find the nearest surface. */
        struct hit hit;
        if (!closest_hit(scene, &path.ray, &hit)) {
            end = RT_END_ESCAPED;
            break;
        }
        const struct surface surface = surface_at(scene, &path.ray, &hit);
        const uint material_index = scene->shapes[surface.shape].material;
        global const rt_material_data *material = scene->materials + material_index;
        const float3 wo = -path.ray.direction;

        /* Lose what the medium absorbs on the way. */
        if (!cross_medium(&path, scene, hit.t)) {
            end = RT_END_ABSORBED;
            break;
        }

        /* Go straight on through a boundary that a stronger medium hides. */
        const struct boundary boundary =
            media_meet(scene, path.media, material_index, dot(wo, surface.normal) > 0.0f);
        if (!boundary.exists) {
            path.straight = false;
            alive = pass_boundary(&path.ray, &path.media, &path.hidden, &surface, boundary.beyond);
            continue;
        }

        /* Leave a photon where the map wants one. */
        const struct bsdf bsdf = bsdf_at(scene, material, &surface, wo, boundary.eta, path.flux);
        if (bsdf_is_diffuse(&bsdf) && is_stored(&path, params))
            leave_photon(&path, params, &surface, &bsdf, index, slots);

        /* Choose a lobe, or absorption, and go on. */
        alive = scatter_path(&path, &surface, &bsdf, boundary.beyond, u);
        if (!alive)
            end = RT_END_ABSORBED;

        /* Nothing that a caustic map keeps comes after an event that spreads light. */
        if (for_caustics && path.scattered)
            break;
    }
    end_path(&path, end, account);
}

/*
 * shares: [light_count]; slots: [params.max_depth - 1][params.slots], a column a path, of which
 * each fills as many as its account says: so neighbours write side by side, and rows that few paths
 * reach stay untouched; accounts: [item_count].
 */
KERNEL photon_emit(const rt_params params, global const rt_scene_header *header,
                   global const rt_light_share *shares, global rt_photon *slots,
                   global rt_path_account *accounts)
{
    const uint item = (uint)get_global_id(0);
    if (item >= params.item_count)
        return;
    const struct scene scene = scene_open(header);
    const uint index = params.first_item + item;
    const struct sampler sampler = sampler_start(
        &scene, &params, params.store == RT_STORE_CAUSTIC ? RT_STREAM_CAUSTIC : RT_STREAM_PHOTONS,
        index);
    rt_path_account account;
    follow_light_path(&scene, &params, &sampler, shares, index, slots + item, &account);
    accounts[item] = account;
}
