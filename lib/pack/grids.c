/* grids.c - densities and albedos on grids, and the largest number of each brick of voxels. */
#include <math.h>
#include <string.h>

#include "pack/packing.h"
#include "scene/check.h"

static size_t rows_of(size_t count, size_t size)
{
    return (count * size + RT_SCENE_ROW - 1) / RT_SCENE_ROW;
}

static rt_u32 bricks_along(rt_u32 voxels)
{
    return (voxels + RT_GRID_BRICK - 1) / RT_GRID_BRICK;
}

static size_t value_rows(const rt_scene_grid *grid)
{
    return rows_of(rt_scene_grid_numbers(grid), sizeof(float));
}

static size_t majorant_rows(const rt_scene_grid *grid)
{
    return rows_of((size_t)bricks_along(grid->size[0]) * bricks_along(grid->size[1]) *
                       bricks_along(grid->size[2]),
                   sizeof(float));
}

void rt_grids_widen(const rt_scene *scene, float lo[3], float hi[3])
{
    const rt_medium *medium = &scene->medium;
    rt_affine to_world;
    if (!medium->density || (rt_is_black(medium->absorption) && rt_is_black(medium->scattering)))
        return;
    const rt_scene_grid *grid = scene->grids + medium->density - 1;
    int is_empty = memcmp(lo, hi, 3 * sizeof *lo) == 0;
    if (!rt_affine_inverse(&to_world, &grid->to_voxels))
        return;
    for (int corner = 0; corner < 8; corner++) {
        double voxels[3], world[3];
        for (int c = 0; c < 3; c++)
            voxels[c] = corner >> c & 1 ? grid->size[c] : 0;
        rt_affine_point(world, &to_world, voxels);
        for (int c = 0; c < 3; c++) {
            lo[c] = is_empty ? (float)world[c] : fminf(lo[c], (float)world[c]);
            hi[c] = is_empty ? (float)world[c] : fmaxf(hi[c], (float)world[c]);
        }
        is_empty = 0;
    }
}

size_t rt_grids_rows(const rt_scene *scene)
{
    size_t rows = rows_of(scene->grid_count, sizeof(rt_grid_data));
    for (size_t i = 0; i < scene->grid_count; i++)
        rows += value_rows(scene->grids + i) + majorant_rows(scene->grids + i);
    return rows;
}

/* The voxels along an axis whose values may be met in a brick: half a voxel around it, too. */
static void reach(rt_u32 *first, rt_u32 *end, rt_u32 brick, rt_u32 size)
{
    const rt_u32 begin = brick * RT_GRID_BRICK;
    *first = begin > 0 ? begin - 1 : 0;
    *end = begin + RT_GRID_BRICK + 1 < size ? begin + RT_GRID_BRICK + 1 : size;
}

/* The largest number in a brick. */
static float majorant(const rt_scene_grid *grid, rt_u32 bx, rt_u32 by, rt_u32 bz)
{
    const size_t width = grid->size[0], height = grid->size[1], channels = grid->size[3];
    rt_u32 x0, x1, y0, y1, z0, z1;
    float most = 0;
    reach(&x0, &x1, bx, grid->size[0]);
    reach(&y0, &y1, by, grid->size[1]);
    reach(&z0, &z1, bz, grid->size[2]);
    for (rt_u32 z = z0; z < z1; z++)
        for (rt_u32 y = y0; y < y1; y++)
            for (size_t i = x0 * channels; i < x1 * channels; i++) {
                const float value = grid->values[(z * height + y) * width * channels + i];
                most = value > most ? value : most;
            }
    return most;
}

static void fill_majorants(float *out, const rt_scene_grid *grid, const rt_u32 bricks[3])
{
    for (rt_u32 z = 0; z < bricks[2]; z++)
        for (rt_u32 y = 0; y < bricks[1]; y++)
            for (rt_u32 x = 0; x < bricks[0]; x++)
                *out++ = majorant(grid, x, y, z);
}

void rt_pack_grids(const rt_packing *p)
{
    rt_grid_data *out = rt_packing_table(p, p->header.grids);
    if (!p->header.grids)
        return;
    rt_u32 row = p->header.grids + (rt_u32)rows_of(p->scene->grid_count, sizeof *out);
    for (size_t i = 0; i < p->scene->grid_count; i++, out++) {
        const rt_scene_grid *grid = p->scene->grids + i;
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 4; c++)
                out->to_voxels[r][c] = (float)grid->to_voxels.m[r][c];
        for (int axis = 0; axis < 3; axis++) {
            out->size[axis] = grid->size[axis];
            out->bricks[axis] = bricks_along(grid->size[axis]);
        }
        out->channels = grid->size[3];
        out->repeats = (rt_u32)grid->repeats;
        out->values = row;
        row += (rt_u32)value_rows(grid);
        out->majorants = row;
        row += (rt_u32)majorant_rows(grid);
        memcpy(rt_packing_table(p, out->values), grid->values,
               rt_scene_grid_numbers(grid) * sizeof *grid->values);
        fill_majorants(rt_packing_table(p, out->majorants), grid, out->bricks);
    }
}
