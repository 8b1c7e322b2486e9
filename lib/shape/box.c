/* box.c - the box: in object space the cube from -1 to 1. */
#include "shape/area_scale.h"
#include "shape/placed.h"

#include <math.h>

static void extent(const rt_scene_shape *shape, const double row[4], double *lo, double *hi)
{
    (void)shape;
    double reach = fabs(row[0]) + fabs(row[1]) + fabs(row[2]);
    *lo = row[3] - reach;
    *hi = row[3] + reach;
}

static double area(const rt_scene_shape *shape, const rt_affine *to_world)
{
    (void)shape;
    double c[3][3];
    rt_affine_cofactors(c, to_world);
    return 8 * (rt_area_scale(c, 1, 0, 0) + rt_area_scale(c, 0, 1, 0) + rt_area_scale(c, 0, 0, 1));
}

static int contains(const rt_scene *scene, const rt_scene_shape *shape, const double p[3])
{
    double q[3];
    return rt_shape_to_object(q, scene, shape, p) && fabs(q[0]) < 1 && fabs(q[1]) < 1 &&
           fabs(q[2]) < 1;
}

const rt_shape_class rt_shape_box = {.name = "box",
                                     .storage = RT_STORED_ANALYTIC,
                                     .faces = RT_FACES_FLAT,
                                     .boundary = rt_boundary_solid,
                                     .contains = contains,
                                     .extent = extent,
                                     .area = area};

rt_status rt_scene_add_box(rt_scene *scene, uint32_t *out, const float centre[3],
                           const float size[3], const rt_surface *surface, rt_error *error)
{
    rt_new_shape added = {.shape.kind = RT_SHAPE_BOX, .surface = surface};
    rt_status status = rt_check_point(centre, "box", "centre", error);
    for (int i = 0; i < 3 && status == RT_OK; i++)
        status = rt_check_length(size[i], "box", "size", error);
    if (status != RT_OK)
        return status;
    rt_affine placement = rt_placement_scaled(centre, 0.5 * size[0], 0.5 * size[1], 0.5 * size[2]);
    return rt_shape_add_placed(scene, out, &added, &placement, "box", error);
}
