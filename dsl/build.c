/* build.c - hands the fields of checked blocks to the calls of the public interface. */
#include "dsl/build.h"

#include <string.h>

/* A boolean is false unless its field says otherwise. */
static void set_default(rt_block_fields *fields, const rt_field *field)
{
    static const int yes = 1;
    if (field->type == RT_FIELD_BOOLEAN && strcmp(field->fallback, "true") == 0)
        memcpy((unsigned char *)fields + field->offset, &yes, sizeof yes);
}

void rt_build_begin(rt_block_fields *fields, const rt_block *block, const rt_scene *scene)
{
    memset(fields, 0, sizeof *fields);
    if (block->id == RT_BLOCK_FILM || block->id == RT_BLOCK_RENDER)
        rt_scene_get_options(scene, &fields->options);
    for (size_t i = 0; i < block->field_count; i++)
        set_default(fields, &block->fields[i]);
}

/* What a render would refuse is wrong in the text already. */
static rt_status build_render(rt_scene *scene, const rt_render_options *options, rt_error *error)
{
    rt_status status = rt_render_options_check(options, error);
    return status == RT_OK ? rt_scene_set_options(scene, options, error) : status;
}

/* Its name is that of messages. */
static rt_status build_texture(rt_scene *scene, const rt_texture *texture, rt_build_name *name,
                               rt_error *error)
{
    rt_texture named = *texture;
    named.name = name->text;
    return rt_scene_add_texture(scene, &name->index, &named, error);
}

rt_status rt_build_block(rt_scene *scene, const rt_block *block, const rt_block_fields *fields,
                         rt_build_name *name, rt_error *error)
{
    switch (block->id) {
    case RT_BLOCK_CAMERA:
        return rt_scene_set_camera(scene, &fields->camera, error);
    case RT_BLOCK_FILM:
        return rt_scene_set_options(scene, &fields->options, error);
    case RT_BLOCK_RENDER:
        return build_render(scene, &fields->options, error);
    case RT_BLOCK_TEXTURE:
        return build_texture(scene, &fields->texture, name, error);
    case RT_BLOCK_GRID:
        return rt_scene_add_grid(scene, &name->index, &fields->grid, error);
    case RT_BLOCK_MATERIAL:
        return rt_scene_add_material(scene, &name->index, name->text, &fields->material, error);
    case RT_BLOCK_POINT_LIGHT:
        return rt_scene_add_point_light(scene, &fields->point_light, error);
    case RT_BLOCK_SPOT_LIGHT:
        return rt_scene_add_spot_light(scene, &fields->spot_light, error);
    case RT_BLOCK_PROJECTOR_LIGHT:
        return rt_scene_add_projector_light(scene, &fields->projector_light, error);
    case RT_BLOCK_GONIOMETRIC_LIGHT:
        return rt_scene_add_goniometric_light(scene, &fields->goniometric_light, error);
    case RT_BLOCK_BEAM_LIGHT:
        return rt_scene_add_beam_light(scene, &fields->beam_light, error);
    case RT_BLOCK_DIRECTIONAL_LIGHT:
        return rt_scene_add_directional_light(scene, &fields->directional_light, error);
    case RT_BLOCK_ENVIRONMENT_LIGHT:
        return rt_scene_set_environment(scene, &fields->environment, error);
    case RT_BLOCK_PORTAL:
        return rt_scene_add_portal(scene, &fields->portal, error);
    case RT_BLOCK_MEDIUM:
        return rt_scene_set_medium(scene, &fields->medium, error);
    case RT_BLOCK_MESH:
    case RT_BLOCK_INSTANCE:
    case RT_BLOCK_SHAPE:
    case RT_BLOCK_COUNT:
        break;
    }
    return block->build(scene, fields->shape, name, error);
}
