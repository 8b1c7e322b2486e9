/*
 * path.cl - path tracing: each work-item takes the samples of a few pixels, those of a pixel in
 * order.
 */
#include "camera/camera.h"
#include "entry.h"
#include "camera/film.h"
#include "integrate/path.h"

#if RT_WIDTH > 1
#include "integrate/batch.h"
#else
/* Adds a launch's samples to the pixels of the items from `item` to before `end`. */
static inline void sample_pixels(const struct scene *scene, const rt_params *params, uint item,
                                 uint end, global rt_film_pixel *film)
{
    for (; item < end; item++) {
        const uint2 at = pixel_of_item(params, params->first_item + item);
        const uint index = at.y * params->width + at.x;
        rt_film_pixel pixel = film[index];
        for (uint i = 0u; i < params->sample_count; i++) {
            const struct sampler sampler =
                sampler_start(scene, params, index, params->first_sample + i);
            float weight, cut_off;
            const struct ray ray = pixel_ray(&scene->header->camera, params, &sampler, at, &weight);
            const float3 radiance =
                follow_path(scene, params, &sampler, ray, FOLLOW_ALL, 0, &cut_off);
            film_add(&pixel, radiance, weight, cut_off);
        }
        film[index] = pixel;
    }
}
#endif

KERNEL path(const rt_params params, global const rt_scene_header *header,
            global rt_film_pixel *film)
{
    const uint item = (uint)get_global_id(0) * params.pixels_an_item;
    if (item >= params.item_count)
        return;
    const struct scene scene = scene_open(header);
    sample_pixels(&scene, &params, item, min(item + params.pixels_an_item, params.item_count),
                  film_plane(film, &params));
}
