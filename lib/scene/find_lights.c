/*
 * find_lights.c - lights inside opaque solids that the camera is not in.
 *
 * The solids are gone through once, and each is compared with the lights whose bounds begin within
 * its own along one axis: their number times that of the lights would be too many.
 */
#include <stdlib.h>

#include "scene/check.h"
#include "scene/inside.h"
#include "scene/inspection.h"

/* A light at a point, or else an area light. */
typedef struct light {
    const rt_scene_light *delta;
    const rt_scene_shape *shape;
    const float *lo, *hi; /* bounds */
    rt_u32 order;         /* in which it is reported */
    rt_u32 solid;         /* the first around it, or RT_NONE */
} light;

static int contains_light(const rt_scene *scene, const rt_scene_shape *solid, const light *light)
{
    for (int i = 0; i < 3; i++)
        if (!(solid->lo[i] <= light->lo[i] && light->hi[i] <= solid->hi[i]))
            return 0;
    if (light->shape)
        return light->shape != solid && rt_shape_contains_shape(scene, solid, light->shape);
    const float *p = light->delta->position;
    return rt_shape_contains(scene, solid, (const double[3]){p[0], p[1], p[2]});
}

/* Lists the lights that are somewhere, delta lights first. */
static size_t list_lights(light lights[RT_CHECKED_MAX], const rt_scene *scene)
{
    size_t count = 0;
    for (size_t i = 0; i < scene->light_count && count < RT_CHECKED_MAX; i++) {
        const rt_scene_light *from = scene->lights + i;
        if (RT_LIGHT_IS_POINT(from->kind))
            lights[count++] = (light){.delta = from, .lo = from->position, .hi = from->position};
    }
    for (size_t i = 0; i < scene->shape_count && count < RT_CHECKED_MAX; i++) {
        const rt_scene_shape *from = scene->shapes + i;
        if (from->emission != RT_NONE)
            lights[count++] = (light){.shape = from, .lo = from->lo, .hi = from->hi};
    }
    for (size_t i = 0; i < count; i++) {
        lights[i].order = (rt_u32)i;
        lights[i].solid = RT_NONE;
    }
    return count;
}

static int compare_begins(const void *a, const void *b)
{
    const light *x = a, *y = b;
    return (x->lo[0] > y->lo[0]) - (x->lo[0] < y->lo[0]);
}

static int compare_orders(const void *a, const void *b)
{
    const light *x = a, *y = b;
    return (x->order > y->order) - (x->order < y->order);
}

/* The first of the lights, sorted by their begin, that begins at x or behind it. */
static size_t first_from(const light *lights, size_t count, float x)
{
    size_t first = 0, end = count;
    while (first < end) {
        size_t middle = first + (end - first) / 2;
        if (lights[middle].lo[0] < x)
            first = middle + 1;
        else
            end = middle;
    }
    return first;
}

static void enclose(light *lights, size_t count, const rt_scene *scene)
{
    const float *eye = scene->camera.eye;
    for (size_t i = 0; i < scene->shape_count; i++) {
        const rt_scene_shape *solid = scene->shapes + i;
        for (size_t k = first_from(lights, count, solid->lo[0]);
             k < count && lights[k].lo[0] <= solid->hi[0]; k++)
            if (lights[k].solid == RT_NONE && contains_light(scene, solid, lights + k) &&
                rt_material_hides(scene->materials + solid->material) &&
                !rt_shape_contains(scene, solid, (const double[3]){eye[0], eye[1], eye[2]}))
                lights[k].solid = (rt_u32)i;
    }
}

void rt_find_lights_inside(rt_inspection *in)
{
    const rt_scene *scene = in->scene;
    light lights[RT_CHECKED_MAX];
    size_t count = list_lights(lights, scene);
    if (count == 0)
        return;
    qsort(lights, count, sizeof *lights, compare_begins);
    enclose(lights, count, scene);
    qsort(lights, count, sizeof *lights, compare_orders);
    for (size_t i = 0; i < count; i++) {
        const light *light = lights + i;
        rt_finding hidden = rt_finding_of(RT_FINDING_LIGHT_IN_OPAQUE);
        if (light->solid == RT_NONE)
            continue;
        hidden.shape = light->solid;
        if (light->shape)
            hidden.emitter = (uint32_t)(light->shape - scene->shapes);
        else
            hidden.light = (uint32_t)(light->delta - scene->lights);
        rt_inspection_report(in, hidden, "this light is inside an opaque %s and never seen",
                             rt_inspection_name(scene->shapes + light->solid));
    }
}
