/* frustum.c - what cylinder and cone share. */
#include "shape/frustum.h"

#include <math.h>

#include "shape/area_scale.h"

static const double pi = 3.14159265358979323846;

enum { side_steps_max = 1 << 18 };

void rt_frustum_extent(double top, const double row[4], double *lo, double *hi)
{
    double across = hypot(row[0], row[1]), at_top = top * across;
    *lo = row[3] + fmin(-across, row[2] - at_top);
    *hi = row[3] + fmax(across, row[2] + at_top);
}

/* The side has radius r = 1 - (1 - p) z and the element (cos phi, sin phi, 1 - p) r dphi dz. */
double rt_frustum_area(const rt_scene_shape *shape, const rt_affine *to_world, double top)
{
    double c[3][3], p = top;
    rt_affine_cofactors(c, to_world);
    double side = 0.5 * (1 + p) * rt_area_scale_turn(c, 1, 1 - p, side_steps_max);
    return side + (shape->caps ? pi * (1 + p * p) * rt_area_scale(c, 0, 0, 1) : 0);
}

/* One that comes to a point needs no cap there, but one at its base. */
int rt_frustum_contains(const rt_scene *scene, const rt_scene_shape *shape, double top,
                        const double p[3])
{
    double q[3];
    return shape->caps && rt_shape_to_object(q, scene, shape, p) && q[2] > 0 && q[2] < 1 &&
           hypot(q[0], q[1]) < 1 + (top - 1) * q[2];
}

rt_shape_boundary rt_frustum_boundary(const rt_scene *scene, const rt_scene_shape *shape)
{
    (void)scene;
    return shape->caps ? RT_BOUNDARY_CURVED_CLOSED : RT_BOUNDARY_CURVED;
}

rt_status rt_frustum_add(rt_scene *scene, uint32_t *out, rt_new_shape *added, const float a[3],
                         const float b[3], float radius, const char *const names[3],
                         rt_error *error)
{
    const char *who = names[0];
    double n[3];
    rt_status status;
    if ((status = rt_check_point(a, who, names[1], error)) != RT_OK ||
        (status = rt_check_point(b, who, names[2], error)) != RT_OK ||
        (status = rt_check_length(radius, who, "radius", error)) != RT_OK)
        return status;
    rt_vec_sub(n, b, a);
    double height = rt_vec_length(n);
    if (!(height > 0))
        return rt_fail_field(error, RT_ERROR_INPUT, names[2], "%s: %s and %s are the same point",
                             who, names[1], names[2]);
    for (int i = 0; i < 3; i++)
        n[i] /= height;
    rt_affine placement = rt_placement_about(a, n, radius, height);
    return rt_shape_add_placed(scene, out, added, &placement, who, error);
}
