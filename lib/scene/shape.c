/*
 * shape.c - what all shapes share: checks on adding one, transforms, emission, bounding spheres.
 * lib/shape has what differs by kind.
 */
#include <math.h>
#include <string.h>

#include "base/error.h"
#include "scene/check.h"
#include "scene/scene.h"
#include "scene/shape_class.h"

static const double pi = 3.14159265358979323846;

enum { shapes_max = 0x3fffffff };

int rt_scene_is_instance(const rt_scene *scene, const rt_scene_shape *shape)
{
    return shape->kind == RT_SHAPE_TRIANGLES && !shape->emits &&
           scene->meshes[shape->mesh].placed > 1;
}

size_t rt_scene_shape_primitives(const rt_scene *scene, const rt_scene_shape *shape)
{
    if (shape->kind != RT_SHAPE_TRIANGLES || rt_scene_is_instance(scene, shape))
        return 1;
    return scene->meshes[shape->mesh].triangle_count;
}

int rt_scene_is_mirrored(const rt_scene_shape *shape)
{
    return shape->has_transform && rt_affine_determinant(&shape->to_world) < 0;
}

void rt_scene_vertex(const rt_scene *scene, const rt_scene_shape *shape, size_t vertex,
                     float out[3])
{
    const float *position = scene->meshes[shape->mesh].positions + 3 * vertex;
    if (!shape->has_transform) {
        memcpy(out, position, 3 * sizeof *out);
        return;
    }
    double p[3] = {position[0], position[1], position[2]}, q[3];
    rt_affine_point(q, &shape->to_world, p);
    for (int i = 0; i < 3; i++)
        out[i] = (float)q[i];
}

double rt_scene_primitive_area(const rt_scene *scene, const rt_scene_shape *shape, size_t primitive)
{
    float v[3][3];
    double a[3], b[3], normal[3];
    if (shape->kind != RT_SHAPE_TRIANGLES)
        return shape->area;
    const uint32_t *corner = scene->meshes[shape->mesh].indices + 3 * primitive;
    for (int i = 0; i < 3; i++)
        rt_scene_vertex(scene, shape, corner[i], v[i]);
    rt_vec_sub(a, v[1], v[0]);
    rt_vec_sub(b, v[2], v[0]);
    rt_vec_cross(normal, a, b);
    return 0.5 * rt_vec_length(normal);
}

void rt_scene_shape_radiance(const rt_scene *scene, const rt_scene_shape *shape, float radiance[3])
{
    const rt_surface *s = &shape->surface;
    const rt_material *m = scene->materials + s->material;
    if (!rt_is_black(s->power)) {
        double sides = m->two_sided ? 2 : 1;
        for (int c = 0; c < 3; c++)
            radiance[c] = (float)(s->power[c] / (pi * sides * shape->area));
    } else {
        memcpy(radiance, rt_is_black(s->radiance) ? m->emission : s->radiance,
               3 * sizeof *radiance);
    }
}

int rt_surface_has_light(const rt_surface *s)
{
    return !rt_is_black(s->radiance) || !rt_is_black(s->power);
}

uint32_t rt_scene_emission_texture(const rt_scene *scene, const rt_scene_shape *shape)
{
    const rt_surface *s = &shape->surface;
    return rt_surface_has_light(s) ? s->texture : scene->materials[s->material].emission_texture;
}

rt_status rt_surface_transform(rt_affine *out, const rt_surface *surface, const char *who,
                               rt_error *error)
{
    rt_affine inverse;
    *out = rt_affine_from(&surface->transform);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            if (!(fabs(out->m[i][j]) <= RT_COORDINATE_MAX))
                return rt_fail_field(error, RT_ERROR_INPUT, "transform",
                                     "%s: the transform has the entry %g; it must lie within %g",
                                     who, out->m[i][j], RT_COORDINATE_MAX);
    if (!rt_affine_inverse(&inverse, out))
        return rt_fail_field(error, RT_ERROR_INPUT, "transform",
                             "%s: the transform cannot be inverted: it flattens the shape", who);
    return RT_OK;
}

static rt_status check_surface(const rt_scene *scene, const rt_surface *s, const char *who,
                               rt_error *error)
{
    rt_status status;
    if (s->material >= scene->material_count)
        return rt_fail_field(error, RT_ERROR_INPUT, "material",
                             "%s: there is no material %u among %zu", who, s->material,
                             scene->material_count);
    if ((status = rt_texture_check_colours(scene, s->texture, who, "texture", error)) != RT_OK ||
        (status = rt_check_colour(s->radiance, who, "radiance", error)) != RT_OK ||
        (status = rt_check_colour(s->power, who, "power", error)) != RT_OK)
        return status;
    if (!rt_is_black(s->radiance) && !rt_is_black(s->power))
        return rt_fail_field(error, RT_ERROR_INPUT, "power", "%s: give radiance or power, not both",
                             who);
    if (s->texture && !rt_surface_has_light(s))
        return rt_material_check_albedo(scene, scene->materials + s->material, s->texture, who,
                                        "texture", error);
    return RT_OK;
}

static rt_status check_extent(const rt_scene_shape *shape, const char *who, rt_error *error)
{
    for (int i = 0; i < 3; i++)
        if (!(shape->lo[i] >= -RT_COORDINATE_MAX && shape->hi[i] <= RT_COORDINATE_MAX))
            return rt_fail_field(error, RT_ERROR_INPUT, "transform",
                                 "%s: it reaches beyond coordinates of %g", who, RT_COORDINATE_MAX);
    return RT_OK;
}

static rt_status check_infinite(const rt_scene *scene, const rt_surface *s, const char *who,
                                rt_error *error)
{
    const char *field = !rt_is_black(s->power)      ? "power"
                        : !rt_is_black(s->radiance) ? "radiance"
                                                    : "material";
    if (rt_surface_has_light(s) || !rt_is_black(scene->materials[s->material].emission))
        return rt_fail_field(error, RT_ERROR_INPUT, field, "%s: an infinite plane cannot emit",
                             who);
    return RT_OK;
}

/* Refuses a power that is too large for the shape's area. */
static rt_status check_power(const rt_scene *scene, const rt_scene_shape *shape, const char *who,
                             rt_error *error)
{
    float radiance[3];
    if (rt_is_black(shape->surface.power))
        return RT_OK;
    rt_scene_shape_radiance(scene, shape, radiance);
    for (int i = 0; i < 3; i++)
        if (!(radiance[i] <= RT_COLOUR_MAX))
            return rt_fail_field(
                error, RT_ERROR_INPUT, "power",
                "%s: power is %g W on %g m^2; the radiance must not exceed %g W/(m^2 sr)", who,
                shape->surface.power[i], shape->area, RT_COLOUR_MAX);
    return RT_OK;
}

rt_status rt_scene_add_shape(rt_scene *scene, uint32_t *out, rt_scene_shape *shape, const char *who,
                             rt_error *error)
{
    const rt_surface *s = &shape->surface;
    rt_status status = check_surface(scene, s, who, error);
    if (status == RT_OK && rt_shape_class_of(shape->kind)->storage == RT_STORED_INFINITE)
        status = check_infinite(scene, s, who, error);
    else if (status == RT_OK)
        status = check_extent(shape, who, error);
    if (status == RT_OK)
        status = check_power(scene, shape, who, error);
    if (status == RT_OK && scene->shape_count >= shapes_max)
        status = rt_fail(error, RT_ERROR_INPUT, "more than %d shapes", shapes_max);
    if (status == RT_OK)
        status = rt_grow((void **)&scene->shapes, &scene->shape_room, scene->shape_count,
                         sizeof *shape, error);
    if (status != RT_OK)
        return status;
    shape->emits = rt_surface_has_light(s) || !rt_is_black(scene->materials[s->material].emission);
    if (shape->kind == RT_SHAPE_TRIANGLES && !shape->emits)
        scene->meshes[shape->mesh].placed++;
    if (out)
        *out = (uint32_t)scene->shape_count;
    scene->shapes[scene->shape_count++] = *shape;
    return RT_OK;
}

double rt_point_distance(const double a[3], const float b[3])
{
    return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

double rt_bounds_sphere(double centre[3], const float lo[3], const float hi[3])
{
    for (int i = 0; i < 3; i++)
        centre[i] = 0.5 * ((double)lo[i] + hi[i]);
    return rt_point_distance(centre, hi);
}

double rt_shape_bounding_sphere(const rt_scene *scene, const rt_scene_shape *shape,
                                double centre[3])
{
    const rt_shape_class *class = rt_shape_class_of(shape->kind);
    return class->bounding_sphere ? class->bounding_sphere(scene, shape, centre)
                                  : rt_bounds_sphere(centre, shape->lo, shape->hi);
}
