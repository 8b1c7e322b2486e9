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
 * Where the density lies on a grid, paths collide by delta tracking (volume/grid.h), with
 * coefficients and a density of collisions that are those at the point. The expected value of
 * absorption is then taken at each collision, null ones included: of the flux that would have gone
 * through up to there, the part a_c sigma_a,c/sigma_t,c. Where the albedo lies on a grid, what is
 * absorbed is booked at the collision at which the path ends or is scattered.
 *
 * References:
 *   Jensen, Christensen: "Efficient Simulation of Light Transport in Scenes with Participating
 *     Media using Photon Maps", SIGGRAPH 1998.
 */
#ifndef RT_KERNELS_PHOTON_VOLUME_PATH_H
#define RT_KERNELS_PHOTON_VOLUME_PATH_H

#include "photon/light_path.h"
#include "photon/store.h"
#include "volume/march.h"
#include "volume/phase.h"

/* Where a path collides with a medium. */
struct collision {
    float3 position;
    float density; /* of the medium, there; of three channels the largest */
};

/* What of sigma_t absorbs, where that is the same everywhere; else 0. */
static inline float3 absorbed_share(const struct medium *medium)
{
    if (has_albedo(medium))
        return (float3)(0.0f);
    const float3 absorption = medium->extinction - medium->scattering;
    return (float3)(medium->extinction.x > 0.0f ? absorption.x / medium->extinction.x : 0.0f,
                    medium->extinction.y > 0.0f ? absorption.y / medium->extinction.y : 0.0f,
                    medium->extinction.z > 0.0f ? absorption.z / medium->extinction.z : 0.0f);
}

/* Attenuates the flux over a distance that the path is known to pass. */
static inline void pass_medium(struct light_path *path, const struct scene *scene,
                               const struct medium *medium, float distance)
{
    const float3 passed =
        path->flux * (is_on_grid(medium) ? marched_transmittance(scene, medium, path->ray.origin,
                                                                 path->ray.direction, distance)
                                         : transmittance(medium, distance));
    path->absorbed += path->flux - passed;
    path->flux = passed;
}

/* The flux that a collision scatters, by its flux over the density of collisions. */
static inline float3 scattered_flux(const struct light_path *path, const struct scene *scene,
                                    const struct medium *medium, const struct collision *collision)
{
    float3 scattered = path->flux * medium->scattering * collision->density;
    if (is_coloured(medium))
        scattered *= density_colour(scene, medium, collision->position);
    if (has_albedo(medium))
        scattered *= albedo_at(scene, medium, collision->position);
    return scattered;
}

/* Books what is absorbed at a collision where the albedo lies on a grid. */
static inline void book_absorbed(struct light_path *path, const struct scene *scene,
                                 const struct medium *medium, const struct collision *collision)
{
    if (!has_albedo(medium))
        return;
    const float3 collided = path->flux * medium->extinction * collision->density *
                            density_colour(scene, medium, collision->position);
    const float3 absorbed = collided - scattered_flux(path, scene, medium, collision);
    path->absorbed += absorbed;
    path->roulette -= absorbed;
}

/*
 * Brings the path to the end of its segment of this length, which may be infinite; true where it
 * collides with the medium before. Its flux is then that over the density of collisions, W m, and
 * all of what is left is accounted as roulette.
 */
static inline bool collide_in_medium(struct light_path *path, const struct scene *scene,
                                     const struct medium *medium, float length,
                                     const struct sampler *sampler, struct collision *collision)
{
    const float2 u = sampler_set(sampler, set_segment(path->depth + path->hidden)).xy;
    const float3 pmf = channel_pmf(path->flux);
    const float3 passes = transmittance(medium, length);
    const float3 absorbed = path->flux * absorbed_share(medium) * (1.0f - passes);
    path->absorbed += absorbed;
    path->roulette += path->flux - absorbed;
    const float distance = sample_distance(medium, pmf, u);
    if (distance < length) {
        path->flux *=
            transmittance(medium, distance) * (1.0f / distance_pdf(medium, pmf, distance));
        collision->position = path->ray.origin + distance * path->ray.direction;
        collision->density = 1.0f;
        book_absorbed(path, scene, medium, collision);
        return true;
    }
    path->flux *= passes * (1.0f / passing_probability(medium, pmf, length));
    path->roulette -= path->flux;
    return false;
}

/* The same where the density lies on a grid. */
static inline bool collide_in_grid(struct light_path *path, const struct scene *scene,
                                   const struct medium *medium, float length,
                                   const struct sampler *sampler, struct collision *collision)
{
    struct stream stream = stream_of(sampler, set_segment(path->depth + path->hidden));
    const struct ray *ray = &path->ray;
    const float3 pmf = channel_pmf(path->flux);
    struct tracked tracked;
    const bool collides =
        delta_tracking(&tracked, scene, medium, ray->origin, ray->direction, length, pmf, &stream);
    const float3 absorbed = path->flux * absorbed_share(medium) * tracked.collided;
    path->absorbed += absorbed;
    path->roulette += path->flux - absorbed;
    if (collides) {
        path->flux *= collided_weight(&tracked, medium, pmf);
        collision->position = ray->origin + tracked.distance * ray->direction;
        collision->density = tracked.density;
        book_absorbed(path, scene, medium, collision);
        return true;
    }
    path->flux *= tracked.passed;
    path->roulette -= path->flux;
    return false;
}

/*
 * Scatters a path that collided at a point, or ends it by Russian roulette: false. `reference`: the
 * largest channel of the flux that it came with.
 */
static inline bool scatter_light_in_medium(struct light_path *path, const struct scene *scene,
                                           const struct medium *medium,
                                           const struct collision *collision, float reference,
                                           float4 u)
{
    const float3 direction = path->ray.direction;
    const float3 scattered = scattered_flux(path, scene, medium, collision);
    const float survival = roulette_survival(scattered, reference);
    path->flux = (float3)(0.0f);
    if (!(u.z < survival))
        return false;
    path->flux = scattered * (1.0f / survival);
    path->roulette -= path->flux;
    path->ray =
        make_ray(collision->position, phase_sample(medium->g, direction, u.xy), 0.0f, INFINITY);
    path->straight = false;
    path->scattered = true;
    DISPERSED(path->wavelength = 0.0f);
    path->depth++;
    return true;
}

/* Stores a photon in a medium, in the next slot of the path's column. */
static inline void store_volume_photon(struct light_path *path, const rt_params *params,
                                       const struct collision *collision, uint index,
                                       global rt_photon *slots)
{
    rt_photon photon;
    if (path->straight && params->direct == RT_DIRECT_NEE)
        return;
    vstore3(collision->position, 0, photon.position);
    photon.path = index;
    vstore3(-path->ray.direction, 0, photon.wi);
    photon.flags =
        (path->depth << 8) | RT_PHOTON_VOLUME | (is_caustic(path) ? RT_PHOTON_CAUSTIC : 0u);
    vstore3(path->flux, 0, photon.flux);
    photon.shading = collision->density;
    vstore3(-path->ray.direction, 0, photon.normal);
    photon.shape = path->media.x;
    keep_photon(path, params, &photon, slots);
}

#endif
