/*
 * path.cl - path tracing: each work-item takes the samples of RT_PATH_BATCH pixels, in order.
 */
#include "camera.h"
#include "film.h"
#include "integrate.h"

/* Adds one sample to each of the pixels. */
INLINE_NEVER void sample_pixels(const struct scene *scene, const rt_params *params, const uint2 *pixels, uint count,
                                uint number, global rt_film_pixel *film)
{
    struct path paths[RT_PATH_BATCH];
    const float2 size = (float2)(params->width, params->height);

    for (uint i = 0; i < count; i++) {
        const uint index = pixels[i].y * params->width + pixels[i].x;
        const struct sampler sampler = sampler_start(scene, params, index, number);
        const float4 u = sampler_set(&sampler, SET_START);
        const float2 at = (convert_float2(pixels[i]) + u.xy) / size;
        path_start(paths + i, camera_ray(&scene->header->camera, at, u.zw), sampler);
    }
    follow_paths(scene, params, paths, count, false, 0);
    for (uint i = 0; i < count; i++) {
        const uint index = pixels[i].y * params->width + pixels[i].x;
        rt_film_pixel pixel = film[index];
        film_add(&pixel, paths[i].radiance);
        film[index] = pixel;
    }
}

kernel void path(const rt_params params, global const rt_scene_header *header, global rt_film_pixel *film)
{
    const uint item = (uint)get_global_id(0) * RT_PATH_BATCH;
    if (item >= params.item_count)
        return;
    const struct scene scene = scene_open(header);
    const uint count = min(RT_PATH_BATCH, params.item_count - item);
    uint2 pixels[RT_PATH_BATCH];

    for (uint i = 0; i < count; i++)
        pixels[i] = pixel_of_item(&params, params.first_item + item + i);
    for (uint i = 0; i < params.sample_count; i++)
        sample_pixels(&scene, &params, pixels, count, params.first_sample + i, film);
}
