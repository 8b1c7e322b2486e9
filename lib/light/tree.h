/* tree.h - the light tree, from which kernels choose a light for a point. */
#ifndef RT_LIB_LIGHT_TREE_H
#define RT_LIB_LIGHT_TREE_H

#include "scene/scene.h"

/* Leaves of the tree, a power of two. */
size_t rt_light_tree_leaves(const rt_scene *scene);

/*
 * Fills nodes[2 leaves] from the lights of the scene, whose finite shapes lie in the bounding
 * sphere of the header, and the shape of each primitive; the environment counts with this share of
 * its weight. Fails only for want of memory.
 */
rt_status rt_light_tree_fill(rt_light_node *nodes, const rt_scene *scene,
                             const rt_scene_header *header, const rt_light_data *lights,
                             const rt_u32 *prim_shape, double environment_share, rt_memory *memory,
                             rt_error *error);

#endif
