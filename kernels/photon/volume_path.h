/*
 * volume_path.h - photon paths in media: how far they go, what they lose, and how they are
 * scattered.
 *
 * A distance is sampled by the transmittance (volume/medium.h). Where it ends before the next
 * surface, the path collides with the medium: there its flux over the density of collisions, in
 * W m, is what a volume photon carries (Jensen and Christensen 1998), and the flux that goes on is
 * sigma_s times that. Absorption is accounted by its expected value, sigma_a/sigma_t (1 - T) of
 * the flux, and what the sampled distance deviates from it as roulette; see light_path.h.
 *
 * References:
 *   Jensen, Christensen: "Efficient Simulation of Light Transport in Scenes with Participating
 *     Media using Photon Maps", SIGGRAPH 1998.
 */
#ifndef RT_KERNELS_PHOTON_VOLUME_PATH_H
#define RT_KERNELS_PHOTON_VOLUME_PATH_H

#include "photon/light_path.h"
#include "photon/store.h"
#include "volume/medium.h"
#include "volume/phase.h"

/* What of sigma_t absorbs. */
static inline float3 absorbed_share(const struct medium *medium)
{
    const float3 absorption = medium->extinction - medium->scattering;
    return (float3)(medium->extinction.x > 0.0f ? absorption.x / medium->extinction.x : 0.0f,
                    medium->extinction.y > 0.0f ? absorption.y / medium->extinction.y : 0.0f,
                    medium->extinction.z > 0.0f ? absorption.z / medium->extinction.z : 0.0f);
}

/* Attenuates the flux over a distance that the path is known to pass. */
static inline void pass_medium(struct light_path *path, const struct medium *medium, float distance)
{
    const float3 passed = path->flux * transmittance(medium, distance);
    path->absorbed += path->flux - passed;
    path->flux = passed;
}

/*
 * Brings the path to the end of its segment of this length, which may be infinite; true where it
 * collides with the medium at *distance before. Its flux is then that over the density of
 * collisions, W m, and all of what is left is accounted as roulette.
 */
static inline bool collide_in_medium(struct light_path *path, const struct medium *medium,
                                     float length, float2 u, float *distance)
{
    const float3 pmf = channel_pmf(path->flux);
    const float3 passes = transmittance(medium, length);
    const float3 absorbed = path->flux * absorbed_share(medium) * (1.0f - passes);
    path->absorbed += absorbed;
    path->roulette += path->flux - absorbed;
    *distance = sample_distance(medium, pmf, u);
    if (*distance < length) {
        path->flux *=
            transmittance(medium, *distance) * (1.0f / distance_pdf(medium, pmf, *distance));
        return true;
    }
    path->flux *= passes * (1.0f / passing_probability(medium, pmf, length));
    path->roulette -= path->flux;
    return false;
}

/*
 * Scatters a path that collided at a point, or ends it by Russian roulette: false. `reference`: the
 * largest channel of the flux that it came with.
 */
static inline bool scatter_light_in_medium(struct light_path *path, const struct medium *medium,
                                           float3 position, float reference, float4 u)
{
    const float3 direction = path->ray.direction;
    const float3 scattered = path->flux * medium->scattering;
    const float survival = roulette_survival(scattered, reference);
    path->flux = (float3)(0.0f);
    if (!(u.z < survival))
        return false;
    path->flux = scattered * (1.0f / survival);
    path->roulette -= path->flux;
    path->ray = make_ray(position, phase_sample(medium->g, direction, u.xy), 0.0f, INFINITY);
    path->straight = false;
    path->scattered = true;
    path->depth++;
    return true;
}

/* Stores a photon in a medium, in the next slot of the path's column. */
static inline void store_volume_photon(struct light_path *path, const rt_params *params,
                                       float3 position, uint index, global rt_photon *slots)
{
    rt_photon photon;
    if (path->straight && params->direct == RT_DIRECT_NEE)
        return;
    vstore3(position, 0, photon.position);
    photon.path = index;
    vstore3(-path->ray.direction, 0, photon.wi);
    photon.flags =
        (path->depth << 8) | RT_PHOTON_VOLUME | (is_caustic(path) ? RT_PHOTON_CAUSTIC : 0u);
    vstore3(path->flux, 0, photon.flux);
    photon.shading = 1.0f;
    vstore3(-path->ray.direction, 0, photon.normal);
    photon.shape = path->media.x;
    keep_photon(path, params, &photon, slots);
}

#endif
