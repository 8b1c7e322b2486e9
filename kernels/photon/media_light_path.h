/*
 * media_light_path.h - the photon paths of photon_emit_media.cl and photon_emit_grids.cl: each
 * work-item follows one path from a light, and stores a photon wherever it collides with a medium,
 * too.
 *
 * Paths for a caustic map alone are attenuated by media and never scattered in them: what is
 * scattered is no caustic at a surface.
 */
#ifndef RT_KERNELS_PHOTON_MEDIA_LIGHT_PATH_H
#define RT_KERNELS_PHOTON_MEDIA_LIGHT_PATH_H

#include "entry.h"
#include "accel/traverse.h"
#include "count.h"
#include "photon/volume_path.h"
#include "surface/vertex.h"

/* Goes on at the surface that a path hits; false where it ends, as *end then says. */
static inline bool meet_photon(struct light_path *path, const struct scene *scene,
                               const rt_params *params, const struct sampler *sampler,
                               const struct hit *hit, float4 u, uint index, global rt_photon *slots,
                               uint *end)
{
    struct meeting met;
    meet_surface(&met, scene, &path->ray, hit, path->media);
    *end = RT_END_CUT_OFF;
    if (is_passable(scene, &met.surface, &met.boundary))
        return pass_boundary(&path->ray, &path->media, &path->hidden, &met.surface,
                             met.boundary.beyond);
    *end = RT_END_ABSORBED;
    return shade_photon(path, scene, params, sampler, &met, u, index, slots);
}

/* Extends a path by one segment; false where it ends, as *end then says. */
static inline bool extend_light_path(struct light_path *path, const struct scene *scene,
                                     const rt_params *params, const struct sampler *sampler,
                                     bool for_caustics, uint index, global rt_photon *slots,
                                     uint *end)
{
    const float4 u = light_path_numbers(path, sampler);
    const struct medium medium = medium_of(scene, path->media.x);
    const struct ray ray = path->ray;
    const float reference = largest3(path->flux);
    struct collision collision;
    struct hit hit;

    /* Find the nearest surface, or the collision before it. */
    COUNT(scene, RT_COUNTER_PHOTON, ray.direction.x);
    const bool found = closest_hit(scene, &ray, &hit);
    const float length = found ? hit.t : INFINITY;
    *end = RT_END_ABSORBED;
    if (for_caustics || !medium_scatters(&medium))
        pass_medium(path, scene, &medium, length);
    else if (is_on_grid(&medium)
                 ? collide_in_grid(path, scene, &medium, length, sampler, &collision)
                 : collide_in_medium(path, scene, &medium, length, sampler, &collision)) {
        store_volume_photon(path, params, &collision, index, slots);
        return scatter_light_in_medium(path, scene, &medium, &collision, reference, u);
    }
    if (!(largest3(path->flux) > 0.0f))
        return false;
    if (!found) {
        *end = RT_END_ESCAPED;
        return false;
    }
    return meet_photon(path, scene, params, sampler, &hit, u, index, slots, end);
}

/*
 * Takes from a path what a medium without end, in which it starts infinitely far, leaves of it;
 * false where that is nothing.
 */
static inline bool cross_endless_medium(struct light_path *path, const struct scene *scene,
                                        uint light)
{
    const struct medium medium = medium_of(scene, path->media.x);
    if (is_far(scene->lights + light) && !is_on_grid(&medium))
        pass_medium(path, scene, &medium, INFINITY);
    return largest3(path->flux) > 0.0f;
}

/* As in photon_emit.cl. */
INLINE_NEVER void follow_light_path(const struct scene *scene, const rt_params *params,
                                    const struct sampler *sampler,
                                    global const rt_light_share *shares, uint index,
                                    global rt_photon *slots, rt_path_account *account)
{
    const bool for_caustics = params->store == RT_STORE_CAUSTIC;
    struct light_path path;
    uint end = RT_END_CUT_OFF;
    bool alive = start_light_path(&path, scene, shares, sampler, for_caustics, account) &&
                 can_follow(&path.ray);
    if (alive && !cross_endless_medium(&path, scene, account->light)) {
        alive = false;
        end = RT_END_ABSORBED;
    }
    while (alive && path.depth < params->max_depth) {
        alive = extend_light_path(&path, scene, params, sampler, for_caustics, index, slots, &end);
        if (for_caustics && path.scattered)
            break;
    }
    end_light_path(&path, alive ? RT_END_CUT_OFF : end, account);
}

/* The path of a work-item; the arguments are those of photon_emit. */
static inline void emit_item(const rt_params *params, global const rt_scene_header *header,
                             global const rt_light_share *shares, global rt_photon *slots,
                             global rt_path_account *accounts)
{
    const uint item = item_number();
    if (item >= params->item_count)
        return;
    const struct scene scene = scene_open(header);
    const uint index = params->first_item + item;
    const struct sampler sampler = sampler_start(
        &scene, params, params->store == RT_STORE_CAUSTIC ? RT_STREAM_CAUSTIC : RT_STREAM_PHOTONS,
        index);
    rt_path_account account;
    follow_light_path(&scene, params, &sampler, shares, index, slots + item, &account);
    accounts[item] = account;
}

#endif
