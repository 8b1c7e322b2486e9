/*
 * inside.c - whether points lie in solids.
 *
 * Analytic shapes are asked by their equations, in the space of their own that kernels/types.h
 * describes. Of a mesh, the solid angles of its triangles are summed: over a closed surface they
 * make a full sphere seen from inside, and nothing seen from outside, with no ray that could graze
 * an edge (Van Oosterom and Strackee, "The Solid Angle of a Plane Triangle", IEEE Trans. Biomed.
 * Eng. 30(2), 1983).
 */
#include "scene/inside.h"

#include <math.h>

#include "scene/check.h"

static const double pi = 3.14159265358979323846;

/*
 * The rounding of a sum of many solid angles, in full spheres; a hole that is smaller goes
 * unnoticed.
 */
static const double rounding = 1e-6;

int rt_material_is_transparent(const rt_material *m)
{
    return !rt_is_black(m->kt) || (m->fresnel == RT_FRESNEL_DIELECTRIC && !rt_is_black(m->ks));
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/*
 * The solid angle of a triangle of corners a, b, c seen from the origin, in full spheres; positive
 * from behind.
 */
static double solid_angle(const double a[3], const double b[3], const double c[3])
{
    double n[3], la = rt_vec_length(a), lb = rt_vec_length(b), lc = rt_vec_length(c);
    rt_vec_cross(n, b, c);
    return atan2(dot(a, n), la * lb * lc + dot(a, b) * lc + dot(a, c) * lb + dot(b, c) * la) /
           (2 * pi);
}

static int mesh_contains(const rt_scene_mesh *mesh, const double p[3])
{
    double sum = 0;
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        double v[3][3];
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < 3; k++)
                v[c][k] =
                    mesh->positions[3 * (size_t)mesh->indices[3 * i + (size_t)c] + (size_t)k] -
                    p[k];
        sum += solid_angle(v[0], v[1], v[2]);
    }
    double turns = round(sum);
    return fabs(sum - turns) > rounding ? 0 : (turns > 0) - (turns < 0);
}

static int sphere_contains(const rt_scene_shape *sphere, const double p[3])
{
    const double to[3] = {p[0] - sphere->p[0], p[1] - sphere->p[1], p[2] - sphere->p[2]};
    return rt_vec_length(to) < sphere->p[3];
}

int rt_shape_contains(const rt_scene *scene, const rt_scene_shape *shape, const double p[3])
{
    rt_affine to_object;
    double q[3];
    int is_open = shape->kind == RT_SHAPE_PLANE || shape->kind == RT_SHAPE_QUAD ||
                  shape->kind == RT_SHAPE_DISC;
    if (is_open)
        return 0;
    for (int i = 0; i < 3; i++)
        if (!(p[i] > shape->lo[i] && p[i] < shape->hi[i]))
            return 0;
    if (shape->kind == RT_SHAPE_SPHERE)
        return sphere_contains(shape, p);
    if (!rt_affine_inverse(&to_object, &shape->to_world))
        return 0;
    rt_affine_point(q, &to_object, p);
    double across = hypot(q[0], q[1]);
    switch (shape->kind) {
    case RT_SHAPE_ELLIPSOID:
        return hypot(across, q[2]) < 1;
    case RT_SHAPE_TORUS:
        return hypot(across - 1, q[2]) < shape->p[0];
    case RT_SHAPE_CYLINDER:
        return shape->caps && q[2] > 0 && q[2] < 1 && across < 1;
    case RT_SHAPE_CONE: /* One that comes to a point needs no cap there, but one at its base. */
        return shape->caps && q[2] > 0 && q[2] < 1 && across < 1 + (shape->p[0] - 1) * q[2];
    default:
        return mesh_contains(scene->meshes + shape->mesh, q);
    }
}

int rt_shape_contains_bounds(const rt_scene *scene, const rt_scene_shape *shape,
                             const rt_scene_shape *other)
{
    for (int corner = 0; corner < 8; corner++) {
        double p[3];
        for (int i = 0; i < 3; i++)
            p[i] = corner >> i & 1 ? other->hi[i] : other->lo[i];
        if (!rt_shape_contains(scene, shape, p))
            return 0;
    }
    return 1;
}
