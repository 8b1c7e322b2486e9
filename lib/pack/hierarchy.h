/*
 * hierarchy.h - the bounding volume hierarchies of a scene: one over all shapes, and one for each
 * mesh that instances share; instances are leaves of the first.
 */
#ifndef RT_LIB_PACK_HIERARCHY_H
#define RT_LIB_PACK_HIERARCHY_H

#include "accel/bvh.h"
#include "scene/scene.h"

/* Where a mesh's tree lies in the tables. */
typedef struct rt_mesh_tree {
    rt_bvh *bvh; /* NULL: the mesh has none of its own */
    rt_bvh_mesh input;
    rt_u32 first_node, first_block, block_count;
    rt_u32 root; /* in the table of nodes, once that is written */
} rt_mesh_tree;

/* All zero is empty. */
typedef struct rt_hierarchy {
    rt_memory *memory;   /* that it counts in; NULL: none */
    int has_pairs;       /* it is to be written with two-wide nodes */
    rt_bvh_mesh *meshes; /* of the tree of all shapes: its input */
    rt_bvh_quad *quads;
    rt_bvh_analytic *analytic;
    /* [placed_count]: of meshes placed by a transform, in world space */
    float **positions;
    size_t placed_count;
    rt_bvh *top;
    rt_bvh_counts top_counts;
    rt_mesh_tree *trees; /* [mesh_count] */
    size_t mesh_count;
    rt_bvh_counts counts; /* of all trees */
    float lo[3], hi[3];   /* bounds of all finite shapes */
} rt_hierarchy;

/*
 * Builds the trees with so many threads. first_prim has one entry a shape. To be freed whatever is
 * returned; refers to the scene until then.
 */
rt_status rt_hierarchy_build(rt_hierarchy *hierarchy, const rt_scene *scene,
                             const rt_u32 *first_prim, uint32_t threads,
                             rt_stage_progress *progress, rt_error *error);

/* Writes the trees into tables as long as the counts say. */
void rt_hierarchy_write(rt_hierarchy *hierarchy, rt_bvh_node *nodes, rt_tri_block *blocks,
                        rt_u32 *analytic);

/*
 * The same with two-wide nodes, in a table of rt_hierarchy_pairs nodes, of which it may need fewer.
 * Fails with RT_ERROR_MEMORY.
 */
uint64_t rt_hierarchy_pairs(const rt_hierarchy *hierarchy);
rt_status rt_hierarchy_write_pairs(rt_hierarchy *hierarchy, rt_pair_node *nodes,
                                   rt_tri_block *blocks, rt_u32 *analytic, rt_error *error);
void rt_hierarchy_free(rt_hierarchy *hierarchy);

#endif
