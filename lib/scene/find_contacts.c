/*
 * find_contacts.c - lights that lie in an opaque surface: which of the two rays meet first, and
 * whether light leaves a point that stands there, is up to rounding.
 */
#include <float.h>
#include <math.h>

#include "scene/check.h"
#include "scene/emitting_side.h"
#include "scene/face.h"
#include "scene/inside.h"
#include "scene/inspection.h"
#include "scene/reach.h"

/*
 * Faces of a light, and points across each, that are looked at, of which more than a row lies in a
 * surface that does not only cross it; and shapes in all.
 */
enum { FACES_MAX = 256, PLACES = 5, PLACES_LEAST = 6, WORK_MAX = 20000000 };

typedef struct search {
    rt_inspection *in;
    size_t work;
} search;

/* Farther than rounding moves a surface, and far less than a gap that one sees. */
static double step_at(const double p[3])
{
    return 4 * FLT_EPSILON * fmax(fmax(fabs(p[0]), fabs(p[1])), fabs(p[2]));
}

/*
 * The opaque shape without light of its own whose surface a point lies in, as a line along d meets
 * it, or RT_NONE.
 */
static uint32_t surface_along(search *s, const rt_scene_shape *light, const double p[3],
                              const double d[3])
{
    /* Shadow rays to a delta light end before it by 2e-6 of their length (light/sample.h). */
    const double step = (light ? 1 : 4) * step_at(p);
    double from[3], distance = 4 * step;
    for (int i = 0; i < 3; i++)
        from[i] = p[i] - 2 * step * d[i];
    const uint32_t shape =
        rt_scene_first_along(s->in->scene, light, from, d, 1, &distance, &s->work);
    return shape != RT_NONE && s->in->scene->shapes[shape].emission == RT_NONE ? shape : RT_NONE;
}

static uint32_t surface_at(search *s, const float position[3])
{
    const double p[3] = {position[0], position[1], position[2]};
    for (int axis = 0; axis < 3; axis++) {
        const uint32_t shape =
            surface_along(s, NULL, p, (const double[3]){axis == 0, axis == 1, axis == 2});
        if (shape != RT_NONE)
            return shape;
    }
    return RT_NONE;
}

static uint32_t surface_of_face(search *s, const rt_scene_shape *light, const rt_face *face)
{
    uint32_t first = RT_NONE;
    int found = 0;
    for (int i = 0; face->area > 0 && i < PLACES * PLACES; i++) {
        double p[3];
        rt_face_point(p, face, (i / PLACES + 0.5) / PLACES, (i % PLACES + 0.5) / PLACES);
        const uint32_t shape = surface_along(s, light, p, face->normal);
        first = first == RT_NONE ? shape : first;
        found += shape != RT_NONE && shape == first;
    }
    return found >= PLACES_LEAST ? first : RT_NONE;
}

/* One that faces away from all there is, is told as that. */
static int is_dark(search *s, const rt_scene_shape *light)
{
    return rt_emitting_side_of(s->in->scene, light, 1, &s->work).miss != RT_MISS_NONE;
}

/* Whether a face bounds a closed mesh: where it touches another shape nothing sees it. */
static int is_of_solid(const search *s, const rt_scene_shape *light, const rt_face *face)
{
    for (int side = -1; side <= 1; side += 2) {
        double p[3];
        for (int i = 0; i < 3; i++)
            p[i] = face->centre[i] + 1e-3 * side * sqrt(face->area) * face->normal[i];
        if (rt_shape_contains(s->in->scene, light, p))
            return 1;
    }
    return 0;
}

/* Boxes and curved shapes, which have no such faces, are solids. */
static uint32_t surface_of(search *s, const rt_scene_shape *light)
{
    const size_t count = rt_face_count(s->in->scene, light);
    for (size_t i = 0; i < count && i < FACES_MAX && s->work <= WORK_MAX; i++) {
        const rt_face face = rt_face_of(s->in->scene, light, i);
        const uint32_t shape = surface_of_face(s, light, &face);
        if (shape != RT_NONE)
            return is_of_solid(s, light, &face) || is_dark(s, light) ? RT_NONE : shape;
    }
    return RT_NONE;
}

static void report(search *s, uint32_t light, uint32_t emitter, uint32_t surface)
{
    rt_finding finding = rt_finding_of(RT_FINDING_LIGHT_IN_SURFACE);
    if (surface == RT_NONE)
        return;
    finding.light = light;
    finding.emitter = emitter;
    finding.shape = surface;
    rt_inspection_report(s->in, finding, "this light lies in the surface of a %s: %s",
                         rt_inspection_name(s->in->scene->shapes + surface),
                         light == RT_NONE ? "which of the two is seen is up to rounding"
                                          : "what it lights is up to rounding");
}

void rt_find_lights_in_surfaces(rt_inspection *in)
{
    const rt_scene *scene = in->scene;
    search s = {in, 0};
    size_t checked = 0;
    for (size_t i = 0; i < scene->light_count && checked < RT_CHECKED_MAX; i++)
        if (RT_LIGHT_IS_POINT(scene->lights[i].kind) && s.work <= WORK_MAX) {
            checked++;
            report(&s, (uint32_t)i, RT_NONE, surface_at(&s, scene->lights[i].position));
        }
    for (size_t i = 0; i < scene->shape_count && checked < RT_CHECKED_MAX; i++)
        if (scene->shapes[i].emission != RT_NONE && s.work <= WORK_MAX) {
            checked++;
            report(&s, RT_NONE, (uint32_t)i, surface_of(&s, scene->shapes + i));
        }
}
