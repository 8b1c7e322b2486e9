/*
 * reach.c - the support function of shapes, and lines that meet them: exact for flat shapes, by the
 * bounds of the others.
 */
#include "scene/reach.h"

#include <math.h>

#include "base/vec.h"
#include "scene/inside.h"
#include "scene/shape_class.h"

static double dot(const double a[3], const float b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* ---- Reach ----------------------------------------------------------------- */

static double reach_of_bounds(const rt_scene_shape *shape, const double n[3])
{
    double reach = 0;
    for (int i = 0; i < 3; i++)
        reach += n[i] * (double)(n[i] > 0 ? shape->hi[i] : shape->lo[i]);
    return reach;
}

static double reach_of_plane(const float p[8], const double n[3])
{
    const double normal[3] = {p[4], p[5], p[6]};
    double across[3];
    rt_vec_cross(across, n, normal);
    return rt_vec_length(across) < 1e-6 ? dot(n, p) : INFINITY;
}

static double reach_of_mesh(const rt_scene *scene, const rt_scene_shape *shape, const double n[3],
                            double enough, size_t *work)
{
    const size_t count = scene->meshes[shape->mesh].vertex_count;
    double reach = -INFINITY;
    for (size_t i = 0; i < count && reach <= enough; i++, ++*work) {
        float vertex[3];
        rt_scene_vertex(scene, shape, i, vertex);
        reach = fmax(reach, dot(n, vertex));
    }
    return reach;
}

/* Of a shape in object space: n . x is a row of numbers there. */
static double reach_of_placed(const rt_scene *scene, const rt_scene_shape *shape, const double n[3])
{
    const rt_affine to_world = rt_scene_to_world(scene, shape);
    double row[4], lo, hi;
    for (int k = 0; k < 4; k++)
        row[k] = n[0] * to_world.m[0][k] + n[1] * to_world.m[1][k] + n[2] * to_world.m[2][k];
    rt_shape_class_of(shape->kind)->extent(shape, row, &lo, &hi);
    return hi;
}

double rt_shape_reach(const rt_scene *scene, const rt_scene_shape *shape, const double n[3],
                      double enough, size_t *work)
{
    const rt_shape_class *class = rt_shape_class_of(shape->kind);
    const float *p = rt_scene_parameters(scene, shape);
    ++*work;
    if (class->storage == RT_STORED_INFINITE)
        return reach_of_plane(p, n);
    const double bounds = reach_of_bounds(shape, n);
    if (bounds <= enough)
        return bounds;
    if (class->storage == RT_STORED_MESH)
        return reach_of_mesh(scene, shape, n, enough, work);
    if (class->storage == RT_STORED_QUAD)
        return dot(n, p) + fmax(dot(n, p + 3), 0) + fmax(dot(n, p + 6), 0);
    return reach_of_placed(scene, shape, n);
}

/* ---- Lines ----------------------------------------------------------------- */

/*
 * The distance along the line from p to the triangle, or the parallelogram, of corner a and edges
 * b, c; infinite where it meets none (Moeller and Trumbore 1997).
 */
static double to_edges(const double p[3], const double d[3], const double a[3], const double b[3],
                       const double c[3], int is_triangle)
{
    const double from[3] = {p[0] - a[0], p[1] - a[1], p[2] - a[2]};
    double dc[3], fb[3];
    rt_vec_cross(dc, d, c);
    rt_vec_cross(fb, from, b);
    const double volume = rt_vec_dot(b, dc);
    const double u = rt_vec_dot(from, dc) / volume;
    const double v = rt_vec_dot(d, fb) / volume;
    const double t = rt_vec_dot(c, fb) / volume;
    const int is_within = u >= 0 && v >= 0 && (is_triangle ? u + v <= 1 : u <= 1 && v <= 1);
    return is_within && t >= 0 ? t : INFINITY;
}

/* Where the line enters and leaves the bounds, or 0: it misses them, or they are behind it. */
static int meets_bounds(const rt_scene_shape *shape, const double p[3], const double d[3],
                        double *enter, double *leave)
{
    *enter = -INFINITY;
    *leave = INFINITY;
    for (int i = 0; i < 3; i++) {
        const double a = (shape->lo[i] - p[i]) / d[i], b = (shape->hi[i] - p[i]) / d[i];
        *enter = fmax(*enter, fmin(a, b)); /* of NaN, within a face, the other counts */
        *leave = fmin(*leave, fmax(a, b));
    }
    return *enter <= *leave && *leave >= 0;
}

/* To the bounds; from inside of them only to those of a box, which are its walls. */
static double to_bounds(const rt_scene_shape *shape, const double p[3], const double d[3])
{
    double enter, leave;
    if (!meets_bounds(shape, p, d, &enter, &leave))
        return INFINITY;
    return enter >= 0 ? enter : shape->kind == RT_SHAPE_BOX ? leave : INFINITY;
}

/* To the mesh where it is nearer than the limit; infinite, and hardly any work, by its bounds. */
static double to_mesh(const rt_scene *scene, const rt_scene_shape *shape, const double p[3],
                      const double d[3], double limit, size_t *work)
{
    const rt_scene_mesh *mesh = scene->meshes + shape->mesh;
    double nearest = INFINITY, enter, leave;
    if (!meets_bounds(shape, p, d, &enter, &leave) || enter >= limit)
        return INFINITY;
    *work += mesh->triangle_count;
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        float v[3][3];
        double b[3], c[3];
        for (int k = 0; k < 3; k++)
            rt_scene_vertex(scene, shape, mesh->indices[3 * i + (size_t)k], v[k]);
        rt_vec_sub(b, v[1], v[0]);
        rt_vec_sub(c, v[2], v[0]);
        const double a[3] = {v[0][0], v[0][1], v[0][2]};
        nearest = fmin(nearest, to_edges(p, d, a, b, c, 1));
    }
    return nearest;
}

static double to_shape(const rt_scene *scene, const rt_scene_shape *shape, const double p[3],
                       const double d[3], double limit, size_t *work)
{
    const rt_shape_class *class = rt_shape_class_of(shape->kind);
    const float *q = rt_scene_parameters(scene, shape);
    if (class->storage == RT_STORED_INFINITE) {
        const double t =
            (dot((const double[3]){q[0], q[1], q[2]}, q + 4) - dot(p, q + 4)) / dot(d, q + 4);
        return t >= 0 ? t : INFINITY;
    }
    if (class->storage == RT_STORED_ANALYTIC)
        return to_bounds(shape, p, d);
    if (class->storage == RT_STORED_MESH)
        return to_mesh(scene, shape, p, d, limit, work);
    return to_edges(p, d, (const double[3]){q[0], q[1], q[2]}, (const double[3]){q[3], q[4], q[5]},
                    (const double[3]){q[6], q[7], q[8]}, 0);
}

/* Whether no row of its placement mixes axes, so that a box is its bounds. */
static int is_upright(const rt_scene *scene, const rt_scene_shape *box)
{
    const rt_affine to_world = rt_scene_to_world(scene, box);
    for (int i = 0; i < 3; i++) {
        int mixed = 0;
        for (int k = 0; k < 3; k++)
            mixed += to_world.m[i][k] != 0;
        if (mixed != 1)
            return 0;
    }
    return 1;
}

static int is_wall(const rt_scene *scene, const rt_scene_shape *shape)
{
    return rt_material_hides(scene->materials + shape->material) &&
           (rt_shape_class_of(shape->kind)->storage != RT_STORED_ANALYTIC ||
            (shape->kind == RT_SHAPE_BOX && is_upright(scene, shape)));
}

uint32_t rt_scene_first_along(const rt_scene *scene, const rt_scene_shape *from, const double p[3],
                              const double d[3], int walls, double *distance, size_t *work)
{
    uint32_t first = RT_NONE;
    for (size_t i = 0; i < scene->shape_count; i++, ++*work) {
        const rt_scene_shape *shape = scene->shapes + i;
        if (shape == from || (walls && !is_wall(scene, shape)))
            continue;
        const double t = to_shape(scene, shape, p, d, *distance, work);
        if (t < *distance) {
            *distance = t;
            first = (uint32_t)i;
        }
    }
    return first;
}
