/* find_leaning.c - meshes of glass with sharp edges whose normals are those of a smooth surface. */
#include <math.h>

#include "base/vec.h"
#include "scene/check.h"
#include "scene/inspection.h"

/* The cosine of 30 degrees, and the part of the area from which on it is told. */
static const double least_cosine = 0.8660254, least_part = 0.02;

/* Triangles of all meshes that are looked at. */
enum { LEANING_MAX = 8000000 };

/* The area of a triangle, twice, and whether one of its normals leans far from it. */
static double area_of(const rt_scene_mesh *mesh, const uint32_t *v, int *leans)
{
    double edges[2][3], normal[3];
    for (int k = 0; k < 3; k++)
        for (size_t e = 0; e < 2; e++)
            edges[e][k] = (double)mesh->positions[3 * (size_t)v[1 + e] + (size_t)k] -
                          mesh->positions[3 * (size_t)v[0] + (size_t)k];
    rt_vec_cross(normal, edges[0], edges[1]);
    const double area = sqrt(rt_vec_dot(normal, normal));
    *leans = 0;
    for (int i = 0; i < 3; i++) {
        const float *n = mesh->normals + 3 * (size_t)v[i];
        const double at[3] = {n[0], n[1], n[2]};
        const double cosine = fabs(rt_vec_dot(at, normal)), length = sqrt(rt_vec_dot(at, at));
        *leans |= cosine < least_cosine * length * area;
    }
    return area;
}

/* The part of a mesh's area from which normals lean far. */
static double leaning_part(const rt_scene_mesh *mesh)
{
    double all = 0, leaning = 0;
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        int leans;
        const double area = area_of(mesh, mesh->indices + 3 * i, &leans);
        all += area;
        leaning += leans ? area : 0;
    }
    return all > 0 ? leaning / all : 0;
}

void rt_find_leaning_normals(rt_inspection *in)
{
    const rt_scene *scene = in->scene;
    size_t work = 0, checked = 0;
    for (size_t i = 0; i < scene->shape_count && checked < RT_CHECKED_MAX; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        const rt_material *m = scene->materials + shape->material;
        if (shape->kind != RT_SHAPE_TRIANGLES || !rt_inspection_is_glass(m) || m->ior == 1)
            continue;
        const rt_scene_mesh *mesh = scene->meshes + shape->mesh;
        checked++;
        if (!mesh->normals || mesh->triangle_count > LEANING_MAX - work)
            continue;
        work += mesh->triangle_count;
        rt_finding leaning = rt_finding_of(RT_FINDING_LEANING_NORMALS);
        const double part = leaning_part(mesh);
        leaning.shape = (uint32_t)i;
        if (part > least_part)
            rt_inspection_report(in, leaning,
                                 "normals lean by more than 30 degrees from %.3g %% of this "
                                 "transparent mesh: its sharp edges, smoothed, refract light as no "
                                 "glass does, and are too dark or too bright",
                                 100 * part);
    }
}
