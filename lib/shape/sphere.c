/* sphere.c - the sphere, in world space: p[0..2] centre, p[3] radius. */
#include "shape/unit_sphere.h"

#include <string.h>

static int contains(const rt_scene *scene, const rt_scene_shape *shape, const double p[3])
{
    (void)scene;
    const double to[3] = {p[0] - shape->p[0], p[1] - shape->p[1], p[2] - shape->p[2]};
    return rt_vec_length(to) < shape->p[3];
}

static double bounding_sphere(const rt_scene *scene, const rt_scene_shape *shape, double centre[3])
{
    (void)scene;
    for (int i = 0; i < 3; i++)
        centre[i] = 0.5 * ((double)shape->lo[i] + shape->hi[i]);
    return shape->p[3];
}

static void light(rt_light_data *out, const rt_scene *scene, const rt_scene_shape *shape,
                  size_t primitive)
{
    const rt_material *material = scene->materials + shape->material;
    (void)primitive;
    out->kind = RT_LIGHT_SPHERE;
    if ((material->interface || (out->flags & RT_LIGHT_CUTOUT)) && material->two_sided)
        out->flags |= RT_LIGHT_FAR_SIDE;
    memcpy(out->a, shape->p, sizeof out->a);
    out->width = shape->p[3];
}

const rt_shape_class rt_shape_sphere = {.name = "sphere",
                                        .storage = RT_STORED_ANALYTIC,
                                        .faces = RT_FACES_BALL,
                                        .boundary = rt_boundary_solid,
                                        .contains = contains,
                                        .extent = rt_unit_sphere_extent,
                                        .bounding_sphere = bounding_sphere,
                                        .light = light};

rt_status rt_scene_add_sphere(rt_scene *scene, uint32_t *out, const float centre[3], float radius,
                              const rt_surface *surface, rt_error *error)
{
    rt_status status = rt_check_point(centre, "sphere", "centre", error);
    if (status == RT_OK)
        status = rt_check_length(radius, "sphere", "radius", error);
    if (status != RT_OK)
        return status;
    rt_affine placement = rt_placement_scaled(centre, radius, radius, radius);
    return rt_shape_add_unit_sphere(scene, out, &placement, surface, "sphere", error);
}
