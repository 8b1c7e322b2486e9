/*
 * disc.c - the disc, with or without a hole: in object space at z = 0 from radius p[0] to 1, normal
 * +z.
 */
#include "shape/placed.h"
#include "shape/area_scale.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

static void extent(const rt_scene_shape *shape, const double row[4], double *lo, double *hi)
{
    (void)shape;
    double reach = hypot(row[0], row[1]);
    *lo = row[3] - reach;
    *hi = row[3] + reach;
}

static double area(const rt_scene_shape *shape, const rt_affine *to_world)
{
    double c[3][3], hole = shape->p[0];
    rt_affine_cofactors(c, to_world);
    return pi * (1 - hole * hole) * rt_area_scale(c, 0, 0, 1);
}

const rt_shape_class rt_shape_disc = {.name = "disc",
                                      .storage = RT_STORED_ANALYTIC,
                                      .faces = RT_FACES_FLAT,
                                      .boundary = rt_boundary_flat,
                                      .extent = extent,
                                      .area = area};

rt_status rt_scene_add_disc(rt_scene *scene, uint32_t *out, const float centre[3],
                            const float normal[3], float radius, float inner_radius,
                            const rt_surface *surface, rt_error *error)
{
    rt_new_shape added = {.shape.kind = RT_SHAPE_DISC, .surface = surface};
    double n[3];
    rt_status status;

    if ((status = rt_check_point(centre, "disc", "centre", error)) != RT_OK ||
        (status = rt_check_direction(n, normal, "disc", "normal", error)) != RT_OK ||
        (status = rt_check_length(radius, "disc", "radius", error)) != RT_OK)
        return status;
    if (!(inner_radius >= 0 && inner_radius < radius))
        return rt_fail_field(
            error, RT_ERROR_INPUT, "inner_radius",
            "disc: inner_radius is %g m; it must be at least 0 and less than radius, %g",
            inner_radius, radius);
    added.shape.p[0] = inner_radius / radius;
    rt_affine placement = rt_placement_about(centre, n, radius, radius);
    return rt_shape_add_placed(scene, out, &added, &placement, "disc", error);
}
