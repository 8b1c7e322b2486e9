/* gather_item.h - the camera path of a work-item in photon mapping: its begin, end and points. */
#ifndef RT_KERNELS_INTEGRATE_GATHER_ITEM_H
#define RT_KERNELS_INTEGRATE_GATHER_ITEM_H

#include "camera/camera.h"
#include "camera/film.h"
#include "integrate/gather.h"

/* Begins the path of an item: clears its gather points, and finds its ray. */
static inline void begin_eye_path(struct path *path, const struct gather *gather,
                                  const struct scene *scene, const rt_params *params, uint item)
{
    const uint2 at = pixel_of_item(params, params->first_item + item);
    const uint index = at.y * params->width + at.x;
    const struct sampler sampler = sampler_start(scene, params, index, params->first_sample);
    float film_weight;
    const struct ray ray = pixel_ray(&scene->header->camera, params, &sampler, at, &film_weight);
    clear_gather_point(gather->point, index, params->first_sample, film_weight);
    for (uint i = 0u; i < params->final_gather; i++)
        clear_gather_point(gather->caustics + i * gather->stride, index, params->first_sample,
                           film_weight);
    path_begin(path, scene, &sampler, ray);
}

/* Writes what the path collected before its gather points. */
static inline void end_eye_path(const struct path *path, const struct gather *gather)
{
    vstore3(path->radiance, 0, gather->point->radiance);
    gather->point->cut_off = path->cut_off;
}

/* The gather points of an item. */
static inline struct gather gather_of_item(const struct gather *first, uint item)
{
    struct gather gather;
    gather.point = first->point + item;
    gather.caustics = first->caustics + item;
    gather.stride = first->stride;
    return gather;
}

#endif
