/*
 * photon_emit.cl - photon tracing: each work-item follows one path from a light.
 *
 * A path starts with the flux of the chosen light over the probability of choosing it, and stores a
 * photon at each surface with an event that is gathered, unless the map leaves that light to shadow
 * rays or to another map (store.h); the other events, smooth or rough, are followed, here and from
 * the eye, and are no part of what a photon stands for. The division by the number of paths is left
 * to those who use the photons, so that maps can be joined. Its photons go to slots of its own, so
 * that the map does not depend on the order in which paths are followed.
 *
 * Paths for a caustic map alone start towards specular shapes (aim.h).
 *
 * A path has at most max_depth - 1 segments: with the one segment from the eye to the place
 * where photons are gathered, that is the longest path of path tracing.
 *
 * Reference:
 *   Jensen: "Global Illumination using Photon Maps", EGWR 1996.
 */
#include "accel/traverse.h"
#include "count.h"
#include "entry.h"
#include "photon/light_path.h"
#include "photon/store.h"
#include "sample/rng.h"
#include "surface/vertex.h"

/* False where the path ends, as *end then says. */
static inline bool reach_surface(struct light_path *path, const struct scene *scene,
                                 struct meeting *met, uint *end)
{
    struct hit hit;
    COUNT(scene, RT_COUNTER_PHOTON, path->ray.direction.x);
    if (!closest_hit(scene, &path->ray, &hit)) {
        *end = RT_END_ESCAPED;
        return false;
    }
    meet_surface(met, scene, &path->ray, &hit, path->media);
    if (cross_medium(path, scene, hit.t))
        return true;
    *end = RT_END_ABSORBED;
    return false;
}

/* Starts a path; false where that is its end, as *end then says. */
CALLED_ON_GPUS bool set_out(struct light_path *path, const struct scene *scene,
                            const rt_params *params, const struct sampler *sampler,
                            global const rt_light_share *shares, uint *end,
                            rt_path_account *account)
{
    const bool for_caustics = params->store == RT_STORE_CAUSTIC;
    *end = RT_END_CUT_OFF;
    if (!start_light_path(path, scene, shares, sampler, for_caustics, account) ||
        !can_follow(&path->ray))
        return false;
    if (come_from_afar(path, scene, account->light))
        return true;
    *end = RT_END_ABSORBED;
    return false;
}

/* Follows it to its end: photons go to the slots of its column, from the first row on. */
CALLED_ON_GPUS void follow_on(struct light_path *path, const struct scene *scene,
                              const rt_params *params, const struct sampler *sampler, uint index,
                              global rt_photon *slots, uint *end)
{
    bool alive = true;
    while (alive && path->depth < params->max_depth) {
        /*
         * Draw the numbers of the next vertex: they depend on nothing, so a processor makes them
         * while it waits below.
         */
        const float4 u = light_path_numbers(path, sampler);

        /* Find the nearest surface, and lose what the medium absorbs until there. */
        struct meeting met;
        if (!reach_surface(path, scene, &met, end))
            break;

        /* Skip a boundary suppressed by a medium of higher priority. */
        if (!met.boundary.exists) {
            path->straight = false;
            alive = pass_boundary(&path->ray, &path->media, &path->hidden, &met.surface,
                                  met.boundary.beyond);
            continue;
        }

        /* Store a photon; choose an event, or absorption, and go on. */
        alive = shade_photon(path, scene, params, sampler, &met, u, index, slots);
        if (!alive)
            *end = RT_END_ABSORBED;

        /* No caustic photon comes after an event other than a delta one. */
        if (params->store == RT_STORE_CAUSTIC && path->scattered)
            break;
    }
}

/* Follows a path from its start to its end, and closes its account. */
INLINE_NEVER void follow_light_path(const struct scene *scene, const rt_params *params,
                                    const struct sampler *sampler,
                                    global const rt_light_share *shares, uint index,
                                    global rt_photon *slots, rt_path_account *account)
{
    struct light_path path;
    uint end;
    if (set_out(&path, scene, params, sampler, shares, &end, account))
        follow_on(&path, scene, params, sampler, index, slots, &end);
    end_light_path(&path, end, account);
}

/*
 * shares: [light_count]; slots: [params.max_depth - 1][params.slots], a column a path, of which
 * each fills as many as its account says: so neighbours write side by side, and rows that few paths
 * reach stay untouched; accounts: [item_count].
 */
KERNEL ENTRY(photon_emit)(const rt_params params, global const rt_scene_header *header,
                          global const rt_light_share *shares, global rt_photon *slots,
                          global rt_path_account *accounts)
{
    const uint item = item_number();
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
