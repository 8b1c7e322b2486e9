/*
 * triangles.c - meshes as they are placed: triangles in world space, or an instance of the mesh's
 * own tree.
 *
 * Whether a point is inside is decided by the solid angles of the triangles: over a closed surface
 * they make a full sphere seen from inside, and nothing seen from outside, with no ray that could
 * graze an edge (Van Oosterom and Strackee, "The Solid Angle of a Plane Triangle", IEEE Trans.
 * Biomed. Eng. 30(2), 1983).
 */
#include "shape/edges.h"
#include "shape/placed.h"

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

/*
 * The rounding of a sum of many solid angles, in full spheres; a hole that is smaller goes
 * unnoticed.
 */
static const double rounding = 1e-6;

static rt_shape_boundary boundary(const rt_scene *scene, const rt_scene_shape *shape)
{
    return scene->meshes[shape->mesh].triangle_count == 1 ? RT_BOUNDARY_FLAT
                                                          : RT_BOUNDARY_CURVED_CLOSED;
}

/* ---- Inside ------------------------------------------------------------------ */

/*
 * The solid angle of a triangle of corners a, b, c seen from the origin, in full spheres; positive
 * from behind.
 */
static double solid_angle(const double a[3], const double b[3], const double c[3])
{
    double n[3], la = rt_vec_length(a), lb = rt_vec_length(b), lc = rt_vec_length(c);
    rt_vec_cross(n, b, c);
    return atan2(rt_vec_dot(a, n), la * lb * lc + rt_vec_dot(a, b) * lc + rt_vec_dot(a, c) * lb +
                                       rt_vec_dot(b, c) * la) /
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

static int contains(const rt_scene *scene, const rt_scene_shape *shape, const double p[3])
{
    double q[3];
    return rt_shape_to_object(q, scene, shape, p) ? mesh_contains(scene->meshes + shape->mesh, q)
                                                  : 0;
}

/* ---- Ball and light ---------------------------------------------------------- */

/* About the middle of its bounds: of an instance that of these, else that of its vertices. */
static double bounding_sphere(const rt_scene *scene, const rt_scene_shape *shape, double centre[3])
{
    double radius = rt_bounds_sphere(centre, shape->lo, shape->hi), farthest = 0;
    if (rt_scene_is_instance(scene, shape))
        return radius;
    for (size_t i = 0; i < scene->meshes[shape->mesh].vertex_count; i++) {
        float vertex[3];
        rt_scene_vertex(scene, shape, i, vertex);
        farthest = fmax(farthest, rt_point_distance(centre, vertex));
    }
    return fmin(radius, farthest);
}

static void light(rt_light_data *out, const rt_scene *scene, const rt_scene_shape *shape,
                  size_t primitive)
{
    const uint32_t *corner = scene->meshes[shape->mesh].indices + 3 * primitive;
    float v[3][3];
    double b[3], c[3];
    out->kind = RT_LIGHT_TRIANGLE;
    for (int i = 0; i < 3; i++)
        rt_scene_vertex(scene, shape, corner[i], v[i]);
    memcpy(out->a, v[0], sizeof out->a);
    rt_vec_sub(b, v[1], v[0]);
    rt_vec_sub(c, v[2], v[0]);
    rt_light_set_edges(out, b, c);
}

#define PLACED_MESH(title)                                                                         \
    {                                                                                              \
        .name = title, .storage = RT_STORED_MESH, .faces = RT_FACES_FLAT, .boundary = boundary,    \
        .contains = contains, .bounding_sphere = bounding_sphere, .light = light                   \
    }
const rt_shape_class rt_shape_triangles = PLACED_MESH("mesh");
/* The same: a shape of the scene is one or the other on the device. */
const rt_shape_class rt_shape_instance = PLACED_MESH("mesh");

/* ---- Placing ----------------------------------------------------------------- */

/*
 * The area of a mesh in world space; a map that is no similarity stretches each triangle by its own
 * factor.
 */
static double placed_area(const rt_scene_mesh *mesh, const rt_affine *to_world)
{
    double scale = rt_affine_similarity(to_world), area = 0;
    if (scale > 0)
        return mesh->area * scale * scale;
    for (size_t i = 0; i < mesh->triangle_count; i++)
        area += rt_triangle_area(mesh, i, to_world);
    return area;
}

/* The bounds of the mesh's box as it is placed, rounded outwards. */
static void place_bounds(rt_scene_shape *shape, const rt_scene_mesh *mesh,
                         const rt_affine *to_world)
{
    for (int i = 0; i < 3; i++) {
        const double *a = to_world->m[i];
        double lo = a[3], hi = a[3], reach = fabs(a[3]);
        for (int j = 0; j < 3; j++) {
            double x = a[j] * mesh->lo[j], y = a[j] * mesh->hi[j];
            lo += fmin(x, y);
            hi += fmax(x, y);
            reach += fmax(fabs(x), fabs(y));
        }
        shape->lo[i] = nextafterf((float)(lo - 0x1p-21 * reach), -INFINITY);
        shape->hi[i] = nextafterf((float)(hi + 0x1p-21 * reach), INFINITY);
    }
}

/*
 * From the space of a mesh to the world. Where its origin is far away, the transform is exact: it
 * may bring the mesh back.
 */
static rt_status place_mesh(rt_affine *to_world, const rt_scene_mesh *mesh,
                            const rt_surface *surface, rt_error *error)
{
    rt_status status = rt_surface_transform(to_world, surface, "instance", error);
    if (status != RT_OK || (mesh->origin[0] == 0 && mesh->origin[1] == 0 && mesh->origin[2] == 0))
        return status;
    double moved[3];
    *to_world = rt_affine_exact(&surface->transform);
    rt_affine_point(moved, to_world, mesh->origin);
    for (int i = 0; i < 3; i++)
        to_world->m[i][3] = moved[i];
    return RT_OK;
}

static rt_status add_part(rt_scene *scene, uint32_t mesh, double area, const rt_surface *surface,
                          rt_error *error)
{
    rt_new_shape added = {.shape = {.kind = RT_SHAPE_TRIANGLES, .mesh = mesh}, .surface = surface};
    rt_affine *to_world = &added.placement.to_world;
    rt_status status = place_mesh(to_world, scene->meshes + mesh, surface, error);
    if (status != RT_OK)
        return status;
    added.shape.has_transform = !rt_affine_is_identity(to_world);
    added.area = area;
    place_bounds(&added.shape, scene->meshes + mesh, to_world);
    return rt_scene_add_shape(scene, NULL, &added, "instance", error);
}

/* The area of all parts, which share its power. */
static rt_status area_of_parts(double *area, const rt_scene *scene, uint32_t mesh,
                               const rt_surface *surface, rt_error *error)
{
    rt_affine to_world;
    rt_status status = RT_OK;
    *area = 0;
    for (uint32_t part = mesh; part != RT_NONE && status == RT_OK;
         part = scene->meshes[part].next) {
        status = place_mesh(&to_world, scene->meshes + part, surface, error);
        if (status == RT_OK)
            *area += placed_area(scene->meshes + part, &to_world);
    }
    return status;
}

/* Takes the latest shape back. */
static void take_back(rt_scene *scene)
{
    const rt_scene_shape *shape = scene->shapes + --scene->shape_count;
    scene->emission_count -= shape->emission != RT_NONE;
    scene->placement_count -= shape->placement != RT_NONE;
    scene->meshes[shape->mesh].placed -= shape->emission == RT_NONE;
}

rt_status rt_scene_add_instance(rt_scene *scene, uint32_t *out, uint32_t mesh,
                                const rt_surface *surface, rt_error *error)
{
    const size_t before = scene->shape_count;
    double area = 0;
    rt_status status = RT_OK;
    if (mesh >= scene->mesh_count)
        return rt_fail_field(error, RT_ERROR_INPUT, "mesh",
                             "instance: there is no mesh %u among %zu", mesh, scene->mesh_count);
    const int has_own_textures = surface->texture == scene->meshes[mesh].texture;
    if (!rt_is_black(surface->power))
        status = area_of_parts(&area, scene, mesh, surface, error);
    for (uint32_t part = mesh; part != RT_NONE && status == RT_OK;
         part = scene->meshes[part].next) {
        rt_surface own = *surface;
        if (has_own_textures)
            own.texture = scene->meshes[part].texture;
        status = add_part(scene, part, area, &own, error);
    }
    while (status != RT_OK && scene->shape_count > before)
        take_back(scene);
    if (status == RT_OK && out)
        *out = (uint32_t)before;
    return status;
}

rt_status rt_scene_add_triangles(rt_scene *scene, uint32_t *out, const float *positions,
                                 size_t vertex_count, const uint32_t *indices,
                                 size_t triangle_count, const float *normals,
                                 const rt_surface *surface, rt_error *error)
{
    rt_mesh_data data = {.positions = positions,
                         .normals = normals,
                         .indices = indices,
                         .vertex_count = vertex_count,
                         .triangle_count = triangle_count};
    uint32_t mesh;
    rt_status status = rt_scene_add_mesh(scene, &mesh, &data, error);
    if (status != RT_OK)
        return status;
    status = rt_scene_add_instance(scene, out, mesh, surface, error);
    if (status != RT_OK)
        rt_scene_mesh_free(scene->meshes + --scene->mesh_count);
    return status;
}
