/* uneven_grid.c - a grid of densities. */
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

double grid_density(const rt_grid *grid, const double p[3])
{
    double sum = 0;
    for (int corner = 0; corner < 8; corner++) {
        size_t at[3];
        double weight = 1;
        for (int axis = 0; axis < 3; axis++) {
            const double base = floor(p[axis] - 0.5), part = p[axis] - 0.5 - base;
            const int upper = corner >> axis & 1;
            const double last = grid->size[axis] - 1.0;
            at[axis] = (size_t)fmin(fmax(base + upper, 0), last);
            weight *= upper ? part : 1 - part;
        }
        sum += weight * grid->values[(at[2] * grid->size[1] + at[1]) * grid->size[0] + at[0]];
    }
    return sum;
}
