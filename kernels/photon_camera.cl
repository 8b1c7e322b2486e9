/*
 * photon_camera.cl - the eye paths of photon mapping: each work-item follows one sample of one
 * pixel to its gather points.
 */
#include "camera/camera.h"
#include "entry.h"
#include "camera/film.h"
#include "integrate/path.h"
#include "photon/gather_point.h"

/*
 * points: [item_count], in the order of items; caustics: [params.final_gather][stride], a row for
 * each diffuse event before that. The sample is params.first_sample.
 */
KERNEL photon_camera(const rt_params params, global const rt_scene_header *header,
                     global rt_gather_point *points, global rt_gather_point *caustics, uint stride)
{
    const uint item = (uint)get_global_id(0);
    if (item >= params.item_count)
        return;
    const struct scene scene = scene_open(header);
    const uint2 at = pixel_of_item(&params, params.first_item + item);
    const uint index = at.y * params.width + at.x;
    const struct sampler sampler = sampler_start(&scene, &params, index, params.first_sample);
    float film_weight;
    const struct ray ray = pixel_ray(&header->camera, &params, &sampler, at, &film_weight);

    struct gather gather;
    gather.point = points + item;
    gather.caustics = caustics + item;
    gather.stride = stride;
    clear_gather_point(gather.point, index, params.first_sample, film_weight);
    for (uint i = 0u; i < params.final_gather; i++)
        clear_gather_point(gather.caustics + i * stride, index, params.first_sample, film_weight);
    float cut_off;
    const float3 radiance =
        follow_path(&scene, &params, &sampler, ray, FOLLOW_TO_GATHER, &gather, &cut_off);
    vstore3(radiance, 0, points[item].radiance);
    points[item].cut_off = cut_off;
}
