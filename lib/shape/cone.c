/* cone.c - the cone: in object space a frustum of radius 1 at z = 0 and p[0] <= 1 at z = 1. */
#include "shape/frustum.h"

static void extent(const rt_scene_shape *shape, const double row[4], double *lo, double *hi)
{
    rt_frustum_extent(shape->p[0], row, lo, hi);
}

static double area(const rt_scene_shape *shape, const rt_affine *to_world)
{
    return rt_frustum_area(shape, to_world, shape->p[0]);
}

static int contains(const rt_scene *scene, const rt_scene_shape *shape, const double p[3])
{
    return rt_frustum_contains(scene, shape, shape->p[0], p);
}

const rt_shape_class rt_shape_cone = {.name = "cone",
                                      .storage = RT_STORED_ANALYTIC,
                                      .faces = RT_FACES_FRUSTUM | RT_FACES_FLAT,
                                      .boundary = rt_frustum_boundary,
                                      .contains = contains,
                                      .extent = extent,
                                      .area = area};

rt_status rt_scene_add_cone(rt_scene *scene, uint32_t *out, const float base[3],
                            const float apex[3], float radius, float apex_radius, int caps,
                            const rt_surface *surface, rt_error *error)
{
    static const char *const names[] = {"cone", "base", "apex"};
    rt_new_shape added = {.shape = {.kind = RT_SHAPE_CONE, .caps = caps != 0}, .surface = surface};
    if (!(apex_radius >= 0 && apex_radius <= radius))
        return rt_fail_field(
            error, RT_ERROR_INPUT, "apex_radius",
            "cone: apex_radius is %g m; it must be at least 0 and at most radius, %g", apex_radius,
            radius);
    added.shape.p[0] = radius > 0 ? apex_radius / radius : 0;
    return rt_frustum_add(scene, out, &added, base, apex, radius, names, error);
}
