/*
 * grid_file.h - files of grids of densities.
 *
 * A header of 20 bytes, "RTGRID1" and a line feed, then the numbers of voxels along x, y and z as
 * unsigned integers of 32 bits; then a float of 32 bits for each voxel, that of x fastest and that
 * of z slowest, and no more. All numbers are little-endian.
 */
#ifndef RT_LIB_SCENE_GRID_FILE_H
#define RT_LIB_SCENE_GRID_FILE_H

#include "base/bytes.h"
#include "types.h"

#define RT_GRID_HEADER 20u
#define RT_GRID_VOXELS_MAX ((uint64_t)1 << 30)

/* How many voxels a grid of this size has; fails where a side has none or all are too many. */
rt_status rt_grid_count(size_t *out, const rt_u32 size[3], rt_error *error);

/* Whether all densities are finite and not negative; the error names the first that is not. */
rt_status rt_grid_check(const float *values, const rt_u32 size[3], rt_error *error);

/* Reads the bytes of a file. *values counts in `memory`, is freed by rt_memory_free. */
rt_status rt_grid_decode(float **values, rt_u32 size[3], const rt_bytes *file, rt_memory *memory,
                         rt_error *error);

/* The same of a file, which errors name. */
rt_status rt_grid_read(float **values, rt_u32 size[3], const char *path, rt_memory *memory,
                       rt_error *error);

#endif
