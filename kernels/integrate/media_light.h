/*
 * media_light.h - light sampling in scenes with media: from points in a medium, from the segment of
 * a ray, and from surfaces.
 *
 * Light that a ray's segment scatters towards the eye is estimated by three techniques, each with
 * its density over the distance on the segment and the direction to the light:
 *   distance   the distance by transmittance, then a light from the point there
 *   segment    a light for the segment, the distance by its equiangular density, then its point
 *   phase      the distance by transmittance, the direction by the phase function (emission.h)
 * They are combined by the power heuristic, exponent 2 (Veach and Guibas 1995). No phase function
 * meets a delta light, whose weights leave out that technique.
 *
 * Where the density lies on a grid, the density of a distance is not known, and the technique
 * `segment` is left out: the others know that it is.
 *
 * Shadow rays go on through boundaries without a surface, of interfaces and of media hidden by one
 * of higher priority, and carry the transmittance.
 */
#ifndef RT_KERNELS_INTEGRATE_MEDIA_LIGHT_H
#define RT_KERNELS_INTEGRATE_MEDIA_LIGHT_H

#include "integrate/direct_light.h"
#include "surface/contact.h"
#include "volume/grid.h"
#include "volume/phase.h"
#include "volume/segment.h"

/* A path, and how it was scattered at the vertex before if that lies in a medium. */
struct media_path {
    struct path path;
    bool in_medium;         /* whether it does; of what follows, all is undefined otherwise */
    bool on_grid;           /* of a density on a grid: the technique `segment` was left out */
    struct segment segment; /* that ended there, ... */
    float distance;         /* ... at this distance, ... */
    float pdf;              /* ... which was sampled with this density */
};

/* ---- Visibility ------------------------------------------------------------------ */

/* The numbers that shadow rays of the path's vertex under way track by. */
static inline struct stream shadow_numbers(const struct path *path)
{
    return stream_of(&path->sampler, set_segment(path->depth + path->hidden) + 1u);
}

/* The transmittance of a medium along a ray of unit direction, on a grid an estimate of it. */
static inline float3 transmittance_along(const struct scene *scene, const struct medium *medium,
                                         const struct ray *ray, float length,
                                         const struct stream *stream)
{
    return is_on_grid(medium)
               ? ratio_tracking(scene, medium, ray->origin, ray->direction, length, stream)
               : transmittance(medium, length);
}

/* The ray from a point to a sampled light, of unit direction, and the distance to the light. */
static inline struct ray ray_to_light(float3 origin, const struct light_sample *sample,
                                      float *distance)
{
    struct ray ray = shadow_ray(origin, sample);
    *distance = INFINITY;
    if (sample->distant)
        return ray;
    *distance = length(ray.direction);
    ray.direction *= 1.0f / *distance;
    ray.t_max = *distance * shadow_end(sample);
    return ray;
}

/*
 * The part of a light's radiance that arrives at a point in these media: none where a surface is in
 * between, else the transmittance.
 */
INLINE_NEVER float3 light_transmittance(const struct scene *scene, uint4 media, float3 origin,
                                        const struct light_sample *sample, struct stream stream)
{
    float3 arrives = (float3)(1.0f);
    for (uint crossed = 0u; crossed <= RT_HIDDEN_BOUNDARIES; crossed++) {
        float distance;
        const struct ray ray = ray_to_light(origin, sample, &distance);
        const struct medium medium = medium_of(scene, media.x);
        struct hit hit;
        COUNT(scene, RT_COUNTER_SHADOW, ray.direction.x);
        if (!can_follow(&ray))
            return (float3)(0.0f);
        if (!closest_hit(scene, &ray, &hit))
            return arrives * transmittance_along(scene, &medium, &ray, distance, &stream);
        if (is_opaque(scene, hit.prim))
            return (float3)(0.0f);
        struct surface surface;
        surface_at(&surface, scene, &ray, &hit);
        const struct boundary boundary = meet_boundary(scene, media, &surface, -ray.direction);
        if (!is_passable(scene, &surface, &boundary))
            return (float3)(0.0f);
        arrives *= transmittance_along(scene, &medium, &ray, hit.t, &stream);
        stream.count += RT_STREAM_LEAP;
        origin = leave_surface(&surface, ray.direction);
        media = boundary.beyond;
    }
    return (float3)(0.0f);
}

/* A point joined with a sampled light, before what is in between is known. */
struct media_connection {
    float3 radiance; /* that the light adds to the path's if all of it arrives; 0: no light */
    float3 origin;
    uint4 media; /* around it */
    struct light_sample sample;
    struct stream numbers;
};

/* Adds the light of a connection that arrives to the path. */
static inline void add_arrival(struct path *path, const struct scene *scene,
                               const struct media_connection *connection)
{
    if (largest3(connection->radiance) > 0.0f)
        path->radiance +=
            connection->radiance * light_transmittance(scene, connection->media, connection->origin,
                                                       &connection->sample, connection->numbers);
}

/* ---- Weights ----------------------------------------------------------------------- */

/* The density that the technique `segment` has for a light and the path's vertex, 1/m. */
static inline float other_light_pdf(const struct media_path *p, const struct scene *scene,
                                    uint light)
{
    return KNOWS_GRIDS && p->on_grid ? 0.0f
                                     : segment_light_pdf(scene, &p->segment, light, p->distance);
}

/*
 * The weight of a sample of light sampling, by its distance or its segment: the other of the two
 * generates it with `other` times its density, and the phase function with `phase` times.
 */
static inline float media_light_weight(const rt_params *params, bool delta, float other,
                                       float phase)
{
    const float light = 1.0f + other * other;
    if (delta || params->estimator == RT_ESTIMATOR_LIGHT)
        return 1.0f / light;
    return params->estimator == RT_ESTIMATOR_BSDF ? 0.0f : 1.0f / (light + phase * phase);
}

/*
 * The weight of emission that a direction sampled at the vertex before found: light sampling from
 * there has `ratio` times its density, `ratio` 0: it could not have found it.
 */
static inline float media_emission_weight(const struct media_path *p, const struct scene *scene,
                                          const rt_params *params, uint light, float ratio)
{
    if (p->path.pdf_w == 0.0f)
        return 1.0f;
    if (params->estimator != RT_ESTIMATOR_MIS)
        return params->estimator == RT_ESTIMATOR_BSDF ? 1.0f : 0.0f;
    float other = 0.0f;
    if (p->in_medium && ratio > 0.0f)
        other = other_light_pdf(p, scene, light) / (p->pdf * light_pmf(scene, light, p->path.from));
    return 1.0f / (1.0f + ratio * ratio * (1.0f + other * other));
}

/* ---- Samples ----------------------------------------------------------------------- */

/*
 * The technique `segment`: adds light that the segment under way scatters. `alone`: the path is not
 * scattered in the medium, so that the phase function meets no light.
 */
static inline void add_segment_light(struct path *path, const struct scene *scene,
                                     const rt_params *params, const struct medium *medium,
                                     const struct segment *segment, const bool alone, float4 u)
{
    struct equiangular seen;
    struct light_sample sample;
    float pmf;
    if (path->depth == params->max_depth || scene->light_nodes[1].weight == 0.0f)
        return;
    const uint light = choose_light(scene, segment->reference, u.z, &pmf);
    if (pmf == 0.0f || !see_equiangular(&seen, scene, light, segment))
        return;
    const float distance = equiangular_sample(&seen, u.w);
    const float3 position = segment->origin + distance * segment->direction;
    if (!(distance > 0.0f && distance < segment->length) ||
        !sample_chosen(scene, scene->lights + light, position, u.xy, &sample))
        return;
    const float pdf = pmf * equiangular_pdf(&seen, distance);
    const float sampled = distance_pdf(medium, segment->pmf, distance);
    const float phase = phase_pdf_w(medium->g, segment->direction, sample.wi);
    const float weight = media_light_weight(params, alone || sample.delta,
                                            sampled * light_pmf(scene, light, position) / pdf,
                                            sampled * phase * sample.inv_pdf / pdf);
    const float3 scattered = scattering_at(scene, medium, position) *
                             transmittance(medium, distance) *
                             (phase * weight * sample.inv_pdf / pdf);
    const float3 radiance = path->eta_scale * path->beta * scattered * sample.radiance;
    if (largest3(radiance) > 0.0f)
        path->radiance += radiance * light_transmittance(scene, path->media, position, &sample,
                                                         shadow_numbers(path));
}

/* The technique `distance`: adds the light that arrives at the vertex in a medium. */
static inline void add_vertex_light(struct media_path *p, const struct scene *scene,
                                    const rt_params *params, const struct medium *medium,
                                    const bool alone, float4 u)
{
    struct path *path = &p->path;
    struct light_sample sample;
    float pmf;
    if (scene->light_nodes[1].weight == 0.0f)
        return;
    const uint light = choose_light(scene, path->from, u.z, &pmf);
    if (pmf == 0.0f || !sample_chosen(scene, scene->lights + light, path->from, u.xy, &sample))
        return;
    const float phase = phase_pdf_w(medium->g, p->segment.direction, sample.wi);
    const float other = other_light_pdf(p, scene, light) / (p->pdf * pmf);
    const float weight =
        media_light_weight(params, alone || sample.delta, other, phase * sample.inv_pdf / pmf);
    const float3 radiance =
        path->eta_scale * path->beta * sample.radiance * (phase * weight * sample.inv_pdf / pmf);
    if (largest3(radiance) > 0.0f)
        path->radiance += radiance * light_transmittance(scene, path->media, path->from, &sample,
                                                         shadow_numbers(path));
}

/* Joins a vertex at a surface with a sampled light; held, last: as in sample_direct. */
static inline void connect_surface(struct media_connection *connection, const struct path *path,
                                   const struct scene *scene, const rt_params *params,
                                   const struct vertex *vertex, uint held, const bool last,
                                   float4 u)
{
    struct light_sample *const sample = &connection->sample;
    float3 scattered;
    if (!sample_direct(sample, &scattered, scene, params, vertex, held, last, u))
        return;
    connection->radiance =
        path->eta_scale * path->beta * (scattered * sample->radiance * sample->inv_pdf);
    connection->media = vertex_crosses(vertex, sample->wi) ? vertex->beyond : path->media;
    connection->origin = vertex_leave(vertex, sample->wi);
    connection->numbers = shadow_numbers(path);
}

#endif
