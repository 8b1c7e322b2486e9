/*
 * vcm_grid.cl - the light vertices of an iteration in one list, in the order of their paths, and
 * sorted by the buckets of their cells: the sort is that of photon_order.cl, and stable, so that
 * the order of no bucket depends on threads.
 */
#include "entry.h"
#include "vcm/grid.h"
#include "vcm/store.h"

/*
 * Moves the vertices of a batch of paths, from the path `first` on, from their columns to the list
 * from `base` on. places: [paths], of this batch; counts, firsts: of all paths, how many vertices
 * each has and where in the list they begin.
 */
KERNEL vcm_pack(uint paths, uint first, uint slots, uint base, global const uint *counts,
                global const uint *places, global const rt_light_vertex *columns,
                global uint *firsts, global rt_light_vertex *list)
{
    const uint path = item_number();
    if (path >= paths)
        return;
    const uint to = base + places[path];
    firsts[first + path] = to;
    for (uint i = 0u; i < counts[first + path]; i++)
        list[to + i] = columns[(size_t)i * slots + path];
}

/* items: the bucket of each vertex above its index in the list */
KERNEL vcm_keys(uint count, global const rt_scene_header *header, const rt_vcm_params vcm,
                global const rt_light_vertex *list, global ulong *items)
{
    const uint i = item_number();
    if (i >= count)
        return;
    const struct scene scene = scene_open(header);
    const int3 cell = cell_at(cell_place(&scene, vcm.radius, row3(list[i].position)));
    items[i] = (ulong)bucket_of(cell, vcm.bucket_bits) << RT_INDEX_BITS | i;
}

#define RT_PREFETCH_AHEAD 16u /* vertices of a list that is not read in order */

/* What merging takes of the sorted vertices; and where each bucket begins. */
KERNEL vcm_points(uint count, const rt_vcm_params vcm, global const ulong *items,
                  global const rt_light_vertex *list, global rt_merge_point *points,
                  global rt_merge_light *lights, global uint *begins)
{
    const uint i = item_number();
    if (i > count)
        return;
    const uint buckets = 1u << vcm.bucket_bits;
    const uint before = i > 0u ? (uint)(items[i - 1u] >> RT_INDEX_BITS) + 1u : 0u;
    const uint here = i < count ? (uint)(items[i] >> RT_INDEX_BITS) : buckets;
    for (uint bucket = before; bucket <= here; bucket++)
        begins[bucket] = i;
    if (i == count)
        return;
    if (i + RT_PREFETCH_AHEAD < count)
        PREFETCH(list + ((uint)items[i + RT_PREFETCH_AHEAD] & RT_INDEX_MASK));
    const uint index = (uint)items[i] & RT_INDEX_MASK;
    vstore3(row3(list[index].position), 0, points[i].position);
    points[i].depth = stored_depth(list + index);
    const struct partial_weights partial = stored_weights(list + index);
    float3 wo;
    vstore3(stored_normal(list + index, &wo), 0, lights[i].normal);
    vstore3(wo, 0, lights[i].wo);
    lights[i].dVCM = partial.dVCM;
    lights[i].dVC = partial.dVC;
    vstore3(unpack_flux(vload2(0, list[index].flux)), 0, lights[i].flux);
    lights[i].reserved = 0u;
}
