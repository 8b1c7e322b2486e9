/* grid.c - adding grids of densities and albedos to a scene. */
#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "scene/check.h"
#include "scene/grid_file.h"
#include "scene/scene.h"
#include "scene/vdb.h"

/* The name of the member of rt_grid that is the cause of a failure to read its file. */
static rt_status at_path(rt_status status, rt_error *error)
{
    if (status != RT_OK && error)
        snprintf(error->field, sizeof error->field, "path");
    return status;
}

/* Takes the numbers of a file of OpenVDB, and where its voxels are. */
static rt_status take_vdb(rt_scene *scene, rt_scene_grid *grid, rt_affine *voxels,
                          const rt_grid *from, rt_error *error)
{
    rt_vdb read;
    if (!rt_is_black(from->lo) || !rt_is_black(from->hi))
        return rt_fail_field(error, RT_ERROR_INPUT, "lo",
                             "grid: %.300s has a place of its own: move it by a transform",
                             from->path);
    rt_status status =
        rt_vdb_read(&read, from->path, from->layer, scene->vdb_module, scene->memory, error);
    if (status != RT_OK)
        return at_path(status, error);
    grid->values = read.values;
    grid->outside = read.background;
    memcpy(grid->size, read.size, sizeof grid->size);
    *voxels = read.to_world;
    return RT_OK;
}

/* Copies the caller's array. */
static rt_status copy_values(rt_scene *scene, rt_scene_grid *grid, const rt_grid *from,
                             rt_error *error)
{
    size_t count;
    if (!from->values)
        return rt_fail_field(error, RT_ERROR_INPUT, "path", "grid: it needs a file, or values");
    if (from->channels > 1 && from->channels != 3)
        return rt_fail_field(error, RT_ERROR_INPUT, "channels", "grid: %u channels; it has 1, or 3",
                             from->channels);
    memcpy(grid->size, from->size, sizeof from->size);
    grid->size[3] = from->channels ? from->channels : 1;
    rt_status status = rt_grid_count(&count, grid->size, error);
    if (status == RT_OK)
        status = rt_grid_check(from->values, grid->size, error);
    if (status != RT_OK)
        return status;
    grid->values = rt_memory_alloc(scene->memory, count, sizeof *grid->values, "a grid", error);
    if (!grid->values)
        return RT_ERROR_MEMORY;
    memcpy(grid->values, from->values, count * sizeof *grid->values);
    return RT_OK;
}

/* The map from voxels to the box. */
static rt_status place_voxels(rt_affine *voxels, const rt_grid *from, const rt_u32 size[3],
                              rt_error *error)
{
    static const float unit[3] = {1, 1, 1};
    const float *hi = rt_is_black(from->lo) && rt_is_black(from->hi) ? unit : from->hi;
    rt_status status = rt_check_point(from->lo, "grid", "lo", error);
    if (status == RT_OK)
        status = rt_check_point(hi, "grid", "hi", error);
    if (status != RT_OK)
        return status;
    memset(voxels, 0, sizeof *voxels);
    for (int i = 0; i < 3; i++) {
        const double side = (double)hi[i] - from->lo[i];
        if (!(side >= RT_LENGTH_MIN))
            return rt_fail_field(error, RT_ERROR_INPUT, "hi",
                                 "grid: hi has the coordinate %g; it must be greater than %g, that "
                                 "of lo",
                                 hi[i], from->lo[i]);
        voxels->m[i][i] = side / size[i];
        voxels->m[i][3] = from->lo[i];
    }
    return RT_OK;
}

/* Takes the numbers from the file or the caller's array, and where the voxels are. */
static rt_status take_values(rt_scene *scene, rt_scene_grid *grid, rt_affine *voxels,
                             const rt_grid *from, rt_error *error)
{
    if (from->path && rt_vdb_is_named(from->path))
        return take_vdb(scene, grid, voxels, from, error);
    if (from->layer)
        return rt_fail_field(error, RT_ERROR_INPUT, "layer",
                             "grid: only files of OpenVDB have grids of names");
    rt_status status =
        from->path
            ? at_path(rt_grid_read(&grid->values, grid->size, from->path, scene->memory, error),
                      error)
            : copy_values(scene, grid, from, error);
    return status == RT_OK ? place_voxels(voxels, from, grid->size, error) : status;
}

/* Sets the map from the world to voxels, and the diagonal of the box. */
static rt_status place(rt_scene_grid *grid, const rt_grid *from, const rt_affine *voxels,
                       rt_error *error)
{
    const rt_surface placed = {.transform = from->transform};
    double diagonal[3];
    rt_affine to_world;
    rt_status status = rt_surface_transform(&to_world, &placed, "grid", error);
    if (status != RT_OK)
        return status;
    to_world = rt_affine_product(&to_world, voxels);
    rt_affine_vector(diagonal, &to_world, (double[3]){grid->size[0], grid->size[1], grid->size[2]});
    if (!rt_affine_inverse(&grid->to_voxels, &to_world))
        return rt_fail_field(error, RT_ERROR_INPUT, "transform",
                             "grid: the transform cannot be inverted: it flattens the box");
    grid->diagonal = rt_vec_length(diagonal);
    return RT_OK;
}

size_t rt_scene_grid_numbers(const rt_scene_grid *grid)
{
    return (size_t)grid->size[0] * grid->size[1] * grid->size[2] * grid->size[3];
}

rt_status rt_scene_add_grid(rt_scene *scene, uint32_t *out, const rt_grid *grid, rt_error *error)
{
    rt_scene_grid made;
    rt_affine voxels;
    memset(&made, 0, sizeof made);
    if ((unsigned)grid->wrap > RT_GRID_REPEAT)
        return rt_fail_field(error, RT_ERROR_INPUT, "wrap", "grid: there is no wrap %d",
                             (int)grid->wrap);
    made.repeats = grid->wrap == RT_GRID_REPEAT;
    rt_status status = rt_grow(scene->memory, (void **)&scene->grids, &scene->grid_room,
                               scene->grid_count, sizeof made, "the list of grids", error);
    if (status == RT_OK)
        status = take_values(scene, &made, &voxels, grid, error);
    if (status == RT_OK)
        status = place(&made, grid, &voxels, error);
    if (status != RT_OK) {
        rt_memory_free(made.values);
        return status;
    }
    const size_t count = rt_scene_grid_numbers(&made);
    for (size_t i = 0; i < count; i++)
        made.largest = made.values[i] > made.largest ? made.values[i] : made.largest;
    scene->grids[scene->grid_count++] = made;
    if (out)
        *out = (uint32_t)scene->grid_count;
    return RT_OK;
}

/* Collisions that tracking a ray through a medium may take; far thicker ones let no light pass. */
static const double thickness_max = 1e5;

/* Whether a grid of this handle, which may be 0, was added. */
static rt_status check_handle(const rt_scene *scene, uint32_t handle, const char *who,
                              const char *field, rt_error *error)
{
    if (handle > scene->grid_count)
        return rt_fail_field(error, RT_ERROR_INPUT, field, "%s: there is no grid %u among %zu", who,
                             handle, scene->grid_count);
    return RT_OK;
}

rt_status rt_grid_check_albedo(const rt_scene *scene, uint32_t handle, const char *who,
                               rt_error *error)
{
    rt_status status = check_handle(scene, handle, who, "albedo", error);
    if (status == RT_OK && handle != 0 && scene->grids[handle - 1].largest > 1)
        return rt_fail_field(error, RT_ERROR_INPUT, "albedo",
                             "%s: its albedo reaches %g; it must lie from 0 to 1", who,
                             scene->grids[handle - 1].largest);
    return status;
}

rt_status rt_grid_check_medium(const rt_scene *scene, uint32_t handle, const float absorption[3],
                               const float scattering[3], const char *who, rt_error *error)
{
    double extinction = 0;
    rt_status status = check_handle(scene, handle, who, "density", error);
    if (status != RT_OK || handle == 0)
        return status;
    const rt_scene_grid *grid = scene->grids + handle - 1;
    if (grid->repeats)
        return rt_fail_field(error, RT_ERROR_INPUT, "density",
                             "%s: a density ends with the box of its grid: only an albedo has "
                             "'wrap repeat'",
                             who);
    if (grid->outside > 0)
        return rt_fail_field(error, RT_ERROR_INPUT, "density",
                             "%s: its density is %g outside of the voxels of its file, without an "
                             "end",
                             who, grid->outside);
    for (int c = 0; c < 3; c++)
        extinction = fmax(extinction, (double)absorption[c] + scattering[c]);
    const double thickness = extinction * grid->largest * grid->diagonal;
    if (!(thickness <= thickness_max))
        return rt_fail_field(error, RT_ERROR_INPUT, "density",
                             "%s: density %g, coefficient %g per metre and diagonal %g m make an "
                             "optical thickness of %g; it must not exceed %g",
                             who, grid->largest, extinction, grid->diagonal, thickness,
                             thickness_max);
    return RT_OK;
}
