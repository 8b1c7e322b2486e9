/* origin.c - remembers places by object, and reports findings there. */
#include "dsl/origin.h"

#include <stdlib.h>
#include <string.h>

static int add_place(rt_places *places, rt_place place)
{
    if (places->count == places->capacity) {
        size_t capacity = places->capacity ? 2 * places->capacity : 64;
        rt_place *items = realloc(places->items, capacity * sizeof *items);
        if (!items)
            return 0;
        places->items = items;
        places->capacity = capacity;
    }
    places->items[places->count++] = place;
    return 1;
}

int rt_origins_add(rt_origins *origins, const rt_block *block, rt_place place)
{
    const rt_field *field;
    if (block->id == RT_BLOCK_CAMERA)
        origins->camera = place;
    if (strcmp(block->word, "light") == 0)
        return add_place(&origins->lights, place);
    /* A shape is what has a material. */
    for (size_t i = 0; (field = rt_block_field(block, i)) != NULL; i++)
        if (field->type == RT_FIELD_MATERIAL)
            return add_place(&origins->shapes, place);
    return 1;
}

/* Reports under way. */
typedef struct reporting {
    const rt_origins *origins;
    rt_reports *reports;
    rt_place last; /* of a light or open shape that was reported, line 0 before the first */
} reporting;

static rt_place place_of(const rt_origins *origins, const rt_finding *finding)
{
    if (finding->light != RT_NONE)
        return origins->lights.items[finding->light];
    if (finding->emitter != RT_NONE)
        return origins->shapes.items[finding->emitter];
    if (finding->kind == RT_FINDING_OPEN_GLASS || finding->other != RT_NONE)
        return origins->shapes.items[finding->shape];
    if (finding->kind == RT_FINDING_NOTHING_IN_VIEW ||
        finding->kind == RT_FINDING_CAMERA_IN_OPAQUE ||
        finding->kind == RT_FINDING_CAMERA_IN_MEDIUM)
        return origins->camera;
    return (rt_place){origins->text, 0, 0, 0, 0, 0};
}

static void report(void *user, const rt_finding *finding)
{
    reporting *r = user;
    rt_place place = place_of(r->origins, finding);
    /* The iterations of a repeat are at one place: say once what is wrong there. */
    if (finding->kind == RT_FINDING_LIGHT_IN_OPAQUE || finding->kind == RT_FINDING_OPEN_GLASS ||
        finding->other != RT_NONE) {
        if (place.source == r->last.source && place.offset == r->last.offset)
            return;
        r->last = place;
    }
    rt_report_finding(r->reports, place, finding);
    if (finding->kind == RT_FINDING_OPEN_GLASS) {
        rt_report_hint(r->reports, "glass is a closed shape, such as a sphere; with ior 1 it is a "
                                   "sheet without refraction");
    } else if (finding->other != RT_NONE) {
        const rt_place *other = &r->origins->shapes.items[finding->other];
        rt_report_hint(r->reports,
                       "the other is at %s:%d; give the material of one of them a higher priority",
                       other->source->path, other->line);
    } else if (finding->shape != RT_NONE) {
        const rt_place *solid = &r->origins->shapes.items[finding->shape];
        rt_text word = rt_place_text(solid);
        rt_report_hint(r->reports, "the %.*s is at %s:%d", (int)word.length, word.at,
                       solid->source->path, solid->line);
    }
}

void rt_origins_report(const rt_origins *origins, const rt_scene *scene, rt_reports *reports)
{
    reporting r = {origins, reports, {NULL, 0, 0, 0, 0, 0}};
    rt_scene_check(scene, report, &r);
}

void rt_origins_free(rt_origins *origins)
{
    free(origins->shapes.items);
    free(origins->lights.items);
    memset(origins, 0, sizeof *origins);
}
