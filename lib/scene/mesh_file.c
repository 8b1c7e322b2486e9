/* mesh_file.c - adding meshes from files to a scene. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "mesh/load.h"
#include "mesh/normals.h"
#include "scene/check.h"
#include "scene/scene.h"

/* The texture that the file names, looked up beside it. */
static rt_status add_texture(rt_scene *scene, uint32_t *out, const char *path, const char *name,
                             rt_error *error)
{
    const char *slash = strrchr(path, '/');
    size_t directory = slash && name[0] != '/' ? (size_t)(slash - path) + 1 : 0;
    char *beside = malloc(directory + strlen(name) + 1);
    if (!beside)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for the name of a texture");
    memcpy(beside, path, directory);
    strcpy(beside + directory, name);
    rt_texture texture = {.path = beside};
    rt_status status =
        rt_path_is_within(scene->root, beside)
            ? rt_scene_add_texture(scene, out, &texture, error)
            : rt_fail(error, RT_ERROR_INPUT,
                      "%.200s: its texture lies outside of the scene's folder", path);
    free(beside);
    return status;
}

/* Moves the arrays of a mesh that was read to the scene's. */
static rt_status take_loaded(rt_scene *scene, uint32_t *out, rt_mesh *mesh, const char *path,
                             rt_error *error)
{
    rt_scene_mesh made;
    memset(&made, 0, sizeof made);
    made.vertex_count = mesh->vertex_count;
    made.triangle_count = mesh->triangle_count;
    made.positions = mesh->positions;
    made.normals = mesh->normals;
    made.uv = mesh->uv;
    made.colours = mesh->colours;
    made.indices = mesh->indices;
    rt_scene_mesh_measure(&made);
    if (!(made.area > 0))
        return rt_fail(error, RT_ERROR_INPUT, "%.400s holds no triangle with an area", path);
    for (int i = 0; i < 3; i++)
        if (!(made.lo[i] >= -RT_COORDINATE_MAX && made.hi[i] <= RT_COORDINATE_MAX))
            return rt_fail(error, RT_ERROR_INPUT, "%.400s reaches beyond coordinates of %g", path,
                           RT_COORDINATE_MAX);
    rt_status status = rt_scene_take_mesh(scene, out, &made, error);
    if (status == RT_OK) {
        mesh->positions = mesh->normals = mesh->uv = mesh->colours = NULL;
        mesh->indices = NULL;
    }
    return status;
}

/* Gives the mesh the normals that the caller asks for. */
static rt_status shade(rt_mesh *mesh, rt_shading shading, rt_error *error)
{
    switch (shading) {
    case RT_SHADING_FILE:
        return RT_OK;
    case RT_SHADING_FLAT:
        rt_memory_free(mesh->normals);
        mesh->normals = NULL;
        return RT_OK;
    case RT_SHADING_SMOOTH:
        return rt_mesh_smooth(mesh, error);
    }
    return RT_OK;
}

static void tell(rt_mesh_info *info, const rt_scene_mesh *mesh, const rt_mesh *read,
                 uint32_t texture)
{
    memset(info, 0, sizeof *info);
    info->vertex_count = mesh->vertex_count;
    info->triangle_count = mesh->triangle_count;
    info->degenerate = (size_t)read->zero_area;
    info->texture = texture;
    info->names_materials = read->names_materials;
    info->goes_on = read->goes_on;
    info->warnings = read->warnings;
    memcpy(info->lo, mesh->lo, sizeof info->lo);
    memcpy(info->hi, mesh->hi, sizeof info->hi);
}

rt_status rt_scene_load_mesh(rt_scene *scene, uint32_t *out, const char *path, rt_shading shading,
                             rt_mesh_info *info, rt_error *error)
{
    if (rt_is_missing(path, "path", error))
        return RT_ERROR_USAGE;
    rt_mesh *mesh = NULL;
    uint32_t texture = 0;

    if ((unsigned)shading > RT_SHADING_SMOOTH)
        return rt_fail_field(error, RT_ERROR_INPUT, "shading", "mesh: there is no shading %d",
                             (int)shading);
    rt_status status = rt_mesh_load_in(&mesh, path, scene->memory, NULL, error);
    if (status != RT_OK)
        goto out;
    status = shade(mesh, shading, error);
    if (status != RT_OK)
        goto out;
    if (mesh->texture) {
        status = add_texture(scene, &texture, path, mesh->texture, error);
        if (status != RT_OK)
            goto out;
    }
    status = take_loaded(scene, out, mesh, path, error);
    if (status == RT_OK && info)
        tell(info, scene->meshes + *out, mesh, texture);
out:
    if (status != RT_OK && error && !error->field[0])
        snprintf(error->field, sizeof error->field, "path");
    rt_mesh_destroy(mesh);
    return rt_at_file(status, path, error);
}
