/*
 * radii.h - the pixels' own radii of merging in the first iteration, found by the light vertices of
 * a pilot: where many lie around what a pixel sees, light is concentrated, and a smaller disc that
 * holds RT_MERGE_WANTED of them blurs it less.
 *
 * Where a disc holds more than twice as many, the search begins again on a grid of half the radius,
 * so that no pixel looks at all vertices of a bright spot.
 */
#ifndef RT_KERNELS_VCM_RADII_H
#define RT_KERNELS_VCM_RADII_H

#include "accel/traverse.h"
#include "count.h"
#include "integrate/path_state.h"
#include "vcm/grid.h"

/* Follows a camera path to the first vertex that merges; false: there is none. */
static bool find_merge_surface(struct path *path, const struct scene *scene,
                               const rt_params *params, struct meeting *met)
{
    while (path->alive) {
        const float8 u = path_numbers(path);
        const struct ray ray = path->ray;
        struct hit hit;
        count_path_ray(scene, path);
        if (!closest_hit(scene, &ray, &hit))
            return false;
        meet_surface(met, scene, &path->ray, &hit, path->media);
        if (!met->boundary.exists) {
            path_pass(path, met);
            continue;
        }
        const struct vertex vertex =
            vertex_at(scene, met, path->media.x, path->beta, CARRY_RADIANCE);
        if (vertex_connects(&vertex))
            return true;
        const uint event = vertex_choose(&vertex, 1.0f, u.hi.z);
        if (event == RT_NO_EVENT || path->depth == params->max_depth)
            return false;
        path_scatter(path, &vertex, event, false, u.hi.xyw);
    }
    return false;
}

/* How many of the vertices of a cell are within the radius, no more than `most`. */
static uint count_merge_points(const rt_vcm_params *vcm, const rt_merge_query *query,
                               global const rt_merge_point *points,
                               global const rt_merge_light *lights, global const uint *begins,
                               int3 cell, uint most)
{
    const uint bucket = bucket_of(cell, vcm->bucket_bits);
    const float3 at = vload3(0, query->position), normal = vload3(0, query->normal);
    uint count = 0u;
    for (uint i = begins[bucket]; i < begins[bucket + 1u] && count < most; i++) {
        const float3 off = row3(points[i].position) - at;
        count += dot(off, off) <= square(vcm->radius) &&
                 fabs(dot(row3(lights[i].normal), normal)) >= RT_PHOTON_NORMAL_COSINE;
    }
    return count;
}

#endif
