/*
 * unit_sphere.c - a placed unit sphere: a sphere where the placement is a similarity, else an
 * ellipsoid.
 */
#include "shape/unit_sphere.h"

#include <float.h>
#include <math.h>

static const double pi = 3.14159265358979323846;

void rt_unit_sphere_extent(const rt_scene_shape *shape, const double row[4], double *lo, double *hi)
{
    (void)shape;
    const double reach = hypot(hypot(row[0], row[1]), row[2]);
    *lo = row[3] - reach;
    *hi = row[3] + reach;
}

rt_status rt_shape_add_unit_sphere(rt_scene *scene, uint32_t *out, const rt_affine *placement,
                                   const rt_surface *surface, const char *who, rt_error *error)
{
    rt_new_shape added = {.shape.kind = RT_SHAPE_ELLIPSOID, .surface = surface};
    rt_scene_shape *shape = &added.shape;
    rt_affine transform, whole = *placement;
    const int is_moved = !rt_transform_is_none(&surface->transform);
    if (is_moved) {
        transform = rt_affine_from(&surface->transform);
        whole = rt_affine_product(&transform, placement);
    }
    double radius = rt_affine_similarity(&whole);
    if (!(radius > 0))
        return rt_shape_add_placed(scene, out, &added, placement, who, error);
    rt_status status = is_moved ? rt_surface_transform(&transform, surface, who, error) : RT_OK;
    if (status != RT_OK)
        return status;
    shape->kind = RT_SHAPE_SPHERE;
    added.area = 4 * pi * radius * radius;
    added.placement.to_world = whole;
    shape->p[3] = (float)radius;
    for (int i = 0; i < 3; i++) {
        shape->p[i] = (float)(whole.m[i][3] + 0.0); /* no -0 */
        shape->lo[i] = nextafterf(shape->p[i] - shape->p[3], -FLT_MAX);
        shape->hi[i] = nextafterf(shape->p[i] + shape->p[3], FLT_MAX);
        for (int j = 0; j < 3; j++)
            shape->has_transform |= i != j ? whole.m[i][j] != 0 : !(whole.m[i][j] > 0);
    }
    return rt_scene_add_shape(scene, out, &added, who, error);
}
