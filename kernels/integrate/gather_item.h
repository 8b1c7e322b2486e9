/*
 * gather_item.h - the camera path of a work-item in photon mapping: its begin, end and points, and
 * the continuations that it is split into.
 */
#ifndef RT_KERNELS_INTEGRATE_GATHER_ITEM_H
#define RT_KERNELS_INTEGRATE_GATHER_ITEM_H

#include "camera/camera.h"
#include "camera/film.h"
#include "integrate/gather.h"
#include "integrate/split.h"

/* Clears the gather points of a path. */
static inline void clear_gather(const struct gather *gather, const rt_params *params, uint pixel,
                                float film_weight)
{
    clear_gather_point(gather->point, pixel, params->first_sample, film_weight);
    for (uint i = 0u; i < params->final_gather; i++)
        clear_gather_point(gather->caustics + i * gather->stride, pixel, params->first_sample,
                           film_weight);
}

/* Moves on to the gather points of the next continuation. */
static inline void next_gather(struct gather *gather)
{
    gather->point++;
    gather->caustics++;
}

/* The gather points of an item, as which a whole path begins. */
static inline struct gather gather_of_item(const struct gather *first, const rt_params *params,
                                           uint item, struct fork *fork)
{
    struct gather gather;
    gather.point = first->point + item * params->split;
    gather.caustics = first->caustics + item * params->split;
    gather.stride = first->stride;
    gather.fork = fork;
    return gather;
}

/* Begins the path of an item: clears its gather points, and finds its ray. */
static inline void begin_eye_path(struct path *path, const struct gather *gather,
                                  const struct scene *scene, const rt_params *params, uint item)
{
    const uint2 at = pixel_of_item(params, params->first_item + item);
    const uint index = at.y * params->width + at.x;
    const struct sampler sampler = sampler_start(scene, params, index, params->first_sample);
    float film_weight;
    const struct ray ray = pixel_ray(scene, params, &sampler, at, &film_weight);
    struct gather each = *gather;
    for (uint i = 0u; i < params->split; i++, next_gather(&each))
        clear_gather(&each, params, index, film_weight);
    path_begin(path, scene, &sampler, ray);
}

/* Writes what the path, or a continuation, collected before its gather points. */
static inline void end_eye_path(const struct path *path, const struct gather *gather,
                                const rt_params *params)
{
    const float part = path->whole ? 1.0f : 1.0f / (float)params->split;
    if (!path->whole)
        join_gather_points(path, gather);
    vstore3(path->radiance, 0, gather->point->radiance);
    gather->point->cut_off = part * path->cut_off;
}

/* Begins the next continuation of a path that was split; false: there is none. */
static inline bool begin_continuation(struct path *path, struct gather *gather,
                                      const rt_params *params)
{
    if (path->whole || gather->fork->next == params->split)
        return false;
    copy_path(path, &gather->fork->path);
    aim_continuation(path, params, gather->fork->next++);
    next_gather(gather);
    return true;
}

#endif
