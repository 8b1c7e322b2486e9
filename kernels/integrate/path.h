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
#include "sample/roulette.h"
#include "surface/vertex.h"

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
 * Chooses an event by u, or ends the path by Russian roulette, RT_NO_EVENT, but not where the next
 * gathered event is its last.
 */
static inline uint choose_event(struct path *path, const rt_params *params,
                                const struct vertex *vertex, const bool last, float u)
{
    const float3 throughput = path->beta * vertex_albedo(vertex);
    const float survival = last ? 1.0f : eye_path_survival(params, path->depth, throughput);
    const uint event = vertex_choose(vertex, survival, u);
    path->alive = event != RT_NO_EVENT;
    path->beta *= 1.0f / survival;
    RECORD(path->vertex.survival = survival);
    return event;
}

/*
 * Extends the path by the numbers u: gathers photons by an event whose light they hold; where it
 * goes on, samples a direction.
 */
static inline void go_on(struct path *path, const rt_params *params, const struct vertex *vertex,
                         uint held, const bool last, float4 u, const struct gather *gather)
{
    const uint event = choose_event(path, params, vertex, last, u.z);
    const bool gathered = held >> event & 1u;
    if (gathered)
        add_gather_point(path, gather, last, vertex, event);
    if (path->alive)
        path_scatter(path, vertex, event, gathered, u.xyw);
}

/*
 * Shades the vertex at what the path's ray met, *met at *hit, with its sample values u, and
 * extends the path. `purpose` is a constant at each call; *gather serves FOLLOW_TO_GATHER alone.
 */
static inline void path_vertex(const struct scene *scene, const rt_params *params,
                               struct path *path, const struct hit *hit, struct meeting *met,
                               float8 u, struct connection *connection, const uint purpose,
                               const struct gather *gather)
{
    const bool resumes = arrive(path, scene, hit->t, purpose);
    RECORD(record_surface(path, met));

    /* Add what the surface emits, also where a medium of higher priority hides its boundary. */
    if (!resumes)
        add_emission(path, scene, params, met, purpose);

    /* Skip such a boundary; end the path at the maximum depth. */
    if (!met->boundary.exists) {
        path->pdf_w = 0.0f;
        path_pass(path, met);
        return;
    }
    path->alive = !(purpose == FOLLOW_DIRECT && path->scattered);
    if (path->alive && path->depth == params->max_depth)
        path_cut_off(path, scene->materials + met->part);
    if (!path->alive)
        return;

    /* Split the path at the first rough event that is left to it. */
    const float3 drawn = path_disperse(path, scene, met);
    struct vertex vertex;
    make_vertex(&vertex, scene, met, path->media.x, path->beta * drawn, CARRY_RADIANCE);
    if (purpose == FOLLOW_TO_GATHER && is_split_at(path, params, &vertex))
        u = split_path(path, gather, params, hit);
    path->beta *= drawn;

    /* Sample direct light; then an event, or end the path, but not at its gather point. */
    const uint held = purpose == FOLLOW_TO_GATHER ? vertex_held(&vertex, params) : 0u;
    const bool last = ends_at_gather_point(path, params, purpose);
    connect_light(connection, scene, params, path, &vertex, held, last, u.lo);
    go_on(path, params, &vertex, held, last, u.hi, gather);
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
    struct meeting met;
    meet_surface(&met, scene, &path->ray, &hit, path->media);
    path_vertex(scene, params, path, &hit, &met, u, &connection, purpose, gather);

    /* Add the direct light that arrives. */
    add_connection(path, scene, &connection);
}

#endif
