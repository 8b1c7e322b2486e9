/* mesh_file.c - adding meshes from files to a scene. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "mesh/load.h"
#include "mesh/normals.h"
#include "mesh/source.h"
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

/* All that its triangles have, 0 for the others that it names; textures is to be freed. */
static rt_status add_textures(rt_scene *scene, uint32_t **textures, const rt_mesh *mesh,
                              const char *path, rt_error *error)
{
    const char *name = mesh->textures;
    /* without numbers all triangles have the first */
    const uint32_t count = mesh->texture_of ? mesh->texture_count : mesh->texture_count > 0;
    rt_status status = RT_OK;
    *textures = calloc((size_t)count + 1, sizeof **textures);
    if (!*textures)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for textures");
    (*textures)[0] = mesh->texture_of ? 0 : count;
    for (uint32_t i = 0; mesh->texture_of && i < mesh->triangle_count; i++)
        if (mesh->texture_of[i] != RT_MESH_BARE)
            (*textures)[mesh->texture_of[i]] = 1;
    for (uint32_t i = 0; i < count && status == RT_OK; i++, name += strlen(name) + 1)
        if ((*textures)[i])
            status = add_texture(scene, *textures + i, path, name, error);
    return status;
}

/* Moves the arrays of a mesh that was read to the scene's, or takes it apart by texture. */
static rt_status take_loaded(rt_scene *scene, uint32_t *out, rt_mesh *mesh,
                             const uint32_t *textures, const char *path, rt_error *error)
{
    rt_scene_mesh made;
    memset(&made, 0, sizeof made);
    made.next = RT_NONE;
    made.texture = textures[0];
    made.vertex_count = mesh->vertex_count;
    made.triangle_count = mesh->triangle_count;
    made.positions = mesh->positions;
    memcpy(made.origin, mesh->origin, sizeof made.origin);
    made.normals = mesh->normals;
    made.uv = mesh->uv;
    made.has_bare_corners = mesh->has_bare_corners;
    made.colours = mesh->colours;
    made.of_vertices = mesh->of_vertices;
    made.of_triangles = mesh->of_triangles;
    made.indices = mesh->indices;
    rt_scene_mesh_measure(&made);
    if (!(made.area > 0))
        return rt_fail(error, RT_ERROR_INPUT, "%.400s holds no triangle with an area", path);
    for (int i = 0; i < 3; i++)
        if (!(made.origin[i] + made.lo[i] >= -RT_COORDINATE_MAX &&
              made.origin[i] + made.hi[i] <= RT_COORDINATE_MAX))
            return rt_fail(error, RT_ERROR_INPUT, "%.400s reaches beyond coordinates of %g", path,
                           RT_COORDINATE_MAX);
    if (mesh->texture_of)
        return rt_scene_add_parts(scene, out, &made, mesh->texture_of, textures,
                                  mesh->texture_count, error);
    rt_status status = rt_scene_take_mesh(scene, out, &made, error);
    if (status == RT_OK) {
        mesh->positions = mesh->normals = mesh->uv = mesh->colours = NULL;
        mesh->indices = NULL;
        memset(&mesh->of_vertices, 0, sizeof mesh->of_vertices);
        memset(&mesh->of_triangles, 0, sizeof mesh->of_triangles);
    }
    return status;
}

/* Gives the mesh the normals that the caller asks for. A bad one in the file matters with these. */
static rt_status shade(rt_mesh *mesh, const char *path, rt_shading shading, rt_error *error)
{
    char message[128];
    switch (shading) {
    case RT_SHADING_FILE:
        snprintf(message, sizeof message,
                 "%llu normals are zero or not finite, and are made from the faces around",
                 (unsigned long long)mesh->bad_normals);
        if (mesh->bad_normals)
            rt_mesh_warnings_add(&mesh->warnings, path, 0, message);
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

static void tell(rt_mesh_info *info, const rt_scene *scene, uint32_t first, const rt_mesh *read)
{
    const rt_scene_mesh *mesh = scene->meshes + first;
    memset(info, 0, sizeof *info);
    info->degenerate = (size_t)read->zero_area;
    info->vertex_count = read->vertex_count;
    info->triangle_count = read->triangle_count;
    info->texture = mesh->texture;
    info->names_materials = read->names_materials;
    info->goes_on = read->goes_on;
    info->has_colours = mesh->colours != NULL;
    info->warnings = read->warnings;
    for (uint32_t part = first; part != RT_NONE; part = mesh->next) {
        mesh = scene->meshes + part;
        info->part_count++;
        for (int i = 0; i < 3; i++) {
            const float lo = (float)(mesh->origin[i] + mesh->lo[i]);
            const float hi = (float)(mesh->origin[i] + mesh->hi[i]);
            info->lo[i] = part == first || lo < info->lo[i] ? lo : info->lo[i];
            info->hi[i] = part == first || hi > info->hi[i] ? hi : info->hi[i];
        }
    }
}

rt_status rt_scene_load_mesh(rt_scene *scene, uint32_t *out, const char *path, rt_shading shading,
                             rt_mesh_info *info, rt_error *error)
{
    if (rt_is_missing(path, "path", error))
        return RT_ERROR_USAGE;
    rt_mesh *mesh = NULL;
    uint32_t *textures = NULL;

    if ((unsigned)shading > RT_SHADING_SMOOTH)
        return rt_fail_field(error, RT_ERROR_INPUT, "shading", "mesh: there is no shading %d",
                             (int)shading);
    rt_status status = rt_mesh_load_in(&mesh, path, scene->memory, NULL, error);
    if (status != RT_OK)
        goto out;
    status = shade(mesh, path, shading, error);
    if (status != RT_OK)
        goto out;
    status = add_textures(scene, &textures, mesh, path, error);
    if (status != RT_OK)
        goto out;
    status = take_loaded(scene, out, mesh, textures, path, error);
    if (status == RT_OK && info)
        tell(info, scene, *out, mesh);
out:
    if (status != RT_OK && error && !error->field[0])
        snprintf(error->field, sizeof error->field, "path");
    rt_mesh_destroy(mesh);
    free(textures);
    return rt_at_file(status, path, error);
}
