/*
 * integrate.h - follows a path from the eye: the rendering equation by Monte Carlo.
 *
 *   Lo(x, wo) = Le(x, wo) + integral of fr(x, wo, wi) Li(x, wi) |n.wi| dwi            Kajiya 1986
 *
 * At each vertex, light that comes straight from a lamp is estimated twice, by a point sampled on a
 * light and by the direction sampled from the surface, combined by multiple importance sampling with
 * the power heuristic (Veach and Guibas 1995). Delta events and point lights leave only one of the
 * two, which then counts fully.
 *
 * The same function serves photon mapping, whose eye paths end where the photon map is asked: at the
 * diffuse event after `final_gather` others. There the path is not continued, so light sampling
 * stands alone at that vertex and counts fully (or not at all, where the map holds direct light too).
 *
 * References:
 *   Kajiya: "The Rendering Equation", SIGGRAPH 1986.
 *   Veach, Guibas: "Optimally Combining Sampling Techniques for Monte Carlo Rendering", SIGGRAPH 1995.
 *   Arvo, Kirk: "Particle Transport and Image Synthesis", SIGGRAPH 1990 (Russian roulette).
 */
#ifndef RT_INTEGRATE_H
#define RT_INTEGRATE_H

#include "bsdf.h"
#include "light.h"
#include "medium.h"
#include "rng.h"
#include "traverse.h"

/* The first vertex of a path, counted from 0, at which roulette may end it. */
#define RT_ROULETTE_VERTEX 1u

/* Where an eye path asks the photon map; found is false when the path ended before. */
struct gather {
    bool found;
    float3 position;
    float3 normal; /* geometric, on the side of wo */
    float3 wo;
    float3 weight; /* of the reflected radiance, kd excluded */
    uint material;
};

/*
 * The power heuristic's weight of a sample that another technique makes `ratio` times as often:
 * p^2 / (p^2 + q^2), ratio = q / p.
 */
static inline float mis_weight(float ratio)
{
    return 1.0f / (1.0f + ratio * ratio);
}

/*
 * The light that a surface emits along wo, weighted against the light sampling at the previous vertex
 * `from`, whose scattering had density pdf_w; 0: nothing to weigh against.
 */
static inline float3 emitted_light(const struct scene *scene, const struct surface *surface, float3 wo, float3 from,
                                   float pdf_w)
{
    const uint index = surface_light(scene, surface);
    if (index == RT_NONE)
        return (float3)(0.0f);
    global const rt_light_data *light = scene->lights + index;
    const float3 emitted = light_radiance(light, surface->normal, wo);
    if (pdf_w == 0.0f || largest3(emitted) <= 0.0f)
        return emitted;
    return emitted * mis_weight(light_pdf_w(light, from, surface) / pdf_w);
}

/* A path under way: what it carries from one vertex to the next. */
struct path {
    struct ray ray;    /* of unit direction */
    float3 from;       /* the vertex before: where the ray began */
    float3 radiance;   /* gathered so far */
    float3 beta;       /* throughput, without the change of radiance at refraction */
    float squeeze;     /* which is kept here, and means nothing to roulette */
    float pdf_w;       /* density of the ray's direction, 0 for the camera and delta events */
    uint4 media;       /* the solids it is inside of */
    uint depth;        /* segments, the one under way included */
    uint hidden;       /* boundaries crossed that a stronger medium hides */
    uint diffuse_events;
    struct sampler sampler;
};

/* A light's point that a path's vertex was joined with, before it is known whether anything is in between. */
struct connection {
    struct ray ray;
    float3 radiance; /* that it adds to the path's */
    uint path;
    bool exists;     /* false: no light would be scattered */
};

static inline void path_start(struct path *path, struct ray ray, struct sampler sampler)
{
    path->ray = ray;
    path->from = ray.origin;
    path->radiance = (float3)(0.0f);
    path->beta = (float3)(1.0f);
    path->squeeze = 1.0f;
    path->pdf_w = 0.0f;
    path->media = RT_VACUUM;
    path->depth = 1u;
    path->hidden = 0u;
    path->diffuse_events = 0u;
    path->sampler = sampler;
}

/*
 * Samples a point of a light, whose light goes by way of the surface to wo, with this weight on the path so far;
 * `alone`: no other technique can find it.
 */
static inline void connect_light(struct connection *connection, const struct scene *scene,
                                 const struct surface *surface, const struct bsdf *bsdf, float4 u, float3 weight,
                                 bool alone)
{
    struct light_sample sample;
    if (!sample_light(scene, surface->position, u, &sample))
        return;
    const float3 scattered = bsdf_eval(bsdf, sample.wi);
    if (largest3(scattered) <= 0.0f)
        return;
    /* Light that is scattered comes from the side of wo. */
    connection->ray = shadow_ray(surface->position + surface->error * bsdf->normal, &sample);
    const float share = alone || sample.delta ? 1.0f : mis_weight(bsdf_pdf_w(bsdf, sample.wi) * sample.spread);
    connection->radiance = weight * scattered * sample.radiance * (share * sample.spread);
    connection->exists = true;
}

static inline struct gather gather_at(const struct surface *surface, const struct bsdf *bsdf, float3 weight,
                                      uint material)
{
    struct gather gather;
    gather.found = true;
    gather.position = surface->position;
    gather.normal = bsdf->normal;
    gather.wo = bsdf->wo;
    gather.weight = weight;
    gather.material = material;
    return gather;
}

/*
 * The chance to go on after a vertex, from the throughput that would be left. Its square root, by which weights
 * still fall along a path, makes the least variance times time of what was measured in closed rooms of albedo
 * 0.7: up to a fifth less than the throughput itself, from the same vertex or the next.
 */
static inline float survival_chance(uint vertex, float3 throughput)
{
    return vertex < RT_ROULETTE_VERTEX ? 1.0f : min(1.0f, sqrt(largest3(throughput)));
}

/*
 * Chooses how a path goes on from a surface; false when it ends there. u: u.xy the direction, u.z the event.
 * beyond: the media on the other side; last: a diffuse event is where the photon map is asked.
 */
static inline bool path_continue(struct path *path, const struct surface *surface, const struct bsdf *bsdf,
                                 uint4 beyond, float4 u, uint material, bool last, struct gather *gather)
{
    /* Choose an event, or the end of the path by roulette. */
    const float survival = survival_chance(path->depth - 1u, path->beta * bsdf_albedo(bsdf));
    const uint event = bsdf_choose(bsdf, survival, u.z);
    if (event == EVENT_ABSORBED)
        return false;
    const float3 beta = path->beta * (1.0f / survival);

    /* In photon mapping, report the last diffuse event. */
    if (event == EVENT_DIFFUSE) {
        if (last) {
            *gather = gather_at(surface, bsdf, path->squeeze * beta * (1.0f / bsdf->diffuse), material);
            return false;
        }
        path->diffuse_events++;
    }

    /* Take the event's direction. */
    const struct scatter scatter = bsdf_scatter(bsdf, event, u.xy, CARRY_RADIANCE);
    const float lift = event == EVENT_REFRACTED ? -surface->error : surface->error;
    path->ray = make_ray(surface->position + lift * bsdf->normal, scatter.wi, 0.0f, INFINITY);
    path->from = surface->position;
    path->beta = beta * scatter.weight;
    path->squeeze *= scatter.squeeze;
    path->pdf_w = scatter.pdf_w;
    if (event == EVENT_REFRACTED)
        path->media = beyond;
    path->depth++;
    return largest3(path->beta) > 0.0f;
}

/*
 * Takes a path through the vertex that its ray hit, with the vertex's numbers u; false when it ends there.
 * connection->exists tells whether light is to be tried for. to_gather is a constant at each call: false for path
 * tracing, true to end the path at a gather point.
 */
static inline bool path_scatter(const struct scene *scene, const rt_params *params, struct path *path,
                                const struct hit *hit, float8 u, struct connection *connection, const bool to_gather,
                                struct gather *gather)
{
    const struct surface surface = surface_at(scene, &path->ray, hit);
    const uint material_index = scene->shapes[surface.shape].material;
    global const rt_material_data *material = scene->materials + material_index;
    const float3 wo = -path->ray.direction;
    connection->exists = false;

    /* Go straight on through a boundary that a stronger medium hides. */
    struct boundary boundary;
    boundary.eta = 1.0f;
    if (is_transparent(material)) {
        boundary = media_cross(scene, path->media, material_index, dot(wo, surface.normal) > 0.0f);
        if (!boundary.exists) {
            path->ray.origin = leave_surface(&surface, path->ray.direction);
            path->media = boundary.beyond;
            path->pdf_w = 0.0f;
            return ++path->hidden <= RT_HIDDEN_BOUNDARIES;
        }
    }

    /* Add what the surface emits. */
    const float3 weight = path->squeeze * path->beta;
    path->radiance += weight * emitted_light(scene, &surface, wo, path->from, path->pdf_w);
    if (path->depth == params->max_depth)
        return false;

    /* Sample direct light, except where the photon map holds it. */
    const struct bsdf bsdf = bsdf_at(material, &surface, wo, boundary.eta, path->beta);
    const bool last = to_gather && path->diffuse_events == params->final_gather;
    if (bsdf_is_diffuse(&bsdf) && !(last && params->direct == RT_DIRECT_PHOTONS))
        connect_light(connection, scene, &surface, &bsdf, u.lo, weight, last);

    return path_continue(path, &surface, &bsdf, boundary.beyond, u.hi, material_index, last, gather);
}

/*
 * Follows `count` paths, RT_PATH_BATCH at most, to their ends, all of them one vertex at a time. No path waits for
 * another in any of the steps, so that a processor that runs ahead has several of them under way at once.
 */
static inline void follow_paths(const struct scene *scene, const rt_params *params, struct path *paths, uint count,
                                const bool to_gather, struct gather *gather)
{
    uint alive[RT_PATH_BATCH]; /* the paths that go on, in order */
    struct hit hits[RT_PATH_BATCH];
    float8 numbers[RT_PATH_BATCH];
    struct connection connections[RT_PATH_BATCH];
    for (uint i = 0; i < count; i++)
        alive[i] = i;

    while (count > 0u) {
        /* Find the nearest surfaces. */
        uint hit_count = 0u;
        for (uint i = 0; i < count; i++) {
            alive[hit_count] = alive[i];
            hit_count += closest_hit(scene, &paths[alive[i]].ray, &hits[hit_count]);
        }

        /* Draw the numbers of the vertices there. */
        for (uint i = 0; i < hit_count; i++) {
            const struct path *path = paths + alive[i];
            numbers[i] = sampler_pair(&path->sampler, set_light(path->depth - 1u));
        }

        /* Scatter. */
        uint connection_count = 0u;
        count = 0u;
        for (uint i = 0; i < hit_count; i++) {
            struct connection *connection = connections + connection_count;
            const uint index = alive[i];
            connection->path = index;
            alive[count] = index;
            count += path_scatter(scene, params, paths + index, hits + i, numbers[i], connection, to_gather, gather);
            connection_count += connection->exists;
        }

        /* Add the direct light that arrives. */
        for (uint i = 0; i < connection_count; i++)
            if (!occluded(scene, &connections[i].ray))
                paths[connections[i].path].radiance += connections[i].radiance;
    }
}

#endif
