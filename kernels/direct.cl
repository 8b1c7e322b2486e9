/*
 * direct.cl - emission and direct light alone: each work-item takes the samples of one pixel.
 */
#define RT_RADIANCE_ALONE
#include "camera/camera.h"
#include "entry.h"
#include "camera/film.h"
#include "integrate/path.h"

KERNEL ENTRY(direct)(const rt_params params, global const rt_scene_header *header,
                     global rt_film_pixel *film, global const uint *rates)
{
    const uint item = item_number();
    if (item >= params.item_count)
        return;
    const struct scene scene = scene_open_compensated(header, &params);
    const uint2 at = pixel_of_item(&params, params.first_item + item);
    const uint index = at.y * params.width + at.x;
    global rt_film_pixel *const plane = film_plane(film, &params);
    rt_film_pixel pixel = plane[index];

    const uint last = samples_at(&params, rates, index, params.first_sample + params.sample_count);
    for (uint i = samples_at(&params, rates, index, params.first_sample); i < last; i++) {
        const struct sampler sampler = sampler_start(&scene, &params, index, i);
        float weight, cut_off;
        const struct ray ray = pixel_ray(&scene, &params, &sampler, at, &weight);
        const float3 radiance =
            follow_path(&scene, &params, &sampler, ray, FOLLOW_DIRECT, 0, &cut_off);
        film_add(&pixel, radiance, weight, cut_off);
    }
    plane[index] = pixel;
}
