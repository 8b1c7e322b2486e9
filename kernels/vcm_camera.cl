/*
 * vcm_camera.cl - camera paths of vertex connection and merging: each work-item follows one, and
 * adds it to the film of a pass. Before the first, the radii of merging that pixels begin with.
 */
#include "entry.h"
#include "camera/film.h"
#include "vcm/camera_path.h"
#include "vcm/radii.h"

/*
 * shares: [light_count]; vertices: [params.max_depth - 1][vcm.slots], of which the column of an
 * item holds as many as counts [height * width] says, those of its light path. With vcm.is_packed,
 * a list instead, in which those of item i begin at firsts, as many, and points, lights and begins
 * are the grid; own: [height][width], squared radii, where vcm.own_factor says so; parts:
 * [height][width][2][3], what merging over half and a quarter of the discs finds more. The sample
 * is params.first_sample. With vcm.is_query, neither of light paths, nor grid nor film is touched;
 * queries: [height][width], of the first vertices that merge; their radii are not known yet.
 */
KERNEL vcm_camera(const rt_params params, global const rt_scene_header *header,
                  const rt_vcm_params vcm, global const rt_light_share *shares,
                  global const rt_light_vertex *vertices, global const uint *counts,
                  global const uint *firsts, global const rt_merge_point *points,
                  global const rt_merge_light *lights, global const uint *begins,
                  global const float *own, global float *parts, global rt_film_pixel *film,
                  global rt_merge_query *queries)
{
    const uint item = item_number();
    if (item >= params.item_count)
        return;
    const struct vcm_scene all = {
        scene_open(header), &params,        technique_weights_of(&vcm), shares,
        vcm.radius,         vcm.bucket_bits};
    const uint path_index = params.first_item + item;
    struct light_vertices light = {vertices + item, vcm.slots, counts[path_index],
                                   points,          lights,    begins};
    if (vcm.is_packed && !vcm.is_query) {
        light.first = vertices + firsts[path_index];
        light.stride = 1u;
    }
    const uint2 at = pixel_of_item(&params, path_index);
    const uint index = at.y * params.width + at.x;
    const struct sampler sampler = sampler_start(&all.scene, &params, index, params.first_sample);
    float weight;
    const struct ray ray = pixel_ray(&all.scene, &params, &sampler, at, &weight);
    struct vcm_camera_path path;
    const float squared = square(vcm.radius);
    const float own_squared =
        vcm.own_factor > 0.0f ? fmin(vcm.own_factor * own[index], squared) : squared;
    begin_camera_path(&path, &all, &sampler, ray, own_squared,
                      vcm.is_measured ? parts + 6u * (size_t)index : 0);
    path.query = vcm.is_query ? queries + index : 0;
    if (path.query)
        *path.query = no_query();
    while (path.eye.alive)
        extend_camera_path(&path, &all, &light);
    if (path.query)
        return;
    rt_film_pixel pixel = film[index];
    film_add(&pixel, path.eye.radiance, weight, path.eye.cut_off);
    film[index] = pixel;
}

/* Asks at `count` of the light vertices, or all if they are fewer: queries [count]. */
KERNEL vcm_light_queries(uint count, uint vertex_count, global const rt_merge_point *points,
                         global const rt_merge_light *lights, global rt_merge_query *queries)
{
    const uint item = item_number();
    if (item >= count)
        return;
    const uint vertex = vertex_count > count ? (uint)((ulong)item * vertex_count / count) : item;
    queries[item] = item < vertex_count
                        ? query_at(row3(points[vertex].position), row3(lights[vertex].normal))
                        : no_query();
}

/*
 * Sets the squared radii that are not known yet, by the vertices within vcm.radius; they are no
 * larger than squared_limit. Those of discs that hold too many stay unknown.
 */
KERNEL vcm_radii(uint count, global const rt_scene_header *header, const rt_vcm_params vcm,
                 global const rt_merge_point *points, global const rt_merge_light *lights,
                 global const uint *begins, float squared_limit, global rt_merge_query *queries)
{
    const uint item = item_number();
    if (item >= count)
        return;
    const rt_merge_query query = queries[item];
    if (!query.is_query || query.squared_radius >= 0.0f)
        return;
    const struct scene scene = scene_open(header);
    const float3 place = cell_place(&scene, vcm.radius, vload3(0, query.position));
    const int3 low = cell_at(place - 0.5f), high = cell_at(place + 0.5f);
    const uint most = 2u * RT_MERGE_WANTED + 1u;
    uint found = 0u;
    for (int z = low.z; z <= high.z && found < most; z++)
        for (int y = low.y; y <= high.y && found < most; y++)
            for (int x = low.x; x <= high.x && found < most; x++)
                found += count_merge_points(&vcm, &query, points, lights, begins, (int3)(x, y, z),
                                            most - found);
    if (found < most)
        queries[item].squared_radius = fmin(
            squared_limit, square(vcm.radius) * ((float)RT_MERGE_WANTED / (float)max(found, 1u)));
}
