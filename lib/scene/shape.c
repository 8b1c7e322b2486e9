/*
 * shape.c - what all shapes share: checks on adding one, transforms, emission, bounding spheres.
 * lib/shape has what differs by kind.
 */
#include <math.h>
#include <string.h>

#include "base/error.h"
#include "scene/attributes.h"
#include "scene/check.h"
#include "scene/parts.h"
#include "scene/scene.h"
#include "scene/shape_class.h"

static const double pi = 3.14159265358979323846;

enum { shapes_max = 0x3fffffff };

int rt_scene_is_instance(const rt_scene *scene, const rt_scene_shape *shape)
{
    return shape->kind == RT_SHAPE_TRIANGLES && shape->emission == RT_NONE &&
           scene->meshes[shape->mesh].placed > 1;
}

size_t rt_scene_shape_primitives(const rt_scene *scene, const rt_scene_shape *shape)
{
    if (shape->kind != RT_SHAPE_TRIANGLES || rt_scene_is_instance(scene, shape))
        return 1;
    return scene->meshes[shape->mesh].triangle_count;
}

/* ---- Where a shape is --------------------------------------------------------- */

/* Whether a shape has more parameters than it holds itself. */
static int has_many_parameters(const rt_scene_shape *shape)
{
    rt_shape_storage storage = rt_shape_class_of(shape->kind)->storage;
    return storage == RT_STORED_QUAD || storage == RT_STORED_INFINITE;
}

const float *rt_scene_parameters(const rt_scene *scene, const rt_scene_shape *shape)
{
    return has_many_parameters(shape) ? scene->placements[shape->placement].p : shape->p;
}

/* Without a row, it is a mesh as it stands in its file, or a sphere that is not turned. */
rt_affine rt_scene_to_world(const rt_scene *scene, const rt_scene_shape *shape)
{
    rt_affine a = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    if (shape->placement != RT_NONE)
        return scene->placements[shape->placement].to_world;
    for (int i = 0; i < 3 && shape->kind == RT_SHAPE_SPHERE; i++) {
        a.m[i][i] = shape->p[3];
        a.m[i][3] = shape->p[i];
    }
    return a;
}

int rt_scene_is_mirrored(const rt_scene *scene, const rt_scene_shape *shape)
{
    return shape->has_transform &&
           rt_affine_determinant(&scene->placements[shape->placement].to_world) < 0;
}

/* The map of a placed mesh; NULL: the identity. */
static const rt_affine *map_of(const rt_scene *scene, const rt_scene_shape *shape)
{
    return shape->has_transform ? &scene->placements[shape->placement].to_world : NULL;
}

static void place_vertex(float out[3], const rt_scene_mesh *mesh, size_t vertex,
                         const rt_affine *to_world)
{
    const float *position = mesh->positions + 3 * vertex;
    if (!to_world) {
        memcpy(out, position, 3 * sizeof *out);
        return;
    }
    double p[3] = {position[0], position[1], position[2]}, q[3];
    rt_affine_point(q, to_world, p);
    for (int i = 0; i < 3; i++)
        out[i] = (float)q[i];
}

void rt_scene_vertex(const rt_scene *scene, const rt_scene_shape *shape, size_t vertex,
                     float out[3])
{
    place_vertex(out, scene->meshes + shape->mesh, vertex, map_of(scene, shape));
}

double rt_triangle_area(const rt_scene_mesh *mesh, size_t triangle, const rt_affine *to_world)
{
    float v[3][3];
    double a[3], b[3], normal[3];
    const uint32_t *corner = mesh->indices + 3 * triangle;
    for (int i = 0; i < 3; i++)
        place_vertex(v[i], mesh, corner[i], to_world);
    rt_vec_sub(a, v[1], v[0]);
    rt_vec_sub(b, v[2], v[0]);
    rt_vec_cross(normal, a, b);
    return 0.5 * rt_vec_length(normal);
}

/* ---- Emission ---------------------------------------------------------------- */

double rt_scene_primitive_area(const rt_scene *scene, const rt_scene_shape *shape, size_t primitive)
{
    if (shape->kind != RT_SHAPE_TRIANGLES)
        return scene->emissions[shape->emission].area;
    return rt_triangle_area(scene->meshes + shape->mesh, primitive, map_of(scene, shape));
}

/* The radiance that spreads the power, or that the surface or its material has. */
static void radiance_of(float radiance[3], const rt_scene *scene, uint32_t material,
                        const rt_scene_emission *e)
{
    const rt_material *m = scene->materials + material;
    if (!rt_is_black(e->power)) {
        double sides = m->two_sided ? 2 : 1;
        for (int c = 0; c < 3; c++)
            radiance[c] = (float)(e->power[c] / (pi * sides * e->area));
    } else {
        memcpy(radiance, rt_is_black(e->radiance) ? m->emission : e->radiance,
               3 * sizeof *radiance);
    }
}

void rt_scene_shape_radiance(const rt_scene *scene, const rt_scene_shape *shape, float radiance[3])
{
    radiance_of(radiance, scene, shape->material, scene->emissions + shape->emission);
}

static int has_light(const rt_surface *s)
{
    return !rt_is_black(s->radiance) || !rt_is_black(s->power);
}

int rt_scene_has_own_light(const rt_scene *scene, const rt_scene_shape *shape)
{
    if (shape->emission == RT_NONE)
        return 0;
    const rt_scene_emission *e = scene->emissions + shape->emission;
    return !rt_is_black(e->radiance) || !rt_is_black(e->power);
}

int rt_scene_is_cutout(const rt_scene *scene, const rt_scene_shape *shape)
{
    const rt_material *m = scene->materials + shape->material;
    return m->opacity < 1 || m->opacity_texture;
}

uint32_t rt_scene_emission_texture(const rt_scene *scene, const rt_scene_shape *shape)
{
    return rt_scene_has_own_light(scene, shape)
               ? shape->texture
               : scene->materials[shape->material].emission_texture;
}

/* ---- Adding ------------------------------------------------------------------ */

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

/* The texture of a shape multiplies kd of its material, or of the parts of that. */
static rt_status check_texture(const rt_scene *scene, const rt_surface *s, const char *who,
                               rt_error *error)
{
    const rt_material *leaves[RT_PARTS_MOST];
    const size_t count =
        rt_material_leaves(scene, scene->materials + s->material, RT_SIDE_BOTH, leaves);
    rt_status status = RT_OK;
    for (size_t i = 0; i < count && status == RT_OK; i++)
        status = rt_material_check_albedo(scene, leaves[i], s->texture, who, "texture", error);
    return status;
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
    return s->texture && !has_light(s) ? check_texture(scene, s, who, error) : RT_OK;
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
    if (has_light(s) || !rt_is_black(scene->materials[s->material].emission))
        return rt_fail_field(error, RT_ERROR_INPUT, field, "%s: an infinite plane cannot emit",
                             who);
    return RT_OK;
}

static rt_scene_emission emission_of(const rt_new_shape *added)
{
    rt_scene_emission e;
    memcpy(e.radiance, added->surface->radiance, sizeof e.radiance);
    memcpy(e.power, added->surface->power, sizeof e.power);
    e.area = added->area;
    return e;
}

/* Refuses a power that is too large for the shape's area. */
static rt_status check_power(const rt_scene *scene, const rt_new_shape *added, const char *who,
                             rt_error *error)
{
    const rt_scene_emission e = emission_of(added);
    float radiance[3];
    if (rt_is_black(e.power))
        return RT_OK;
    radiance_of(radiance, scene, added->surface->material, &e);
    for (int i = 0; i < 3; i++)
        if (!(radiance[i] <= RT_COLOUR_MAX))
            return rt_fail_field(
                error, RT_ERROR_INPUT, "power",
                "%s: power is %g W on %g m^2; the radiance must not exceed %g W/(m^2 sr)", who,
                e.power[i], e.area, RT_COLOUR_MAX);
    return RT_OK;
}

static rt_status check_shape(const rt_scene *scene, const rt_new_shape *added, const char *who,
                             rt_error *error)
{
    const int is_mesh = added->shape.kind == RT_SHAPE_TRIANGLES;
    rt_status status = check_surface(scene, added->surface, who, error);
    if (status == RT_OK)
        status = rt_attributes_check(scene, is_mesh ? scene->meshes + added->shape.mesh : NULL,
                                     added->surface, who, error);
    if (status == RT_OK && rt_shape_class_of(added->shape.kind)->storage == RT_STORED_INFINITE)
        status = check_infinite(scene, added->surface, who, error);
    else if (status == RT_OK)
        status = check_extent(&added->shape, who, error);
    if (status == RT_OK)
        status = check_power(scene, added, who, error);
    if (status == RT_OK && scene->shape_count >= shapes_max)
        status = rt_fail(error, RT_ERROR_INPUT, "more than %d shapes", shapes_max);
    return status;
}

rt_status rt_scene_add_shape(rt_scene *scene, uint32_t *out, const rt_new_shape *added,
                             const char *who, rt_error *error)
{
    const rt_surface *s = added->surface;
    rt_scene_shape shape = added->shape;
    rt_status status = check_shape(scene, added, who, error);
    if (status != RT_OK)
        return status;
    const int emits = has_light(s) || !rt_is_black(scene->materials[s->material].emission);
    const int is_placed = shape.has_transform || has_many_parameters(&shape);
    status = rt_grow(scene->memory, (void **)&scene->shapes, &scene->shape_room, scene->shape_count,
                     sizeof shape, "the list of shapes", error);
    if (status == RT_OK && emits)
        status = rt_grow(scene->memory, (void **)&scene->emissions, &scene->emission_room,
                         scene->emission_count, sizeof *scene->emissions,
                         "the list of emissive shapes", error);
    if (status == RT_OK && is_placed)
        status = rt_grow(scene->memory, (void **)&scene->placements, &scene->placement_room,
                         scene->placement_count, sizeof *scene->placements,
                         "the list of placements", error);
    if (status != RT_OK)
        return status;
    shape.material = s->material;
    shape.texture = s->texture;
    shape.emission = emits ? (rt_u32)scene->emission_count++ : RT_NONE;
    shape.placement = is_placed ? (rt_u32)scene->placement_count++ : RT_NONE;
    if (emits)
        scene->emissions[shape.emission] = emission_of(added);
    else if (shape.kind == RT_SHAPE_TRIANGLES)
        scene->meshes[shape.mesh].placed++;
    if (is_placed)
        scene->placements[shape.placement] = added->placement;
    if (out)
        *out = (uint32_t)scene->shape_count;
    scene->shapes[scene->shape_count++] = shape;
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

int rt_scene_has_shading_normals(const rt_scene *scene)
{
    for (size_t i = 0; i < scene->shape_count; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        const rt_material *m = scene->materials + shape->material;
        if (rt_material_has_bumps(m) ||
            rt_material_any(scene, m, RT_SIDE_BOTH, rt_material_has_bumps) ||
            (shape->kind == RT_SHAPE_TRIANGLES && scene->meshes[shape->mesh].normals))
            return 1;
    }
    return 0;
}
