/* plane.c - the infinite plane, in world space: p[0..2] a point, p[4..6] the unit normal. */
#include "shape/placed.h"

#include <math.h>

static rt_shape_boundary boundary(const rt_scene *scene, const rt_scene_shape *shape)
{
    (void)scene, (void)shape;
    return RT_BOUNDARY_HALF_SPACE;
}

/* Its bounding sphere is infinite too. */
static double bounding_sphere(const rt_scene *scene, const rt_scene_shape *shape, double centre[3])
{
    (void)scene, (void)shape;
    centre[0] = centre[1] = centre[2] = 0;
    return INFINITY;
}

const rt_shape_class rt_shape_plane = {.name = "plane",
                                       .storage = RT_STORED_INFINITE,
                                       .faces = RT_FACES_FLAT,
                                       .boundary = boundary,
                                       .bounding_sphere = bounding_sphere};

rt_status rt_scene_add_plane(rt_scene *scene, uint32_t *out, const float point[3],
                             const float normal[3], const rt_surface *surface, rt_error *error)
{
    rt_new_shape added = {.shape.kind = RT_SHAPE_PLANE, .surface = surface, .area = INFINITY};
    rt_affine transform, placement, inverse;
    float *parameters = added.placement.p;
    double n[3], p[3], m[3];
    rt_status status;

    if ((status = rt_check_point(point, "plane", "point", error)) != RT_OK ||
        (status = rt_check_direction(n, normal, "plane", "normal", error)) != RT_OK ||
        (status = rt_surface_transform(&transform, surface, "plane", error)) != RT_OK)
        return status;
    added.shape.has_transform = !rt_affine_is_identity(&transform);
    placement = rt_placement_about(point, n, 1, 1);
    added.placement.to_world = rt_affine_product(&transform, &placement);
    rt_affine_inverse(&inverse, &transform);
    rt_affine_normal(m, &inverse, n);
    rt_affine_point(p, &transform, (const double[3]){point[0], point[1], point[2]});
    double length = rt_vec_length(m);
    for (int i = 0; i < 3; i++) {
        parameters[i] = (float)p[i];
        parameters[4 + i] = (float)(m[i] / length);
        if (!(fabsf(parameters[i]) <= RT_COORDINATE_MAX))
            return rt_fail_field(error, RT_ERROR_INPUT, "transform",
                                 "plane: its point lies beyond coordinates of %g",
                                 RT_COORDINATE_MAX);
    }
    return rt_scene_add_shape(scene, out, &added, "plane", error);
}
