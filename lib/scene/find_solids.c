/*
 * find_solids.c - transparent solids that meet where their priorities settle nothing, or lie in one
 * of higher priority.
 */
#include <math.h>

#include "scene/check.h"
#include "scene/inside.h"
#include "scene/inspection.h"
#include "scene/overlap.h"
#include "scene/shape_class.h"

/* ---- Meetings -------------------------------------------------------------- */

static int same_colour(const float a[3], const float b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

#define SAME_COLOUR(name) same_colour(a->name, b->name)
#define SAME_NUMBER(name) a->name == b->name
#define SAME_INPUT(TYPE, name, RANGE, NEED, unit, help)                                            \
    &&SAME_##TYPE(name) && a->name##_texture == b->name##_texture
static int same_surface(const rt_material *a, const rt_material *b)
{
    return a->interface == b->interface && a->thin == b->thin && a->blend == b->blend &&
           a->with == b->with && a->weight == b->weight && a->weight_texture == b->weight_texture &&
           a->exponent == b->exponent RT_SURFACE_INPUTS(SAME_INPUT)
                              RT_PRINCIPLED_NUMBERS(SAME_INPUT);
}

static int same_medium(const rt_material *a, const rt_material *b)
{
    return a->ior == b->ior && a->relative_ior == b->relative_ior && a->density == b->density &&
           a->albedo == b->albedo && same_colour(a->absorption, b->absorption) &&
           same_colour(a->scattering, b->scattering) && a->g == b->g;
}

/* Reports two solids that meet if their priorities do not settle what is where they do. */
static void find_meeting(rt_inspection *in, uint32_t first, uint32_t second, size_t *work)
{
    const rt_scene *scene = in->scene;
    const rt_scene_shape *a = scene->shapes + first, *b = scene->shapes + second;
    const rt_material *m = scene->materials + a->material, *n = scene->materials + b->material;
    double p[3];
    if (a->material == b->material || m->priority != n->priority ||
        (same_surface(m, n) && same_medium(m, n)))
        return;
    const rt_meeting meeting = rt_shapes_meeting(scene, b, a, p, work);
    if (meeting == RT_APART || (meeting == RT_TOUCHING && same_surface(m, n)))
        return;
    const int is_overlap = meeting == RT_OVERLAPPING;
    rt_finding finding = rt_finding_of(is_overlap ? RT_FINDING_OVERLAP : RT_FINDING_CONTACT);
    finding.shape = second;
    finding.other = first;
    rt_inspection_report(
        in, finding,
        is_overlap ? "this %s overlaps a %s of the same priority near (%.4g, %.4g, %.4g): the "
                     "medium there is that of the solid entered last, so that modes may differ"
                   : "this %s touches a %s of the same priority and another surface near (%.4g, "
                     "%.4g, %.4g): the material defined first gives the surface there",
        rt_inspection_name(b), rt_inspection_name(a), p[0], p[1], p[2]);
}

/* ---- Hidden ---------------------------------------------------------------- */

/* Reports a solid that has no effect, once. */
static void find_hiding(rt_inspection *in, uint32_t inner, const rt_solids *solids, size_t *work)
{
    const rt_scene *scene = in->scene;
    const rt_scene_shape *a = scene->shapes + inner;
    if (a->emission != RT_NONE)
        return;
    for (uint32_t i = 0; i < solids->count; i++) {
        const rt_scene_shape *b = scene->shapes + solids->shape[i];
        if (scene->materials[a->material].priority >= scene->materials[b->material].priority ||
            !rt_shape_is_within(scene, a, b, work))
            continue;
        rt_finding finding = rt_finding_of(RT_FINDING_HIDDEN);
        finding.shape = inner;
        finding.other = solids->shape[i];
        rt_inspection_report(in, finding,
                             "this %s lies wholly in a %s of higher priority: it has no effect",
                             rt_inspection_name(a), rt_inspection_name(b));
        return;
    }
}

/* ---- Which solids ---------------------------------------------------------- */

enum { SIZES = 512 }; /* powers of two */

static int is_solid(const rt_scene *scene, const rt_scene_shape *shape)
{
    return rt_material_is_transparent(scene->materials + shape->material) &&
           rt_shape_class_of(shape->kind)->contains;
}

static int size_of(const rt_scene_shape *shape)
{
    double square = 0;
    for (int i = 0; i < 3; i++) {
        const double edge = (double)shape->hi[i] - shape->lo[i];
        square += edge * edge;
    }
    return square > 0 ? ilogb(square) / 2 + SIZES / 2 : 0;
}

/* The largest transparent solids: what holds others is among them. */
static void choose_solids(rt_solids *out, const rt_scene *scene)
{
    size_t counts[SIZES] = {0}, room = RT_CHECKED_MAX;
    int all = SIZES; /* from that size on all of them */
    out->count = 0;
    for (size_t i = 0; i < scene->shape_count; i++)
        if (is_solid(scene, scene->shapes + i))
            counts[size_of(scene->shapes + i)]++;
    while (all > 0 && counts[all - 1] <= room)
        room -= counts[--all];
    for (size_t i = 0; i < scene->shape_count; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        if (!is_solid(scene, shape) || size_of(shape) < all - (room > 0))
            continue;
        room -= size_of(shape) < all;
        out->shape[out->count++] = (uint32_t)i;
    }
}

static int has_transparent_material(const rt_scene *scene)
{
    for (size_t i = 0; i < scene->material_count; i++)
        if (rt_material_is_transparent(scene->materials + i))
            return 1;
    return 0;
}

void rt_find_solids(rt_inspection *in)
{
    size_t work = 20000000, more = 10000000; /* evaluations, about a second and half of one */
    rt_solids solids;
    if (!has_transparent_material(in->scene))
        return;
    choose_solids(&solids, in->scene);
    rt_find_nests(in, &solids);
    for (uint32_t i = 0; i < solids.count; i++)
        for (uint32_t k = i + 1; k < solids.count; k++)
            find_meeting(in, solids.shape[i], solids.shape[k], &work);
    for (uint32_t i = 0; i < solids.count; i++)
        find_hiding(in, solids.shape[i], &solids, &more);
}
