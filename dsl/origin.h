/*
 * origin.h - where the camera, the shapes and the lights of a scene come from, to point at what is
 * wrong with them.
 */
#ifndef RT_DSL_ORIGIN_H
#define RT_DSL_ORIGIN_H

#include "dsl/report.h"
#include "dsl/schema.h"

/* The place of a block, without what its text tells; a scene may have very many. */
typedef struct rt_origin {
    uint32_t at; /* its first byte, counted over all texts */
    uint32_t line;
    uint32_t order; /* as rt_place.order; or the greatest number, when that is greater */
} rt_origin;

/* The origins of blocks, in the order in which the scene counts what they add. */
typedef struct rt_origin_list {
    rt_origin *items;
    size_t count, capacity;
} rt_origin_list;

/* All zero is none. */
typedef struct rt_origins {
    const rt_source *text; /* the first text: what is said of the scene as a whole is said of it */
    rt_place camera;
    rt_origin_list shapes, lights, grids;
    rt_budget *budget; /* that they count in; NULL: none */
} rt_origins;

/* Notes the place of a block that the scene took; returns 0 when memory is exhausted. */
int rt_origins_add(rt_origins *origins, const rt_block *block, rt_place place);

/*
 * Reports all that rt_scene_check finds in the scene, at the blocks that it is about, in these
 * texts.
 */
void rt_origins_report(const rt_origins *origins, const rt_sources *sources, const rt_scene *scene,
                       rt_reports *reports);

void rt_origins_free(rt_origins *origins);

#endif
