/* torus.c - the torus: in object space about z, of major radius 1 and minor radius p[0] < 1. */
#include "shape/placed.h"
#include "shape/area_scale.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

enum { tube_steps_min = 32, tube_steps_max = 512 };

static void extent(const rt_scene_shape *shape, const double row[4], double *lo, double *hi)
{
    double across = hypot(row[0], row[1]), reach = across + shape->p[0] * hypot(across, row[2]);
    *lo = row[3] - reach;
    *hi = row[3] + reach;
}

static int contains(const rt_scene *scene, const rt_scene_shape *shape, const double p[3])
{
    double q[3];
    return rt_shape_to_object(q, scene, shape, p) &&
           hypot(hypot(q[0], q[1]) - 1, q[2]) < shape->p[0];
}

/*
 * The element is (cos phi cos theta, sin phi cos theta, sin theta) (1 + m cos theta) m dphi dtheta.
 */
static double area(const rt_scene_shape *shape, const rt_affine *to_world)
{
    double c[3][3], sum = 0, before, m = shape->p[0], offset = 0;
    int steps = tube_steps_min, total = 0;
    rt_affine_cofactors(c, to_world);
    do {
        before = total ? sum / total : 0;
        for (int i = 0; i < steps; i++) {
            double theta = 2 * pi * (i + offset) / steps;
            sum += m * (1 + m * cos(theta)) *
                   rt_area_scale_turn(c, cos(theta), sin(theta), 4 * tube_steps_max);
        }
        steps = total ? 2 * steps : steps;
        total += total ? steps / 2 : steps;
        offset = 0.5;
    } while (total < tube_steps_max &&
             fabs(sum / total - before) > RT_AREA_CONVERGED * sum / total);
    return 2 * pi * sum / total;
}

const rt_shape_class rt_shape_torus = {.name = "torus",
                                       .storage = RT_STORED_ANALYTIC,
                                       .faces = RT_FACES_TORUS,
                                       .boundary = rt_boundary_solid,
                                       .contains = contains,
                                       .extent = extent,
                                       .area = area};

rt_status rt_scene_add_torus(rt_scene *scene, uint32_t *out, const float centre[3],
                             const float axis[3], float major_radius, float minor_radius,
                             const rt_surface *surface, rt_error *error)
{
    rt_new_shape added = {.shape.kind = RT_SHAPE_TORUS, .surface = surface};
    double n[3];
    rt_status status;

    if ((status = rt_check_point(centre, "torus", "centre", error)) != RT_OK ||
        (status = rt_check_direction(n, axis, "torus", "axis", error)) != RT_OK ||
        (status = rt_check_length(major_radius, "torus", "major_radius", error)) != RT_OK ||
        (status = rt_check_length(minor_radius, "torus", "minor_radius", error)) != RT_OK)
        return status;
    if (!(minor_radius < major_radius))
        return rt_fail_field(error, RT_ERROR_INPUT, "minor_radius",
                             "torus: minor_radius is %g m; it must be less than major_radius, %g",
                             minor_radius, major_radius);
    added.shape.p[0] = minor_radius / major_radius;
    rt_affine placement = rt_placement_about(centre, n, major_radius, major_radius);
    return rt_shape_add_placed(scene, out, &added, &placement, "torus", error);
}
