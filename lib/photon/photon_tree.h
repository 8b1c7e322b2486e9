/*
 * photon_tree.h - the tree of photons that the device gathers from; see rt_photon_tree in types.h.
 *
 * The order of the photons is Hilbert's curve through the box around them, by 12 bits an axis;
 * photons of one cell of the curve keep the order of the map. So the tree depends on the map alone,
 * not on the number of threads.
 */
#ifndef RT_LIB_PHOTON_PHOTON_TREE_H
#define RT_LIB_PHOTON_PHOTON_TREE_H

#include "photon/photon_list.h"
#include "types.h"

/* The tree in host memory. All zero is that of no photons. */
typedef struct rt_photon_tree_data {
    rt_photon_tree shape;
    size_t node_count;
    rt_photon_node *nodes;   /* [node_count], on a 64-byte boundary, as are the blocks */
    rt_photon_block *blocks; /* [shape.block_count] */
    void *block;             /* of host memory, that holds both */
    size_t bytes;            /* of it */
    rt_memory *memory;       /* that it counts in; NULL: none */
} rt_photon_tree_data;

/* The most photons of a tree. */
enum { RT_PHOTON_TREE_MAX = 1 << 28 };

/*
 * Sizes and places of all levels of the tree of so many photons; *node_count: its nodes. Fails with
 * RT_ERROR_MEMORY where there are more photons than a tree can hold.
 */
rt_status rt_photon_tree_lay_out(rt_photon_tree *shape, size_t *node_count, size_t photons,
                                 rt_error *error);

/*
 * Builds the tree of a list, which is not referred to afterwards, on `threads` threads. It counts
 * in `memory`.
 */
rt_status rt_photon_tree_build(rt_photon_tree_data *out, const rt_photon_list *list,
                               uint32_t threads, rt_memory *memory, rt_error *error);

/*
 * The same of volume photons, of radius 0: in place of normals, blocks hold what RT_VOLUME_* say.
 * Once their radii are set, rt_photon_tree_bound_spheres bounds their spheres.
 */
rt_status rt_photon_tree_build_in_media(rt_photon_tree_data *out, const rt_photon_list *list,
                                        uint32_t threads, rt_memory *memory, rt_error *error);
void rt_photon_tree_bound_spheres(rt_photon_tree_data *tree);

/* Frees what the tree holds and empties it. */
void rt_photon_tree_free(rt_photon_tree_data *tree);

#endif
