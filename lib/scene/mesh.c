/* mesh.c - meshes: adding them from memory, and placing them. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "mesh/origin.h"
#include "scene/check.h"
#include "scene/scene.h"

/* Primitives are numbered with 31 bits on the device. */
enum { triangles_max = 0x3fffffff };

void rt_scene_mesh_free(rt_scene_mesh *mesh)
{
    rt_memory_free(mesh->positions);
    rt_memory_free(mesh->normals);
    rt_memory_free(mesh->uv);
    rt_memory_free(mesh->colours);
    rt_attributes_free(&mesh->of_vertices);
    rt_attributes_free(&mesh->of_triangles);
    rt_memory_free(mesh->indices);
    memset(mesh, 0, sizeof *mesh);
}

/* fmax of numbers, without its call. */
static double larger(double a, double b)
{
    return a > b ? a : b;
}

void rt_scene_mesh_measure(rt_scene_mesh *mesh)
{
    double finest = INFINITY; /* squared */
    mesh->area = 0;
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        const uint32_t *corner = mesh->indices + 3 * i;
        const float *v0 = mesh->positions + 3 * (size_t)corner[0];
        const float *v1 = mesh->positions + 3 * (size_t)corner[1];
        const float *v2 = mesh->positions + 3 * (size_t)corner[2];
        double a[3], b[3], c[3], n[3];
        rt_vec_sub(a, v1, v0);
        rt_vec_sub(b, v2, v0);
        rt_vec_sub(c, v2, v1);
        rt_vec_cross(n, a, b);
        const double edge = larger(larger(rt_vec_dot(a, a), rt_vec_dot(b, b)), rt_vec_dot(c, c));
        finest = edge > 0 && edge < finest ? edge : finest;
        mesh->area += 0.5 * rt_vec_length(n);
        for (int v = 0; v < 3; v++)
            for (int k = 0; k < 3; k++) {
                float x = mesh->positions[3 * (size_t)corner[v] + (size_t)k];
                mesh->lo[k] = (i == 0 && v == 0) || x < mesh->lo[k] ? x : mesh->lo[k];
                mesh->hi[k] = (i == 0 && v == 0) || x > mesh->hi[k] ? x : mesh->hi[k];
            }
    }
    mesh->finest = sqrt(finest);
    rt_attributes_measure(&mesh->of_vertices, mesh->indices, 3 * mesh->triangle_count);
    rt_attributes_measure(&mesh->of_triangles, NULL, mesh->triangle_count);
}

rt_status rt_scene_take_mesh(rt_scene *scene, uint32_t *out, const rt_scene_mesh *mesh,
                             rt_error *error)
{
    rt_status status = rt_grow(scene->memory, (void **)&scene->meshes, &scene->mesh_room,
                               scene->mesh_count, sizeof *mesh, "the list of meshes", error);
    if (status != RT_OK)
        return status;
    scene->meshes[scene->mesh_count] = *mesh;
    *out = (uint32_t)scene->mesh_count++;
    return RT_OK;
}

/* ---- From memory ----------------------------------------------------------- */

static rt_status check_vertices(const rt_mesh_data *mesh, rt_error *error)
{
    rt_status status = RT_OK;
    for (size_t i = 0; i < mesh->vertex_count && status == RT_OK; i++) {
        status = rt_check_point(mesh->positions + 3 * i, "triangles", "positions", error);
        if (status == RT_OK && mesh->normals)
            status = rt_check_point(mesh->normals + 3 * i, "triangles", "normals", error);
        if (status == RT_OK && mesh->colours)
            status = rt_check_colour(mesh->colours + 3 * i, "triangles", "colours", error);
        if (status == RT_OK && mesh->uv &&
            !(isfinite(mesh->uv[2 * i]) && isfinite(mesh->uv[2 * i + 1])))
            status =
                rt_fail_field(error, RT_ERROR_INPUT, "uv", "triangles: uv %zu is not finite", i);
    }
    return status;
}

static rt_status check_attribute(const rt_mesh_data *mesh, size_t index, rt_error *error)
{
    const rt_mesh_attribute *const a = mesh->attributes + index;
    const size_t length = a->name ? strlen(a->name) : 0,
                 rows = a->of_triangles ? mesh->triangle_count : mesh->vertex_count;
    if (length == 0 || length >= RT_ATTRIBUTE_NAME)
        return rt_fail_field(error, RT_ERROR_INPUT, "attributes",
                             "triangles: the name of attribute %zu has %zu bytes; it must have 1 "
                             "to %d",
                             index, length, RT_ATTRIBUTE_NAME - 1);
    for (size_t i = 0; i < index; i++)
        if (strcmp(mesh->attributes[i].name, a->name) == 0)
            return rt_fail_field(error, RT_ERROR_INPUT, "attributes",
                                 "triangles: two attributes are called '%s'", a->name);
    if (a->width < 1 || a->width > RT_ATTRIBUTE_WIDTH || !a->values)
        return rt_fail_field(error, RT_ERROR_INPUT, "attributes",
                             "triangles: the attribute '%s' is of %u numbers; it must be of 1 to "
                             "%d, which are given",
                             a->name, a->width, RT_ATTRIBUTE_WIDTH);
    for (size_t i = 0; i < rows * a->width; i++)
        if (!isfinite(a->values[i]))
            return rt_fail_field(error, RT_ERROR_INPUT, "attributes",
                                 "triangles: number %zu of the attribute '%s' is not finite", i,
                                 a->name);
    return RT_OK;
}

static rt_status check_data(const rt_mesh_data *mesh, rt_error *error)
{
    if (mesh->triangle_count == 0 || mesh->triangle_count > triangles_max)
        return rt_fail_field(error, RT_ERROR_INPUT, "triangle_count",
                             "triangles: %zu triangles; there must be 1 to %d",
                             mesh->triangle_count, triangles_max);
    for (size_t i = 0; i < 3 * mesh->triangle_count; i++)
        if (mesh->indices[i] >= mesh->vertex_count)
            return rt_fail_field(error, RT_ERROR_INPUT, "indices",
                                 "triangles: triangle %zu names vertex %u of %zu", i / 3,
                                 mesh->indices[i], mesh->vertex_count);
    rt_status status = check_vertices(mesh, error);
    for (size_t i = 0; i < mesh->attribute_count && status == RT_OK; i++)
        status = check_attribute(mesh, i, error);
    return status;
}

/* Copies count * size bytes, or nothing where there is nothing to copy, or *status is a failure. */
static void *copy(const rt_scene *scene, const void *from, size_t count, size_t size,
                  rt_status *status, rt_error *error)
{
    void *to = from && *status == RT_OK
                   ? rt_memory_alloc(scene->memory, count, size, "a mesh", error)
                   : NULL;
    if (to)
        memcpy(to, from, count * size);
    else if (from)
        *status = RT_ERROR_MEMORY;
    return to;
}

/* Copies the attributes of the vertices or triangles, checked already, into rows of all. */
static rt_status copy_attributes(rt_attributes *to, const rt_scene *scene, const rt_mesh_data *mesh,
                                 int of_triangles, rt_error *error)
{
    const size_t rows = of_triangles ? mesh->triangle_count : mesh->vertex_count;
    rt_status status = RT_OK;
    for (size_t i = 0; i < mesh->attribute_count && status == RT_OK; i++) {
        const rt_mesh_attribute *a = mesh->attributes + i;
        if (!a->of_triangles == !of_triangles)
            status =
                rt_attributes_add(to, a->name, strlen(a->name), a->width, scene->memory, error);
    }
    if (status != RT_OK || to->count == 0)
        return status;
    to->values = rt_memory_alloc(scene->memory, rows, to->width * sizeof(float), "a mesh", error);
    if (!to->values)
        return RT_ERROR_MEMORY;
    float *at = to->values; /* the first row of the next one */
    for (size_t i = 0; i < mesh->attribute_count; i++) {
        const rt_mesh_attribute *a = mesh->attributes + i;
        if (!a->of_triangles != !of_triangles)
            continue;
        for (size_t row = 0; row < rows; row++)
            memcpy(at + row * to->width, a->values + row * a->width, a->width * sizeof *at);
        at += a->width;
    }
    return RT_OK;
}

static rt_status check_area(const rt_scene_mesh *mesh, rt_error *error)
{
    int is_one = mesh->triangle_count == 1;
    if (!(mesh->area > 0))
        return rt_fail_field(error, RT_ERROR_INPUT, "positions",
                             is_one ? "triangle: its area is zero"
                                    : "triangles: all have zero area");
    if (mesh->area < RT_AREA_MIN)
        return rt_fail_field(error, RT_ERROR_INPUT, "positions",
                             "%s: area %g m^2; it must be at least %g",
                             is_one ? "triangle" : "triangles, together", mesh->area, RT_AREA_MIN);
    return RT_OK;
}

/* Takes the positions relative to a point near a mesh that is far away; of floats that is exact. */
static void move_near(rt_scene_mesh *mesh)
{
    double lo[3], hi[3];
    for (int i = 0; i < 3; i++) {
        lo[i] = mesh->lo[i];
        hi[i] = mesh->hi[i];
    }
    if (!rt_mesh_origin(mesh->origin, lo, hi))
        return;
    for (size_t i = 0; i < 3 * mesh->vertex_count; i++)
        mesh->positions[i] = (float)(mesh->positions[i] - mesh->origin[i % 3]);
    rt_scene_mesh_measure(mesh);
}

rt_status rt_scene_add_mesh(rt_scene *scene, uint32_t *out, const rt_mesh_data *mesh,
                            rt_error *error)
{
    rt_scene_mesh made;
    const size_t vertices = mesh->vertex_count;
    rt_status status = check_data(mesh, error);
    if (status != RT_OK)
        return status;

    memset(&made, 0, sizeof made);
    made.next = RT_NONE;
    made.vertex_count = vertices;
    made.triangle_count = mesh->triangle_count;
    made.positions = copy(scene, mesh->positions, vertices, 3 * sizeof(float), &status, error);
    made.normals = copy(scene, mesh->normals, vertices, 3 * sizeof(float), &status, error);
    made.uv = copy(scene, mesh->uv, vertices, 2 * sizeof(float), &status, error);
    made.colours = copy(scene, mesh->colours, vertices, 3 * sizeof(float), &status, error);
    made.indices =
        copy(scene, mesh->indices, mesh->triangle_count, 3 * sizeof(uint32_t), &status, error);
    if (status == RT_OK)
        status = copy_attributes(&made.of_vertices, scene, mesh, 0, error);
    if (status == RT_OK)
        status = copy_attributes(&made.of_triangles, scene, mesh, 1, error);
    if (status != RT_OK)
        goto out;
    rt_scene_mesh_measure(&made);
    move_near(&made);
    status = check_area(&made, error);
    if (status != RT_OK)
        goto out;
    status = rt_scene_take_mesh(scene, out, &made, error);
out:
    if (status != RT_OK)
        rt_scene_mesh_free(&made);
    return status;
}
