/*
 * find_nests.c - points around which more transparent solids lie than a path keeps in mind: it
 * forgets one, and its light is wrong.
 */
#include "scene/inside.h"
#include "scene/inspection.h"
#include "scene/overlap.h"

enum { samples = 128, listed_max = 8 };

/* Solids around one point, in the order of the scene; no more are counted than can be listed. */
typedef struct nest {
    uint32_t solids[listed_max];
    uint32_t count;
    double point[3];
} nest;

static int bounds_meet(const rt_scene_shape *a, const rt_scene_shape *b)
{
    for (int i = 0; i < 3; i++)
        if (!(a->lo[i] < b->hi[i] && b->lo[i] < a->hi[i]))
            return 0;
    return 1;
}

/* The solids whose bounds meet those of this one, itself included. */
static void choose_near(rt_solids *out, const rt_scene *scene, const rt_scene_shape *solid,
                        const rt_solids *solids)
{
    out->count = 0;
    for (uint32_t i = 0; i < solids->count; i++)
        if (bounds_meet(scene->shapes + solids->shape[i], solid))
            out->shape[out->count++] = solids->shape[i];
}

/* Finds the solids around its point; returns whether they are too many. */
static int look_around(nest *out, const rt_scene *scene, const rt_solids *near, size_t *work)
{
    out->count = 0;
    for (uint32_t i = 0; i < near->count && out->count < listed_max; i++) {
        const rt_scene_shape *shape = scene->shapes + near->shape[i];
        const size_t cost = rt_shape_cost(scene, shape);
        if (*work < cost || out->count + (near->count - i) <= RT_NESTED_MAX)
            return 0;
        *work -= cost;
        if (rt_shape_contains(scene, shape, out->point) == 1)
            out->solids[out->count++] = near->shape[i];
    }
    return out->count > RT_NESTED_MAX;
}

/* Looks for a nest in one solid. */
static int find_nest(nest *out, const rt_scene *scene, const rt_scene_shape *solid,
                     const rt_solids *solids, size_t *work)
{
    rt_solids near;
    choose_near(&near, scene, solid, solids);
    for (int i = 0; i < samples && near.count > RT_NESTED_MAX; i++) {
        rt_shape_sample(out->point, solid, i);
        if (look_around(out, scene, &near, work))
            return 1;
    }
    return 0;
}

static void report(rt_inspection *in, const nest *found)
{
    rt_finding finding = rt_finding_of(RT_FINDING_TOO_MANY_SOLIDS);
    finding.shape = found->solids[found->count - 1];
    finding.solids = found->solids;
    finding.solid_count = found->count;
    rt_inspection_report(in, finding,
                         "this %s and %u more transparent solids lie around (%.4g, %.4g, %.4g): "
                         "light is wrong where they are more than %d in all",
                         rt_inspection_name(in->scene->shapes + finding.shape), found->count - 1,
                         found->point[0], found->point[1], found->point[2], RT_NESTED_MAX);
}

/* One for each solid that is the last defined of a nest. */
void rt_find_nests(rt_inspection *in, const rt_solids *solids)
{
    size_t work = 10000000; /* evaluations, about half a second */
    uint32_t reported[RT_CHECKED_MAX], count = 0;
    for (uint32_t i = 0; i < solids->count; i++) {
        nest found;
        uint32_t k = 0;
        if (!find_nest(&found, in->scene, in->scene->shapes + solids->shape[i], solids, &work))
            continue;
        while (k < count && reported[k] != found.solids[found.count - 1])
            k++;
        if (k < count)
            continue;
        reported[count++] = found.solids[found.count - 1];
        report(in, &found);
    }
}
