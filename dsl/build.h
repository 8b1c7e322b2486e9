/* build.h - from checked blocks to the scene, through the public interface. */
#ifndef RT_DSL_BUILD_H
#define RT_DSL_BUILD_H

#include "dsl/schema.h"

/*
 * Fills *fields with what a block has before its entries are applied: the defaults, or for `film`
 * and `render` what the scene has so far, as they share one struct.
 */
void rt_build_begin(rt_block_fields *fields, const rt_block *block, const rt_scene *scene);

/*
 * Adds a block to the scene. Fails as the builder calls of rt.h do, with error->field naming a
 * field of the block where it can.
 */
rt_status rt_build_block(rt_scene *scene, const rt_block *block, const rt_block_fields *fields,
                         rt_build_name *name, rt_error *error);

#endif
