/*
 * normals.c - normals of vertices from the triangles around them, and triangles without area.
 *
 * Weights by angle do not depend on how a surface is cut into triangles, those by area do.
 *
 * References:
 *   Thuermer, Wuethrich: "Computing Vertex Normals from Polygonal Facets", Journal of Graphics
 *     Tools 3(1), 1998.
 */
#include "mesh/normals.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* The edges that leave a corner, in double: float coordinates cannot overflow their products. */
static void edges_at(const rt_mesh *mesh, size_t triangle, int corner, double e[3], double f[3])
{
    const uint32_t *v = mesh->indices + 3 * triangle;
    const float *a = mesh->positions + 3 * (size_t)v[corner];
    const float *b = mesh->positions + 3 * (size_t)v[(corner + 1) % 3];
    const float *c = mesh->positions + 3 * (size_t)v[(corner + 2) % 3];
    for (int i = 0; i < 3; i++) {
        e[i] = (double)b[i] - a[i];
        f[i] = (double)c[i] - a[i];
    }
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Twice the area of a triangle times its normal. */
static void area_vector(const rt_mesh *mesh, size_t triangle, double out[3])
{
    double e[3], f[3];
    edges_at(mesh, triangle, 0, e, f);
    out[0] = e[1] * f[2] - e[2] * f[1];
    out[1] = e[2] * f[0] - e[0] * f[2];
    out[2] = e[0] * f[1] - e[1] * f[0];
}

uint64_t rt_normals_zero_area(const rt_mesh *mesh)
{
    uint64_t count = 0;
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        double n[3];
        area_vector(mesh, i, n);
        count += n[0] == 0 && n[1] == 0 && n[2] == 0;
    }
    return count;
}

/* Scales v to length 1; returns 0 when it has no direction. */
static int normalise(double v[3])
{
    double length = sqrt(dot(v, v));
    if (!(length > 0 && length <= DBL_MAX))
        return 0;
    for (int i = 0; i < 3; i++)
        v[i] /= length;
    return 1;
}

/* Writes v at length 1, likewise. */
static int normalise_to(const double v[3], float out[3])
{
    double unit[3] = {v[0], v[1], v[2]};
    if (!normalise(unit))
        return 0;
    for (int i = 0; i < 3; i++)
        out[i] = (float)unit[i];
    return 1;
}

static const char what[] = "the normals of a mesh";

/* Where the sum stands that a vertex has with those which are one with it in the file. */
static size_t sum_at(const rt_mesh *mesh, size_t vertex)
{
    return 3 * (size_t)(mesh->shared ? mesh->shared[vertex] : vertex);
}

/* Adds a triangle's normal at its corners, weighted by the angles there; none without area. */
static void add_face(double *sums, const rt_mesh *mesh, size_t triangle)
{
    double n[3], e[3], f[3];
    area_vector(mesh, triangle, n);
    const double area = sqrt(dot(n, n));
    if (!normalise(n))
        return;
    for (int corner = 0; corner < 3; corner++) {
        double *sum = sums + sum_at(mesh, mesh->indices[3 * triangle + (size_t)corner]);
        edges_at(mesh, triangle, corner, e, f);
        const double angle = atan2(area, dot(e, f));
        for (int axis = 0; axis < 3; axis++)
            sum[axis] += angle * n[axis];
    }
}

/* The sums at all vertices, freed by rt_memory_free; NULL is a failure. */
static double *sum_faces(const rt_mesh *mesh, rt_error *error)
{
    double *sums =
        rt_memory_zeroed(mesh->memory, mesh->vertex_count, 3 * sizeof *sums, what, error);
    for (size_t i = 0; sums && i < mesh->triangle_count; i++)
        add_face(sums, mesh, i);
    return sums;
}

/* Whether the faces around it have a normal. */
static int set_from(const rt_mesh *mesh, const double *sums, size_t vertex, float *normals)
{
    static const float up[3] = {0, 1, 0};
    if (normalise_to(sums + sum_at(mesh, vertex), normals + 3 * vertex))
        return 1;
    memcpy(normals + 3 * vertex, up, sizeof up);
    return 0;
}

rt_status rt_normals_repair(rt_mesh *mesh, uint64_t *replaced, rt_error *error)
{
    double *sums = NULL;
    *replaced = 0;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const float *n = mesh->normals + 3 * i;
        const double wide[3] = {n[0], n[1], n[2]};
        if (normalise_to(wide, mesh->normals + 3 * i))
            continue;
        if (!sums && !(sums = sum_faces(mesh, error)))
            return RT_ERROR_MEMORY;
        const int is_bare = mesh->zero_is_bare && n[0] == 0 && n[1] == 0 && n[2] == 0;
        ++*replaced;
        mesh->bad_normals += (uint64_t)(set_from(mesh, sums, i, mesh->normals) && !is_bare);
    }
    rt_memory_free(sums);
    return RT_OK;
}

rt_status rt_mesh_smooth(rt_mesh *mesh, rt_error *error)
{
    double *sums = sum_faces(mesh, error);
    float *normals =
        sums ? rt_memory_zeroed(mesh->memory, mesh->vertex_count, 3 * sizeof *normals, what, error)
             : NULL;
    if (!normals) {
        rt_memory_free(sums);
        return RT_ERROR_MEMORY;
    }
    for (size_t i = 0; i < mesh->vertex_count; i++)
        set_from(mesh, sums, i, normals);
    rt_memory_free(sums);
    rt_memory_free(mesh->normals);
    mesh->normals = normals;
    return RT_OK;
}
