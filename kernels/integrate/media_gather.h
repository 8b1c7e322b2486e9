/*
 * media_gather.h - the camera paths of photon mapping in scenes with media that scatter.
 *
 * A path is not scattered in media: it goes on to the next surface with the transmittance, and each
 * segment adds the light that the medium scatters along it, from volume photons (photon/beam.h)
 * and, unless these hold direct light, from sampled lights (the techniques `distance` and `segment`
 * of media_light.h find all of it; where the density lies on a grid, `distance` alone). At
 * surfaces, photons are gathered as in gather.h.
 */
#ifndef RT_KERNELS_INTEGRATE_MEDIA_GATHER_H
#define RT_KERNELS_INTEGRATE_MEDIA_GATHER_H

#include "integrate/gather.h"
#include "integrate/media_path.h"
#include "photon/grid_beam.h"

/* The technique `distance` at a point of the segment where the path is not scattered. */
static inline void add_distance_light(const struct media_path *p, float3 *radiance,
                                      const struct scene *scene, const rt_params *params,
                                      const struct medium *medium, float4 u)
{
    struct media_path there = *p;
    there.on_grid = false;
    there.pdf = distance_pdf(medium, p->segment.pmf, p->distance);
    there.path.from = p->segment.origin + p->distance * p->segment.direction;
    there.path.beta *= scattering_at(scene, medium, there.path.from) *
                       transmittance(medium, p->distance) * (1.0f / there.pdf);
    there.path.radiance = (float3)(0.0f);
    add_vertex_light(&there, scene, params, medium, true, u);
    *radiance += there.path.radiance;
}

/* The same at a point found by delta tracking, where the density lies on a grid. */
static inline void add_tracked_light(const struct media_path *p, float3 *radiance,
                                     const struct scene *scene, const rt_params *params,
                                     const struct medium *medium, struct stream stream, float4 u)
{
    struct media_path there = *p;
    struct tracked tracked;
    if (!delta_tracking(&tracked, scene, medium, p->segment.origin, p->segment.direction,
                        p->segment.length, p->segment.pmf, &stream))
        return;
    there.on_grid = true;
    there.pdf = 1.0f;
    there.path.from = p->segment.origin + tracked.distance * p->segment.direction;
    there.path.beta *= scattered_weight(&tracked, scene, medium, p->segment.pmf, there.path.from);
    there.path.radiance = (float3)(0.0f);
    add_vertex_light(&there, scene, params, medium, true, u);
    *radiance += there.path.radiance;
}

/* As gather_in_medium, where the density lies on a grid. */
static inline void gather_in_grid(struct media_path *p, const struct scene *scene,
                                  const rt_params *params, const struct volume_map *map,
                                  const struct medium *medium, float length, float4 u)
{
    struct path *path = &p->path;
    struct stream stream = stream_of(&path->sampler, set_segment(path->depth + path->hidden));
    if (!medium_scatters(medium) || path->depth >= params->max_depth) {
        path->beta *=
            marched_transmittance(scene, medium, path->ray.origin, path->ray.direction, length);
        return;
    }
    p->segment.origin = path->ray.origin;
    p->segment.direction = path->ray.direction;
    p->segment.length = length;
    p->segment.pmf = channel_pmf(path->beta);
    if (params->direct == RT_DIRECT_NEE)
        add_tracked_light(p, &path->radiance, scene, params, medium, stream, u);
    stream.count += RT_STREAM_LEAP;
    float3 passes;
    const float3 scattered =
        grid_radiance(map, scene, medium, path->media.x, &p->segment, &stream, &passes);
    path->radiance += path->eta_scale * path->beta * scattered;
    path->beta *= passes;
}

/* Adds the light that the medium scatters along the segment under way, and attenuates the path. */
static inline void gather_in_medium(struct media_path *p, const struct scene *scene,
                                    const rt_params *params, const struct volume_map *map,
                                    const struct medium *medium, float length, float4 u, float8 v)
{
    struct path *path = &p->path;
    if (is_on_grid(medium)) {
        gather_in_grid(p, scene, params, map, medium, length, u);
        return;
    }
    if (medium_scatters(medium) && path->depth < params->max_depth) {
        p->segment =
            make_segment(medium, path->ray.origin, path->ray.direction, length, path->beta);
        if (params->direct == RT_DIRECT_NEE) {
            add_segment_light(path, scene, params, medium, &p->segment, true, v.lo);
            p->distance = sample_distance(medium, p->segment.pmf, v.hi.xy);
            if (p->distance < length)
                add_distance_light(p, &path->radiance, scene, params, medium, u);
        }
        path->radiance += path->eta_scale * path->beta *
                          volume_radiance(map, scene, medium, path->media.x, &p->segment, v.hi.zw);
    }
    path->beta *= transmittance(medium, length);
}

/* Extends a path that is alive by its next vertex, or through a boundary without a surface. */
static inline void media_gather_extend(const struct scene *scene, const rt_params *params,
                                       const struct volume_map *map, struct media_path *p,
                                       const struct gather *gather)
{
    struct path *path = &p->path;
    const float8 u = path_numbers(path);
    struct hit hit;
    if (path->resumes) {
        copy_hit(&hit, &gather->fork->hit);
        media_surface(p, scene, params, &hit, u, FOLLOW_TO_GATHER, gather);
        return;
    }
    const struct ray ray = path->ray;
    const struct medium medium = medium_of(scene, path->media.x);
    count_path_ray(scene, path);
    const bool found = closest_hit(scene, &ray, &hit);
    gather_in_medium(p, scene, params, map, &medium, found ? hit.t : INFINITY, u.lo,
                     segment_numbers(path));
    path->alive = found && largest3(path->beta) > 0.0f;
    if (path->alive)
        media_surface(p, scene, params, &hit, u, FOLLOW_TO_GATHER, gather);
    else if (!found && largest3(path->beta) > 0.0f && !left_to_photons(path, FOLLOW_TO_GATHER))
        add_escaped_light(p, scene, params);
}

#endif
