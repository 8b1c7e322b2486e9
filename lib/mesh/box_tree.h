/* box_tree.h - boxes in the plane about items that lie together, to find those near a place. */
#ifndef RT_LIB_MESH_BOX_TREE_H
#define RT_LIB_MESH_BOX_TREE_H

#include <stddef.h>
#include <stdint.h>

#include "mesh/source.h"

/* Items of a leaf. */
#define RT_BOX_LEAF 8

typedef struct rt_box {
    double lo[2], hi[2];
} rt_box;

extern const rt_box rt_box_empty;

void rt_box_add(rt_box *box, const double point[2]);

/* A binary tree: node 1 is the root, nodes 2 i and 2 i + 1 are below node i, the leaves last. */
typedef struct rt_box_tree {
    rt_box *nodes;
    size_t leaf_count; /* a power of two */
    uint32_t *order;   /* [count]: the items along a curve that fills the plane; leaf k has those
                          from k RT_BOX_LEAF on */
    uint32_t *places;  /* [count]: of each item in that order; behind it in one block */
    size_t count;
    uint64_t steps; /* nodes that were looked at */
    uint64_t asked; /* the steps when a cancel was last asked for */
} rt_box_tree;

/*
 * Makes a tree of empty boxes for items at these points, in the box about them. Fails with
 * RT_ERROR_MEMORY. Free it with rt_box_tree_free, also then.
 */
rt_status rt_box_tree_make(rt_box_tree *tree, const double (*points)[2], size_t count,
                           const rt_mesh_source *source);
void rt_box_tree_free(rt_box_tree *tree);

/* Sets the box of a leaf; those above it are right after rt_box_tree_join or _update. */
void rt_box_tree_set(rt_box_tree *tree, size_t leaf, const rt_box *box);
void rt_box_tree_join(rt_box_tree *tree);
void rt_box_tree_update(rt_box_tree *tree, size_t leaf);

/* A search for the leaves whose boxes meet a box, and a triangle where there is one. */
typedef struct rt_box_search {
    rt_box_tree *tree;
    rt_box box;
    const double (*triangle)[2]; /* counter-clockwise, or NULL */
    size_t stack[64];
    int depth;
} rt_box_search;

void rt_box_search_begin(rt_box_search *search, rt_box_tree *tree, const rt_box *box,
                         const double (*triangle)[2]);

/* The next leaf, or SIZE_MAX. */
size_t rt_box_search_next(rt_box_search *search);

/* The end of the leaf's items in order. */
static inline size_t rt_box_leaf_end(const rt_box_tree *tree, size_t leaf)
{
    const size_t end = (leaf + 1) * RT_BOX_LEAF;
    return end < tree->count ? end : tree->count;
}

#endif
