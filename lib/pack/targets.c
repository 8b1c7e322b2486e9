/*
 * targets.c - balls around what caustics can come from: each holds a shape that reflects or
 * refracts specularly.
 */
#include <math.h>

#include "pack/packing.h"
#include "scene/check.h"
#include "scene/inside.h"

enum { targets_most = 64 };

/* More than the rounding of rays that graze a shape. */
static const double slack = 1e-5;

/* Whether a light path can go on from the shape without being spread. */
static int is_specular(const rt_scene *scene, const rt_scene_shape *shape)
{
    const rt_material *m = scene->materials + shape->surface.material;
    int is_shiny = !rt_is_black(m->ks) || !rt_is_black(m->kt);
    return is_shiny && (m->roughness < RT_SMOOTH_ALPHA || rt_material_is_transparent(m));
}

static double distance(const double a[3], const float b[3])
{
    return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
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

/* The ball about the middle of a box that holds all of the box. */
static double middle_of_box(double centre[3], const float lo[3], const float hi[3])
{
    for (int i = 0; i < 3; i++)
        centre[i] = 0.5 * ((double)lo[i] + hi[i]);
    return distance(centre, hi);
}

/* A plane has no end, and so has its ball. */
static void write_ball(rt_target *out, const rt_scene *scene, const rt_scene_shape *shape)
{
    double centre[3] = {0}, radius = INFINITY;
    if (shape->kind != RT_SHAPE_PLANE)
        radius = middle_of_box(centre, shape->lo, shape->hi);
    if (shape->kind == RT_SHAPE_SPHERE) {
        radius = shape->p[3];
    } else if (shape->kind == RT_SHAPE_TRIANGLES && !rt_scene_is_instance(scene, shape)) {
        float vertex[3];
        double farthest = 0;
        for (size_t i = 0; i < scene->meshes[shape->mesh].vertex_count; i++) {
            rt_scene_vertex(scene, shape, i, vertex);
            farthest = fmax(farthest, distance(centre, vertex));
        }
        radius = fmin(radius, farthest);
    }
    write_target(out, centre, radius);
}

/* One ball around all. */
static void write_ball_of_all(rt_target *out, const rt_scene *scene)
{
    float lo[3] = {INFINITY, INFINITY, INFINITY}, hi[3] = {-INFINITY, -INFINITY, -INFINITY};
    double centre[3], radius;
    int has_plane = 0;
    for (size_t i = 0; i < scene->shape_count; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        if (!is_specular(scene, shape))
            continue;
        has_plane |= shape->kind == RT_SHAPE_PLANE;
        for (int axis = 0; axis < 3 && shape->kind != RT_SHAPE_PLANE; axis++) {
            lo[axis] = fminf(lo[axis], shape->lo[axis]);
            hi[axis] = fmaxf(hi[axis], shape->hi[axis]);
        }
    }
    radius = middle_of_box(centre, lo, hi);
    write_target(out, centre, has_plane ? INFINITY : radius);
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
        write_ball_of_all(out, scene);
        return;
    }
    for (size_t i = 0; i < scene->shape_count; i++)
        if (is_specular(scene, scene->shapes + i))
            write_ball(out++, scene, scene->shapes + i);
}
