/*
 * media_samples.h - the samples that a work-item of path_media.cl or path_grids.cl takes.
 */
#ifndef RT_KERNELS_INTEGRATE_MEDIA_SAMPLES_H
#define RT_KERNELS_INTEGRATE_MEDIA_SAMPLES_H

#include "entry.h"
#include "camera/camera.h"
#include "camera/film.h"
#include "integrate/media_path.h"

/* Adds a launch's samples to a pixel. */
static inline void sample_pixel(const struct scene *scene, const rt_params *params, uint2 at,
                                uint index, global const uint *rates, rt_film_pixel *pixel)
{
    const uint last = samples_at(params, rates, index, params->first_sample + params->sample_count);
    for (uint i = samples_at(params, rates, index, params->first_sample); i < last; i++) {
        const struct sampler sampler = sampler_start(scene, params, index, i);
        struct media_path p;
        float weight;
        path_begin(&p.path, scene, &sampler, pixel_ray(scene, params, &sampler, at, &weight));
        p.in_medium = false;
        while (p.path.alive)
            media_path_extend(scene, params, &p);
        film_add(pixel, p.path.radiance, weight, p.path.cut_off);
    }
}

/* Adds a launch's samples to the pixels of a work-item. */
static inline void sample_items(const rt_params *params, global const rt_scene_header *header,
                                global rt_film_pixel *film, global const uint *rates)
{
    const uint begin = item_number() * params->pixels_an_item;
    const struct scene scene = scene_open_compensated(header, params);
    global rt_film_pixel *const plane = film_plane(film, params);
    const uint end = min(begin + params->pixels_an_item, params->item_count);
    for (uint item = begin; item < end; item++) {
        const uint2 at = pixel_of_item(params, params->first_item + item);
        const uint index = at.y * params->width + at.x;
        rt_film_pixel pixel = plane[index];
        sample_pixel(&scene, params, at, index, rates, &pixel);
        plane[index] = pixel;
    }
}

#endif
