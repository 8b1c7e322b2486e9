/* hierarchy.h - a scene's shapes as the builder of the bounding volume hierarchy wants them. */
#ifndef RT_LIB_SCENE_HIERARCHY_H
#define RT_LIB_SCENE_HIERARCHY_H

#include "accel/bvh.h"
#include "scene/scene.h"

/* The lists that input points to, and into the scene. All zero is empty. */
typedef struct rt_hierarchy_shapes {
    rt_bvh_mesh *meshes;
    rt_bvh_quad *quads;
    rt_bvh_analytic *analytic;
    rt_bvh_input input;
} rt_hierarchy_shapes;

/*
 * Lists all shapes but planes; first_prim has one entry a shape. To be freed whatever is returned, after
 * the hierarchy is written.
 */
rt_status rt_hierarchy_list(rt_hierarchy_shapes *lists, const rt_scene *scene, const rt_u32 *first_prim,
                            rt_error *error);
void rt_hierarchy_free(rt_hierarchy_shapes *lists);

#endif
