/* placed.c - checks, placements and bounds of shapes, and adding a placed shape. */
#include "shape/placed.h"

#include <float.h>
#include <math.h>

rt_status rt_check_length(float radius, const char *who, const char *field, rt_error *error)
{
    if (!(radius >= RT_LENGTH_MIN && radius <= RT_COORDINATE_MAX))
        return rt_fail_field(error, RT_ERROR_INPUT, field,
                             "%s: %s is %g m; it must lie between %g and %g", who, field, radius,
                             RT_LENGTH_MIN, RT_COORDINATE_MAX);
    return RT_OK;
}

rt_status rt_check_direction(double out[3], const float v[3], const char *who, const char *field,
                             rt_error *error)
{
    static const float zero[3];
    rt_status status = rt_check_point(v, who, field, error);
    if (status != RT_OK)
        return status;
    rt_vec_sub(out, v, zero);
    double length = rt_vec_length(out);
    if (!(length > 0))
        return rt_fail_field(error, RT_ERROR_INPUT, field, "%s: %s is zero", who, field);
    for (int i = 0; i < 3; i++)
        out[i] /= length;
    return RT_OK;
}

rt_affine rt_placement_about(const float centre[3], const double n[3], double radius, double height)
{
    double x[3], y[3], z[3], origin[3];
    rt_frame_about(n, x, y);
    for (int i = 0; i < 3; i++) {
        x[i] *= radius;
        y[i] *= radius;
        z[i] = height * n[i];
        origin[i] = centre[i];
    }
    return rt_affine_frame(x, y, z, origin);
}

rt_affine rt_placement_scaled(const float centre[3], double x, double y, double z)
{
    rt_affine a = {{{x, 0, 0, centre[0]}, {0, y, 0, centre[1]}, {0, 0, z, centre[2]}}};
    return a;
}

void rt_shape_set_bounds(rt_scene_shape *shape, int axis, double lo, double hi)
{
    double room = 0x1p-21 * fmax(fabs(lo), fabs(hi));
    shape->lo[axis] = nextafterf((float)(lo - room), -FLT_MAX);
    shape->hi[axis] = nextafterf((float)(hi + room), FLT_MAX);
}

rt_status rt_shape_add_placed(rt_scene *scene, uint32_t *out, rt_new_shape *added,
                              const rt_affine *placement, const char *who, rt_error *error)
{
    rt_scene_shape *shape = &added->shape;
    rt_affine *to_world = &added->placement.to_world;
    const rt_shape_class *class = rt_shape_class_of(shape->kind);
    rt_affine transform, inverse;
    rt_status status = rt_surface_transform(&transform, added->surface, who, error);
    if (status != RT_OK)
        return status;
    *to_world = rt_affine_product(&transform, placement);
    shape->has_transform = 1;
    added->area = class->area(shape, to_world);
    if (!rt_affine_inverse(&inverse, to_world))
        return rt_fail_field(error, RT_ERROR_INPUT, "transform", "%s: it is too small or too flat",
                             who);
    for (int i = 0; i < 3; i++) {
        double lo, hi;
        class->extent(shape, to_world->m[i], &lo, &hi);
        rt_shape_set_bounds(shape, i, lo, hi);
    }
    return rt_scene_add_shape(scene, out, added, who, error);
}

int rt_shape_to_object(double out[3], const rt_scene *scene, const rt_scene_shape *shape,
                       const double p[3])
{
    rt_affine to_object, to_world = rt_scene_to_world(scene, shape);
    if (!rt_affine_inverse(&to_object, &to_world))
        return 0;
    rt_affine_point(out, &to_object, p);
    return 1;
}
