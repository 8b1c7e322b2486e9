/*
 * grid_file.h - files of grids of densities and albedos.
 *
 * A header of 20 bytes, "RTGRID" with the number of channels, 1 or 3, and a line feed, then the
 * numbers of voxels along x, y and z as unsigned integers of 32 bits; then a float of 32 bits for
 * each channel of each voxel, that of x fastest and that of z slowest, and no more. All numbers are
 * little-endian. In what follows, size[3] is the number of channels.
 */
#ifndef RT_LIB_SCENE_GRID_FILE_H
#define RT_LIB_SCENE_GRID_FILE_H

#include "base/bytes.h"
#include "types.h"

#define RT_GRID_HEADER 20u
#define RT_GRID_VOXELS_MAX ((uint64_t)1 << 30)

/* How many numbers a grid of this size has; fails where a side has none or voxels are too many. */
rt_status rt_grid_count(size_t *out, const rt_u32 size[4], rt_error *error);

/* Whether all numbers are finite and not negative; the error names the first that is not. */
rt_status rt_grid_check(const float *values, const rt_u32 size[4], rt_error *error);

/* Reads the bytes of a file. *values counts in `memory`, is freed by rt_memory_free. */
rt_status rt_grid_decode(float **values, rt_u32 size[4], const rt_bytes *file, rt_memory *memory,
                         rt_error *error);

/* The same of a file, which errors name. */
rt_status rt_grid_read(float **values, rt_u32 size[4], const char *path, rt_memory *memory,
                       rt_error *error);

#endif
