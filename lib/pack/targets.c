/* targets.c - bounding spheres of the shapes that reflect or refract specularly. */
#include <math.h>

#include "pack/packing.h"
#include "scene/shape_class.h"
#include "scene/check.h"
#include "scene/inside.h"
#include "scene/parts.h"

enum { targets_most = 64 };

/* More than the rounding of rays that graze a shape. */
static const double slack = 1e-5;

/*
 * Whether a photon path can leave the shape without a diffuse or rough event: by a delta lobe, or
 * at a boundary that nested media suppress.
 */
static int is_shiny(const rt_material *m)
{
    return rt_material_is_mirror(m) ||
           (rt_material_is_specular(m) && rt_material_is_transparent(m));
}

static int is_specular(const rt_scene *scene, const rt_scene_shape *shape)
{
    return rt_material_any(scene, scene->materials + shape->material, RT_SIDE_BOTH, is_shiny);
}

static void write_target(rt_target *out, const double centre[3], double radius)
{
    double reach = 0;
    for (int i = 0; i < 3; i++) {
        out->centre[i] = (float)centre[i];
        reach = fmax(reach, fabs(centre[i]));
    }
    out->radius = (float)(radius + slack * (radius + reach));
}

/* One bounding sphere around all specular shapes. */
static void write_sphere_of_all(rt_target *out, const rt_scene *scene)
{
    float lo[3] = {INFINITY, INFINITY, INFINITY}, hi[3] = {-INFINITY, -INFINITY, -INFINITY};
    double centre[3], radius;
    int has_infinite = 0;
    for (size_t i = 0; i < scene->shape_count; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        if (!is_specular(scene, shape))
            continue;
        int is_infinite = rt_shape_class_of(shape->kind)->storage == RT_STORED_INFINITE;
        has_infinite |= is_infinite;
        for (int axis = 0; axis < 3 && !is_infinite; axis++) {
            lo[axis] = fminf(lo[axis], shape->lo[axis]);
            hi[axis] = fmaxf(hi[axis], shape->hi[axis]);
        }
    }
    radius = rt_bounds_sphere(centre, lo, hi);
    write_target(out, centre, has_infinite ? INFINITY : radius);
}

static size_t count_specular(const rt_scene *scene)
{
    size_t count = 0;
    for (size_t i = 0; i < scene->shape_count; i++)
        count += is_specular(scene, scene->shapes + i);
    return count;
}

size_t rt_targets_count(const rt_scene *scene)
{
    size_t count = count_specular(scene);
    return count > targets_most ? 1 : count;
}

void rt_pack_targets(const rt_packing *p)
{
    rt_target *out = rt_packing_table(p, p->header.targets);
    const rt_scene *scene = p->scene;
    if (count_specular(scene) > targets_most) {
        write_sphere_of_all(out, scene);
        return;
    }
    for (size_t i = 0; i < scene->shape_count; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        double centre[3], radius;
        if (!is_specular(scene, shape))
            continue;
        radius = rt_shape_bounding_sphere(scene, shape, centre);
        write_target(out++, centre, radius);
    }
}
