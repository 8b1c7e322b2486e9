/*
 * path.cl - path tracing: each work-item takes the samples of one pixel, in order.
 */
#include "camera.h"
#include "film.h"
#include "integrate.h"

kernel void path(const rt_params params, global const rt_scene_header *header, global rt_film_pixel *film)
{
    const uint item = (uint)get_global_id(0);
    if (item >= params.item_count)
        return;
    const struct scene scene = scene_open(header);
    const uint2 at = pixel_of_item(&params, params.first_item + item);
    const uint index = at.y * params.width + at.x;
    const float2 size = (float2)(params.width, params.height);
    rt_film_pixel pixel = film[index];

    for (uint i = 0; i < params.sample_count; i++) {
        const struct sampler sampler = sampler_start(&scene, &params, index, params.first_sample + i);
        const float4 u = sampler_set(&sampler, SET_START);
        const struct ray ray = camera_ray(&header->camera, (convert_float2(at) + u.xy) / size, u.zw);
        film_add(&pixel, follow_path(&scene, &params, &sampler, ray, false, 0));
    }
    film[index] = pixel;
}
