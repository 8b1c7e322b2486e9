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

#include "vcm/grid.h"

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
