/* find_solids.c - transparent solids that meet where their priorities settle nothing. */
#include "scene/check.h"
#include "scene/inside.h"
#include "scene/inspection.h"
#include "scene/overlap.h"
#include "scene/shape_class.h"

static int same_colour(const float a[3], const float b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

static int same_surface(const rt_material *a, const rt_material *b)
{
    return same_colour(a->kd, b->kd) && same_colour(a->ks, b->ks) && same_colour(a->kt, b->kt) &&
           a->roughness == b->roughness && a->kd_texture == b->kd_texture &&
           a->ks_texture == b->ks_texture && a->kt_texture == b->kt_texture;
}

static int same_medium(const rt_material *a, const rt_material *b)
{
    return a->ior == b->ior && same_colour(a->absorption, b->absorption);
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
                     "medium there is that of the solid entered last"
                   : "this %s touches a %s of the same priority and another surface near (%.4g, "
                     "%.4g, %.4g): the material defined first gives the surface there",
        rt_inspection_name(b), rt_inspection_name(a), p[0], p[1], p[2]);
}

void rt_find_meetings(rt_inspection *in)
{
    const rt_scene *scene = in->scene;
    size_t work = 20000000; /* evaluations, about a second */
    uint32_t solids[RT_CHECKED_MAX], count = 0;
    for (size_t i = 0; i < scene->shape_count && count < RT_CHECKED_MAX; i++) {
        const rt_scene_shape *shape = scene->shapes + i;
        if (rt_shape_class_of(shape->kind)->contains &&
            rt_material_is_transparent(scene->materials + shape->material))
            solids[count++] = (uint32_t)i;
    }
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = i + 1; k < count; k++)
            find_meeting(in, solids[i], solids[k], &work);
}
