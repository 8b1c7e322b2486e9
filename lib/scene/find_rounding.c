/* find_rounding.c - meshes that lose by single precision where a transform places them. */
#include <math.h>

#include "mesh/origin.h"
#include "scene/inspection.h"

/* The most that rounding moves a vertex of a shape. */
static double most_of(const rt_scene_shape *shape)
{
    double largest = 0;
    for (int i = 0; i < 3; i++)
        largest = fmax(largest, fmax(fabsf(shape->lo[i]), fabsf(shape->hi[i])));
    return sqrt(3) * 0x1p-24 * largest;
}

static rt_rounding measure(const rt_scene *scene, const rt_scene_shape *shape)
{
    const rt_scene_mesh *mesh = scene->meshes + shape->mesh;
    const rt_affine to_world = rt_scene_to_world(scene, shape);
    rt_rounding rounding = {0, 0, 0};
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        double exact[3][3], rounded[3][3];
        for (int c = 0; c < 3; c++) {
            const uint32_t vertex = mesh->indices[3 * i + (size_t)c];
            const float *p = mesh->positions + 3 * (size_t)vertex;
            float placed[3];
            rt_affine_point(exact[c], &to_world, (const double[3]){p[0], p[1], p[2]});
            rt_scene_vertex(scene, shape, vertex, placed);
            for (int k = 0; k < 3; k++)
                rounded[c][k] = placed[k];
        }
        rt_rounding_add(&rounding, (const double(*)[3])exact, (const double(*)[3])rounded);
    }
    return rounding;
}

/* Whether the bounds alone say that no triangle loses as much. */
static int is_safe(const rt_scene *scene, const rt_scene_shape *shape)
{
    const rt_affine to_world = rt_scene_to_world(scene, shape);
    return most_of(shape) <=
           RT_ROUNDING_MAX * scene->meshes[shape->mesh].finest * rt_affine_similarity(&to_world);
}

void rt_find_rounding(rt_inspection *in)
{
    const rt_scene *scene = in->scene;
    size_t checked = 0;
    for (size_t i = 0; i < scene->shape_count && checked < RT_CHECKED_MAX; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        if (shape->kind != RT_SHAPE_TRIANGLES || !shape->has_transform || is_safe(scene, shape))
            continue;
        checked++;
        const rt_rounding rounding = measure(scene, shape);
        if (rounding.triangles == 0)
            continue;
        rt_finding found = rt_finding_of(RT_FINDING_ROUNDED);
        found.shape = (uint32_t)i;
        rt_inspection_report(in, found,
                             "so far from the origin, single precision moves vertices of %llu of "
                             "%zu triangles by up to %.2g m, %.2g of a triangle",
                             (unsigned long long)rounding.triangles,
                             scene->meshes[shape->mesh].triangle_count, rounding.length,
                             rounding.part);
    }
}
