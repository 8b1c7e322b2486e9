/*
 * vcm_radii.cl - the pixels' own radii of merging in the first iteration, found by the light
 * vertices of a pilot: where many lie around what a pixel sees, light is concentrated, and a
 * smaller disc that holds RT_MERGE_WANTED of them blurs it less.
 *
 * Where a disc holds more than twice as many, the search begins again on a grid of half the radius,
 * so that no pixel looks at all vertices of a bright spot.
 */
#include "camera/camera.h"
#include "camera/film.h"
#include "entry.h"
#include "integrate/path.h"
#include "vcm/grid.h"

/* Follows a camera path to the first vertex that merges; false: there is none. */
static bool find_query(struct path *path, const struct scene *scene, const rt_params *params,
                       struct surface *surface)
{
    while (path->alive) {
        const float8 u = path_numbers(path);
        const struct ray ray = path->ray;
        struct hit hit;
        count_path_ray(scene, path);
        if (!closest_hit(scene, &ray, &hit))
            return false;
        *surface = surface_at(scene, &path->ray, &hit);
        const float3 wo = -path->ray.direction;
        const struct boundary boundary = meet_boundary(scene, path->media, surface, wo);
        if (!boundary.exists) {
            path->alive =
                pass_boundary(&path->ray, &path->media, &path->hidden, surface, boundary.beyond);
            continue;
        }
        const struct bsdf bsdf =
            bsdf_at(scene, scene->materials + scene->shapes[surface->shape].material, surface, wo,
                    &boundary, path->beta, CARRY_RADIANCE);
        if (bsdf_lobes(&bsdf))
            return true;
        const uint lobe = bsdf_choose(&bsdf, 1.0f, u.hi.z);
        if (lobe == RT_LOBE_NONE || path->depth == params->max_depth)
            return false;
        path_scatter(path, surface, &bsdf, lobe, false, u.hi.xyw, boundary.beyond);
    }
    return false;
}

/* queries: [height][width], of one sample of each pixel; their radii are not known yet */
KERNEL vcm_queries(const rt_params params, global const rt_scene_header *header,
                   global rt_merge_query *queries)
{
    const uint item = item_number();
    if (item >= params.item_count)
        return;
    const struct scene scene = scene_open(header);
    const uint2 at = pixel_of_item(&params, params.first_item + item);
    const uint index = at.y * params.width + at.x;
    const struct sampler sampler = sampler_start(&scene, &params, index, params.first_sample);
    float weight;
    const struct ray ray = pixel_ray(&header->camera, &params, &sampler, at, &weight);
    struct path path;
    struct surface surface;
    path_begin(&path, &scene, &sampler, ray);
    rt_merge_query query = {{0.0f, 0.0f, 0.0f}, 0u, {0.0f, 0.0f, 0.0f}, -1.0f};
    if (find_query(&path, &scene, &params, &surface)) {
        vstore3(surface.position, 0, query.position);
        vstore3(surface.normal, 0, query.normal);
        query.is_query = 1u;
    }
    queries[index] = query;
}

/* How many of the vertices of a cell are within the radius, no more than `most`. */
static uint count_in_cell(const struct scene *scene, const rt_vcm_params *vcm,
                          const rt_merge_query *query, global const rt_merge_point *points,
                          global const rt_merge_light *lights, global const uint *begins, int3 cell,
                          uint most)
{
    const uint bucket = bucket_of(cell, vcm->bucket_bits);
    const float3 at = vload3(0, query->position), normal = vload3(0, query->normal);
    uint count = 0u;
    for (uint i = begins[bucket]; i < begins[bucket + 1u] && count < most; i++) {
        const float3 position = row3(points[i].position);
        const float3 off = position - at;
        count += dot(off, off) <= square(vcm->radius) &&
                 fabs(dot(row3(lights[i].normal), normal)) >= RT_PHOTON_NORMAL_COSINE &&
                 all(cell_at(cell_place(scene, vcm->radius, position)) == cell);
    }
    return count;
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
                found += count_in_cell(&scene, &vcm, &query, points, lights, begins,
                                       (int3)(x, y, z), most - found);
    if (found < most)
        queries[item].squared_radius = fmin(
            squared_limit, square(vcm.radius) * ((float)RT_MERGE_WANTED / (float)max(found, 1u)));
}
