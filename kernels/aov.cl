/*
 * aov.cl - what the first surface is like: albedo, normal and depth, each a layer of the film. Each
 * work-item takes the samples of one pixel, the same that the other modes take.
 */
#include "bsdf/bsdf.h"
#include "camera/camera.h"
#include "entry.h"
#include "camera/film.h"
#include "accel/traverse.h"

/*
 * The distance along the view axis; all directions at once have none, so the distance from the eye.
 */
static float depth_of(global const rt_camera_data *camera, float3 position)
{
    const float3 away = position - row3(camera->eye);
    return camera->kind == RT_CAMERA_KIND_ENVIRONMENT ? length(away)
                                                      : dot(away, row3(camera->axis));
}

/* layers: RT_LAYER_COUNT films one after the other; see RT_LAYER_ALBEDO for what they sum. */
KERNEL aov(const rt_params params, global const rt_scene_header *header,
           global rt_film_pixel *layers)
{
    const uint item = (uint)get_global_id(0);
    if (item >= params.item_count)
        return;
    const struct scene scene = scene_open(header);
    const uint2 at = pixel_of_item(&params, params.first_item + item);
    const uint index = at.y * params.width + at.x;
    const size_t film_size = (size_t)params.width * params.height;
    rt_film_pixel albedo = layers[RT_LAYER_ALBEDO * film_size + index];
    rt_film_pixel normal = layers[RT_LAYER_NORMAL * film_size + index];
    rt_film_pixel depth = layers[RT_LAYER_DEPTH * film_size + index];

    for (uint i = 0; i < params.sample_count; i++) {
        const struct sampler sampler =
            sampler_start(&scene, &params, index, params.first_sample + i);
        float3 colour = (float3)(0.0f), shading = (float3)(0.0f), distance = (float3)(0.0f);
        float weight;
        const struct ray ray = pixel_ray(&header->camera, &params, &sampler, at, &weight);
        struct hit hit;
        if (can_follow(&ray) && closest_hit(&scene, &ray, &hit)) {
            const struct surface surface = surface_at(&scene, &ray, &hit);
            global const rt_material_data *material =
                scene.materials + scene.shapes[surface.shape].material;
            const float3 wo = -ray.direction;
            const struct bsdf bsdf = bsdf_at(&scene, material, &surface, wo, 1.0f, (float3)(1.0f));
            colour = bsdf_albedo(&bsdf);
            /*
             * The normal that light sees, bumps included, turned back to the side that the shape
             * has it on.
             */
            shading = (dot(wo, surface.normal) < 0.0f ? -1.0f : 1.0f) * bsdf.shading;
            distance = (float3)(depth_of(&header->camera, surface.position), 1.0f, weight);
        }
        film_add(&albedo, colour, weight);
        film_add(&normal, shading, weight);
        film_add(&depth, distance, 1.0f);
    }
    layers[RT_LAYER_ALBEDO * film_size + index] = albedo;
    layers[RT_LAYER_NORMAL * film_size + index] = normal;
    layers[RT_LAYER_DEPTH * film_size + index] = depth;
}
