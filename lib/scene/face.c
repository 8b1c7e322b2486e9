/* face.c - faces by a corner and two edges, and discs. */
#include "scene/face.h"

#include <math.h>

#include "base/vec.h"

static const double pi = 3.14159265358979323846;

size_t rt_face_count(const rt_scene *scene, const rt_scene_shape *shape)
{
    if (shape->kind == RT_SHAPE_TRIANGLES)
        return scene->meshes[shape->mesh].triangle_count;
    return shape->kind == RT_SHAPE_QUAD || shape->kind == RT_SHAPE_DISC;
}

/* Sets what follows from corner and edges. */
static void complete(rt_face *face, int is_mirrored)
{
    const int is_triangle = face->kind == RT_SHAPE_TRIANGLES;
    rt_vec_cross(face->normal, face->b, face->c);
    const double length = rt_vec_length(face->normal);
    for (int i = 0; i < 3; i++) {
        face->centre[i] = face->corner[i] + (face->b[i] + face->c[i]) / (is_triangle ? 3 : 2);
        face->normal[i] *= (is_mirrored ? -1 : 1) / length;
    }
    face->area = is_triangle ? 0.5 * length : length;
}

static rt_face quad(const rt_scene *scene, const rt_scene_shape *shape)
{
    const float *p = rt_scene_parameters(scene, shape);
    rt_face out = {.kind = RT_SHAPE_QUAD};
    for (int i = 0; i < 3; i++) {
        out.corner[i] = p[i];
        out.b[i] = p[3 + i];
        out.c[i] = p[6 + i];
    }
    complete(&out, rt_scene_is_mirrored(scene, shape));
    return out;
}

static rt_face triangle(const rt_scene *scene, const rt_scene_shape *shape, size_t index)
{
    const uint32_t *corners = scene->meshes[shape->mesh].indices + 3 * index;
    rt_face out = {.kind = RT_SHAPE_TRIANGLES};
    float v[3][3];
    for (int k = 0; k < 3; k++)
        rt_scene_vertex(scene, shape, corners[k], v[k]);
    for (int i = 0; i < 3; i++)
        out.corner[i] = v[0][i];
    rt_vec_sub(out.b, v[1], v[0]);
    rt_vec_sub(out.c, v[2], v[0]);
    complete(&out, rt_scene_is_mirrored(scene, shape));
    return out;
}

/* The normal is +z of the object, on whichever side the placement has that. */
static rt_face disc(const rt_scene *scene, const rt_scene_shape *shape)
{
    const rt_affine to_world = rt_scene_to_world(scene, shape);
    rt_face out = {.kind = RT_SHAPE_DISC, .area = rt_scene_primitive_area(scene, shape, 0)};
    rt_affine inverse;
    if (rt_affine_inverse(&inverse, &to_world))
        rt_affine_normal(out.normal, &inverse, (const double[3]){0, 0, 1});
    const double length = rt_vec_length(out.normal);
    for (int i = 0; i < 3; i++) {
        out.b[i] = to_world.m[i][0];
        out.c[i] = to_world.m[i][1];
        out.centre[i] = out.corner[i] = to_world.m[i][3];
        out.normal[i] /= length;
    }
    return out;
}

rt_face rt_face_of(const rt_scene *scene, const rt_scene_shape *shape, size_t i)
{
    if (shape->kind == RT_SHAPE_QUAD)
        return quad(scene, shape);
    return shape->kind == RT_SHAPE_DISC ? disc(scene, shape) : triangle(scene, shape, i);
}

void rt_face_point(double out[3], const rt_face *face, double u, double v)
{
    double x = u, y = v;
    if (face->kind == RT_SHAPE_DISC) {
        x = u * cos(2 * pi * v);
        y = u * sin(2 * pi * v);
    } else if (face->kind == RT_SHAPE_TRIANGLES && u + v > 1) {
        x = 1 - v;
        y = 1 - u;
    }
    for (int i = 0; i < 3; i++)
        out[i] = face->corner[i] + x * face->b[i] + y * face->c[i];
}
