/* uneven_grid.h - a grid that hides nothing, and what a grid means. */
#ifndef RT_TESTS_LIB_SCENE_UNEVEN_GRID_H
#define RT_TESTS_LIB_SCENE_UNEVEN_GRID_H

#include "rt.h"

enum { nx = 20, ny = 5, nz = 18, voxels = nx * ny * nz };

/* Uneven, with empty voxels, bricks that differ, and one voxel that stands out. */
void uneven_fill(float values[voxels]);

/* The number of a channel at a point in voxels; of the density, which has one, within the box. */
double grid_number(const rt_grid *grid, const double p[3], uint32_t channel);
double grid_density(const rt_grid *grid, const double p[3]);

#endif
