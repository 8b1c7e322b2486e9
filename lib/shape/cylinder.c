/* cylinder.c - the cylinder: in object space a frustum of radius 1 at both ends. */
#include "shape/frustum.h"

static void extent(const rt_scene_shape *shape, const double row[4], double *lo, double *hi)
{
    (void)shape;
    rt_frustum_extent(1, row, lo, hi);
}

static double area(const rt_scene_shape *shape, const rt_affine *to_world)
{
    return rt_frustum_area(shape, to_world, 1);
}

static int contains(const rt_scene *scene, const rt_scene_shape *shape, const double p[3])
{
    return rt_frustum_contains(scene, shape, 1, p);
}

const rt_shape_class rt_shape_cylinder = {.name = "cylinder",
                                          .storage = RT_STORED_ANALYTIC,
                                          .faces = RT_FACES_FRUSTUM | RT_FACES_FLAT,
                                          .boundary = rt_frustum_boundary,
                                          .contains = contains,
                                          .extent = extent,
                                          .area = area};

rt_status rt_scene_add_cylinder(rt_scene *scene, uint32_t *out, const float a[3], const float b[3],
                                float radius, int caps, const rt_surface *surface, rt_error *error)
{
    static const char *const names[] = {"cylinder", "a", "b"};
    rt_new_shape added = {.shape = {.kind = RT_SHAPE_CYLINDER, .caps = caps != 0},
                          .surface = surface};
    return rt_frustum_add(scene, out, &added, a, b, radius, names, error);
}
