/*
 * grid.h - the cells in which light vertices are found for merging: cubes with the diameter of the
 * merging disc as their side, so that a sphere around a point touches eight at most. Cells share
 * buckets by a hash, but those eight never do: so a point in the sphere is met once, in the bucket
 * of its cell, and the others that share the bucket lie outside.
 */
#ifndef RT_KERNELS_VCM_GRID_H
#define RT_KERNELS_VCM_GRID_H

#include "math/frame.h"
#include "scene.h"
#include "types.h"

/*
 * Where a point lies, in cells from the lowest corner of the scene. Cells are no smaller than a
 * millionth of the scene: where they could not be counted, all would be one.
 */
static inline float3 cell_place(const struct scene *scene, float radius, float3 position)
{
    const float reach = fmax(radius, 0x1p-20f * scene->header->radius);
    return (position - row3(scene->header->bounds_lo)) * (0.5f / reach);
}

static inline int3 cell_at(float3 place)
{
    return convert_int3_sat(floor(place));
}

/* Three bits, two places apart. */
static inline uint spread_bits(uint i)
{
    return (i & 1u) | (i & 2u) << 2 | (i & 4u) << 4;
}

/*
 * Blocks of 8 x 8 x 8 cells are hashed; the buckets of a block are side by side, in Morton's order,
 * so that cells near each other share caches and pages, and neighbours differ whatever the hash.
 * bits: 10 at least
 */
static inline uint bucket_of(int3 cell, uint bits)
{
    const uint3 block = as_uint3(cell >> 3), c = as_uint3(cell);
    uint hash = block.x * 0x8da6b343u ^ block.y * 0xd8163841u ^ block.z * 0xcb1ab31fu;
    hash = (hash ^ (hash >> 15)) * 0x9e3779b9u;
    return (hash >> (41u - bits)) << 9 | spread_bits(c.x) | spread_bits(c.y) << 1 |
           spread_bits(c.z) << 2;
}

#endif
