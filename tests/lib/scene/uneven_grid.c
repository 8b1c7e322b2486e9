/* uneven_grid.c - a grid of densities, and what a grid means. */
#include "lib/scene/uneven_grid.h"

#include <math.h>

void uneven_fill(float values[voxels])
{
    for (int i = 0; i < voxels; i++) {
        const double wave = sin(0.9 * (i % nx)) + cos(1.3 * (i / nx % ny)) + sin(2.1 * i / nx / ny);
        const int x = i % nx, y = i / nx % ny;
        values[i] = wave < 0 ? 0 : (float)wave * (x < 9 ? 0.1f : 2.5f) * (y > 2 ? 1 : 0.2f);
    }
    values[(8 * ny + 3) * nx + 8] = 6;
}

/* The voxel of an index that may lie outside of the box. */
static size_t voxel_of(const rt_grid *grid, double index, int axis)
{
    const double size = grid->size[axis];
    return (size_t)(grid->wrap == RT_GRID_REPEAT ? index - floor(index / size) * size
                                                 : fmin(fmax(index, 0), size - 1));
}

double grid_number(const rt_grid *grid, const double p[3], uint32_t channel)
{
    const uint32_t channels = grid->channels ? grid->channels : 1;
    double sum = 0;
    for (int corner = 0; corner < 8; corner++) {
        size_t at[3];
        double weight = 1;
        for (int axis = 0; axis < 3; axis++) {
            const double base = floor(p[axis] - 0.5), part = p[axis] - 0.5 - base;
            const int upper = corner >> axis & 1;
            at[axis] = voxel_of(grid, base + upper, axis);
            weight *= upper ? part : 1 - part;
        }
        const size_t voxel = (at[2] * grid->size[1] + at[1]) * grid->size[0] + at[0];
        sum += weight * grid->values[voxel * channels + channel % channels];
    }
    return sum;
}

double grid_density(const rt_grid *grid, const double p[3])
{
    return grid_number(grid, p, 0);
}
