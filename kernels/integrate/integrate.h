/*
 * integrate.h - follows a path from the eye: the rendering equation by Monte Carlo.
 *
 *   Lo(x, wo) = Le(x, wo) + integral of fr(x, wo, wi) Li(x, wi) |n.wi| dwi            Kajiya 1986
 *
 * At each vertex, light that comes straight from a lamp is estimated twice, by a point sampled on a
 * light and by the direction sampled from the surface, combined by multiple importance sampling
 * with the power heuristic (Veach and Guibas 1995). Delta events and point lights leave only one of
 * the two, which then counts fully.
 *
 * The same function serves photon mapping, whose eye paths end where the photon map is asked: at
 * the diffuse event after `final_gather` others. There the path is not continued, so light sampling
 * stands alone at that vertex and counts fully (or not at all, where the map holds direct light
 * too). At the diffuse events before it, the caustic photons are asked for, which came there
 * through delta surfaces only: eye paths would find that light too seldom, and that of a point
 * light never. A path that goes from such a surface through delta surfaces to a lamp therefore
 * leaves the lamp's light out.
 *
 * References:
 *   Kajiya: "The Rendering Equation", SIGGRAPH 1986.
 *   Veach, Guibas: "Optimally Combining Sampling Techniques for Monte Carlo Rendering", SIGGRAPH
 *     1995.
 *   Arvo, Kirk: "Particle Transport and Image Synthesis", SIGGRAPH 1990 (Russian roulette).
 */
#ifndef RT_KERNELS_INTEGRATE_INTEGRATE_H
#define RT_KERNELS_INTEGRATE_INTEGRATE_H

#include "bsdf/bsdf.h"
#include "light/light.h"
#include "integrate/matte.h"
#include "material/medium.h"
#include "integrate/path_state.h"
#include "photon/gather_point.h"
#include "sample/rng.h"
#include "accel/traverse.h"

/* Where an eye path asks photon maps. */
struct gather {
    /* where it ends: position, normal, weight and material are filled in */
    global rt_gather_point *point;
    global rt_gather_point *caustics; /* [params->final_gather], the diffuse events before that, */
    uint stride;                      /* so many points apart */
};

/* Which light is wanted of a path. */
enum purpose {
    FOLLOW_ALL,       /* all that comes by any way */
    FOLLOW_DIRECT,    /* emission, and light scattered once; delta events do not count */
    FOLLOW_TO_GATHER, /* what the photon map is not asked for; the path ends where it is */
};

/*
 * The weight of a sample that the other technique makes `ratio` times as often: the power heuristic
 * p^2 / (p^2 + q^2), ratio = q / p; or all or nothing, where one technique stands alone.
 */
static inline float mis_weight(const rt_params *params, uint technique, float ratio)
{
    if (params->estimator != RT_ESTIMATOR_MIS)
        return params->estimator == technique ? 1.0f : 0.0f;
    return 1.0f / (1.0f + ratio * ratio);
}

/*
 * The light that a surface emits along wo, weighted against the light sampling at the previous
 * vertex `from`, whose scattering had density pdf_w; 0: nothing to weigh against.
 */
static inline float3 emitted_light(const struct scene *scene, const rt_params *params,
                                   const struct surface *surface, float3 wo, float3 from,
                                   float pdf_w)
{
    const uint index = surface_light(scene, surface);
    if (index == RT_NONE)
        return (float3)(0.0f);
    global const rt_light_data *light = scene->lights + index;
    const float3 emitted = light_radiance(scene, light, surface, wo);
    if (pdf_w == 0.0f || largest3(emitted) <= 0.0f)
        return emitted;
    return emitted *
           mis_weight(params, RT_ESTIMATOR_BSDF, light_pdf_w(scene, light, from, surface) / pdf_w);
}

/* The same of the environment, for a ray in direction w that meets nothing. */
INLINE_NEVER float3 environment_light(const struct scene *scene, const rt_params *params,
                                      float3 from, float3 w, float pdf_w)
{
    const float3 radiance = sky_radiance(scene, w);
    if (pdf_w == 0.0f || largest3(radiance) <= 0.0f)
        return radiance;
    return radiance *
           mis_weight(params, RT_ESTIMATOR_BSDF, sky_light_pdf_w(scene, from, w) / pdf_w);
}

/* What counts of a lobe's light from a sampled point; `alone`: not weighted. */
static inline float3 counted(const rt_params *params, const struct light_sample *sample,
                             struct lobe_value lobe, bool alone)
{
    if (alone || sample->delta)
        return lobe.value;
    return lobe.value * mis_weight(params, RT_ESTIMATOR_LIGHT, lobe.pdf_w * sample->spread);
}

/*
 * Joins a vertex with one sampled point of a light, whose light goes by way of the surface to wo.
 * Diffuse light stands alone at the last vertex of a path, unless the photon map has it; rough
 * events go on there.
 */
static inline void connect_light(struct connection *connection, const struct scene *scene,
                                 const rt_params *params, const struct path *path,
                                 const struct surface *surface, const struct bsdf *bsdf,
                                 uint beyond, float4 u, bool last)
{
    struct light_sample sample;
    if (!sample_light(scene, surface->position, u, &sample))
        return;
    float3 scattered = (float3)(0.0f);
    if (!(last && params->direct == RT_DIRECT_PHOTONS))
        scattered = counted(params, &sample, bsdf_eval(bsdf, bsdf->diffuse_lobe, sample.wi), last);
    if (bsdf_is_rough(bsdf))
        scattered += counted(params, &sample, bsdf_eval(bsdf, RT_LOBE_GGX, sample.wi), false);
    const bool through = dot(sample.wi, bsdf->normal) < 0.0f;
    const float lift = through ? -surface->error : surface->error;
    connection->ray = shadow_ray(surface->position + lift * bsdf->normal, &sample);
    const float distance = sample.distant ? INFINITY : length(connection->ray.direction);
    const float3 arrived =
        medium_transmittance(scene->materials, through ? beyond : path->media.x, distance);
    connection->radiance =
        path->eta_scale * path->beta * (scattered * arrived * sample.radiance * sample.spread);
}

/*
 * The chance to go on after `depth` segments, from the throughput that would be left: the paths
 * that go on from below the threshold all carry as much as the threshold.
 */
static inline float survival_chance(const rt_params *params, uint depth, float3 throughput)
{
    return depth < params->roulette_depth
               ? 1.0f
               : min(1.0f, largest3(throughput) / params->roulette_threshold);
}

/*
 * Whether caustic photons account for a light that the path meets: they come by delta events alone
 * to a diffuse surface, where the final gather asks for them.
 */
static inline bool left_to_photons(const uint purpose, uint diffuse_events, float pdf_w, bool rough)
{
    return purpose == FOLLOW_TO_GATHER && diffuse_events > 0u && pdf_w == 0.0f && !rough;
}

/*
 * Asks for the photons around a diffuse event: for all of them at the last, where the path ends,
 * else caustic ones.
 */
static inline void ask_photons(struct path *path, const struct gather *gather, bool last,
                               const struct surface *surface, const struct bsdf *bsdf,
                               uint material)
{
    global rt_gather_point *point =
        last ? gather->point : gather->caustics + path->diffuse_events * gather->stride;
    set_gather_point(point, surface->position, bsdf, material, path->eta_scale * path->beta);
    path->depth = last ? 0u : path->depth;
    path->diffuse_events++;
}

/* Adds what a surface emits along wo, unless caustic photons account for it. */
static inline void add_emitted(struct path *path, const struct scene *scene,
                               const rt_params *params, const struct surface *surface, float3 wo,
                               const uint purpose)
{
    if (!left_to_photons(purpose, path->diffuse_events, path->pdf_w, path->rough))
        path->radiance += path->eta_scale * path->beta *
                          emitted_light(scene, params, surface, wo, path->from, path->pdf_w);
}

/* Begins a path with this ray; one that cannot be followed ends at once. */
static inline void path_begin(struct path *path, const struct scene *scene,
                              const struct sampler *sampler, struct ray ray)
{
    path->sampler = *sampler;
    path->ray = ray;
    path->from = ray.origin;
    path->radiance = (float3)(0.0f);
    path->beta = (float3)(1.0f);
    path->eta_scale = 1.0f;
    path->pdf_w = 0.0f;
    path->media = vload4(0, scene->header->eye_media) - 1u;
    path->depth = can_follow(&ray) ? 1u : 0u;
    path->hidden = 0u;
    path->diffuse_events = 0u;
    path->scattered = false;
    path->rough = false;
}

/* Ends a path whose ray meets nothing. */
static inline void path_escape(const struct scene *scene, const rt_params *params,
                               struct path *path, const uint purpose)
{
    path->depth = 0u;
    if (!has_sky(scene) || left_to_photons(purpose, path->diffuse_events, path->pdf_w, path->rough))
        return;
    path->radiance +=
        path->eta_scale * path->beta *
        medium_transmittance(scene->materials, path->media.x, INFINITY) *
        environment_light(scene, params, path->from, path->ray.direction, path->pdf_w);
}

/* Goes on from a surface by the chosen lobe, by u in [0,1)^3. */
static inline void path_scatter(struct path *path, const struct surface *surface,
                                const struct bsdf *bsdf, uint lobe, float3 u, uint4 beyond)
{
    const struct scatter scatter = bsdf_scatter(bsdf, lobe, u, CARRY_RADIANCE);
    path->beta *= scatter.weight;
    path->depth = largest3(path->beta) > 0.0f ? path->depth + 1u : 0u;
    path->eta_scale *= scatter.eta_scale;
    path->pdf_w = scatter.pdf_w;
    path->scattered |= path->pdf_w > 0.0f;
    path->from = surface->position;
    if (scatter.through)
        path->media = beyond;
    const float lift = scatter.through ? -surface->error : surface->error;
    path->ray = make_ray(surface->position + lift * bsdf->normal, scatter.wi, 0.0f, INFINITY);
}

/*
 * Takes a path through the vertex that its ray hits, with the vertex's numbers u; *connection holds
 * the direct light that remains to be asked for. purpose is a constant at each call; *gather serves
 * FOLLOW_TO_GATHER alone, and its points are left alone when the path ends before.
 */
static inline void path_vertex(const struct scene *scene, const rt_params *params,
                               struct path *path, const struct hit *hit, float8 u,
                               struct connection *connection, const uint purpose,
                               const struct gather *gather)
{
    const struct surface surface = surface_at(scene, &path->ray, hit);
    const uint material_index = scene->shapes[surface.shape].material;
    global const rt_material_data *material = scene->materials + material_index;
    const float3 wo = -path->ray.direction;

    /* Lose what the medium absorbs on the way. */
    path->beta *= medium_transmittance(scene->materials, path->media.x, hit->t);

    /* Go straight on through a boundary that a stronger medium hides. */
    const struct boundary boundary =
        media_meet(scene, path->media, material_index, dot(wo, surface.normal) > 0.0f);
    if (!boundary.exists) {
        path->pdf_w = 0.0f;
        if (!pass_boundary(&path->ray, &path->media, &path->hidden, &surface, boundary.beyond))
            path->depth = 0u;
        return;
    }

    /* Add what the surface emits, and end a path that is as long as wanted. */
    add_emitted(path, scene, params, &surface, wo, purpose);
    if (path->depth == params->max_depth || (purpose == FOLLOW_DIRECT && path->scattered)) {
        path->depth = 0u;
        return;
    }

    /* Sample direct light. */
    const struct bsdf bsdf = bsdf_at(scene, material, &surface, wo, boundary.eta, path->beta);
    const bool last = purpose == FOLLOW_TO_GATHER && path->diffuse_events == params->final_gather;
    if (bsdf_is_diffuse(&bsdf) || bsdf_is_rough(&bsdf))
        connect_light(connection, scene, params, path, &surface, &bsdf, boundary.beyond.x, u.lo,
                      last);

    /*
     * Choose a lobe, or the end of the path by roulette, which spares nothing where the path ends
     * anyway.
     */
    const float survival =
        last ? 1.0f : survival_chance(params, path->depth, path->beta * bsdf_albedo(&bsdf));
    const uint lobe = bsdf_choose(&bsdf, survival, u.hi.z);
    if (lobe == RT_LOBE_NONE) {
        path->depth = 0u;
        return;
    }
    path->beta *= 1.0f / survival;

    /* In photon mapping, ask for photons wherever the lobe is gathered. */
    const bool gathered = lobe_is_gathered(lobe);
    if (purpose == FOLLOW_TO_GATHER && gathered) {
        ask_photons(path, gather, last, &surface, &bsdf, material_index);
        if (last)
            return;
    }
    path->rough = !gathered && (path->rough || !lobe_is_delta(lobe));

    /* Sample a direction of the lobe and go on. */
    path_scatter(path, &surface, &bsdf, lobe, u.hi.xyw, boundary.beyond);
}

/*
 * Takes paths through their next vertex, RT_PATH_BATCH of them at most; those that have ended stay
 * as they are. No path waits for another in any of the steps, so that a processor that runs ahead
 * has several under way at once.
 */
static inline void follow_paths(const struct scene *scene, const rt_params *params,
                                struct path *paths, const uint count, const uint purpose,
                                const struct gather *gather)
{
    struct hit hits[RT_PATH_BATCH];
    float8 numbers[RT_PATH_BATCH];
    struct connection connections[RT_PATH_BATCH];
    const bool together = purpose == FOLLOW_ALL && params->estimator == RT_ESTIMATOR_MIS;

    /*
     * Find the nearest surfaces, and draw the numbers of the vertices there: that fills the time of
     * waiting.
     */
    for (uint i = 0u; i < count; i++) {
        if (!paths[i].depth)
            continue;
        numbers[i] = sampler_pair(&paths[i].sampler, set_light(paths[i].depth - 1u));
        if (!closest_hit(scene, &paths[i].ray, &hits[i]))
            path_escape(scene, params, &paths[i], purpose);
    }

    /* Scatter, on matte surfaces all together, on others one by one. */
    struct matte matte;
    matte.taken = matte.curved = 0u;
    for (uint i = 0u; i < count; i++) {
        connections[i].radiance = (float3)(0.0f);
        if (!paths[i].depth)
            continue;
        if (!together || !matte_take(&matte, i, scene, params, &paths[i], &hits[i]))
            path_vertex(scene, params, &paths[i], &hits[i], numbers[i], &connections[i], purpose,
                        gather);
    }
    if (matte.taken)
        matte_vertices(scene, params, &matte, paths, hits, numbers, connections);

    /* Add the direct light that arrives. */
    for (uint i = 0u; i < count; i++)
        if (largest3(connections[i].radiance) > 0.0f && !occluded(scene, &connections[i].ray))
            paths[i].radiance += connections[i].radiance;
}

/* Follows one path to its end and returns the radiance that it brings. */
static inline float3 follow_path(const struct scene *scene, const rt_params *params,
                                 const struct sampler *sampler, struct ray ray, const uint purpose,
                                 const struct gather *gather)
{
    struct path path;
    path_begin(&path, scene, sampler, ray);
    while (path.depth)
        follow_paths(scene, params, &path, 1u, purpose, gather);
    return path.radiance;
}

#endif
