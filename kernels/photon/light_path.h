/*
 * light_path.h - a photon path: its start at a light, its events, and the account of its flux.
 *
 * Absorption is accounted by its expected value, 1 - albedo; the deviation caused by choosing one
 * event and by Russian roulette is accounted as roulette, whose expected value is zero: so emitted
 * flux = absorbed + left + roulette, but for rounding.
 *
 * References:
 *   Veach: "Robust Monte Carlo Methods for Light Transport Simulation", PhD thesis, 1997, chapter 5
 *     (flux is not scaled at refraction, radiance is).
 */
#ifndef RT_KERNELS_PHOTON_LIGHT_PATH_H
#define RT_KERNELS_PHOTON_LIGHT_PATH_H

#include "sample/roulette.h"
#include "light/emit.h"
#include "material/medium.h"
#include "photon/aim.h"
#include "photon/importance.h"
#include "sample/rng.h"
#include "surface/vertex.h"

/* A path under way. */
struct light_path {
    struct ray ray;
    float3 flux;
    float3 absorbed, roulette; /* as rt_path_account says */
    uint4 media;
    uint depth;                  /* segments, the one under way included */
    uint hidden;                 /* boundaries skipped inside a medium of higher priority */
    bool straight;               /* no surface was hit yet: direct light */
    bool scattered;              /* by an event other than a delta one */
    uint photons;                /* photons stored */
    uint rejected;               /* photons not stored: not finite, or beyond RT_COORDINATE_MAX */
    DISPERSED(float wavelength;) /* of the run of delta events under way, micrometres; 0: none */
#if RT_WIDTH > 1
    float8 numbers; /* of the last vertex that is even from 0 on, and of the one after it */
#endif
};

/* Whether it came through delta events only. */
static inline bool is_caustic(const struct light_path *path)
{
    return !path->straight && !path->scattered;
}

/*
 * Starts a path and its account, aimed at specular shapes when it is for caustics alone; false when
 * it has no flux.
 */
INLINE_ALWAYS bool start_light_path(struct light_path *path, const struct scene *scene,
                                    global const rt_light_share *shares,
                                    const struct sampler *sampler, bool for_caustics,
                                    rt_path_account *account)
{
    struct emission emission;
    const float8 u = sampler_pair(sampler, SET_START); /* and SET_EMISSION, the set after it */
    float4 start = u.lo, turn = u.hi;
    const float weight = for_caustics ? 1.0f : warp_start(scene, shares, &start, &turn);
    bool lit = light_emit(scene, shares, start, turn, for_caustics, &emission);
    path->flux = path->absorbed = path->roulette = (float3)(0.0f);
    path->media = RT_VACUUM;
    path->photons = path->rejected = 0u;
    account->light = RT_NONE;
    if (lit && for_caustics) {
        aim_at_caustics(scene, shares, u.lo, u.hi, &emission);
        lit = largest3(emission.flux) > 0.0f;
    }
    if (lit) {
        path->ray = make_ray(leave_surface(&emission.at, emission.direction), emission.direction,
                             0.0f, INFINITY);
        path->flux = weight * emission.flux;
        path->media = emission_media(scene, &emission);
        account->light = emission.light;
    }
    vstore3(path->flux, 0, account->emitted);
    path->depth = 1u;
    path->hidden = 0u;
    path->straight = true;
    path->scattered = false;
    DISPERSED(path->wavelength = 0.0f);
    return lit;
}

/*
 * The numbers set_scatter of the next vertex. Lanes make those of two vertices in the time of one;
 * elsewhere it would cost registers to keep them.
 */
static inline float4 light_path_numbers(struct light_path *path, const struct sampler *sampler)
{
    const uint vertex = path->depth - 1u;
#if RT_WIDTH > 1
    const bool is_second = (vertex & 1u) != 0u;
    if (!is_second)
        path->numbers = sampler_sets_of(sampler, set_scatter(vertex), set_scatter(vertex + 1u));
    return is_second ? path->numbers.hi : path->numbers.lo;
#else
    return sampler_set(sampler, set_scatter(vertex));
#endif
}

/* Closes the account of a path that ended so. */
static inline void end_light_path(const struct light_path *path, uint end, rt_path_account *account)
{
    vstore3(path->absorbed, 0, account->absorbed);
    account->photons = path->photons;
    vstore3(path->flux, 0, account->left);
    account->end = end;
    vstore3(path->roulette, 0, account->roulette);
    account->rejected = path->rejected;
}

/* Attenuates the flux by the medium over a distance; false when none is left. */
static inline bool cross_medium(struct light_path *path, const struct scene *scene, float distance)
{
    const float3 passed =
        path->flux * medium_transmittance(scene->materials, path->media.x, distance);
    path->absorbed += path->flux - passed;
    path->flux = passed;
    return largest3(path->flux) > 0.0f;
}

/*
 * Takes from a path that starts infinitely far what an endless solid, behind a plane, leaves of it;
 * false where that is nothing.
 */
static inline bool come_from_afar(struct light_path *path, const struct scene *scene, uint light)
{
    return !is_far(scene->lights + light) || cross_medium(path, scene, INFINITY);
}

/* Finds the wavelength of a boundary that the path meets; returns what it weighs. */
static inline float3 light_path_disperse(struct light_path *path, const struct scene *scene,
                                         const struct sampler *sampler, struct meeting *met)
{
#ifdef RT_DISPERSION
    return meet_dispersion(met, &path->wavelength, scene, path->media.x, path->flux, sampler,
                           path->depth - 1u);
#else
    return (float3)(1.0f);
#endif
}

#ifdef RT_DISPERSION
/* Weighs the flux by that. */
static inline void weigh_flux(struct light_path *path, float3 drawn)
{
    path->roulette += path->flux - path->flux * drawn;
    path->flux *= drawn;
}
#endif

/*
 * Scatters the path at a surface; false when it ends. The survival probability is the largest
 * channel of what radiance would keep over that of the incident flux, which keeps the flux of all
 * photons about equal.
 */
static inline bool scatter_light_path(struct light_path *path, const struct vertex *vertex,
                                      float4 u)
{
    const float3 arrived = path->flux;
    const float3 kept = arrived * vertex_albedo(vertex);
    const float survival =
        roulette_survival(arrived * vertex_radiance_albedo(vertex), largest3(arrived));
    const uint event = vertex_choose(vertex, survival, u.z);
    path->absorbed += arrived - kept;
    path->roulette += kept;
    path->flux = (float3)(0.0f);
    if (event == RT_NO_EVENT)
        return false;
    const struct scatter scatter = vertex_scatter(vertex, event, u.xyw);
    const float3 chosen = arrived * (vertex_event_weight(vertex, event) / survival);
    path->flux = arrived * (scatter.weight / survival);
    path->roulette -= chosen;
    path->absorbed += chosen - path->flux; /* the rest of the loss by normals */
    if (!(largest3(path->flux) > 0.0f))
        return false;
    path->ray = make_ray(vertex_leave(vertex, scatter.wi), scatter.wi, 0.0f, INFINITY);
    path->straight = false;
    path->scattered |= !event_is_delta(event);
    DISPERSED(path->wavelength = event_is_delta(event) ? path->wavelength : 0.0f);
    if (scatter.through)
        path->media = vertex->beyond;
    path->depth++;
    return true;
}

#endif
