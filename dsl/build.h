/* build.h - from checked blocks to the scene, through the public interface. */
#ifndef RT_DSL_BUILD_H
#define RT_DSL_BUILD_H

#include "dsl/schema.h"

/*
 * Fills *fields with what a block has before its entries are applied: the defaults, or for `film`
 * and `render` what the scene has so far, as they share one struct.
 */
void rt_build_begin(rt_block_fields *fields, const rt_block *block, const rt_scene *scene);

/* What a block is called by, or refers to. */
typedef struct rt_build_name {
    const char *text; /* the name that the scene gives it, or "" */
    /* receives the index of a material, texture or mesh; of an instance: the mesh */
    uint32_t index;
    /* of a mesh: the texture that its file names; of an instance: the one it has unless it says */
    uint32_t texture;
} rt_build_name;

/*
 * Adds a block to the scene. Fails as the builder calls of rt.h do, with error->field naming a
 * field of the block where it can.
 */
rt_status rt_build_block(rt_scene *scene, const rt_block *block, const rt_block_fields *fields,
                         rt_build_name *name, rt_error *error);

#endif
