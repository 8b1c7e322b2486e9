/*
 * touch.c - which shapes another one may touch, so that faces of the two coincide: kernels look for
 * these at a hit on such a shape, and nowhere else (kernels/accel/coincident.h).
 *
 * They touch for all that is decided here where their bounds do and both have faces of a like form,
 * and they matter where light enters one of the two. Bounds are compared in order along one axis,
 * so that a scene of many shapes apart takes no square of their number.
 */
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "pack/packing.h"
#include "scene/inside.h"
#include "scene/shape_class.h"

/* A shape as it is compared with others. */
typedef struct extent {
    double lo[3], hi[3]; /* bounds, with room for the error */
    double error;        /* a bound on surface.error in kernels, m; of a plane, about 0 */
    unsigned faces;      /* RT_FACES_* */
    int is_transparent;  /* or a thin sheet: light meets another face there */
    rt_u32 shape;
    const float *p; /* of a plane, as rt_shape.p */
} extent;

/* ---- Errors of surfaces ------------------------------------------------------- */

static const double unit_roundoff = 0.5 * FLT_EPSILON;

/* The largest coordinate, by size, of a box. */
static double largest_coordinate(const float lo[3], const float hi[3])
{
    double most = 0;
    for (int i = 0; i < 3; i++)
        most = fmax(most, fmax(fabs(lo[i]), fabs(hi[i])));
    return most;
}

static double diagonal(const float lo[3], const float hi[3])
{
    double sum = 0;
    for (int i = 0; i < 3; i++)
        sum = hypot(sum, (double)hi[i] - lo[i]);
    return sum;
}

/* Of triangles in these bounds: flat_surface_at, with its slivers. */
static double error_of_triangles(const float lo[3], const float hi[3])
{
    return unit_roundoff * (8 * largest_coordinate(lo, hi) + 272 * diagonal(lo, hi));
}

/* The square root of the sum of the squares of the linear part. */
static double norm(const rt_affine *a)
{
    double sum = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            sum = hypot(sum, a->m[i][j]);
    return sum;
}

/*
 * Of a shape placed by a transform, whose points are within `reach` of the origin of object space,
 * where their error is `error`: place_surface.
 */
static double error_of_placed(const rt_scene *scene, const rt_scene_shape *shape, double reach,
                              double error)
{
    rt_affine inverse, to_world = rt_scene_to_world(scene, shape);
    if (!rt_affine_inverse(&inverse, &to_world))
        return 0;
    double scale = norm(&to_world), condition = scale * norm(&inverse);
    double mapping = 18 * scale * reach + 6 * largest_coordinate(shape->lo, shape->hi);
    return scale * error + unit_roundoff * condition * mapping;
}

static double error_of(const rt_scene *scene, const rt_scene_shape *shape)
{
    switch (rt_shape_class_of(shape->kind)->storage) {
    case RT_STORED_MESH:
        if (rt_scene_is_instance(scene, shape)) {
            const rt_scene_mesh *mesh = scene->meshes + shape->mesh;
            return error_of_placed(scene, shape, 2 * largest_coordinate(mesh->lo, mesh->hi),
                                   error_of_triangles(mesh->lo, mesh->hi));
        }
        return error_of_triangles(shape->lo, shape->hi);
    case RT_STORED_QUAD:
        return error_of_triangles(shape->lo, shape->hi);
    case RT_STORED_ANALYTIC:
        if (shape->kind == RT_SHAPE_SPHERE)
            return error_of_triangles(shape->lo, shape->hi);
        return error_of_placed(scene, shape, 2, 16 * unit_roundoff);
    case RT_STORED_INFINITE:
        break;
    }
    return 0;
}

/* Of a plane where it meets these bounds: it grows with the distance from its point. */
static double error_of_plane(const extent *plane, const extent *at)
{
    double reach = 0;
    for (int i = 0; i < 3; i++)
        reach += fabs(plane->p[i]) + fmax(fabs(at->lo[i]), fabs(at->hi[i]));
    return 9 * unit_roundoff * reach;
}

/* ---- Which touch -------------------------------------------------------------- */

static extent extent_of(const rt_scene *scene, rt_u32 index)
{
    const rt_scene_shape *shape = scene->shapes + index;
    extent out = {.error = error_of(scene, shape),
                  .faces = rt_shape_class_of(shape->kind)->faces,
                  .shape = index,
                  .p = rt_scene_parameters(scene, shape)};
    if ((out.faces & RT_FACES_FRUSTUM) && !shape->caps)
        out.faces = RT_FACES_FRUSTUM;
    for (int i = 0; i < 3; i++) {
        out.lo[i] = shape->lo[i] - out.error;
        out.hi[i] = shape->hi[i] + out.error;
    }
    const rt_material *material = scene->materials + shape->material;
    out.is_transparent = rt_material_is_transparent(material) || material->thin;
    return out;
}

static int may_share_faces(const extent *a, const extent *b)
{
    return (a->faces & b->faces) && (a->is_transparent || b->is_transparent);
}

static void note(const rt_packing *p, const extent *of, double error)
{
    rt_shape_place *place = p->shapes + of->shape;
    place->reach = fmaxf(place->reach, (float)error);
}

static void touch(const rt_packing *p, const extent *a, const extent *b)
{
    if (!may_share_faces(a, b))
        return;
    for (int i = 0; i < 3; i++)
        if (!(a->lo[i] <= b->hi[i] && b->lo[i] <= a->hi[i]))
            return;
    note(p, a, b->error);
    note(p, b, a->error);
}

static void touch_plane(const rt_packing *p, const extent *plane, const extent *b)
{
    const float *point = plane->p, *normal = point + 4;
    double distance = 0, half = 0, error = error_of_plane(plane, b);
    if (!may_share_faces(plane, b))
        return;
    for (int i = 0; i < 3; i++) {
        distance += normal[i] * (0.5 * (b->lo[i] + b->hi[i]) - point[i]);
        half += fabs(normal[i]) * 0.5 * (b->hi[i] - b->lo[i]);
    }
    if (!(fabs(distance) <= half + error))
        return;
    note(p, plane, b->error);
    note(p, b, error);
}

/* Two planes may coincide anywhere; where nothing else is, the size of their error is not known. */
static void touch_planes(const rt_packing *p, const extent *a, const extent *b)
{
    double apart = 0, error = error_of_plane(a, b) + error_of_plane(b, a);
    if (!may_share_faces(a, b))
        return;
    for (int i = 0; i < 3; i++)
        apart += a->p[4 + i] * ((double)b->p[i] - a->p[i]);
    if (fabs(apart) > error)
        return;
    note(p, a, error);
    note(p, b, error);
}

/* The axis along which the bounds are farthest apart. */
static int widest_axis(const extent *extents, size_t count)
{
    double lo[3] = {INFINITY, INFINITY, INFINITY}, hi[3] = {-INFINITY, -INFINITY, -INFINITY};
    int widest = 0;
    for (size_t i = 0; i < count; i++)
        for (int axis = 0; axis < 3; axis++) {
            lo[axis] = fmin(lo[axis], extents[i].lo[axis]);
            hi[axis] = fmax(hi[axis], extents[i].lo[axis]);
        }
    for (int axis = 1; axis < 3; axis++)
        if (hi[axis] - lo[axis] > hi[widest] - lo[widest])
            widest = axis;
    return widest;
}

#define COMPARE_ALONG(axis)                                                                        \
    static int compare_##axis(const void *a, const void *b)                                        \
    {                                                                                              \
        const extent *x = a, *y = b;                                                               \
        return (x->lo[axis] > y->lo[axis]) - (x->lo[axis] < y->lo[axis]);                          \
    }
COMPARE_ALONG(0)
COMPARE_ALONG(1)
COMPARE_ALONG(2)
#undef COMPARE_ALONG

/* Compares finite shapes with each other. */
static void touch_finite(const rt_packing *p, extent *extents, size_t count)
{
    static int (*const compare[3])(const void *, const void *) = {compare_0, compare_1, compare_2};
    int axis = widest_axis(extents, count);
    qsort(extents, count, sizeof *extents, compare[axis]);
    for (size_t i = 0; i < count; i++)
        for (size_t k = i + 1; k < count && extents[k].lo[axis] <= extents[i].hi[axis]; k++)
            touch(p, extents + i, extents + k);
}

rt_status rt_pack_touch(rt_packing *p, rt_error *error)
{
    const rt_scene *scene = p->scene;
    size_t finite = 0, planes = 0, transparent = 0, shapes = scene->shape_count;
    extent *extents =
        rt_memory_alloc(p->memory, shapes, sizeof *extents, "the packing of the scene", error);
    if (!extents)
        return RT_ERROR_MEMORY;
    for (size_t i = 0; i < shapes; i++) {
        extent next = extent_of(scene, (rt_u32)i);
        int is_plane = rt_shape_class_of(scene->shapes[i].kind)->storage == RT_STORED_INFINITE;
        extents[is_plane ? shapes - ++planes : finite++] = next;
        transparent += (size_t)next.is_transparent;
        p->shapes[i].reach = 0;
    }
    if (transparent > 0) {
        touch_finite(p, extents, finite);
        for (size_t i = finite; i < shapes; i++) {
            for (size_t k = 0; k < finite; k++)
                touch_plane(p, extents + i, extents + k);
            for (size_t k = i + 1; k < shapes; k++)
                touch_planes(p, extents + i, extents + k);
        }
    }
    rt_memory_free(extents);
    return RT_OK;
}
