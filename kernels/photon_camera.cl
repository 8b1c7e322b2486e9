/*
 * photon_camera.cl - photon mapping, seen from the eye: each work-item follows one sample of one
 * pixel to the place where the photon map is asked.
 */
#include "camera.h"
#include "film.h"
#include "integrate.h"

/* points: [item_count], in the order of items; the sample is params.first_sample. */
kernel void photon_camera(const rt_params params, global const rt_scene_header *header, global rt_gather_point *points)
{
    const uint item = (uint)get_global_id(0);
    if (item >= params.item_count)
        return;
    const struct scene scene = scene_open(header);
    const uint2 at = pixel_of_item(&params, params.first_item + item);
    const uint index = at.y * params.width + at.x;
    const float2 size = (float2)(params.width, params.height);
    const struct sampler sampler = sampler_start(&scene, &params, index, params.first_sample);
    const float4 u = sampler_set(&sampler, SET_START);
    const struct ray ray = camera_ray(&header->camera, (convert_float2(at) + u.xy) / size, u.zw);

    struct gather gather;
    gather.found = false;
    gather.position = gather.normal = gather.wo = gather.weight = (float3)(0.0f);
    gather.material = 0u;
    struct path path;
    path_start(&path, ray, sampler);
    follow_paths(&scene, &params, &path, 1u, true, &gather);

    rt_gather_point point;
    vstore3(gather.position, 0, point.position);
    point.pixel = index;
    vstore3(gather.normal, 0, point.normal);
    point.material = gather.material;
    vstore3(gather.weight, 0, point.weight);
    point.sample = params.first_sample;
    vstore3(gather.wo, 0, point.wo);
    point.reserved0 = 0u;
    vstore3(path.radiance, 0, point.radiance);
    point.reserved1 = 0u;
    points[item] = point;
}
