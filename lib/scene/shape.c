/* shape.c - adding shapes to a scene, and what can be asked of one. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "scene/check.h"
#include "scene/scene.h"

static const double pi = 3.14159265358979323846;

/* Primitives are numbered with 31 bits on the device. */
enum { shapes_max = 0x3fffffff, triangles_max = 0x3fffffff };

size_t rt_scene_shape_primitives(const rt_scene_shape *shape)
{
    return shape->kind == RT_SHAPE_TRIANGLES ? shape->triangle_count : 1;
}

static double parallelogram_area(const double a[3], const double b[3])
{
    double normal[3];
    rt_vec_cross(normal, a, b);
    return rt_vec_length(normal);
}

double rt_scene_primitive_area(const rt_scene_shape *shape, size_t primitive)
{
    double a[3], b[3];
    static const float zero[3];

    switch (shape->kind) {
    case RT_SHAPE_SPHERE:
        return 4 * pi * (double)shape->p[3] * shape->p[3];
    case RT_SHAPE_QUAD:
        rt_vec_sub(a, shape->p + 3, zero);
        rt_vec_sub(b, shape->p + 6, zero);
        return parallelogram_area(a, b);
    case RT_SHAPE_TRIANGLES: {
        const uint32_t *corner = shape->indices + 3 * primitive;
        const float *v0 = shape->positions + 3 * (size_t)corner[0];
        rt_vec_sub(a, shape->positions + 3 * (size_t)corner[1], v0);
        rt_vec_sub(b, shape->positions + 3 * (size_t)corner[2], v0);
        return 0.5 * parallelogram_area(a, b);
    }
    default:
        return INFINITY; /* a plane */
    }
}

static double shape_area(const rt_scene_shape *shape)
{
    double area = 0;
    for (size_t i = 0; i < rt_scene_shape_primitives(shape); i++)
        area += rt_scene_primitive_area(shape, i);
    return area;
}

void rt_scene_shape_radiance(const rt_scene *scene, const rt_scene_shape *shape, float radiance[3])
{
    const rt_surface *s = &shape->surface;
    const rt_material *m = scene->materials + s->material;
    if (!rt_is_black(s->power)) {
        double sides = m->two_sided ? 2 : 1;
        for (int c = 0; c < 3; c++)
            radiance[c] = (float)(s->power[c] / (pi * sides * shape_area(shape)));
    } else {
        memcpy(radiance, rt_is_black(s->radiance) ? m->emission : s->radiance, 3 * sizeof *radiance);
    }
}

/* A power may be too much for the shape's area. */
static rt_status check_lamp(const rt_scene *scene, const rt_scene_shape *shape, const char *who, rt_error *error)
{
    float radiance[3];
    if (rt_is_black(shape->surface.power))
        return RT_OK;
    rt_scene_shape_radiance(scene, shape, radiance);
    for (int i = 0; i < 3; i++)
        if (!(radiance[i] <= RT_COLOUR_MAX))
            return rt_fail_field(error, RT_ERROR_INPUT, "power",
                                 "%s: power is %g W on %g m^2; the radiance must not exceed %g W/(m^2 sr)", who,
                                 shape->surface.power[i], shape_area(shape), RT_COLOUR_MAX);
    return RT_OK;
}

/* Checks what all shapes share and appends; on success the scene owns the shape's arrays. */
static rt_status add_shape(rt_scene *scene, uint32_t *out, const rt_scene_shape *shape, const char *who,
                           rt_error *error)
{
    const rt_surface *s = &shape->surface;
    rt_status status;

    if (s->material >= scene->material_count)
        return rt_fail_field(error, RT_ERROR_INPUT, "material", "%s: there is no material %u among %zu", who,
                             s->material, scene->material_count);
    if ((status = rt_check_colour(s->radiance, who, "radiance", error)) != RT_OK ||
        (status = rt_check_colour(s->power, who, "power", error)) != RT_OK)
        return status;
    if (!rt_is_black(s->radiance) && !rt_is_black(s->power))
        return rt_fail_field(error, RT_ERROR_INPUT, "power", "%s: give radiance or power, not both", who);
    if (shape->kind == RT_SHAPE_PLANE) {
        const char *field = !rt_is_black(s->power) ? "power" : !rt_is_black(s->radiance) ? "radiance" : "material";
        float radiance[3] = {s->power[0] + s->radiance[0], s->power[1] + s->radiance[1], s->power[2] + s->radiance[2]};
        if (!rt_is_black(radiance) || !rt_is_black(scene->materials[s->material].emission))
            return rt_fail_field(error, RT_ERROR_INPUT, field, "plane: an infinite plane cannot emit");
    }
    if ((status = check_lamp(scene, shape, who, error)) != RT_OK)
        return status;
    if (scene->shape_count >= shapes_max)
        return rt_fail(error, RT_ERROR_INPUT, "more than %d shapes", shapes_max);
    status = rt_grow((void **)&scene->shapes, &scene->shape_room, scene->shape_count, sizeof *shape, error);
    if (status != RT_OK)
        return status;
    if (out)
        *out = (uint32_t)scene->shape_count;
    scene->shapes[scene->shape_count++] = *shape;
    return RT_OK;
}

rt_status rt_scene_add_plane(rt_scene *scene, uint32_t *out, const float point[3], const float normal[3],
                             const rt_surface *surface, rt_error *error)
{
    rt_scene_shape shape = {.kind = RT_SHAPE_PLANE, .surface = *surface};
    static const float zero[3];
    double n[3];
    rt_status status;

    if ((status = rt_check_point(point, "plane", "point", error)) != RT_OK ||
        (status = rt_check_point(normal, "plane", "normal", error)) != RT_OK)
        return status;
    rt_vec_sub(n, normal, zero);
    double length = rt_vec_length(n);
    if (!(length > 0))
        return rt_fail_field(error, RT_ERROR_INPUT, "normal", "plane: normal is zero");
    for (int i = 0; i < 3; i++) {
        shape.p[i] = point[i];
        shape.p[4 + i] = (float)(n[i] / length);
    }
    return add_shape(scene, out, &shape, "plane", error);
}

rt_status rt_scene_add_sphere(rt_scene *scene, uint32_t *out, const float centre[3], float radius,
                              const rt_surface *surface, rt_error *error)
{
    rt_scene_shape shape = {.kind = RT_SHAPE_SPHERE, .surface = *surface};
    rt_status status = rt_check_point(centre, "sphere", "centre", error);
    if (status != RT_OK)
        return status;
    if (!(radius >= RT_LENGTH_MIN && radius <= RT_COORDINATE_MAX))
        return rt_fail_field(error, RT_ERROR_INPUT, "radius", "sphere: radius is %g m; it must lie between %g and %g",
                             radius, RT_LENGTH_MIN, RT_COORDINATE_MAX);
    memcpy(shape.p, centre, 3 * sizeof *centre);
    shape.p[3] = radius;
    return add_shape(scene, out, &shape, "sphere", error);
}

rt_status rt_scene_add_quad(rt_scene *scene, uint32_t *out, const float corner[3], const float edge1[3],
                            const float edge2[3], const rt_surface *surface, rt_error *error)
{
    rt_scene_shape shape = {.kind = RT_SHAPE_QUAD, .surface = *surface};
    rt_status status;

    if ((status = rt_check_point(corner, "quad", "corner", error)) != RT_OK ||
        (status = rt_check_point(edge1, "quad", "edge1", error)) != RT_OK ||
        (status = rt_check_point(edge2, "quad", "edge2", error)) != RT_OK)
        return status;
    memcpy(shape.p, corner, 3 * sizeof *corner);
    memcpy(shape.p + 3, edge1, 3 * sizeof *edge1);
    memcpy(shape.p + 6, edge2, 3 * sizeof *edge2);
    double area = rt_scene_primitive_area(&shape, 0);
    if (!(area > 0))
        return rt_fail_field(error, RT_ERROR_INPUT, "edge2", "quad: its area is zero; edge1 and edge2 must not be parallel");
    if (area < RT_AREA_MIN)
        return rt_fail_field(error, RT_ERROR_INPUT, "edge2", "quad: its area is %g m^2; it must be at least %g", area,
                             RT_AREA_MIN);
    return add_shape(scene, out, &shape, "quad", error);
}

/* Copies count * size bytes, or returns NULL. */
static void *copy(const void *from, size_t count, size_t size)
{
    void *to = count <= SIZE_MAX / size ? malloc(count * size) : NULL;
    if (to)
        memcpy(to, from, count * size);
    return to;
}

static rt_status check_triangles(const float *positions, size_t vertex_count, const uint32_t *indices,
                                 size_t triangle_count, const float *normals, rt_error *error)
{
    rt_status status = RT_OK;
    if (triangle_count == 0 || triangle_count > triangles_max)
        return rt_fail(error, RT_ERROR_INPUT, "triangles: %zu triangles; there must be 1 to %d", triangle_count,
                       triangles_max);
    for (size_t i = 0; i < vertex_count && status == RT_OK; i++) {
        status = rt_check_point(positions + 3 * i, "triangles", "positions", error);
        if (status == RT_OK && normals)
            status = rt_check_point(normals + 3 * i, "triangles", "normals", error);
    }
    for (size_t i = 0; i < 3 * triangle_count && status == RT_OK; i++)
        if (indices[i] >= vertex_count)
            status = rt_fail_field(error, RT_ERROR_INPUT, "indices", "triangles: triangle %zu names vertex %u of %zu",
                                   i / 3, indices[i], vertex_count);
    return status;
}

static rt_status check_area(const rt_scene_shape *triangles, rt_error *error)
{
    double area = shape_area(triangles);
    int is_one = triangles->triangle_count == 1;
    if (!(area > 0))
        return rt_fail_field(error, RT_ERROR_INPUT, "positions",
                             is_one ? "triangle: its area is zero" : "triangles: all have zero area");
    if (area < RT_AREA_MIN)
        return rt_fail_field(error, RT_ERROR_INPUT, "positions", "%s: area %g m^2; it must be at least %g",
                             is_one ? "triangle" : "triangles, together", area, RT_AREA_MIN);
    return RT_OK;
}

rt_status rt_scene_add_triangles(rt_scene *scene, uint32_t *out, const float *positions, size_t vertex_count,
                                 const uint32_t *indices, size_t triangle_count, const float *normals,
                                 const rt_surface *surface, rt_error *error)
{
    rt_scene_shape shape = {.kind = RT_SHAPE_TRIANGLES, .surface = *surface};
    rt_status status = check_triangles(positions, vertex_count, indices, triangle_count, normals, error);
    if (status != RT_OK)
        return status;

    shape.vertex_count = vertex_count;
    shape.triangle_count = triangle_count;
    shape.positions = copy(positions, vertex_count, 3 * sizeof *positions);
    shape.indices = copy(indices, triangle_count, 3 * sizeof *indices);
    shape.normals = normals ? copy(normals, vertex_count, 3 * sizeof *normals) : NULL;
    if (!shape.positions || !shape.indices || (normals && !shape.normals))
        status = rt_fail(error, RT_ERROR_MEMORY, "out of memory for %zu triangles", triangle_count);
    else if ((status = check_area(&shape, error)) == RT_OK)
        status = add_shape(scene, out, &shape, "triangles", error);
    if (status != RT_OK) {
        free(shape.positions);
        free(shape.indices);
        free(shape.normals);
    }
    return status;
}
