/* build.c - hands the fields of checked blocks to the calls of the public interface. */
#include "dsl/build.h"

#include <string.h>

void rt_build_begin(rt_block_fields *fields, const rt_block *block, const rt_scene *scene)
{
    memset(fields, 0, sizeof *fields);
    if (block->id == RT_BLOCK_FILM || block->id == RT_BLOCK_RENDER)
        rt_scene_get_options(scene, &fields->options);
    if (block->id == RT_BLOCK_CYLINDER)
        fields->cylinder.caps = 1;
    if (block->id == RT_BLOCK_CONE)
        fields->cone.caps = 1;
}

static int is_zero(const float *v, int count)
{
    for (int i = 0; i < count; i++)
        if (v[i] != 0)
            return 0;
    return 1;
}

/* What a render would refuse is wrong in the text already. */
static rt_status build_render(rt_scene *scene, const rt_render_options *options, rt_error *error)
{
    rt_status status = rt_render_options_check(options, error);
    return status == RT_OK ? rt_scene_set_options(scene, options, error) : status;
}

static rt_status build_triangle(rt_scene *scene, const rt_triangle_fields *triangle,
                                rt_error *error)
{
    static const uint32_t indices[3] = {0, 1, 2};
    uint32_t mesh;
    rt_mesh_data data = {.positions = triangle->corners[0],
                         .indices = indices,
                         .vertex_count = 3,
                         .triangle_count = 1};
    data.normals = is_zero(triangle->normals[0], 3) ? NULL : triangle->normals[0];
    data.uv = is_zero(triangle->uv[0], 6) ? NULL : triangle->uv[0];
    rt_status status = rt_scene_add_mesh(scene, &mesh, &data, error);
    return status == RT_OK ? rt_scene_add_instance(scene, NULL, mesh, &triangle->surface, error)
                           : status;
}

/* Places a mesh; it has the texture of its file unless the block gives one. */
static rt_status build_instance(rt_scene *scene, const rt_mesh_fields *fields,
                                const rt_build_name *mesh, rt_error *error)
{
    rt_surface surface = fields->surface;
    if (surface.texture == 0)
        surface.texture = mesh->texture;
    return rt_scene_add_instance(scene, NULL, mesh->index, &surface, error);
}

static rt_status build_mesh(rt_scene *scene, const rt_mesh_fields *fields, rt_build_name *name,
                            rt_error *error)
{
    rt_mesh_info info;
    rt_status status = rt_scene_load_mesh(scene, &name->index, fields->path,
                                          (rt_shading)fields->shading, &info, error);
    if (status == RT_OK)
        name->texture = info.texture;
    return status;
}

static rt_status build_model(rt_scene *scene, const rt_mesh_fields *fields, rt_error *error)
{
    rt_build_name mesh = {"", 0, 0};
    rt_status status = build_mesh(scene, fields, &mesh, error);
    return status == RT_OK ? build_instance(scene, fields, &mesh, error) : status;
}

static rt_status build_shape(rt_scene *scene, const rt_block *block, const rt_block_fields *fields,
                             const rt_build_name *name, rt_error *error)
{
    const rt_plane_fields *plane = &fields->plane;
    const rt_sphere_fields *sphere = &fields->sphere;
    const rt_quad_fields *quad = &fields->quad;
    const rt_disc_fields *disc = &fields->disc;
    const rt_cylinder_fields *cylinder = &fields->cylinder;
    const rt_cone_fields *cone = &fields->cone;
    const rt_ellipsoid_fields *ellipsoid = &fields->ellipsoid;
    const rt_torus_fields *torus = &fields->torus;
    switch (block->id) {
    case RT_BLOCK_PLANE:
        return rt_scene_add_plane(scene, NULL, plane->point, plane->normal, &plane->surface, error);
    case RT_BLOCK_SPHERE:
        return rt_scene_add_sphere(scene, NULL, sphere->centre, sphere->radius, &sphere->surface,
                                   error);
    case RT_BLOCK_TRIANGLE:
        return build_triangle(scene, &fields->triangle, error);
    case RT_BLOCK_QUAD:
        return rt_scene_add_quad(scene, NULL, quad->corner, quad->edge1, quad->edge2,
                                 &quad->surface, error);
    case RT_BLOCK_DISC:
        return rt_scene_add_disc(scene, NULL, disc->centre, disc->normal, disc->radius,
                                 disc->inner_radius, &disc->surface, error);
    case RT_BLOCK_CYLINDER:
        return rt_scene_add_cylinder(scene, NULL, cylinder->a, cylinder->b, cylinder->radius,
                                     cylinder->caps, &cylinder->surface, error);
    case RT_BLOCK_CONE:
        return rt_scene_add_cone(scene, NULL, cone->base, cone->apex, cone->radius,
                                 cone->apex_radius, cone->caps, &cone->surface, error);
    case RT_BLOCK_ELLIPSOID:
        return rt_scene_add_ellipsoid(scene, NULL, ellipsoid->centre, ellipsoid->radii,
                                      &ellipsoid->surface, error);
    case RT_BLOCK_TORUS:
        return rt_scene_add_torus(scene, NULL, torus->centre, torus->axis, torus->major_radius,
                                  torus->minor_radius, &torus->surface, error);
    case RT_BLOCK_INSTANCE:
        return build_instance(scene, &fields->mesh, name, error);
    default:
        return build_model(scene, &fields->mesh, error);
    }
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
        return rt_scene_add_texture(scene, &name->index, &fields->texture, error);
    case RT_BLOCK_MATERIAL:
        return rt_scene_add_material(scene, &name->index, name->text, &fields->material, error);
    case RT_BLOCK_MESH:
        return build_mesh(scene, &fields->mesh, name, error);
    case RT_BLOCK_POINT_LIGHT:
        return rt_scene_add_point_light(scene, &fields->point_light, error);
    case RT_BLOCK_SPOT_LIGHT:
        return rt_scene_add_spot_light(scene, &fields->spot_light, error);
    case RT_BLOCK_DIRECTIONAL_LIGHT:
        return rt_scene_add_directional_light(scene, &fields->directional_light, error);
    case RT_BLOCK_ENVIRONMENT_LIGHT:
        return rt_scene_set_environment(scene, &fields->environment, error);
    default:
        return build_shape(scene, block, fields, name, error);
    }
}
