/* scene.c - creates and destroys a scene, and sets its options; the files beside add to it. */
#include "scene/scene.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "scene/check.h"
#include "setting/options.h"

rt_status rt_scene_create(rt_scene **out, rt_error *error)
{
    rt_scene *scene = calloc(1, sizeof *scene);
    if (!scene)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for a scene");
    scene->environment.light = RT_NONE;
    *out = scene;
    return RT_OK;
}

void rt_scene_set_memory(rt_scene *scene, rt_memory *memory)
{
    rt_memory_hold(memory);
    rt_memory_drop(scene->memory);
    scene->memory = memory;
    if (scene->texels.capacity == 0)
        scene->texels.memory = memory;
}

void rt_scene_set_vdb_module(rt_scene *scene, const char *path)
{
    scene->vdb_module = path;
}

void rt_scene_set_root(rt_scene *scene, const char *root)
{
    scene->root = root;
}

void rt_light_table_free(rt_scene_light_table *t)
{
    rt_memory_free(t->lines);
    rt_memory_free(t->values);
    t->lines = t->values = NULL;
}

void rt_scene_destroy(rt_scene *scene)
{
    if (!scene)
        return;
    for (size_t i = 0; i < scene->mesh_count; i++)
        rt_scene_mesh_free(scene->meshes + i);
    for (size_t i = 0; i < scene->texture_count; i++) {
        free(scene->textures[i].path);
        free(scene->textures[i].name);
    }
    for (size_t i = 0; i < scene->grid_count; i++)
        rt_memory_free(scene->grids[i].values);
    rt_bytes_free(&scene->texels);
    rt_memory_free(scene->environment.texels);
    for (size_t i = 0; i < scene->light_table_count; i++)
        rt_light_table_free(scene->light_tables + i);
    rt_memory_free(scene->light_tables);
    rt_memory_free(scene->textures);
    rt_memory_free(scene->texture_rows);
    rt_memory_free(scene->grids);
    rt_memory_free(scene->materials);
    rt_memory_free(scene->meshes);
    rt_memory_free(scene->shapes);
    rt_memory_free(scene->emissions);
    rt_memory_free(scene->placements);
    rt_memory_free(scene->lights);
    rt_memory_free(scene->portals);
    rt_memory_drop(scene->memory);
    free(scene);
}

rt_status rt_scene_set_options(rt_scene *scene, const rt_render_options *options, rt_error *error)
{
    static const rt_render_options defaults;
    if (!options)
        options = &defaults;
    rt_status status = rt_options_check(options, error);
    if (status != RT_OK)
        return status;
    scene->options = *options;
    scene->options.hooks = NULL;
    scene->options.photon_map = NULL;
    scene->options.light_shares = NULL;
    scene->options.light_share_count = 0;
    return RT_OK;
}

void rt_scene_get_options(const rt_scene *scene, rt_render_options *out)
{
    *out = scene->options;
}

void rt_scene_get_info(const rt_scene *scene, rt_scene_info *out)
{
    memset(out, 0, sizeof *out);
    out->shapes = scene->shape_count;
    out->materials = scene->material_count;
    out->lights = scene->light_count;
    out->has_camera = scene->has_camera;
    for (size_t i = 0; i < scene->shape_count; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        int is_mesh = shape->kind == RT_SHAPE_TRIANGLES;
        out->triangles += is_mesh ? scene->meshes[shape->mesh].triangle_count : 0;
        out->primitives += is_mesh ? scene->meshes[shape->mesh].triangle_count : 1;
    }
    out->lights += scene->emission_count;
    out->grids = scene->grid_count;
    out->scatters = !rt_is_black(scene->medium.scattering);
    for (size_t i = 0; i < scene->material_count; i++)
        out->scatters |= !rt_is_black(scene->materials[i].scattering);
}
