/* uneven_grid.h - a grid of densities that hides nothing, and what a grid means. */
#ifndef RT_TESTS_LIB_SCENE_UNEVEN_GRID_H
#define RT_TESTS_LIB_SCENE_UNEVEN_GRID_H

#include "rt.h"

enum { nx = 20, ny = 5, nz = 18, voxels = nx * ny * nz };

/* Uneven, with empty voxels, bricks that differ, and one voxel that stands out. */
void uneven_fill(float values[voxels]);

/* The density at a point in voxels, within the box. */
double grid_density(const rt_grid *grid, const double p[3]);

#endif
