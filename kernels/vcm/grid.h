/*
 * grid.h - the cells in which light vertices are found for merging: cubes with the diameter of the
 * merging disc as their side, so that a sphere around a point touches eight at most. Cells share
 * buckets by a hash, and the points of a bucket are told apart by their cells.
 */
#ifndef RT_KERNELS_VCM_GRID_H
#define RT_KERNELS_VCM_GRID_H

#include "math/frame.h"
#include "scene.h"
#include "types.h"

/* Where a point lies, in cells from the lowest corner of the scene. */
static inline float3 cell_place(const struct scene *scene, float radius, float3 position)
{
    return (position - row3(scene->header->bounds_lo)) * (0.5f / radius);
}

static inline int3 cell_at(float3 place)
{
    return convert_int3_sat(floor(place));
}

static inline uint bucket_of(int3 cell, uint bits)
{
    const uint3 c = as_uint3(cell);
    uint hash = c.x * 0x8da6b343u ^ c.y * 0xd8163841u ^ c.z * 0xcb1ab31fu;
    hash = (hash ^ (hash >> 15)) * 0x9e3779b9u;
    return hash >> (32u - bits);
}

#endif
