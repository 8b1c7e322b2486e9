/*
 * matte.cl - path tracing that takes each vertex by itself, for the test of those that are taken
 * together.
 */
#include "camera/camera.h"
#include "entry.h"
#include "camera/film.h"
#include "integrate/integrate.h"

/* One work-item a pixel. */
KERNEL path_singly(const rt_params params, global const rt_scene_header *header,
                   global rt_film_pixel *film)
{
    const uint item = (uint)get_global_id(0);
    if (item >= params.item_count)
        return;
    const struct scene scene = scene_open(header);
    const uint2 at = pixel_of_item(&params, item);
    const uint index = at.y * params.width + at.x;
    for (uint n = 0u; n < params.sample_count; n++) {
        const struct sampler sampler = sampler_start(&scene, &params, index, n);
        float weight;
        struct path path;
        path_begin(&path, &scene, &sampler,
                   pixel_ray(&header->camera, &params, &sampler, at, &weight));
        while (path.depth) {
            const float8 numbers = sampler_pair(&path.sampler, set_light(path.depth - 1u));
            struct hit hit;
            struct connection connection;
            connection.radiance = (float3)(0.0f);
            if (closest_hit(&scene, &path.ray, &hit))
                path_vertex(&scene, &params, &path, &hit, numbers, &connection, FOLLOW_ALL, 0);
            else
                path_escape(&scene, &params, &path, FOLLOW_ALL);
            if (largest3(connection.radiance) > 0.0f && !occluded(&scene, &connection.ray))
                path.radiance += connection.radiance;
        }
        rt_film_pixel pixel = film[index];
        film_add(&pixel, path.radiance, weight);
        film[index] = pixel;
    }
}
