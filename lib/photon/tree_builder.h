/*
 * tree_builder.h - the tree of photons, built on the device that they lie on: the bytes are those
 * of rt_photon_tree_build.
 */
#ifndef RT_LIB_PHOTON_TREE_BUILDER_H
#define RT_LIB_PHOTON_TREE_BUILDER_H

#include "photon/photon_sorter.h"
#include "types.h"

/* Kernels and memory that serve any number of trees. All zero is none. */
typedef struct rt_tree_builder {
    rt_photon_sorter sorter;
    cl_kernel fill, bound_blocks, bound_nodes;
} rt_tree_builder;

/* rt_tree_builder_release undoes it. */
rt_status rt_tree_builder_create(rt_tree_builder *out, rt_device *device, rt_error *error);
void rt_tree_builder_release(rt_tree_builder *builder);

/*
 * Enqueues the building of a tree of this shape, with so many nodes, of photons
 * [shape.photon_count].
 */
rt_status rt_tree_builder_run(rt_tree_builder *builder, cl_mem photons, const rt_photon_tree *shape,
                              size_t node_count, cl_mem nodes, cl_mem blocks, rt_error *error);

/* Memory for the tree of a gatherer, kept from one to the next: see rt_gather_options. */
typedef struct rt_tree_place {
    rt_tree_builder *builder;
    cl_mem nodes, blocks;
    cl_mem scratch, discs; /* as rt_tree_gather has them */
} rt_tree_place;

/* Releases the buffers; the builder stays. */
void rt_tree_place_release(rt_tree_place *place, rt_device *device);

#endif
