/*
 * path.h - the path integrator: estimates the rendering equation along one camera path by Monte
 * Carlo.
 *
 *   Lo(x, wo) = Le(x, wo) + integral of fr(x, wo, wi) Li(x, wi) |n.wi| dwi            Kajiya 1986
 *
 * Direct light is estimated at each vertex by two techniques, light sampling and BSDF sampling,
 * combined by multiple importance sampling (mis.h). Delta events and delta lights leave only one of
 * the two, which then counts fully. Photon mapping uses the same integrator, ending at gather
 * points (gather.h).
 *
 * References:
 *   Kajiya: "The Rendering Equation", SIGGRAPH 1986.
 *   Veach: "Robust Monte Carlo Methods for Light Transport Simulation", PhD thesis, 1997.
 */
#ifndef RT_KERNELS_INTEGRATE_PATH_H
#define RT_KERNELS_INTEGRATE_PATH_H

#include "integrate/direct_light.h"
#include "integrate/emission.h"
#include "integrate/gather.h"
#include "integrate/path_state.h"
#include "integrate/split.h"
#include "material/contact.h"
#include "sample/roulette.h"

/*
 * Attenuates the path by the medium that it crosses over the length t; not again where it goes on
 * from a vertex that it was split at, which is returned.
 */
static inline bool arrive(struct path *path, const struct scene *scene, float t, const uint purpose)
{
    const bool resumes = purpose == FOLLOW_TO_GATHER && path->resumes;
    path->resumes = false;
    if (!resumes)
        path->beta *= medium_transmittance(scene->materials, path->media.x, t);
    return resumes;
}

/*
 * Chooses a lobe by u, or ends the path by Russian roulette, RT_LOBE_NONE, but not where the next
 * gathered event is its last.
 */
static inline uint choose_lobe(struct path *path, const rt_params *params, const struct bsdf *bsdf,
                               const bool last, float u)
{
    const float3 throughput = path->beta * bsdf_albedo(bsdf);
    const float survival = last ? 1.0f : eye_path_survival(params, path->depth, throughput);
    const uint lobe = bsdf_choose(bsdf, survival, u);
    path->alive = lobe != RT_LOBE_NONE;
    path->beta *= 1.0f / survival;
    RECORD(path->vertex.survival = survival);
    return lobe;
}

/*
 * Shades the vertex that the path's ray hits, with the vertex's sample values u, and extends the
 * path. `purpose` is a constant at each call; *gather serves FOLLOW_TO_GATHER alone.
 */
static inline void path_vertex(const struct scene *scene, const rt_params *params,
                               struct path *path, const struct hit *hit, float8 u,
                               struct connection *connection, const uint purpose,
                               const struct gather *gather)
{
    struct surface surface = surface_at(scene, &path->ray, hit);
    const float3 wo = -path->ray.direction;

    /* Attenuate by the medium. */
    const bool resumes = arrive(path, scene, hit->t, purpose);

    /* Add what the surface emits, also where a medium of higher priority hides its boundary. */
    const struct boundary boundary = meet_boundary(scene, path->media, &surface, wo);
    const uint material = scene->shapes[surface.shape].material;
    RECORD(record_surface(path, &surface, material, wo, boundary.exists));
    if (!resumes)
        add_emission(path, scene, params, &surface, wo, purpose);

    /* Skip such a boundary; end the path at the maximum depth. */
    if (!boundary.exists) {
        path->pdf_w = 0.0f;
        path->alive =
            pass_boundary(&path->ray, &path->media, &path->hidden, &surface, boundary.beyond);
        return;
    }

    path->alive = !(purpose == FOLLOW_DIRECT && path->scattered);
    if (path->alive && path->depth == params->max_depth)
        path_cut_off(path, scene->materials + material);
    if (!path->alive)
        return;

    /* Split the path at the first rough event that is left to it. */
    const struct bsdf bsdf = bsdf_at(scene, scene->materials + material, &surface, wo, &boundary,
                                     path->beta, CARRY_RADIANCE);
    if (purpose == FOLLOW_TO_GATHER && is_split_at(path, params, &bsdf))
        u = split_path(path, gather, params, hit);

    /* Sample direct light. */
    const uint held = purpose == FOLLOW_TO_GATHER ? bsdf_gathered_lobes(&bsdf, params) : 0u;
    const bool last = ends_at_gather_point(path, params, purpose);
    connect_light(connection, scene, params, path, &surface, &bsdf, boundary.beyond.x, held, last,
                  u.lo);

    /* Choose a lobe, or end the path by Russian roulette, but not at its gather point. */
    const uint lobe = choose_lobe(path, params, &bsdf, last, u.hi.z);

    /* Gather photons by a lobe whose light they hold; sample a direction of it and go on. */
    const bool gathered = held >> lobe & 1u;
    if (gathered)
        add_gather_point(path, gather, last, &surface, &bsdf, lobe, material);
    if (path->alive)
        path_scatter(path, &surface, &bsdf, lobe, gathered, u.hi.xyw, boundary.beyond);
}

/* Extends a path that is alive by its next vertex. */
static inline void path_extend(const struct scene *scene, const rt_params *params,
                               struct path *path, const uint purpose, const struct gather *gather)
{
    /* Draw the sample values of the next vertex: that hides the latency of memory below. */
    const float8 u = path_numbers(path);

    /*
     * Find the nearest surface, or what the environment emits. A copy of the ray is handed on, so
     * that the path can live in registers.
     */
    const struct ray ray = path->ray;
    struct hit hit;
    if (purpose == FOLLOW_TO_GATHER && path->resumes) {
        copy_hit(&hit, &gather->fork->hit);
    } else if (count_path_ray(scene, path), !closest_hit(scene, &ray, &hit)) {
        add_environment(path, scene, params, purpose);
        path->alive = false;
        return;
    }

    /* Add emission, sample a light, apply Russian roulette, sample the BSDF. */
    struct connection connection;
    connection.radiance = (float3)(0.0f);
    path_vertex(scene, params, path, &hit, u, &connection, purpose, gather);

    /* Add the direct light that arrives. */
    add_connection(path, scene, &connection);
}

/* Follows one path to its end; returns its radiance and writes the throughput that was cut off. */
static inline float3 follow_path(const struct scene *scene, const rt_params *params,
                                 const struct sampler *sampler, struct ray ray, const uint purpose,
                                 const struct gather *gather, float *cut_off)
{
    struct path path;
    path_begin(&path, scene, sampler, ray);
    while (path.alive)
        path_extend(scene, params, &path, purpose, gather);
    *cut_off = path.cut_off;
    return path.radiance;
}

#endif
