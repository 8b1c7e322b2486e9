/* inside_shape.c - whether solids contain whole shapes, also where these fill them. */
#include <math.h>

#include "base/vec.h"
#include "scene/inside.h"
#include "scene/reach.h"
#include "scene/shape_class.h"

/* Directions that are compared, and the cosine of the largest angle to the nearest of them. */
enum { DIRECTIONS = 1024 };
#define DIRECTIONS_COSINE 0.995
/* How far a shape may reach in a box of half-size 1: less than one that touches it, by rounding. */
#define BOX_REACH (1 - 1e-5)

/* The i-th direction of a Fibonacci lattice on the sphere. */
static void direction_of(double out[3], int i)
{
    const double z = 1 - (2 * i + 1.0) / DIRECTIONS, r = sqrt(1 - z * z), turn = 2.399963229728653;
    out[0] = r * cos(turn * i);
    out[1] = r * sin(turn * i);
    out[2] = z;
}

/* How far a shape reaches along a direction d of the space that the inverse leads to. */
static double reach_along(const rt_scene *scene, const rt_scene_shape *of, const rt_affine *inverse,
                          const double d[3], double enough)
{
    double n[3], offset = 0;
    size_t work = 0;
    for (int k = 0; k < 3; k++) {
        n[k] = d[0] * inverse->m[0][k] + d[1] * inverse->m[1][k] + d[2] * inverse->m[2][k];
        offset += d[k] * inverse->m[k][3];
    }
    return rt_shape_reach(scene, of, n, enough - offset, &work) + offset;
}

static int ball_contains(const rt_scene *scene, const rt_scene_shape *of, const rt_affine *inverse)
{
    for (int i = 0; i < DIRECTIONS; i++) {
        double d[3];
        direction_of(d, i);
        if (!(reach_along(scene, of, inverse, d, DIRECTIONS_COSINE) < DIRECTIONS_COSINE))
            return 0;
    }
    return 1;
}

static int box_contains(const rt_scene *scene, const rt_scene_shape *of, const rt_affine *inverse)
{
    for (int i = 0; i < 6; i++) {
        double d[3] = {0};
        d[i / 2] = i & 1 ? -1 : 1;
        if (!(reach_along(scene, of, inverse, d, BOX_REACH) < BOX_REACH))
            return 0;
    }
    return 1;
}

/* Whether a convex solid has all vertices of a mesh in it. */
static int contains_vertices(const rt_scene *scene, const rt_scene_shape *shape,
                             const rt_scene_shape *mesh)
{
    for (size_t i = 0; i < scene->meshes[mesh->mesh].vertex_count; i++) {
        float v[3];
        rt_scene_vertex(scene, mesh, i, v);
        if (!rt_shape_contains(scene, shape, (const double[3]){v[0], v[1], v[2]}))
            return 0;
    }
    return 1;
}

static int sphere_contains_sphere(const rt_scene_shape *a, const rt_scene_shape *b)
{
    const double to[3] = {(double)b->p[0] - a->p[0], (double)b->p[1] - a->p[1],
                          (double)b->p[2] - a->p[2]};
    return rt_vec_length(to) + b->p[3] < a->p[3];
}

int rt_shape_contains_shape(const rt_scene *scene, const rt_scene_shape *shape,
                            const rt_scene_shape *other)
{
    const rt_shape_class *class = rt_shape_class_of(shape->kind);
    rt_affine to_world, inverse;
    if (rt_shape_contains_bounds(scene, shape, other))
        return 1;
    if (shape->kind == RT_SHAPE_SPHERE && other->kind == RT_SHAPE_SPHERE)
        return sphere_contains_sphere(shape, other);
    if (class->faces != RT_FACES_BALL && shape->kind != RT_SHAPE_BOX)
        return 0;
    if (other->kind == RT_SHAPE_TRIANGLES)
        return contains_vertices(scene, shape, other);
    to_world = rt_scene_to_world(scene, shape);
    if (!rt_affine_inverse(&inverse, &to_world))
        return 0;
    return shape->kind == RT_SHAPE_BOX ? box_contains(scene, other, &inverse)
                                       : ball_contains(scene, other, &inverse);
}
