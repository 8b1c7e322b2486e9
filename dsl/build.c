#include "dsl/build.h"

#include <string.h>

void rt_build_begin(rt_block_fields *fields, const rt_block *block, const rt_scene *scene)
{
    memset(fields, 0, sizeof *fields);
    if (block->id == RT_BLOCK_FILM || block->id == RT_BLOCK_RENDER)
        rt_scene_get_options(scene, &fields->options);
}

static int is_zero(const float v[3])
{
    return v[0] == 0 && v[1] == 0 && v[2] == 0;
}

static rt_status build_triangle(rt_scene *scene, const rt_triangle_fields *triangle, rt_error *error)
{
    static const uint32_t indices[3] = {0, 1, 2};
    const float *normals = is_zero(triangle->normals[0]) ? NULL : triangle->normals[0];
    return rt_scene_add_triangles(scene, NULL, triangle->corners[0], 3, indices, 1, normals, &triangle->surface,
                                  error);
}

rt_status rt_build_block(rt_scene *scene, const rt_block *block, const rt_block_fields *fields, const char *name,
                         uint32_t *material, rt_error *error)
{
    const rt_plane_fields *plane = &fields->plane;
    const rt_sphere_fields *sphere = &fields->sphere;
    const rt_quad_fields *quad = &fields->quad;
    switch (block->id) {
    case RT_BLOCK_CAMERA:
        return rt_scene_set_camera(scene, &fields->camera, error);
    case RT_BLOCK_FILM:
    case RT_BLOCK_RENDER:
        return rt_scene_set_options(scene, &fields->options, error);
    case RT_BLOCK_MATERIAL:
        return rt_scene_add_material(scene, material, name, &fields->material, error);
    case RT_BLOCK_POINT_LIGHT:
        return rt_scene_add_point_light(scene, &fields->point_light, error);
    case RT_BLOCK_PLANE:
        return rt_scene_add_plane(scene, NULL, plane->point, plane->normal, &plane->surface, error);
    case RT_BLOCK_SPHERE:
        return rt_scene_add_sphere(scene, NULL, sphere->centre, sphere->radius, &sphere->surface, error);
    case RT_BLOCK_TRIANGLE:
        return build_triangle(scene, &fields->triangle, error);
    case RT_BLOCK_QUAD:
        return rt_scene_add_quad(scene, NULL, quad->corner, quad->edge1, quad->edge2, &quad->surface, error);
    case RT_BLOCK_COUNT:
        break;
    }
    return RT_OK;
}
