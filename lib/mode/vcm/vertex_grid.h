/*
 * vertex_grid.h - on the device, the light vertices of an iteration in one list, and the grid in
 * which those near a point are found.
 */
#ifndef RT_LIB_MODE_VCM_VERTEX_GRID_H
#define RT_LIB_MODE_VCM_VERTEX_GRID_H

#include "device/device.h"
#include "photon/prefix_sum.h"
#include "types.h"

/* All zero is none. */
typedef struct rt_vertex_grid {
    rt_device *device;
    cl_kernel pack, keys, points, count, move;
    rt_prefix_sum prefix;
    cl_mem list;         /* rt_light_vertex [room] */
    size_t room, filled; /* vertices */
    cl_mem firsts;       /* rt_u32 [paths], where in the list those of each path begin */
    cl_mem items, spare; /* rt_u64 [filled], being sorted */
    cl_mem places;       /* rt_u32, of digits */
    cl_mem order;        /* rt_merge_point [filled], in the order of buckets, */
    cl_mem lights;       /* rt_merge_light, likewise */
    cl_mem begins;       /* rt_u32 [buckets + 1] */
} rt_vertex_grid;

/* For so many paths. rt_vertex_grid_release undoes it. */
rt_status rt_vertex_grid_create(rt_vertex_grid *out, rt_device *device, size_t paths,
                                rt_error *error);
void rt_vertex_grid_release(rt_vertex_grid *grid);

/* The next vertices begin a list. */
void rt_vertex_grid_begin(rt_vertex_grid *grid);

/*
 * Adds the vertices of a batch of paths from the path `first` on: columns and counts as
 * vcm_light.cl has them. places: [paths], with room for rt_prefix_sum_run; it holds sums then.
 */
rt_status rt_vertex_grid_add(rt_vertex_grid *grid, cl_mem columns, cl_mem counts, cl_mem places,
                             rt_u32 slots, rt_u32 first, rt_u32 paths, rt_error *error);

/* Sorts them into cells for this radius; sets vcm->bucket_bits. */
rt_status rt_vertex_grid_sort(rt_vertex_grid *grid, cl_mem scene, rt_vcm_params *vcm,
                              rt_error *error);

#endif
