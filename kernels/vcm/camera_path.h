/*
 * camera_path.h - camera paths of mode vcm, and the techniques that end at one of their vertices:
 * emission that it meets, light sampling, connections with the vertices of a light path, and
 * merging with those of all of them.
 */
#ifndef RT_KERNELS_VCM_CAMERA_PATH_H
#define RT_KERNELS_VCM_CAMERA_PATH_H

#include "accel/traverse.h"
#include "camera/project.h"
#include "count.h"
#include "integrate/path_state.h"
#include "sample/roulette.h"
#include "vcm/grid.h"
#include "vcm/path_weights.h"
#include "vcm/store.h"

/* The vertices of a light path: the first, `stride` apart; and of all paths, for merging. */
struct light_vertices {
    global const rt_light_vertex *first;
    uint stride, count;
    global const rt_merge_point *points; /* in the order of buckets, */
    global const rt_merge_light *lights; /* likewise, */
    global const uint *begins;           /* and where each begins */
};

/* Begins a path, which merges with this squared radius first. */
static inline void begin_camera_path(struct vcm_camera_path *path, const struct vcm_scene *vcm,
                                     const struct sampler *sampler, struct ray ray,
                                     float squared_radius, global float *parts)
{
    path_begin(&path->eye, &vcm->scene, sampler, ray);
    path->partial.dVCM = path->partial.dVC = 0.0f;
    path->squared_radius = squared_radius;
    path->parts = parts;
    if (parts) {
        vstore3((float3)(0.0f), 0, parts);
        vstore3((float3)(0.0f), 1, parts);
    }
}

/* ---- Queries ----------------------------------------------------------------------- */

/* Asks for the radius of merging here. */
static inline rt_merge_query query_at(float3 position, float3 normal)
{
    rt_merge_query query;
    vstore3(position, 0, query.position);
    vstore3(normal, 0, query.normal);
    query.is_query = 1u;
    query.squared_radius = -1.0f;
    return query;
}

/* Asks nowhere. */
static inline rt_merge_query no_query(void)
{
    rt_merge_query query = query_at((float3)(0.0f), (float3)(0.0f));
    query.is_query = 0u;
    return query;
}

/* ---- Emission that the path meets -------------------------------------------------- */

/* Adds what a surface emits. */
static inline void meet_emitter(struct vcm_camera_path *path, const struct vcm_scene *vcm,
                                const struct surface *surface, float3 wo)
{
    const struct scene *scene = &vcm->scene;
    const uint index = surface_light(scene, surface);
    if (index == RT_NONE)
        return;
    global const rt_light_data *light = scene->lights + index;
    const float3 emitted = light_radiance(scene, light, surface, wo);
    if (!(largest3(emitted) > 0.0f))
        return;
    const float weight = emitter_weight(path, vcm, index, surface, wo);
    path->eye.radiance += path->eye.eta_scale * path->eye.beta * emitted * weight;
}

/* Adds the environment's radiance to a path whose ray escapes. */
static inline void meet_environment(struct vcm_camera_path *path, const struct vcm_scene *vcm)
{
    const struct scene *scene = &vcm->scene;
    const float3 w = path->eye.ray.direction;
    if (!meets_environment(scene, path->eye.depth) || !(vcm->all.shown & RT_TECHNIQUE_EMISSION))
        return;
    const float weight = sky_weight(path, vcm, w);
    path->eye.radiance += path->eye.eta_scale * path->eye.beta *
                          medium_transmittance(scene->materials, path->eye.media.x, INFINITY) *
                          environment_radiance(scene, w) * weight;
}

/* ---- Light sampling ----------------------------------------------------------------- */

/* Joins a vertex with a sampled point of a light. */
static inline void connect_sampled_light(struct vcm_camera_path *path, const struct vcm_scene *vcm,
                                         const struct vertex *vertex, float used, float4 u)
{
    const struct scene *scene = &vcm->scene;
    struct light_sample sample;
    float pmf;
    if (scene->light_nodes[1].weight == 0.0f)
        return;
    const uint light = choose_light(scene, vertex->position, u.z, &pmf);
    if (pmf == 0.0f ||
        !sample_chosen(scene, scene->lights + light, vertex->position, u.xy, &sample))
        return;
    sample.inv_pdf /= pmf;
    const struct scattering s = bidir_eval(scene, vertex, sample.wi);
    if (!(s.pdf_w > 0.0f))
        return;
    const float weight = sampled_light_weight(path, vcm, vertex, used, light, &sample, &s);
    const struct ray ray = shadow_ray(vertex_leave(vertex, sample.wi), &sample);
    const float distance = sample.distant ? INFINITY : length(ray.direction);
    const float3 radiance = path->eye.eta_scale * path->eye.beta * s.value *
                            vertex_transmittance(scene, vertex, sample.wi, distance) *
                            sample.radiance * (sample.inv_pdf * weight);
    if (!(largest3(radiance) > 0.0f))
        return;
    COUNT(scene, RT_COUNTER_SHADOW, ray.direction.x);
    if (!occluded(scene, &ray))
        path->eye.radiance += radiance;
}

/* ---- Connections ---------------------------------------------------------------------- */

/* Joins a vertex with one of a light path. */
static inline void connect_vertex(struct vcm_camera_path *path, const struct vcm_scene *vcm,
                                  const struct vertex *vertex, float used,
                                  global const rt_light_vertex *stored)
{
    const struct scene *scene = &vcm->scene;
    const float3 towards = row3(stored->position) - vertex->position;
    const float d2 = dot(towards, towards);
    const float3 wi = towards * (1.0f / sqrt(d2));
    if (!(d2 > 0.0f))
        return;
    const struct scattering here = bidir_eval(scene, vertex, wi);
    if (!(here.pdf_w > 0.0f))
        return;
    struct vertex other;
    load_vertex(&other, scene, stored);
    const struct scattering there = bidir_eval(scene, &other, -wi);
    if (!(there.pdf_w > 0.0f))
        return;
    const struct partial_weights light = stored_weights(stored);
    const float cosine = fabs(dot(wi, vertex->bsdf.normal)),
                cosine_there = fabs(dot(wi, other.bsdf.normal));
    const float light_used =
        used_dVCM(&vcm->all, &light, stored_depth(stored) == 1u, RT_TECHNIQUE_NEE);
    const float weight =
        joined_weight(path, vcm, used, &light, light_used, &here, there.pdf_w * cosine / d2, &there,
                      here.pdf_w * cosine_there / d2);
    const float3 radiance = path->eye.eta_scale * path->eye.beta * here.value *
                            vertex_transmittance(scene, vertex, wi, sqrt(d2)) * there.value *
                            joined_flux(stored, &other) * (weight / d2);
    if (!(largest3(radiance) > 0.0f))
        return;
    const float3 from = vertex_leave(vertex, wi);
    const struct ray ray = make_ray(from, vertex_leave(&other, -wi) - from, 0.0f, RT_SHADOW_END);
    COUNT(scene, RT_COUNTER_SHADOW, ray.direction.x);
    if (!occluded(scene, &ray))
        path->eye.radiance += radiance;
}

/* Joins a vertex with those of the light path that do not make paths too long. */
static inline void connect_vertices(struct vcm_camera_path *path, const struct vcm_scene *vcm,
                                    const struct vertex *vertex, float used,
                                    const struct light_vertices *light)
{
    for (uint i = 0u; i < light->count; i++) {
        global const rt_light_vertex *stored = light->first + (size_t)i * light->stride;
        if (path->eye.depth + 1u + stored_depth(stored) > vcm->params->max_depth)
            return;
        connect_vertex(path, vcm, vertex, used, stored);
    }
}

/* ---- Merging ---------------------------------------------------------------------------- */

/*
 * Merges a vertex with one of a light path: what it scatters of that path's flux, as if that had
 * come to the vertex itself; without 1 / (n pi r^2).
 */
static inline float3 merge_vertex(const struct vcm_camera_path *path, const struct vcm_scene *vcm,
                                  const struct vertex *vertex, float used, uint depth,
                                  global const rt_merge_light *stored)
{
    const float3 wi = row3(stored->wo), normal = row3(stored->normal);
    if (path->eye.depth + depth > vcm->params->max_depth ||
        fabs(dot(normal, vertex->bsdf.normal)) < RT_PHOTON_NORMAL_COSINE)
        return (float3)(0.0f);
    const struct scattering s = bidir_eval(&vcm->scene, vertex, wi);
    if (!(s.pdf_w > 0.0f))
        return (float3)(0.0f);
    const struct partial_weights light = {stored->dVCM, stored->dVC};
    const float light_used = used_dVCM(&vcm->all, &light, depth == 1u, RT_TECHNIQUE_NEE);
    const float weight = merged_weight(path, vcm, used, &light, light_used, &s);
    /*
     * The density of light vertices follows the normal of the surface that they lie on: on a mesh
     * that may be another triangle, and wi graze that of the vertex.
     */
    return s.value * row3(stored->flux) * (weight / fabs(dot(wi, normal)));
}

/* Sums over the disc of merging, and over half and a quarter of its area. */
struct merge_sums {
    float3 whole, half_disc, quarter;
};

/* Adds what merges with a vertex of those from `begin` to `end` that are within the radius. */
static inline void merge_run(struct merge_sums *sums, const struct vcm_camera_path *path,
                             const struct vcm_scene *vcm, const struct vertex *vertex, float used,
                             const struct light_vertices *light, uint begin, uint end)
{
    const float3 none = (float3)(0.0f);
    for (uint i = begin; i < end; i++) {
        const float3 off = row3(light->points[i].position) - vertex->position;
        const float d2 = dot(off, off);
        if (!(d2 <= path->squared_radius))
            continue;
        const float3 merged =
            merge_vertex(path, vcm, vertex, used, light->points[i].depth, light->lights + i);
        sums->whole += merged;
        if (path->parts) {
            sums->half_disc += d2 <= 0.5f * path->squared_radius ? merged : none;
            sums->quarter += d2 <= 0.25f * path->squared_radius ? merged : none;
        }
    }
}

/* The buckets of the cells that the disc of merging touches. */
struct merge_buckets {
    uint bucket[8]; /* RT_NONE: that cell is beyond the disc */
};

/* Finds them, and asks for where their points begin. */
static inline void find_merge_buckets(struct merge_buckets *found,
                                      const struct vcm_camera_path *path,
                                      const struct vcm_scene *vcm, const struct vertex *vertex,
                                      const struct light_vertices *light)
{
    const float3 place = cell_place(&vcm->scene, vcm->radius, vertex->position);
    const float reach = path->squared_radius < square(vcm->radius)
                            ? fmin(0.5f, 0.5001f * sqrt(path->squared_radius) / vcm->radius)
                            : 0.5f;
    const int3 low = cell_at(place - reach), high = cell_at(place + reach);
    for (int i = 0; i < 8; i++) {
        const int3 corner = (int3)(i & 1, i >> 1 & 1, i >> 2);
        const uint bucket = bucket_of(low + corner, vcm->bucket_bits);
        found->bucket[i] = any(corner > high - low) ? RT_NONE : bucket;
        PREFETCH(light->begins + bucket);
    }
}

/* Asks for the first points of the buckets. */
static inline void prefetch_merge_points(const struct merge_buckets *found,
                                         const struct light_vertices *light)
{
    for (int i = 0; i < 8; i++)
        if (found->bucket[i] != RT_NONE) {
            PREFETCH(light->points + light->begins[found->bucket[i]]);
            PREFETCH(light->lights + light->begins[found->bucket[i]]);
        }
}

/*
 * Merges a vertex with those of all light paths around it. Both paths meet a cutout with the
 * probability `opacity`, and what it scatters has that once.
 */
static inline void merge_vertices(struct vcm_camera_path *path, const struct vcm_scene *vcm,
                                  const struct vertex *vertex, float opacity, float used,
                                  const struct light_vertices *light,
                                  const struct merge_buckets *found)
{
    const float3 none = (float3)(0.0f);
    struct merge_sums sums = {none, none, none};
    for (int i = 0; i < 8; i++) {
        const uint bucket = found->bucket[i];
        if (bucket != RT_NONE)
            merge_run(&sums, path, vcm, vertex, used, light, light->begins[bucket],
                      light->begins[bucket + 1u]);
    }
    const float3 throughput = path->eye.eta_scale * path->eye.beta;
    const float per_area = 1.0f / (vcm->all.light_paths * RT_PI * path->squared_radius * opacity);
    path->eye.radiance += throughput * sums.whole * per_area;
    if (path->parts) {
        const float3 half_more = throughput * (2.0f * sums.half_disc - sums.whole) * per_area,
                     quarter_more = throughput * (4.0f * sums.quarter - sums.whole) * per_area;
        vstore3(vload3(0, path->parts) + half_more, 0, path->parts);
        vstore3(vload3(1, path->parts) + quarter_more, 1, path->parts);
    }
}

/* ---- The path ---------------------------------------------------------------------------- */

/* Goes on with the partial weights to a vertex. */
static inline void arrive(struct vcm_camera_path *path, const struct vcm_scene *vcm,
                          const struct surface *surface, float distance)
{
    const float3 w = path->eye.ray.direction;
    const float cosine = grazing_cosine(w, surface->normal);
    if (path->eye.depth > 1u) {
        arrive_weights(&path->partial, &vcm->all, distance, cosine);
        return;
    }
    const float pdf_a = camera_pdf_a(&vcm->scene.header->camera, vcm->params, w, distance) * cosine;
    path->partial = begin_camera_weights(&vcm->all, pdf_a);
    if (path->eye.hidden > 0u)
        pass_weights(&path->partial);
}

/* Russian roulette, and a direction of the chosen event. */
static inline void scatter_camera_path(struct vcm_camera_path *path, const struct vcm_scene *vcm,
                                       const struct vertex *vertex, float used, float4 u)
{
    const struct scene *scene = &vcm->scene;
    const float survival = path->query ? 1.0f
                                       : eye_path_survival(vcm->params, path->eye.depth,
                                                           path->eye.beta * vertex_albedo(vertex));
    const uint chosen = vertex_choose(vertex, survival, u.z);
    path->eye.alive = chosen != RT_NO_EVENT;
    if (!path->eye.alive)
        return;
    const struct bidir_event event = bidir_scatter(scene, vertex, chosen, u.xyw);
    path->eye.beta *= event.weight / survival;
    path->eye.eta_scale *= event.eta_scale;
    path->eye.pdf_w = event.pdf_w;
    path->eye.alive = largest3(path->eye.beta) > 0.0f;
    if (!path->eye.alive)
        return;
    if (event.pdf_w > 0.0f) {
        scatter_weights(&path->partial, &vcm->all, used, event.cosine, event.pdf_w,
                        event.back_pdf_w);
        path->squared_radius = square(vcm->radius);
    } else {
        scatter_delta_weights(&path->partial, event.cosine, event.back_pdf_w);
    }
    DISPERSED(path->eye.wavelength = event.pdf_w > 0.0f ? 0.0f : path->eye.wavelength);
    path->eye.depth++;
    path->eye.from = vertex->position;
    if (event.through)
        path->eye.media = vertex->beyond;
    path->eye.ray = make_ray(vertex_leave(vertex, event.wi), event.wi, 0.0f, INFINITY);
}

/*
 * The techniques that end at a vertex; light: the light path of the same pixel. The memory that
 * merging reads is asked for before the others' rays, so that it is there after them.
 */
CALLED_ON_GPUS void join_vertex(struct vcm_camera_path *path, const struct vcm_scene *vcm,
                                const struct vertex *vertex, float opacity, float used, float4 u,
                                const struct light_vertices *light)
{
    const bool merges = (vcm->all.shown & RT_TECHNIQUE_MERGING) != 0u;
    struct merge_buckets found;
    if (!vertex_connects(vertex))
        return;
    if (merges)
        find_merge_buckets(&found, path, vcm, vertex, light);
    if (vcm->all.shown & RT_TECHNIQUE_NEE)
        connect_sampled_light(path, vcm, vertex, used, u);
    if (merges)
        prefetch_merge_points(&found, light);
    if (vcm->all.shown & RT_TECHNIQUE_CONNECTION)
        connect_vertices(path, vcm, vertex, used, light);
    if (merges)
        merge_vertices(path, vcm, vertex, opacity, used, light, &found);
}

/* Ends a path that asks for its first vertex that merges, if this is it. */
static inline bool answer_query(struct vcm_camera_path *path, const struct meeting *met,
                                const struct vertex *vertex)
{
    if (!path->query || !vertex_connects(vertex))
        return false;
    *path->query = query_at(met->surface.position, met->surface.normal);
    path->eye.alive = false;
    return true;
}

/* Extends a path that is alive by its next vertex. */
INLINE_NEVER void extend_camera_path(struct vcm_camera_path *path, const struct vcm_scene *vcm,
                                     const struct light_vertices *light)
{
    const struct scene *scene = &vcm->scene;

    /* Draw the sample values of the next vertex. */
    const float8 u = path_numbers(&path->eye);

    /* Find the nearest surface, or what the environment emits. */
    struct hit hit;
    count_path_ray(scene, &path->eye);
    if (!closest_hit(scene, &path->eye.ray, &hit)) {
        meet_environment(path, vcm);
        path->eye.alive = false;
        return;
    }
    struct meeting met;
    meet_surface(&met, scene, &path->eye.ray, &hit, path->eye.media);
    path->eye.beta *= medium_transmittance(scene->materials, path->eye.media.x, hit.t);

    /* Add what the surface emits, also where a medium of higher priority hides its boundary. */
    const struct partial_weights before = path->partial;
    arrive(path, vcm, &met.surface, hit.t);
    if (vcm->all.shown & RT_TECHNIQUE_EMISSION)
        meet_emitter(path, vcm, &met.surface, met.wo);

    /* Skip such a boundary; end the path at the maximum depth. */
    if (!met.boundary.exists) {
        path->partial = before;
        path->eye.pdf_w = 0.0f;
        pass_weights(&path->partial);
        path_pass(&path->eye, &met);
        return;
    }
    if (path->eye.depth == vcm->params->max_depth) {
        path_cut_off(&path->eye, scene->materials + met.part);
        return;
    }
    path->eye.beta *= path_disperse(&path->eye, scene, &met);
    struct vertex vertex;
    make_bidir_vertex(&vertex, scene, &met, path->eye.media.x, CARRY_RADIANCE);
    if (answer_query(path, &met, &vertex))
        return;

    /* Join it with a light, and with the vertices of the light path. */
    const float used =
        used_dVCM(&vcm->all, &path->partial, path->eye.depth == 1u, RT_TECHNIQUE_CAMERA);
    join_vertex(path, vcm, &vertex, surface_opacity(scene, &met.surface), used, u.lo, light);

    /* Choose an event, or end the path, and go on. */
    scatter_camera_path(path, vcm, &vertex, used, u.hi);
}

#endif
